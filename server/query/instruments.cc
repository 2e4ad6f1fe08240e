#include "server/query/instruments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/sea/constants.h"
#include "common/sea/point_query.h"

namespace onesea::server {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Vec3d ArmOf(const wire::BodyView& body, Vec3d position_m) {
  return Rotate(body.state.turn, position_m - body.info->centre_of_mass_m);
}

double* Put(Vec3d v, double* to) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
  return to + 3;
}

double* Put(const Quaternion& turn, double* to) {
  to[0] = turn.w;
  return Put(Vec3d{turn.x, turn.y, turn.z}, to + 1);
}

void ReadImu(const wire::Imu& imu, const InstrumentMoment& moment, double* to) {
  const wire::BodyView* now = wire::FindBody(moment.bodies, imu.body_id);
  const wire::BodyView* before = wire::FindBody(moment.before, imu.body_id);
  if (now == nullptr || before == nullptr) return;
  const double per_s = moment.components->recipe.tick_rate_hz;
  const wire::BodyState& state = now->state;
  const Vec3d arm = ArmOf(*now, imu.position_m), spin = state.spin_rad_per_s;
  const Vec3d change = per_s * (state.velocity_m_per_s - before->state.velocity_m_per_s);
  const Vec3d spin_up = per_s * (spin - before->state.spin_rad_per_s);
  const Vec3d felt =
      change + Cross(spin_up, arm) + Cross(spin, Cross(spin, arm)) + Vec3d{0, 0, sea::kGravity};
  to = Put(Rotate(Inverse(state.turn), felt), to);
  to = Put(Rotate(Inverse(state.turn), spin), to);
  Put(state.turn, to);
}

void ReadMotion(const wire::Motion& motion, const InstrumentMoment& moment, double* to) {
  const wire::BodyView* body = wire::FindBody(moment.bodies, motion.body_id);
  if (body == nullptr) return;
  to = Put(body->state.position_m, to);
  to = Put(body->state.turn, to);
  to = Put(body->state.velocity_m_per_s, to);
  Put(body->state.spin_rad_per_s, to);
}

}  // namespace

InstrumentReader::InstrumentReader(std::vector<wire::Instrument> instruments)
    : instruments_(std::move(instruments)) {
  for (const wire::Instrument& instrument : instruments_) {
    Gauge gauge;
    gauge.value = value_count_;
    if (const auto* wave = std::get_if<wire::WaveGauge>(&instrument)) {
      gauge.position_m = {wave->place_m.x, wave->place_m.y, 0.0};
      gauges_.push_back(gauge);
    } else if (const auto* pressure = std::get_if<wire::PressureGauge>(&instrument)) {
      gauge.pressure = true;
      gauge.body_id = pressure->body_id;
      gauge.position_m = pressure->position_m;
      gauges_.push_back(gauge);
    }
    value_count_ += static_cast<std::size_t>(wire::ValueCount(instrument));
  }
}

std::vector<double> InstrumentReader::Read(QueryEngine& engine, const InstrumentMoment& moment) {
  values_.assign(value_count_, kNan);
  double* to = values_.data();
  for (const wire::Instrument& instrument : instruments_) {
    if (const auto* imu = std::get_if<wire::Imu>(&instrument)) ReadImu(*imu, moment, to);
    if (const auto* motion = std::get_if<wire::Motion>(&instrument)) {
      ReadMotion(*motion, moment, to);
    }
    to += wire::ValueCount(instrument);
  }
  if (!gauges_.empty()) ReadGauges(engine, moment);
  return values_;
}

void InstrumentReader::ReadGauges(QueryEngine& engine, const InstrumentMoment& moment) {
  wire::QueryRequest request;
  request.tick = moment.tick;
  for (Gauge& gauge : gauges_) {
    const wire::BodyView* body =
        gauge.body_id == 0 ? nullptr : wire::FindBody(moment.bodies, gauge.body_id);
    const double gone = gauge.body_id != 0 && body == nullptr ? kNan : 0.0;
    gauge.place_m = gauge.position_m + Vec3d{gone, gone, gone};
    if (body != nullptr) gauge.place_m = body->state.position_m + ArmOf(*body, gauge.position_m);
    // A query refuses NaN; what it answers for such a gauge isn't looked at.
    const bool there = std::isfinite(gauge.place_m.x);
    request.points_m.push_back(there ? Vec2d{gauge.place_m.x, gauge.place_m.y} : Vec2d{});
  }
  const absl::StatusOr<wire::QueryAnswer> answer = engine.Answer(
      moment.components, moment.tick, request,
      {.interaction = moment.interaction, .past = nullptr, .water_level = moment.water_level});
  if (!answer.ok()) return;  // a body at the edge of the world: no reading
  for (std::size_t n = 0; n < gauges_.size(); ++n) {
    if (!gauges_[n].pressure) values_[gauges_[n].value] = double{answer->height_m[n]};
  }
  ReadPressures(*engine.SnapshotOf(moment.components, moment.tick), moment, *answer);
}

void InstrumentReader::ReadPressures(const sea::SeaSnapshot& snapshot,
                                     const InstrumentMoment& moment,
                                     const wire::QueryAnswer& surface) {
  constexpr double kRhoG = sea::kWaterDensityKgPerM3 * sea::kGravity;
  const double bottom_m = moment.components->recipe.depth_m;
  const double depth_max_m = bottom_m > 0.0 ? bottom_m : kQueryDepthMaxM;
  const double level_m = wire::WaterLevelAt(moment.water_level, snapshot.time());
  for (std::size_t n = 0; n < gauges_.size(); ++n) {
    const Gauge& gauge = gauges_[n];
    if (!gauge.pressure || !std::isfinite(gauge.place_m.x)) continue;
    const Vec2d place{gauge.place_m.x, gauge.place_m.y};
    const double below_surface_m = double{surface.height_m[n]} - gauge.place_m.z;
    const double below_level_m = level_m - gauge.place_m.z;
    const bool on_land = std::ranges::find(surface.dry_indices, static_cast<std::int32_t>(n)) !=
                         surface.dry_indices.end();
    double& value = values_[gauge.value];
    if (on_land || !(below_surface_m > 0.0)) {
      value = 0.0;
    } else if (!(below_level_m > 0.0)) {
      value = kRhoG * below_surface_m;
    } else {
      const double depth_m = std::min(below_level_m, depth_max_m);
      sea::DepthSample deep;
      sea::SampleAtDepth(*moment.components, snapshot.time(), std::span(&place, 1),
                         std::span(&depth_m, 1), std::span(&deep, 1), snapshot.attenuation().get());
      const double layer_m = moment.interaction == nullptr
                                 ? 0.0
                                 : sea::SampleInteraction(*moment.interaction, place).height_m;
      value = std::max(0.0, kRhoG * (below_level_m + layer_m) + deep.dynamic_pressure_pa);
    }
  }
}

}  // namespace onesea::server
