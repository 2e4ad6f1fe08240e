#pragma once

#include <cstdint>
#include <vector>

namespace onesea::render {

inline constexpr int kFoamTextureSize = 512;
inline constexpr double kFoamTextureM = 8.0;  ///< world size of the tile

/// The lace of foam: walls of Worley cells at three scales, periodic, histogram-equalised, so that
/// the share of texels above 1 - c is c: threshold it with a cover and the mean is that cover.
///
/// (kFoamTextureSize²) row-major, 255 is the last to dissolve. Cost: about 60 ms, one core.
std::vector<std::uint8_t> MakeFoamTexture();

/// Fractal value noise in [0, 255], periodic, equalised as above: the density of clouds and gusts.
std::vector<std::uint8_t> MakeCloudTexture(int size);

}  // namespace onesea::render
