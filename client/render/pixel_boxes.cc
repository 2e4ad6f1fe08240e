#include "client/render/pixel_boxes.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace onesea::render {

PixelBox Union(const PixelBox& a, const PixelBox& b) {
  return {std::min(a.left, b.left), std::min(a.bottom, b.bottom), std::max(a.right, b.right),
          std::max(a.top, b.top)};
}

namespace {

bool Overlap(const PixelBox& a, const PixelBox& b) {
  return a.left < b.right && b.left < a.right && a.bottom < b.top && b.bottom < a.top;
}

}  // namespace

void AddDisjoint(PixelBox box, std::vector<PixelBox>& boxes) {
  for (std::size_t n = 0; n < boxes.size();) {
    if (!Overlap(box, boxes[n])) {
      ++n;
      continue;
    }
    box = Union(box, boxes[n]);
    boxes[n] = boxes.back();
    boxes.pop_back();
    n = 0;
  }
  boxes.push_back(box);
}

PixelBox PictureOf(std::span<const glm::vec3> points, float least, const FrameBlock& block,
                   int width, int height) {
  glm::vec2 low(1e9f), high(-1e9f);
  int behind = 0;
  for (const glm::vec3& point : points) {
    const glm::vec4 clip = block.clip_from_world * glm::vec4(point, 1.0f);
    if (!(clip.w > 0.2f)) {
      ++behind;
      continue;
    }
    const glm::vec2 at = glm::vec2(0.5f + 0.5f * clip.x / clip.w, 0.5f + 0.5f * clip.y / clip.w) *
                         glm::vec2(width, height);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  if (behind == static_cast<int>(points.size())) return {};
  if (behind > 0) return {0, 0, width, height};
  if (std::max(high.x - low.x, high.y - low.y) < least) return {};
  const auto pixel = [](float at, int most) {
    return static_cast<int>(std::clamp(at, 0.0f, static_cast<float>(most)));
  };
  return {pixel(low.x - 2.0f, width), pixel(low.y - 2.0f, height), pixel(high.x + 2.0f, width),
          pixel(high.y + 2.0f, height)};
}

}  // namespace onesea::render
