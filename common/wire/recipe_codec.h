#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "common/sea/recipe.h"

/// The recipe as bytes (proto onesea.v1.Recipe). A round trip keeps every bit of every number.
namespace onesea::wire {

std::string EncodeRecipe(const sea::Recipe& recipe);

/// InvalidArgument with field, value and limit (DataLoss for bytes that do not parse);
/// FailedPrecondition for an unknown sea_model_version. Never crashes on hostile bytes.
absl::StatusOr<sea::Recipe> DecodeRecipe(std::string_view bytes);

/// InvalidArgument when the encoded recipe is longer than kRecipeBytesMax.
absl::Status CheckRecipeBytes(const sea::Recipe& recipe);

}  // namespace onesea::wire
