#pragma once

#include <array>

#include "absl/status/statusor.h"
#include "client/render/gl_objects.h"
#include "client/render/passes/surface_grid.h"
#include "client/render/shader_program.h"

namespace onesea::render {

/// The picture in linear radiance, with the class of each pixel as its depth: what is shaded later
/// is chosen by the depth test, which skips whole blocks of pixels before a shader runs. (An `if`
/// in the shader would skip nothing on a software rasteriser.)
///
///   depth  samples  class
///   0      both     one sheet of water
///   0.5    1        beside a step in distance: a crest, what is behind it, the sky
///   1      1        sky alone
///   0.5    4        sky alone
///   1      4        an edge: several sheets of water within the pixel, or water and sky
class ClassifyPass {
 public:
  static absl::StatusOr<ClassifyPass> Create();

  /// Writes the classes of `geometry` into the depth of `scene`.
  void Draw(const VertexArray& empty, const ColorTarget& scene, const SurfaceGridPass& geometry,
            bool terrain);

  /// Lets the choices below hold for what is drawn into `other`, of the same size, too.
  void ShareClasses(const ColorTarget& other) const;

  /// Restricts what is drawn next with `program` (in use) to one class of pixels; full-screen
  /// triangles only. Ends with ChooseAll().
  static void ChooseSheets(const ShaderProgram& program);
  static void ChooseSheetsAndSteps(const ShaderProgram& program);
  static void ChooseSteps(const ShaderProgram& program);
  static void ChooseEdges(const ShaderProgram& program);
  static void ChooseNotSheets(const ShaderProgram& program);  ///< sky, steps, edges, land
  static void ChooseLand(const ShaderProgram& program, int samples);
  static void ChooseAll();

 private:
  explicit ClassifyPass(std::array<ShaderProgram, 3> programs) : programs_(std::move(programs)) {}
  std::array<ShaderProgram, 3> programs_;  // one sample a pixel, four, one with terrain
  Renderbuffer depth_;
  int width_ = 0, height_ = 0;
};

}  // namespace onesea::render
