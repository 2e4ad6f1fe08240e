// The driver's boat 100 ms away from the server, each way, against the server's boat.
#include "client/model/boat_predictor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "client/model/local_world.h"
#include "common/wire/world_encoder.h"
#include "server/world/body_presets.h"
#include "server/world/world.h"
#include "tests/sea/fake_sea.h"

namespace onesea::client {
namespace {

constexpr int kTickRateHz = 60;
constexpr int kTicksPerFrame = 2;  // as sessions stream by default
constexpr int kDelayTicks = 6;     // 100 ms
constexpr double kTickS = 1.0 / kTickRateHz;
constexpr double kDegree = std::numbers::pi / 180.0;

// A server, 100 ms of wire, and a driver, in steps of a tick. A picture is drawn in each.
class Drive {
 public:
  Drive(double hs_m, const world::PreparedBody& body, const BoatFigures& figures)
      : sea_(sea::FakeSea({.lengths_m = {97.0, 29.0},
                           .index_max = 8,
                           .hs_m = hs_m,
                           .peak_rad_per_m = 0.15,
                           .query_grid_size = 64})),
        predictor_(figures) {
    boat_ = *world_.Spawn(body, {});
    for (int n = 0; n < 300; ++n) world_.Step(++tick_, sea_);  // comes to rest
    encoder_.Encode(State());
    wire::Frame frame;
    frame.keyframe = true;
    frame.world = encoder_.Keyframe();
    Arrive(frame);
  }

