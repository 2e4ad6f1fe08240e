#include "common/wire/direction.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/sea/constants.h"
#include "common/wire/bounds.h"

namespace onesea::wire {

double ToRadFromNauticalDeg(double from_deg) {
  double to_deg = std::fmod(270.0 - from_deg, 360.0);
  if (to_deg < 0.0) to_deg += 360.0;
  return to_deg * (sea::kPi / 180.0);
}

absl::StatusOr<double> DirectionFromProto(const v1::Direction& direction, std::string_view prefix,
                                          std::string_view field, double fallback_rad) {
  switch (direction.sense_case()) {
    case v1::Direction::kToRad:
      ONESEA_RETURN_IF_ERROR(CheckReal(prefix, absl::StrCat(Text(field), ".to_rad"),
                                       direction.to_rad(), -4.0 * sea::kPi, 4.0 * sea::kPi));
      return direction.to_rad();
    case v1::Direction::kFromDeg:
      ONESEA_RETURN_IF_ERROR(CheckReal(prefix, absl::StrCat(Text(field), ".from_deg"),
                                       direction.from_deg(), -360.0, 360.0));
      return ToRadFromNauticalDeg(direction.from_deg());
    case v1::Direction::SENSE_NOT_SET:
      break;
  }
  return fallback_rad;
}

}  // namespace onesea::wire
