#include "client/render/passes/surface.h"

#include <array>
#include <string>

#include "absl/strings/str_cat.h"
#include "client/render/foam_texture.h"
#include "client/render/passes/classify.h"
#include "common/base/check.h"

namespace onesea::render {

namespace {

absl::StatusOr<ShaderProgram> Build(const SurfaceVariant& variant) {
  const auto define = [](const char* name, int value) { return absl::StrCat(name, " ", value); };
  const std::array<std::string, 11> definitions = {
      define("EDGES", variant.edges),     define("UNDERSIDE", variant.underside),
      define("RIPPLES", variant.ripples), define("REGULARS", variant.regular_waves),
      define("SAMPLES", variant.samples), define("CASCADES", variant.cascades),
      define("PATCHES", variant.patches), define("HULLS", variant.hulls),
      define("TERRAIN", variant.terrain), define("ATTENUATED", variant.attenuated),
      define("GROUND_COARSE", 1)};
  std::vector<std::string_view> files = {"frame.glsl", "sky.glsl", "optics.glsl"};
  if (variant.attenuated) files.push_back("attenuation.glsl");
  files.push_back("waves.glsl");
  if (variant.terrain) files.insert(files.end(), {"ground.glsl", "shore.glsl"});
  files.push_back("surface.frag.glsl");
  return ShaderProgram::Build({"fullscreen.vert.glsl"}, files,
                              {definitions.begin(), definitions.end()});
}

}  // namespace

absl::StatusOr<SurfacePass> SurfacePass::Create() {
  SurfacePass pass;
  // The usual variants now, so that a driver's complaint is a status and not a crash later.
  for (bool edges : {false, true}) {
    for (bool underside : {false, true}) {
      const SurfaceVariant variant{.edges = edges, .underside = underside};
      auto program = Build(variant);
      if (!program.ok()) return program.status();
      pass.programs_.emplace(variant, std::move(*program));
    }
  }
  return pass;
}

const ShaderProgram& SurfacePass::ProgramFor(const SurfaceVariant& variant) {
  const auto known = programs_.find(variant);
  if (known != programs_.end()) return known->second;
  auto program = Build(variant);
  ONESEA_CHECK(program.ok()) << std::string(program.status().message());
  return programs_.emplace(variant, std::move(*program)).first->second;
}

SurfacePass::SurfacePass() {
  const std::vector<std::uint8_t> foam = MakeFoamTexture();
  BindTexture(0, GL_TEXTURE_2D, foam_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, kFoamTextureSize, kFoamTextureSize, 0, GL_RED,
               GL_UNSIGNED_BYTE, foam.data());
  SetSampling(GL_TEXTURE_2D, GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR, GL_REPEAT);
  glGenerateMipmap(GL_TEXTURE_2D);
  // A window of one dark cell until there is foam: samplers must always have a texture.
  constexpr std::uint8_t kNone = 0;
  SetFoamWindow({{&kNone, 1}, 1, 1.0, {}});
}

void SurfacePass::SetFoamWindow(const FoamCells& foam) {
  if (foam.cells.empty()) return;
  BindTexture(0, GL_TEXTURE_2D, foam_window_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  if (foam.side != window_side_) {
    window_side_ = foam.side;
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, foam.side, foam.side, 0, GL_RED, GL_UNSIGNED_BYTE,
                 foam.cells.data());
    SetSampling(GL_TEXTURE_2D, GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR, GL_REPEAT);
  } else {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, foam.side, foam.side, GL_RED, GL_UNSIGNED_BYTE,
                    foam.cells.data());
  }
  glGenerateMipmap(GL_TEXTURE_2D);
}

void SurfacePass::DrawVariant(std::span<const Map> maps, const SurfaceVariant& variant) {
  const ShaderProgram& program = ProgramFor(variant);
  program.Use();
  int unit = 0;
  for (const Map& map : maps) {
    BindTexture(unit, map.target, map.texture);
    program.SetSampler(map.name, unit++);
  }
  if (variant.edges) {
    glEnable(GL_BLEND);
    ClassifyPass::ChooseEdges(program);
  } else {
    variant.samples == 1 ? ClassifyPass::ChooseSheetsAndSteps(program)
                         : ClassifyPass::ChooseSheets(program);
  }
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
}

void SurfacePass::Draw(const VertexArray& empty, const ColorTarget& scene,
                       const SurfaceInput& input, const HullMirror& mirror,
                       SurfaceVariant variant) {
  const bool hulls = mirror.picture != nullptr && !mirror.box.empty();
  const Map kMaps[] = {
      {"surface_map", input.geometry.target(), input.geometry.surface()},
      {"slope_map", GL_TEXTURE_2D_ARRAY, input.sea.slope()},
      {"ripple_slope_map", GL_TEXTURE_2D, input.ripples.slope()},
      {"patch_slope_map", GL_TEXTURE_2D_ARRAY, input.patches.slope()},
      {"foam_map", GL_TEXTURE_2D, foam_},
      {"foam_window_map", GL_TEXTURE_2D, foam_window_},
      {"sky_map", GL_TEXTURE_3D, input.sky.map()},
      {"haze_map", GL_TEXTURE_2D, input.sky.haze()},
      {"mirror_map", GL_TEXTURE_2D, hulls ? *mirror.picture : foam_},
      {"mirror_distance_map", GL_TEXTURE_2D, hulls ? *mirror.distance : foam_},
      {"ground_map", GL_TEXTURE_2D, input.ground.ground()},
      {"grain_map", GL_TEXTURE_2D, input.ground.grain()},
      {"attenuation_map", GL_TEXTURE_2D_ARRAY, input.attenuation.factors()},
  };
  // Only water that may mirror a hull pays for it: that box, then what is below, above and beside.
  const PixelBox& box = mirror.box;
  const PixelBox kBoxes[] = {box,
                             {0, 0, scene.width, box.bottom},
                             {0, box.top, scene.width, scene.height},
                             {0, box.bottom, box.left, box.top},
                             {box.right, box.bottom, scene.width, box.top}};
  scene.Bind();
  variant.samples = input.geometry.target() == GL_TEXTURE_2D ? 1 : 4;
  glBindVertexArray(empty.id());
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // the covered share over the sky, premultiplied
  for (bool edges : {false, true}) {
    if (edges && variant.samples == 1) break;
    variant.edges = edges;
    if (!hulls) {
      DrawVariant(kMaps, variant);
      continue;
    }
    glEnable(GL_SCISSOR_TEST);
    for (const PixelBox& part : kBoxes) {
      if (part.empty()) continue;
      variant.hulls = &part == kBoxes;
      part.Scissor();
      DrawVariant(kMaps, variant);
    }
    glDisable(GL_SCISSOR_TEST);
  }
  ClassifyPass::ChooseAll();
}

}  // namespace onesea::render
