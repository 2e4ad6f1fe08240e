#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "common/sea/recipe.h"
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

}  // namespace onesea::wire
