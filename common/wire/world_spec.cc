#include "common/wire/world_spec.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/wire/bounds.h"

namespace onesea::wire {
namespace {

absl::Status CheckSide(const std::string& prefix, const char* field, int cells) {
  ONESEA_RETURN_IF_ERROR(CheckInteger(prefix, field, cells, kRegionSideMin, kRegionSideMax));
  if (cells % kRegionSideStep == 0) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(prefix, field, ": ", cells, " is not a multiple of ", kRegionSideStep));
}

}  // namespace

absl::Status ValidateKinematics(const std::string& prefix, const Kinematics& kinematics) {
  ONESEA_RETURN_IF_ERROR(
      CheckVector(prefix, "position_m", kinematics.position_m, kQueryCoordinateMaxM));
  const double norm = Dot(kinematics.turn, kinematics.turn);
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "turn squared", norm, 0.999, 1.001));
  ONESEA_RETURN_IF_ERROR(
      CheckVector(prefix, "velocity_m_per_s", kinematics.velocity_m_per_s, kBodySpeedMaxMPerS));
  return CheckVector(prefix, "spin_rad_per_s", kinematics.spin_rad_per_s, kBodySpinMaxRadPerS);
}

absl::Status ValidateRegionSpec(const std::string& prefix, const RegionSpec& region) {
  ONESEA_RETURN_IF_ERROR(
      CheckInteger(prefix, "solver", static_cast<std::int64_t>(region.solver), 1, 3));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "x_m", region.middle_m.x, -kQueryCoordinateMaxM, kQueryCoordinateMaxM));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "y_m", region.middle_m.y, -kQueryCoordinateMaxM, kQueryCoordinateMaxM));
  ONESEA_RETURN_IF_ERROR(CheckSide(prefix, "columns", region.columns));
  ONESEA_RETURN_IF_ERROR(CheckSide(prefix, "rows", region.rows));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "cell_m", region.cell_m, kRegionCellMinM, kRegionCellMaxM));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "damping_per_s", region.damping_per_s, 0.0, 10.0));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "height_step_m", region.height_step_m, kHeightStepMinM, kHeightStepMaxM));
  ONESEA_RETURN_IF_ERROR(
      CheckInteger(prefix, "frames_per_update", region.frames_per_update, 1, kFramesPerUpdateMax));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "rain_drops_per_m2_s", region.rain_drops_per_m2_s, 0.0, kRainMaxPerM2S));
  return CheckReal(prefix, "rest_after_s", region.rest_after_s, 0.0, kRestAfterMaxS);
}

absl::Status ValidateWaterLevel(const std::string& prefix, std::span<const WaterLevel> levels) {
  ONESEA_RETURN_IF_ERROR(CheckSize(prefix, "water_level", levels.size(), kWaterLevelsMax));
  double after_s = -kQueryTimeMaxS;
  for (std::size_t n = 0; n < levels.size(); ++n) {
    const std::string entry = absl::StrCat(prefix, "water_level[", n, "].");
    // Each above the one before; the first also at the start itself.
    ONESEA_RETURN_IF_ERROR(CheckReal(entry, "time_s", levels[n].time_s, after_s, kQueryTimeMaxS));
    ONESEA_RETURN_IF_ERROR(
        CheckReal(entry, "level_m", levels[n].level_m, -kWaterLevelMaxM, kWaterLevelMaxM));
    after_s = levels[n].time_s + 1e-3;
  }
  return absl::OkStatus();
}

double WaterLevelAt(std::span<const WaterLevel> levels, SimTime time) {
  if (levels.empty()) return 0.0;
  const double t = time.Seconds();
  const auto after = std::find_if(levels.begin(), levels.end(),
                                  [t](const WaterLevel& entry) { return entry.time_s > t; });
  if (after == levels.begin()) return after->level_m;
  const auto before = after - 1;
  if (after == levels.end()) return before->level_m;
  const double share = (t - before->time_s) / (after->time_s - before->time_s);
  return before->level_m + share * (after->level_m - before->level_m);
}

absl::Status ValidateRopeSpec(const std::string& prefix, const RopeSpec& rope) {
  ONESEA_RETURN_IF_ERROR(
      CheckVector(prefix, "from.point_m", rope.from.point_m, kQueryCoordinateMaxM));
  ONESEA_RETURN_IF_ERROR(CheckVector(prefix, "to.point_m", rope.to.point_m, kQueryCoordinateMaxM));
  if (rope.from.body_id == rope.to.body_id) {
    return absl::InvalidArgumentError(absl::StrCat(
        prefix, "to.body_id: ", rope.to.body_id,
        rope.to.body_id == 0 ? ": both ends are in the world" : ": both ends are on this body"));
  }
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "length_m", rope.length_m, 1e-3, kRopeLengthMaxM));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "stiffness_n_per_m", rope.stiffness_n_per_m, 1e-6, kRopeStiffnessMaxNPerM));
  return CheckReal(prefix, "damping_n_s_per_m", rope.damping_n_s_per_m, 0.0,
                   kRopeStiffnessMaxNPerM);
}

absl::Status ValidateWorldSpec(const std::string& prefix, const WorldSpec& world) {
  ONESEA_RETURN_IF_ERROR(CheckSize(prefix, "regions", world.regions.size(), kRegionsMax));
  ONESEA_RETURN_IF_ERROR(CheckSize(prefix, "bodies", world.bodies.size(), kBodiesMax));
  std::int64_t cells = 0;
  for (std::size_t n = 0; n < world.regions.size(); ++n) {
    const std::string entry = absl::StrCat(prefix, "regions[", n, "].");
    const RegionSpec& region = world.regions[n];
    ONESEA_RETURN_IF_ERROR(ValidateRegionSpec(entry, region));
    ONESEA_RETURN_IF_ERROR(CheckInteger(entry, "follow_body_id", region.follow_body_id, 0,
                                        static_cast<std::int64_t>(world.bodies.size())));
    cells += static_cast<std::int64_t>(region.columns) * region.rows;
  }
  ONESEA_RETURN_IF_ERROR(CheckInteger(prefix, "regions cells", cells, 0, kRegionCellsMax));
  for (std::size_t n = 0; n < world.bodies.size(); ++n) {
    const std::string entry = absl::StrCat(prefix, "bodies[", n, "].");
    ONESEA_RETURN_IF_ERROR(ValidateBodyDescription(entry + "body.", world.bodies[n].body));
    ONESEA_RETURN_IF_ERROR(ValidateKinematics(entry + "start.", world.bodies[n].start));
  }
  ONESEA_RETURN_IF_ERROR(CheckSize(prefix, "ropes", world.ropes.size(), kRopesMax));
  for (std::size_t n = 0; n < world.ropes.size(); ++n) {
    const std::string entry = absl::StrCat(prefix, "ropes[", n, "].");
    const RopeSpec& rope = world.ropes[n];
    const auto last = static_cast<std::int64_t>(world.bodies.size());
    ONESEA_RETURN_IF_ERROR(CheckInteger(entry, "from.body_id", rope.from.body_id, 0, last));
    ONESEA_RETURN_IF_ERROR(CheckInteger(entry, "to.body_id", rope.to.body_id, 0, last));
    ONESEA_RETURN_IF_ERROR(ValidateRopeSpec(entry, rope));
  }
  if (world.body_wind_m_per_s) {
    ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "body_wind.speed_m_per_s",
                                     Norm(*world.body_wind_m_per_s), 0.0, kWindSpeedMaxMPerS));
  }
  return ValidateWaterLevel(prefix, world.water_level);
}

}  // namespace onesea::wire
