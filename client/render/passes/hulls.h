#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "client/render/frame_block.h"
#include "client/render/gl_objects.h"
#include "client/render/passes/sky.h"
#include "client/render/passes/surface.h"
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

  /// After Prepare() of the same picture, the block uploaded: the mirror image in half as many
  /// columns and rows, for the sea's shading. Valid until the next call.
  HullMirror DrawMirror(int width, int height, const SeaTextures& sea, const PatchTextures& patches,
                        const AttenuationTexture& attenuation, const SkyPass& sky);

  /// After DrawMirror(): the hulls over the scene. `depth_boxes`: where depth() shall hold, too.
  void Draw(const VertexArray& empty, const ColorTarget& scene, const SurfaceGridPass& geometry,
            const SkyPass& sky, std::span<const PixelBox> depth_boxes);

  /// How far the hulls of the last Draw() are, of four samples a pixel: 0.5 - 0.5 kNearest / depth,
  /// 1 where there is none; in the boxes of that call. Null: none was drawn.
  const Texture* depth() const { return boxes_.empty() ? nullptr : &depth_; }

 private:
  // A mesh in one fineness.
  struct Level {
    VertexArray vertices;
    Buffer corners;
    GLsizei count = 0;
    float cell_m = 0.0f;  // corners closer than this are one
  };
  struct Mesh {
    std::shared_ptr<const HullMesh> source;
    std::vector<Level> levels;        // finest first
    glm::vec3 low{0.0f}, high{0.0f};  // bounds in the body frame [m]
  };
  struct Visible {
    const Mesh* mesh;
    glm::mat4 world_from_body;
    std::array<float, 3> colour;
    bool in_view, has_image;
    float pixel_m;  // of one pixel's breadth, there
  };
  // For hulls that are large in the picture, and for the others.
  struct Programs {
    ShaderProgram full, plain;
  };
  explicit HullPass(std::array<ShaderProgram, 8> programs);
  static Level Upload(const HullMesh& mesh, float cell_m);
  const Mesh& MeshFor(const std::shared_ptr<const HullMesh>& source);
  void Forget();
  void Resize(int width, int height);
  void FindWater(const SeaTextures& sea, const PatchTextures& patches,
                 const AttenuationTexture& attenuation);
  void DrawMeshes(const Programs& programs, const char* before, bool image, const SkyPass& sky);
  void DrawInstances(const ShaderProgram& program, bool image, bool plain);

  Programs one_, four_, mirror_;  // over a sea of one sample a pixel, of four; the mirror image
  ShaderProgram water_, place_;   // water under hulls; picture over the scene
  std::map<const HullMesh*, Mesh> meshes_;
  std::vector<Visible> visible_;
  std::vector<PixelBox> boxes_;  // disjoint, around all that is in view
  PixelBox mirror_box_;
  Texture picture_, depth_, water_map_, mirror_distance_;
  Renderbuffer mirror_depth_;
  Framebuffer framebuffer_, water_framebuffer_;
  ColorTarget mirror_picture_;
  VertexArray water_vertices_;
  Buffer water_points_;
  int width_ = 0, height_ = 0;
};

}  // namespace onesea::render
