#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "common/sea/terrain.h"

/// Terrain as bytes (proto onesea.v1.Terrain; WIRE.md, "Terrain"). A round trip keeps every sample
/// exactly (but -0 may become 0); whole centimetres and the like take far fewer bytes than others.
namespace onesea::wire {

/// Pre: ValidateTerrain(terrain) is OK. Cost: about 20 ns a sample, once.
std::string EncodeTerrain(const sea::Terrain& terrain);

/// InvalidArgument with field, value and limit (DataLoss for bytes that do not parse, that don't
/// unpack or that have another hash). Takes no memory before the sizes are found within limits;
/// never crashes on hostile bytes.
absl::StatusOr<sea::Terrain> DecodeTerrain(std::string_view bytes);

}  // namespace onesea::wire
