#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/sea/recipe.h"
#include "common/wire/bounds.h"
#include "onesea/v1/recipe.pb.h"

/// Domain <-> proto of recipe.proto. Only common/wire, server/rpc and client/net include this.
namespace onesea::wire {

void ToProto(const sea::SeaState& sea, v1::SeaState* out);
void ToProto(const sea::Cascade& cascade, v1::Cascade* out);
void ToProto(const sea::Recipe& recipe, v1::Recipe* out);

/// Fills in every default and validates. `prefix` is put before field names in errors ("sea.").
/// `folder` is where relative paths of `file` systems begin; empty: such systems are refused.
absl::StatusOr<sea::SeaState> FromProto(const v1::SeaState& proto, std::string_view prefix,
                                        const std::string& folder = "");
sea::Cascade FromProto(const v1::Cascade& proto);  ///< as it is; ValidateRecipe checks it
absl::StatusOr<sea::AmplitudeKind> FromProto(v1::AmplitudeKind kind);  ///< unspecified: fixed
absl::StatusOr<sea::Recipe> FromProto(const v1::Recipe& proto);

/// The fields that v1::Recipe and v1::SessionSpec have alike.
template <typename Proto>
void WriteWaters(const sea::Recipe& recipe, Proto* out) {
  out->set_seed(recipe.seed);
  out->set_tick_rate_hz(recipe.tick_rate_hz);
  out->set_depth_m(recipe.depth_m);
  out->set_current_east_m_per_s(recipe.current_m_per_s.x);
  out->set_current_north_m_per_s(recipe.current_m_per_s.y);
  out->set_loop_period_s(recipe.loop_period_s);
  out->set_amplitude(static_cast<v1::AmplitudeKind>(recipe.amplitude));
  out->set_choppiness(recipe.choppiness);
  for (const sea::Cascade& cascade : recipe.cascades) ToProto(cascade, out->add_cascades());
}

/// The same back, but for those that a SessionSpec may leave out: seed, tick rate and choppiness.
template <typename Proto>
absl::Status ReadWaters(const Proto& proto, sea::Recipe& recipe) {
  recipe.depth_m = proto.depth_m();
  recipe.current_m_per_s = {proto.current_east_m_per_s(), proto.current_north_m_per_s()};
  recipe.loop_period_s = proto.loop_period_s();
  ONESEA_ASSIGN_OR_RETURN(recipe.amplitude, FromProto(proto.amplitude()));
  ONESEA_RETURN_IF_ERROR(
      CheckSize("", "cascades", static_cast<std::size_t>(proto.cascades_size()), kCascadesMax));
  for (const v1::Cascade& cascade : proto.cascades()) {
    recipe.cascades.push_back(FromProto(cascade));
  }
  return absl::OkStatus();
}

}  // namespace onesea::wire
