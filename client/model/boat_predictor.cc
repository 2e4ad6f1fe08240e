#include "client/model/boat_predictor.h"

#include <algorithm>
#include <cmath>

#include "common/base/quaternion.h"

namespace onesea::client {
namespace {

constexpr double kStepS = 1.0 / 60.0;
constexpr double kFadeS = 1.0;      // of heave, roll and pitch
constexpr double kSettleS = 2.0;    // so long an order's place among the others may still change
constexpr double kMissingMax = 10;  // m/s², rad/s²: a collision is not a tendency

Vec3d TurnBetween(const Quaternion& from, const Quaternion& to) {
  Quaternion q = to * Inverse(from);
  if (q.w < 0.0) q = {-q.w, -q.x, -q.y, -q.z};
  const Vec3d axis{q.x, q.y, q.z};
  const double sine = Norm(axis);
  if (!(sine > 1e-12)) return {};
  return (2.0 * std::atan2(sine, q.w) / sine) * axis;
}

// The state a little later, with its drive; `missing` is added to what the equations say.
void StepOn(const BoatFigures& figures, const BoatDrive& drive, const PlaneMotion& missing,
            double seconds, wire::BodyState& state) {
  PlaneMotion motion = PlaneMotionOf(state);
  const PlaneMotion rate = Acceleration(figures, drive, motion);
  const double turn = motion.turn;
  motion.ahead += seconds * (rate.ahead + missing.ahead);
  motion.port += seconds * (rate.port + missing.port);
  motion.turn += seconds * (rate.turn + missing.turn);
  const double yaw_rad = 0.5 * seconds * (turn + motion.turn);
  const double heading = HeadingOf(state.turn) + yaw_rad;
  const double c = std::cos(heading), s = std::sin(heading);
  const double fade = std::exp(-seconds / kFadeS);
  const Vec3d before = state.velocity_m_per_s;
  state.velocity_m_per_s = {c * motion.ahead - s * motion.port, s * motion.ahead + c * motion.port,
                            fade * before.z};
  state.position_m = state.position_m + 0.5 * seconds * (before + state.velocity_m_per_s);
  const Vec3d tilt = seconds * state.spin_rad_per_s;
  state.turn = Normalised(TurnBy({tilt.x, tilt.y, yaw_rad}) * state.turn);
  state.spin_rad_per_s = {fade * state.spin_rad_per_s.x, fade * state.spin_rad_per_s.y,
                          motion.turn};
}

void LearnPart(double seen, double reckoned, double& missing) {
  missing =
      std::clamp(missing + (seen - reckoned) / BoatPredictor::kLearnS, -kMissingMax, kMissingMax);
}

}  // namespace

// Whatever `change` does to what is reckoned for the moment shown last, is not seen at once.
template <typename Change>
void BoatPredictor::Ease(const Change& change) {
  if (!shown_ || !anchor_) return change();
  const wire::BodyState before = Reckon(*shown_);
  change();
  const wire::BodyState after = Reckon(*shown_);
  offset_.place_m = offset_.place_m + (before.position_m - after.position_m);
  offset_.turn_rad = offset_.turn_rad + TurnBetween(after.turn, before.turn);
  if (!(Norm(offset_.place_m) < kEaseMaxM)) offset_ = {};
}

void BoatPredictor::Give(std::int64_t number, SimTime time, const HelmOrder& order) {
  given_.push_back({number, time, std::nullopt, order});
}

void BoatPredictor::Confirm(std::int64_t number, SimTime time) {
  Ease([&] {
    for (Given& given : given_) {
      if (given.number == number) given.acts = time;
    }
  });
}

void BoatPredictor::Withdraw(std::int64_t number) {
  Ease([&] { std::erase_if(given_, [&](const Given& g) { return g.number == number; }); });
}

BoatDrive BoatPredictor::DriveAt(SimTime time) const {
  BoatDrive drive = settled_;
  SimTime at = settled_time_;
  HelmOrder order = settled_order_;
  for (const Given& given : given_) {
    if (!given.acts) continue;
    const SimTime until = std::clamp(*given.acts, at, std::max(at, time));
    AdvanceDrive(figures_, order.throttle, order.rudder, (until - at).Seconds(), drive);
    at = until;
    if (*given.acts > time) return drive;
    order = given.order;
  }
  AdvanceDrive(figures_, order.throttle, order.rudder, std::max(0.0, (time - at).Seconds()), drive);
  return drive;
}

// Orders that act before `time` become part of settled_.
void BoatPredictor::Settle(SimTime time) {
  const auto is_past = [&](const Given& given) { return given.acts && *given.acts < time; };
  // One that nobody answered for goes with the first after it that acted.
  while (std::any_of(given_.begin(), given_.end(), is_past)) {
    const Given& first = given_.front();
    if (is_past(first)) {
      const double seconds = std::max(0.0, (*first.acts - settled_time_).Seconds());
      AdvanceDrive(figures_, settled_order_.throttle, settled_order_.rudder, seconds, settled_);
      settled_time_ = std::max(settled_time_, *first.acts);
      settled_order_ = first.order;
    }
    given_.pop_front();
  }
}

wire::BodyState BoatPredictor::Reckon(SimTime time) const {
  wire::BodyState state = anchor_->state;
  BoatDrive drive = anchor_->drive;
  const double span_s = std::clamp((time - anchor_->time).Seconds(), 0.0, kAheadMaxS);
  const int steps = static_cast<int>(std::ceil(span_s / kStepS));
  const double step_s = span_s / std::max(steps, 1);
  for (int n = 0; n < steps; ++n) {
    const SimTime middle = anchor_->time + SimTime::FromSeconds((n + 0.5) * step_s);
    HelmOrder order = settled_order_;
    for (const Given& given : given_) {
      if (given.acts.value_or(given.given) <= middle) order = given.order;
    }
    AdvanceDrive(figures_, order.throttle, order.rudder, step_s, drive);
    StepOn(figures_, drive, missing_, step_s, state);
  }
  return state;
}

void BoatPredictor::Learn(SimTime time, const wire::BodyState& state) {
  if (anchor_ && time <= anchor_->time) return;
  Ease([&] {
    if (anchor_ && (time - anchor_->time).Seconds() < kAheadMaxS) {
      // As the server had it: orders that weren't there yet have not acted.
      wire::BodyState reckoned = anchor_->state;
      BoatDrive drive = anchor_->drive;
      const double span_s = (time - anchor_->time).Seconds();
      const int steps = static_cast<int>(std::ceil(span_s / kStepS - 1e-6));
      for (int n = 1; n <= steps; ++n) {
        drive = DriveAt(anchor_->time + SimTime::FromSeconds(n * span_s / steps));
        StepOn(figures_, drive, missing_, span_s / steps, reckoned);
      }
      const PlaneMotion seen = PlaneMotionOf(state), guess = PlaneMotionOf(reckoned);
      LearnPart(seen.ahead, guess.ahead, missing_.ahead);
      LearnPart(seen.port, guess.port, missing_.port);
      LearnPart(seen.turn, guess.turn, missing_.turn);
    } else {
      missing_ = {};
      settled_time_ = time;
    }
    Settle(time - SimTime::FromSeconds(kSettleS));
    anchor_ = Anchor{time, state, DriveAt(time)};
  });
}

wire::BodyState BoatPredictor::At(SimTime time) {
  if (shown_) {
    const double keep = std::exp(-std::max(0.0, (time - *shown_).Seconds()) / kEaseS);
    offset_.place_m = keep * offset_.place_m;
    offset_.turn_rad = keep * offset_.turn_rad;
  }
  shown_ = time;
  wire::BodyState state = Reckon(time);
  state.position_m = state.position_m + offset_.place_m;
  state.turn = Normalised(TurnBy(offset_.turn_rad) * state.turn);
  return state;
}

}  // namespace onesea::client
