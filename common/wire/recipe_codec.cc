#include "common/wire/recipe_codec.h"

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"
#include "common/wire/proto_sea.h"

namespace onesea::wire {

sea::Cascade FromProto(const v1::Cascade& proto) {
  return {.length_m = proto.length_m(),
          .rotation_rad = proto.rotation_rad(),
          .wavenumber_min_rad_per_m = proto.wavenumber_min_rad_per_m(),
          .wavenumber_max_rad_per_m = proto.wavenumber_max_rad_per_m(),
          .query_grid_size = proto.query_grid_size()};
}

absl::StatusOr<sea::AmplitudeKind> FromProto(v1::AmplitudeKind kind) {
  switch (kind) {
    case v1::AMPLITUDE_KIND_UNSPECIFIED:
    case v1::AMPLITUDE_KIND_FIXED:
      return sea::AmplitudeKind::kFixed;
    case v1::AMPLITUDE_KIND_RAYLEIGH:
      return sea::AmplitudeKind::kRayleigh;
    default:
      return absl::InvalidArgumentError(
          absl::StrCat("amplitude: ", static_cast<int>(kind),
                       " is none of AMPLITUDE_KIND_FIXED (1), AMPLITUDE_KIND_RAYLEIGH (2)"));
  }
}

absl::StatusOr<sea::Recipe> FromProto(const v1::Recipe& proto) {
  if (proto.sea_model_version() != sea::kSeaModelVersion) {
    return absl::FailedPreconditionError(
        absl::StrCat("sea_model_version: ", proto.sea_model_version(), " is not known here, only ",
                     sea::kSeaModelVersion, "; update the older side"));
  }
  sea::Recipe recipe;
  recipe.sea_model_version = proto.sea_model_version();
  recipe.seed = proto.seed();
  recipe.tick_rate_hz = proto.tick_rate_hz();
  recipe.choppiness = proto.choppiness();
  ONESEA_RETURN_IF_ERROR(ReadWaters(proto, recipe));
  ONESEA_RETURN_IF_ERROR(CheckSize("", "timeline", static_cast<std::size_t>(proto.timeline_size()),
                                   kWeatherEntriesMax));
  for (int n = 0; n < proto.timeline_size(); ++n) {
    const v1::WeatherEntry& entry = proto.timeline(n);
    ONESEA_ASSIGN_OR_RETURN(sea::SeaState sea,
                            FromProto(entry.sea(), absl::StrCat("timeline[", n, "].sea.")));
    recipe.timeline.push_back({entry.start_tick(), entry.span_ticks(), std::move(sea)});
  }
  ONESEA_RETURN_IF_ERROR(sea::ValidateRecipe(recipe));
  return recipe;
}

std::string EncodeRecipe(const sea::Recipe& recipe) {
  v1::Recipe proto;
  ToProto(recipe, &proto);
  return proto.SerializeAsString();
}

absl::StatusOr<sea::Recipe> DecodeRecipe(std::string_view bytes) {
  v1::Recipe proto;
  if (!proto.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return absl::DataLossError(
        absl::StrCat("recipe: ", bytes.size(), " bytes are not an onesea.v1.Recipe"));
  }
  return FromProto(proto);
}

absl::Status CheckRecipeBytes(const sea::Recipe& recipe) {
  v1::Recipe proto;
  ToProto(recipe, &proto);
  const auto size = static_cast<std::int64_t>(proto.ByteSizeLong());
  if (size <= kRecipeBytesMax) return absl::OkStatus();
  return absl::InvalidArgumentError(absl::StrCat("recipe: ", size, " bytes encoded, the limit is ",
                                                 kRecipeBytesMax,
                                                 "; use fewer frequencies or directions"));
}

}  // namespace onesea::wire
