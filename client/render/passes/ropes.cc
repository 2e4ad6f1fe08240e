#include "client/render/passes/ropes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "client/render/hanging_line.h"
#include "client/render/pixel_boxes.h"

namespace onesea::render {
namespace {

constexpr std::size_t kLinePoints = 33;

// Wider by what a rope is wide where it comes nearest.
PixelBox Wider(const PixelBox& box, std::span<const glm::vec3> line, double radius_m,
               const FrameBlock& block, int width, int height) {
  float nearest_m = 1e9f;
  for (const glm::vec3& place : line) {
    nearest_m = std::min(nearest_m, glm::distance(place, glm::vec3(block.eye)));
  }
  const double pixels = radius_m / (std::max(nearest_m, 0.2f) * block.ray_forward.w);
  const int more = static_cast<int>(std::min<double>(2.0 * pixels, width + height));
  return {std::max(box.left - more, 0), std::max(box.bottom - more, 0),
          std::min(box.right + more, width), std::min(box.top + more, height)};
}

}  // namespace

absl::StatusOr<RopePass> RopePass::Create() {
  auto programs = ShaderProgram::BuildForSamples(
      {"frame.glsl", "ropes.vert.glsl"},
      {"frame.glsl", "sky.glsl", "depth.glsl", "before_sea.glsl", "ropes.frag.glsl"},
      {"kNearest 0.2"});
  if (!programs.ok()) return programs.status();
  return RopePass(std::move((*programs)[0]), std::move((*programs)[1]));
}

RopePass::RopePass(ShaderProgram one, ShaderProgram four)
    : one_(std::move(one)), four_(std::move(four)) {
  glBindVertexArray(vertices_.id());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  const auto attribute = [](GLuint location, std::size_t offset) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, 4, GL_FLOAT, GL_FALSE, sizeof(Point),
                          reinterpret_cast<const void*>(offset));  // NOLINT: as OpenGL wants it
  };
  attribute(0, offsetof(Point, x));
  attribute(1, offsetof(Point, tx));
}

bool RopePass::Prepare(const RenderFrame& frame, const FrameBlock& block, double lowest_m,
                       int width, int height) {
  points_.clear();
  firsts_.clear();
  counts_.clear();
  boxes_.clear();
  const Vec3d zero{frame.camera.position_m.x, frame.camera.position_m.y, frame.water_level_m};
  const std::size_t count = std::min<std::size_t>(frame.ropes.size(), kRenderRopesMax);
  for (std::size_t n = 0; n < count; ++n) {
    const RopeLine& rope = frame.ropes[n];
    std::array<Vec3d, kLinePoints> places;
    HangingLine(rope.from_m - zero, rope.to_m - zero, rope.length_m, places);
    if (std::max(places.front().z, places.back().z) < lowest_m) continue;
    std::array<glm::vec3, kLinePoints> line;
    std::transform(places.begin(), places.end(), line.begin(), [](const Vec3d& place) {
      return glm::vec3(static_cast<float>(place.x), static_cast<float>(place.y),
                       static_cast<float>(place.z));
    });
    const PixelBox box = PictureOf(line, 0.5f, block, width, height);
    if (box.empty()) continue;
    boxes_.push_back(Wider(box, line, rope.radius_m, block, width, height));
    AddLine(rope, line);
  }
  return !counts_.empty();
}

void RopePass::AddLine(const RopeLine& rope, std::span<const glm::vec3> line) {
  firsts_.push_back(static_cast<GLint>(points_.size()));
  counts_.push_back(static_cast<GLsizei>(2 * line.size()));
  const float apart_m = glm::distance(line.front(), line.back());
  const float step_m =
      std::max(static_cast<float>(rope.length_m), apart_m) / static_cast<float>(line.size() - 1);
  for (std::size_t n = 0; n < line.size(); ++n) {
    glm::vec3 along = line[std::min(n + 1, line.size() - 1)] - line[n > 0 ? n - 1 : 0];
    along = glm::length(along) > 1e-6f ? glm::normalize(along) : glm::vec3(0, 0, 1);
    const Point point{line[n].x, line[n].y, line[n].z, step_m * static_cast<float>(n),
                      along.x,   along.y,   along.z,   static_cast<float>(rope.radius_m)};
    points_.push_back(point);
    points_.push_back(point);
  }
}

void RopePass::Draw(const ColorTarget& scene, const SurfaceGridPass& geometry, const SkyPass& sky,
                    const Texture* hull_depth) {
  const bool one = geometry.target() == GL_TEXTURE_2D;
  const ShaderProgram& program = one ? one_ : four_;
  scene.Bind();
  program.Use();
  BindTexture(0, geometry.target(), one ? geometry.depth() : geometry.surface());
  program.SetSampler(one ? "depth_map" : "surface_map", 0);
  BindTexture(1, GL_TEXTURE_2D, sky.haze());
  program.SetSampler("haze_map", 1);
  if (hull_depth != nullptr) BindTexture(2, GL_TEXTURE_2D_MULTISAMPLE, *hull_depth);
  program.SetSampler("hull_depth", 2);
  glUniform1i(program.Uniform("hulls"), hull_depth != nullptr ? 1 : 0);
  glBindVertexArray(vertices_.id());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(points_.size() * sizeof(Point)),
               points_.data(), GL_STREAM_DRAW);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glMultiDrawArrays(GL_TRIANGLE_STRIP, firsts_.data(), counts_.data(),
                    static_cast<GLsizei>(counts_.size()));
  glDisable(GL_BLEND);
}

}  // namespace onesea::render
