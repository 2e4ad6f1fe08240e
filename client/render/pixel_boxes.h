#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "client/render/frame_block.h"
#include "client/render/gl_objects.h"

/// Parts of the picture that something covers, so that the rest costs nothing.
namespace onesea::render {

PixelBox Union(const PixelBox& a, const PixelBox& b);

/// Adds a box; those that overlap become one, so that no pixel is drawn twice.
void AddDisjoint(PixelBox box, std::vector<PixelBox>& boxes);

/// Pixels that points (relative to the eye's place on the water) may cover: all of them if one is
/// not before the eye, none if that would be less than `least` either way.
PixelBox PictureOf(std::span<const glm::vec3> points, float least, const FrameBlock& block,
                   int width, int height);

}  // namespace onesea::render
