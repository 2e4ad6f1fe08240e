#include "common/wire/body_gear.h"

#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/sea/constants.h"
#include "common/wire/bounds.h"

namespace onesea::wire {
namespace {

// Half-open: 0 is refused, and so is NaN.
absl::Status CheckPositive(std::string_view prefix, std::string_view field, double value,
                           double max) {
  return CheckReal(prefix, field, value, 1e-9, max);
}

}  // namespace

absl::Status CheckOffset(const std::string& prefix, const std::string& field, Vec3d v) {
  return CheckVector(prefix, field, v, kHullSizeMaxM);
}

absl::Status ValidateThruster(const std::string& prefix, const Thruster& thruster) {
  ONESEA_RETURN_IF_ERROR(CheckOffset(prefix, "position_m", thruster.position_m));
  ONESEA_RETURN_IF_ERROR(CheckOffset(prefix, "direction", thruster.direction));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "direction length", Norm(thruster.direction), 1e-6, 2.0 * kHullSizeMaxM));
  ONESEA_RETURN_IF_ERROR(CheckPositive(prefix, "diameter_m", thruster.diameter_m, 20.0));
  ONESEA_RETURN_IF_ERROR(CheckPositive(prefix, "turns_per_s_max", thruster.turns_per_s_max, 200.0));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "kt", thruster.kt, 0.0, 1.0));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "kt_slope", thruster.kt_slope, 0.0, 2.0));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "lag_s", thruster.lag_s, 0.0, 60.0));
  return CheckReal(prefix, "steer_rad_max", thruster.steer_rad_max, 0.0, sea::kPi);
}

absl::Status ValidateRudder(const std::string& prefix, const Rudder& rudder, int thrusters) {
  ONESEA_RETURN_IF_ERROR(CheckOffset(prefix, "position_m", rudder.position_m));
  ONESEA_RETURN_IF_ERROR(CheckPositive(prefix, "area_m2", rudder.area_m2, 1000.0));
  ONESEA_RETURN_IF_ERROR(CheckPositive(prefix, "aspect_ratio", rudder.aspect_ratio, 10.0));
  ONESEA_RETURN_IF_ERROR(
      CheckPositive(prefix, "angle_rad_max", rudder.angle_rad_max, 0.5 * sea::kPi));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "lag_s", rudder.lag_s, 0.0, 60.0));
  return CheckInteger(prefix, "behind_thruster", rudder.behind_thruster, -1, thrusters - 1);
}

absl::Status ValidateWindage(const std::string& prefix, const Windage& windage) {
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "frontal_area_m2", windage.frontal_area_m2, 0.0, 1e5));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "lateral_area_m2", windage.lateral_area_m2, 0.0, 1e5));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "frontal_coefficient", windage.frontal_coefficient, 0.0, 5.0));
  ONESEA_RETURN_IF_ERROR(
      CheckReal(prefix, "lateral_coefficient", windage.lateral_coefficient, 0.0, 5.0));
  return CheckOffset(prefix, "centre_m", windage.centre_m);
}

absl::Status ValidateDrag(const std::string& prefix, const Drag& drag) {
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "friction", drag.friction, 0.0, 1.0));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "pressure", drag.pressure, 0.0, 10.0));
  ONESEA_RETURN_IF_ERROR(CheckReal(prefix, "suction", drag.suction, 0.0, 10.0));
  return CheckReal(prefix, "planing", drag.planing, 0.0, 10.0);
}

}  // namespace onesea::wire
