#include "client/render/passes/hulls.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "common/base/check.h"

namespace onesea::render {
namespace {

constexpr int kSamples = 4;

glm::mat4 Placement(const HullInstance& hull, const Vec3d& eye) {
  const auto [w, x, y, z] = hull.rotation_wxyz;
  glm::dmat4 matrix(1.0);
  matrix[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0};
  matrix[1] = {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0};
  matrix[2] = {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0};
  matrix[3] = {hull.position_m.x - eye.x, hull.position_m.y - eye.y, hull.position_m.z, 1};
  return glm::mat4(matrix);
}

void SetAttribute(GLuint location, GLint size, std::size_t offset) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(HullCorner),
                        reinterpret_cast<const void*>(offset));
}

}  // namespace

absl::StatusOr<HullPass> HullPass::Create() {
  std::array<ShaderProgram, 2> programs;
  for (std::size_t n = 0; n < programs.size(); ++n) {
    auto program = ShaderProgram::Build({"frame.glsl", "hulls.vert.glsl"},
                                        {"frame.glsl", "sky.glsl", "hulls.frag.glsl"},
                                        {n == 0 ? "SAMPLES 1" : "SAMPLES 4", "kNearest 0.2"});
    if (!program.ok()) return program.status();
    programs[n] = std::move(*program);
  }
  auto place = ShaderProgram::Build({"fullscreen.vert.glsl"}, {"hulls_place.frag.glsl"});
  if (!place.ok()) return place.status();
  return HullPass(std::move(programs), std::move(*place));
}

const HullPass::Mesh& HullPass::MeshFor(const std::shared_ptr<const HullMesh>& source) {
  Mesh& mesh = meshes_[source.get()];
  if (mesh.source == source) return mesh;
  mesh.source = source;
  mesh.count = static_cast<GLsizei>(source->corners.size());
  float radius2 = 0.0f;
  for (const HullCorner& corner : source->corners) {
    const auto& p = corner.position_m;
    radius2 = std::max(radius2, p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  }
  mesh.radius_m = std::sqrt(radius2);
  glBindVertexArray(mesh.vertices.id());
  glBindBuffer(GL_ARRAY_BUFFER, mesh.corners.id());
  glBufferData(GL_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(source->corners.size() * sizeof(HullCorner)),
               source->corners.data(), GL_STATIC_DRAW);
  SetAttribute(0, 3, offsetof(HullCorner, position_m));
  SetAttribute(1, 3, offsetof(HullCorner, normal));
  SetAttribute(2, 3, offsetof(HullCorner, albedo));
  SetAttribute(3, 2, offsetof(HullCorner, gloss));
  return mesh;
}

// Meshes that nobody else holds can't come back.
void HullPass::Forget() {
  std::erase_if(meshes_, [](const auto& entry) { return entry.second.source.use_count() == 1; });
}

bool HullPass::Prepare(const RenderFrame& frame, const FrameBlock& block, int width, int height) {
  visible_.clear();
  if (meshes_.size() > frame.hulls.size()) Forget();
  box_ = {width, height, 0, 0};
  const glm::vec3 forward(block.ray_forward);
  for (const HullInstance& hull : frame.hulls) {
    if (hull.mesh == nullptr || hull.mesh->corners.empty()) continue;
    const Mesh& mesh = MeshFor(hull.mesh);
    const glm::mat4 placement = Placement(hull, frame.camera.position_m);
    const glm::vec4 centre = block.clip_from_world * placement[3];
    if (!(centre.w > -mesh.radius_m)) continue;
    // The picture of the bounding sphere, or all of it from within.
    Box box{0, 0, width, height};
    if (centre.w > 1.5f * mesh.radius_m + 0.3f) {
      const float pixels = 1.3f * mesh.radius_m / (block.ray_forward.w * centre.w) + 2.0f;
      if (pixels < 2.3f) continue;
      const float x = (0.5f + 0.5f * centre.x / centre.w) * static_cast<float>(width);
      const float y = (0.5f + 0.5f * centre.y / centre.w) * static_cast<float>(height);
      box = {static_cast<int>(std::max(x - pixels, 0.0f)),
             static_cast<int>(std::max(y - pixels, 0.0f)),
             static_cast<int>(std::min(x + pixels, static_cast<float>(width))),
             static_cast<int>(std::min(y + pixels, static_cast<float>(height)))};
      if (box.left >= box.right || box.bottom >= box.top) continue;
    }
    box_ = {std::min(box_.left, box.left), std::min(box_.bottom, box.bottom),
            std::max(box_.right, box.right), std::max(box_.top, box.top)};
    visible_.push_back({&mesh, placement, hull.colour});
  }
  return !visible_.empty();
}

void HullPass::Resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  BindTexture(0, GL_TEXTURE_2D_MULTISAMPLE, picture_);
  glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, kSamples, GL_RGBA16F, width, height, GL_TRUE);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, kSamples, GL_DEPTH_COMPONENT32F, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE,
                         picture_.id(), 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  ONESEA_CHECK(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

void HullPass::Draw(const VertexArray& empty, const ColorTarget& scene,
                    const SurfaceGridPass& geometry, const SeaTextures& sea,
                    const PatchTextures& patches, const SkyPass& sky) {
  Resize(scene.width, scene.height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, width_, height_);
  glEnable(GL_SCISSOR_TEST);
  glScissor(box_.left, box_.bottom, box_.right - box_.left, box_.top - box_.bottom);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glClearColor(0, 0, 0, 0);
  glClearDepth(1.0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);

  const bool one = geometry.target() == GL_TEXTURE_2D;
  const ShaderProgram& program = programs_[one ? 0 : 1];
  program.Use();
  const struct {
    const char* name;
    GLenum target;
    const Texture& texture;
  } kInputs[] = {
      {one ? "depth_map" : "surface_map", geometry.target(),
       one ? geometry.depth() : geometry.surface()},
      {"displacement_map", GL_TEXTURE_2D_ARRAY, sea.displacement()},
      {"patch_height_map", GL_TEXTURE_2D_ARRAY, patches.height()},
      {"sky_map", GL_TEXTURE_3D, sky.map()},
      {"haze_map", GL_TEXTURE_2D, sky.haze()},
  };
  int unit = 0;
  for (const auto& input : kInputs) {
    BindTexture(unit, input.target, input.texture);
    program.SetSampler(input.name, unit++);
  }
  const GLint matrix = program.Uniform("world_from_body"), colour = program.Uniform("colour");
  for (const Visible& hull : visible_) {
    glUniformMatrix4fv(matrix, 1, GL_FALSE, glm::value_ptr(hull.world_from_body));
    glUniform3fv(colour, 1, hull.colour.data());
    glBindVertexArray(hull.mesh->vertices.id());
    glDrawArrays(GL_TRIANGLES, 0, hull.mesh->count);
  }
  glDisable(GL_DEPTH_TEST);

  scene.Bind();
  place_.Use();
  BindTexture(0, GL_TEXTURE_2D_MULTISAMPLE, picture_);
  place_.SetSampler("hulls", 0);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glBindVertexArray(empty.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace onesea::render
