#pragma once

#include <array>
#include <map>
#include <vector>

#include "absl/status/statusor.h"
#include "client/render/frame_block.h"
#include "client/render/gl_objects.h"
#include "client/render/passes/sky.h"
#include "client/render/passes/surface_grid.h"
#include "client/render/patch_textures.h"
#include "client/render/render_frame.h"
#include "client/render/sea_textures.h"
#include "client/render/shader_program.h"

namespace onesea::render {

/// Draws bodies over the finished sea: into a picture of their own of four samples a pixel, so
/// that edges are smooth whatever the sea is drawn with, then over the scene. Where the sea stands
/// before a hull is read from the geometry pass: sea and hulls need no common depth buffer.
class HullPass {
 public:
  static absl::StatusOr<HullPass> Create();

  /// Finds the hulls in view and uploads meshes that are new. False: there is nothing to draw.
  bool Prepare(const RenderFrame& frame, const FrameBlock& block, int width, int height);

  /// After Prepare() of the same picture; the block must be uploaded.
  void Draw(const VertexArray& empty, const ColorTarget& scene, const SurfaceGridPass& geometry,
            const SeaTextures& sea, const PatchTextures& patches, const SkyPass& sky);

 private:
  struct Mesh {
    std::shared_ptr<const HullMesh> source;
    VertexArray vertices;
    Buffer corners;
    GLsizei count = 0;
    float radius_m = 0.0f;
  };
  struct Visible {
    const Mesh* mesh;
    glm::mat4 world_from_body;
    std::array<float, 3> colour;
  };
  struct Box {
    int left, bottom, right, top;
  };
  HullPass(std::array<ShaderProgram, 2> programs, ShaderProgram place)
      : programs_(std::move(programs)), place_(std::move(place)) {}
  const Mesh& MeshFor(const std::shared_ptr<const HullMesh>& source);
  void Forget();
  void Resize(int width, int height);

  std::array<ShaderProgram, 2> programs_;  // sea of one sample a pixel, of four
  ShaderProgram place_;
  std::map<const HullMesh*, Mesh> meshes_;
  std::vector<Visible> visible_;
  Box box_{};
  Texture picture_;
  Renderbuffer depth_;
  Framebuffer framebuffer_;
  int width_ = 0, height_ = 0;
};

}  // namespace onesea::render
