#include "common/wire/session_spec.h"

#include <algorithm>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"
#include "common/wire/recipe_codec.h"

namespace onesea {
namespace {

using wire::CheckInteger;
using wire::CheckReal;
using wire::CheckSize;

absl::Status CheckName(const std::string& name) {
  const auto allowed = [](char c) {
    return absl::ascii_islower(static_cast<unsigned char>(c)) ||
           absl::ascii_isdigit(static_cast<unsigned char>(c)) || c == '-';
  };
  if (!name.empty() && name.size() <= kSessionNameLengthMax &&
      std::all_of(name.begin(), name.end(), allowed)) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(
      absl::StrCat("name: '", wire::Printable(name, kSessionNameLengthMax),
                   "' is not of the form [a-z0-9-]{1,", kSessionNameLengthMax, "}"));
}

absl::Status CheckPlace(const SessionSpec& spec) {
  if (spec.latitude_deg) {
    ONESEA_RETURN_IF_ERROR(CheckReal("", "latitude_deg", *spec.latitude_deg, -90.0, 90.0));
  }
  if (spec.longitude_deg) {
    ONESEA_RETURN_IF_ERROR(CheckReal("", "longitude_deg", *spec.longitude_deg, -180.0, 360.0));
  }
  ONESEA_RETURN_IF_ERROR(CheckSize("", "probes", spec.probes_m.size(), kProbesMax));
  for (std::size_t n = 0; n < spec.probes_m.size(); ++n) {
    const std::string prefix = absl::StrCat("probes[", n, "].");
    const Vec2d probe = spec.probes_m[n];
    ONESEA_RETURN_IF_ERROR(
        CheckReal(prefix, "x_m", probe.x, -kQueryCoordinateMaxM, kQueryCoordinateMaxM));
    ONESEA_RETURN_IF_ERROR(
        CheckReal(prefix, "y_m", probe.y, -kQueryCoordinateMaxM, kQueryCoordinateMaxM));
  }
  return absl::OkStatus();
}

absl::Status CheckPace(const SessionSpec& spec) {
  const int tick_rate_hz = spec.recipe.tick_rate_hz;
  ONESEA_RETURN_IF_ERROR(CheckInteger("", "stream_rate_hz", spec.stream_rate_hz, 1, tick_rate_hz));
  if (tick_rate_hz % spec.stream_rate_hz != 0) {
    return absl::InvalidArgumentError(absl::StrCat("stream_rate_hz: ", spec.stream_rate_hz,
                                                   " does not divide tick_rate_hz ", tick_rate_hz));
  }
  ONESEA_RETURN_IF_ERROR(CheckReal("", "speed", spec.speed, kSpeedMin, kSpeedMax));
  ONESEA_RETURN_IF_ERROR(CheckInteger("", "lock_step_participants", spec.lock_step_participants, 1,
                                      kLockStepParticipantsMax));
  return CheckReal("", "lock_step_deadline_s", spec.lock_step_deadline_s, 0.001,
                   kLockStepDeadlineMaxS);
}

}  // namespace

absl::Status ValidateSessionSpec(const SessionSpec& spec) {
  ONESEA_RETURN_IF_ERROR(CheckName(spec.name));
  ONESEA_RETURN_IF_ERROR(sea::ValidateRecipe(spec.recipe));
  if (spec.recipe.timeline.size() != 1 || spec.recipe.timeline[0].start_tick != 0) {
    return absl::InvalidArgumentError("timeline: a new session has one sea, at tick 0");
  }
  ONESEA_RETURN_IF_ERROR(wire::CheckRecipeBytes(spec.recipe));
  ONESEA_RETURN_IF_ERROR(CheckPace(spec));
  ONESEA_RETURN_IF_ERROR(wire::ValidateWorldSpec("world.", spec.world));
  return CheckPlace(spec);
}

std::vector<Vec2d> DefaultProbes() {
  return {{0.0, 0.0},      {37.0, 11.0},   {-83.0, 61.0},   {19.0, -127.0},
          {-211.0, -43.0}, {149.0, 223.0}, {307.0, -181.0}, {-97.0, 367.0}};
}

}  // namespace onesea