  // One picture later, with these keys.
  void Next(const HelmKeys& keys) {
    ServerTick();
    while (!frames_.empty() && frames_.front().first <= tick_) {
      Arrive(frames_.front().second);
      frames_.pop_front();
    }
    while (!answers_.empty() && answers_.front().arrives <= tick_) {
      predictor_.Confirm(answers_.front().number, TimeOfTick(answers_.front().acts, kTickRateHz));
      answers_.pop_front();
    }
    shown_ = predictor_.At(now());
    helm_.Advance(keys, kTickS);
    if (timer_.MustSend(helm_.order(), tick_ * 1'000'000'000 / kTickRateHz)) {
      predictor_.Give(++number_, now(), helm_.order());
      orders_.push_back({number_, tick_ + kDelayTicks, 0, helm_.order()});
    }
  }

  SimTime now() const { return TimeOfTick(tick_, kTickRateHz); }
  double seconds() const { return now().Seconds(); }
  const wire::BodyState& shown() const { return shown_; }  // the driver's picture
  const wire::BodyState& truth() const { return world_.view()->bodies[0].state; }
  // What somebody without prediction sees at the same moment.
  wire::BodyState streamed() const { return local_.view()->FindBody(boat_)->At(now()); }

 private:
  struct Message {
    std::int64_t number;
    Tick arrives, acts;
    HelmOrder order;
  };

  void ServerTick() {
    while (!orders_.empty() && orders_.front().arrives <= tick_) {
      const Message& order = orders_.front();
      EXPECT_TRUE(
          world_.Apply(wire::DriveBody{boat_, {order.order.throttle}, {order.order.rudder}}).ok());
      answers_.push_back({order.number, tick_ + kDelayTicks, tick_, order.order});
      orders_.pop_front();
    }
    world_.Step(++tick_, sea_);
    if (tick_ % kTicksPerFrame != 0) return;
    wire::Frame frame;
    frame.world = encoder_.Encode(State());
    frames_.emplace_back(tick_ + kDelayTicks, frame);
  }
  wire::WorldState State() const {
    return {.tick = tick_,
            .interaction = world_.view()->interaction.get(),
            .bodies = world_.view()->bodies,
            .water_level_m = 0.0,
            .spray = {}};
  }
  void Arrive(const wire::Frame& frame) {
    const wire::Frame sent = wire::DecodeFrame(wire::EncodeFrame(frame)).value();
    ASSERT_TRUE(local_.Apply(sent, kTickRateHz).ok());
    const auto view = local_.view();
    predictor_.Learn(view->time(), view->FindBody(boat_)->At(view->time()));
  }

  std::shared_ptr<const sea::Components> sea_;
  world::World world_{world::WorldOptions{}};
  wire::WorldEncoder encoder_{kTickS};
  std::uint32_t boat_ = 0;
  Tick tick_ = 0;
  std::deque<Message> orders_, answers_;
  std::deque<std::pair<Tick, wire::Frame>> frames_;
  LocalWorld local_;
  Helm helm_;
  OrderTimer timer_;
  BoatPredictor predictor_;
  std::int64_t number_ = 0;
  wire::BodyState shown_;
};

struct Errors {
  double place_rms_m = 0, place_max_m = 0, heading_rms_deg = 0, heading_max_deg = 0;
  double height_rms_m = 0, tilt_rms_deg = 0;
  double jump_max_m = 0;  // what one picture moved beyond the picture before and after it
  double speed_max_m_per_s = 0;
};

double HeadingError(const wire::BodyState& a, const wire::BodyState& b) {
  return std::remainder(HeadingOf(a.turn) - HeadingOf(b.turn), 2.0 * std::numbers::pi) / kDegree;
}

// Full ahead, hard to port, hard to starboard, slow, and astern: a minute.
HelmKeys Lesson(double t) {
  const auto in = [&](double from, double to) { return t >= from && t < to; };
  return {.ahead = in(1, 3),
          .astern = in(34, 36) || in(44, 46),
          .port = in(14, 18) || in(40, 42),
          .starboard = in(22, 24.5) || in(28, 28.2) || in(50, 52)};
}

Errors Measure(Drive& drive, const std::function<wire::BodyState()>& seen) {
  Errors errors;
  const double start_s = drive.seconds();
  wire::BodyState last, before_last;
  int pictures = 0;
  while (drive.seconds() - start_s < 60.0) {
    drive.Next(Lesson(drive.seconds() - start_s));
    const wire::BodyState shown = seen(), &truth = drive.truth();
    const Vec3d off = shown.position_m - truth.position_m;
    const double place_m = std::hypot(off.x, off.y), heading_deg = HeadingError(shown, truth);
    const double tilt_deg = AngleBetween(shown.turn, truth.turn) / kDegree;
    errors.place_rms_m += place_m * place_m;
    errors.place_max_m = std::max(errors.place_max_m, place_m);
    errors.heading_rms_deg += heading_deg * heading_deg;
    errors.heading_max_deg = std::max(errors.heading_max_deg, std::abs(heading_deg));
    errors.height_rms_m += off.z * off.z;
    errors.tilt_rms_deg += std::max(0.0, tilt_deg * tilt_deg - heading_deg * heading_deg);
    errors.speed_max_m_per_s =
        std::max(errors.speed_max_m_per_s, Norm(drive.truth().velocity_m_per_s));
    if (++pictures > 2) {
      const Vec3d jump = shown.position_m - 2.0 * last.position_m + before_last.position_m;
      errors.jump_max_m = std::max(errors.jump_max_m, Norm(jump));
    }
    before_last = last;
    last = shown;
  }
  for (double* sum :
       {&errors.place_rms_m, &errors.heading_rms_deg, &errors.height_rms_m, &errors.tilt_rms_deg}) {
    *sum = std::sqrt(*sum / pictures);
  }
  return errors;
}

void Print(const std::string& name, const Errors& e) {
  std::printf(
      "%-28s place %.3f m rms %.3f max, heading %.2f deg rms %.2f max, height %.3f m rms, "
      "tilt %.2f deg rms, jump %.4f m, top speed %.1f m/s\n",
      name.c_str(), e.place_rms_m, e.place_max_m, e.heading_rms_deg, e.heading_max_deg,
      e.height_rms_m, e.tilt_rms_deg, e.jump_max_m, e.speed_max_m_per_s);
}

struct Boat {
  world::PreparedBody body;
  BoatFigures figures;
};

Boat Prepared(const wire::BodyDescription& description) {
  Boat boat{.body = *world::PrepareBody(description), .figures = {}};
  boat.figures = FiguresOf(boat.body.description);  // what a driver is told of it
  return boat;
}

Boat BoxBoat() {
  wire::BodyDescription boat;
  boat.name = "boat";
  boat.shape = wire::BodyShape{.kind = wire::ShapeKind::kBox, .size_m = {6.0, 2.2, 1.1}};
  boat.mass_kg = 1900.0;
  boat.centre_of_mass_m = Vec3d{0, 0, -0.22};
  // A box, but one with a bow: it meets less resistance than its flat front would.
  boat.drag = wire::Drag{.friction = 0.004, .pressure = 0.12, .suction = 0.08, .planing = 0.0};
  boat.windage =
      wire::Windage{.frontal_area_m2 = 2.5, .lateral_area_m2 = 6.0, .centre_m = {0, 0, 0.5}};
  wire::Thruster motor;
  motor.position_m = {-2.9, 0, -0.85};
  motor.diameter_m = 0.4;
  motor.turns_per_s_max = 25.0;
  motor.steer_rad_max = 0.6;
  boat.thrusters.push_back(motor);
  return Prepared(boat);
}

Boat PresetBoat(const char* name) {
  wire::BodyDescription named;
  named.preset = name;
  return Prepared(named);
}

struct Scene {
  std::string name;
  Boat (*boat)();
  double hs_m;
};

class Lessons : public testing::TestWithParam<Scene> {};
INSTANTIATE_TEST_SUITE_P(
    Seas, Lessons,
    testing::Values(Scene{"BoxInCalm", BoxBoat, 0.01}, Scene{"BoxInWaves", BoxBoat, 0.6},
                    Scene{"MotorBoatInCalm", [] { return PresetBoat("boat"); }, 0.01},
                    Scene{"MotorBoatInWaves", [] { return PresetBoat("boat"); }, 0.6},
                    Scene{"WorkBoatInCalm", [] { return PresetBoat("work-boat"); }, 0.01},
                    Scene{"WorkBoatInWaves", [] { return PresetBoat("work-boat"); }, 0.6}),
    [](const auto& info) { return info.param.name; });

TEST_P(Lessons, ThePictureIsWhereTheServersBoatIs) {
  const Boat boat = GetParam().boat();
  Drive drive(GetParam().hs_m, boat.body, boat.figures);
  const Errors e = Measure(drive, [&] { return drive.shown(); });
  Print("predicted", e);
  EXPECT_GT(e.speed_max_m_per_s, 4.0);
  EXPECT_LT(e.place_rms_m, 0.03);
  EXPECT_LT(e.place_max_m, 0.12);
  EXPECT_LT(e.heading_rms_deg, 0.5);
  EXPECT_LT(e.heading_max_deg, 2.5);
  EXPECT_LT(e.height_rms_m, 0.03);
  EXPECT_LT(e.tilt_rms_deg, 2.0);
  EXPECT_LT(e.jump_max_m, 0.025);
  Drive other(GetParam().hs_m, boat.body, boat.figures);
  Print("as streamed, for comparison", Measure(other, [&] { return other.streamed(); }));
}

// A boat of which nothing is known but that it is one: figures off by half.
TEST_P(Lessons, WrongFiguresAreMadeGoodByTheNews) {
  const Boat boat = GetParam().boat();
  BoatFigures figures = boat.figures;
  figures.thrust_m_per_s2 *= 0.5;
  figures.fall_per_s *= 0.5;
  figures.drag_per_m *= 2.0;
  figures.turn_by_thrust_rad_per_m *= 1.5;
  Drive drive(GetParam().hs_m, boat.body, figures);
  const Errors e = Measure(drive, [&] { return drive.shown(); });
  Print("with wrong figures", e);
  EXPECT_LT(e.place_rms_m, 0.04);
  EXPECT_LT(e.heading_max_deg, 3.0);
  EXPECT_LT(e.jump_max_m, 0.03);
}

// The first picture in which the boat has turned by a degree more than it would have.
template <typename State>
int PictureOfADegree(const std::vector<State>& turning, const std::vector<State>& steady) {
  for (std::size_t n = 0; n < turning.size(); ++n) {
    if (HeadingError(turning[n], steady[n]) > 1.0) return static_cast<int>(n);
  }
  return -1;
}

// Two drivers in the same water, one of whom puts the wheel over. They differ in the next picture,
// and n pictures later the boat has turned as the server's will have n ticks after the order came
// there: nothing of the way is felt, until the news of the server's turn come.
TEST(BoatPredictor, AnOrderShowsInTheNextPicture) {
  const Boat boat = PresetBoat("boat");
  Drive steady(0.01, boat.body, boat.figures), turning(0.01, boat.body, boat.figures);
  for (int n = 0; n < 900; ++n) {
    for (Drive* drive : {&steady, &turning}) drive->Next({.ahead = n < 120});
  }
  std::vector<wire::BodyState> shown, truth, streamed, shown_0, truth_0, streamed_0;
  for (int n = 0; n < 60; ++n) {
    steady.Next({});
    turning.Next({.port = true});
    shown.push_back(turning.shown());
    truth.push_back(turning.truth());
    streamed.push_back(turning.streamed());
    shown_0.push_back(steady.shown());
    truth_0.push_back(steady.truth());
    streamed_0.push_back(steady.streamed());
  }
  // Picture 0 was drawn before the key was read.
  EXPECT_EQ(HeadingError(shown[0], shown_0[0]), 0.0);
  for (std::size_t n = 1; n <= kDelayTicks; ++n) {
    const double here_deg = HeadingError(shown[n], shown_0[n]);
    const double there_deg = HeadingError(truth[n + kDelayTicks], truth_0[n + kDelayTicks]);
    EXPECT_GT(here_deg, 0.0) << n;
    EXPECT_NEAR(here_deg, there_deg, 0.001 + 0.4 * there_deg) << n;
    EXPECT_EQ(HeadingError(truth[n], truth_0[n]), 0.0) << n;  // the server hasn't heard of it
  }
  const int here = PictureOfADegree(shown, shown_0), there = PictureOfADegree(truth, truth_0);
  const int news = PictureOfADegree(streamed, streamed_0);
  std::printf("turned by a degree: shown in picture %d, the server's boat %d, as streamed %d\n",
              here, there, news);
  EXPECT_GT(here, 0);
  EXPECT_LE(here, there + 1);
  EXPECT_LT(here, news);
}

TEST(BoatPredictor, AFarPlaceIsNotEasedTo) {
  BoatPredictor predictor{BoatFigures()};
  wire::BodyState state;
  predictor.Learn(SimTime::FromSeconds(1.0), state);
  predictor.At(SimTime::FromSeconds(1.1));
  state.position_m = {500, 0, 0};
  predictor.Learn(SimTime::FromSeconds(1.2), state);
  EXPECT_NEAR(predictor.At(SimTime::FromSeconds(1.3)).position_m.x, 500.0, 0.1);
}

// The link is lost: the boat stands after a while, as all bodies do, instead of leaving the world.
TEST(BoatPredictor, WithoutNewsItStands) {
  BoatPredictor predictor{BoatFigures()};
  wire::BodyState state;
  state.velocity_m_per_s = {6, 0, 0};
  predictor.Learn(SimTime::FromSeconds(1.0), state);
  const double x_m = predictor.At(SimTime::FromSeconds(10.0)).position_m.x;
  EXPECT_LT(x_m, 6.0 * BoatPredictor::kAheadMaxS);
  EXPECT_EQ(predictor.At(SimTime::FromSeconds(3600.0)).position_m.x, x_m);
}

TEST(BoatPredictor, AWithdrawnOrderLeavesNothing) {
  BoatPredictor with{BoatFigures()}, without{BoatFigures()};
  wire::BodyState state;
  for (BoatPredictor* predictor : {&with, &without}) predictor->Learn({}, state);
  with.Give(1, SimTime::FromSeconds(0.1), {1.0, 1.0});
  with.Withdraw(1);
  const SimTime later = SimTime::FromSeconds(0.5);
  EXPECT_EQ(with.At(later).position_m, without.At(later).position_m);
}

}  // namespace
}  // namespace onesea::client
