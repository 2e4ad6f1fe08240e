#include "client/render/passes/terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "absl/strings/str_cat.h"
#include "client/render/passes/classify.h"

namespace onesea::render {
namespace {

constexpr int kQuads = GroundTextures::kTileQuads;
constexpr int kSide = kQuads + 3;  // vertices, with the skirt
// So many tiles are drawn at most; what then is missing is behind nearer ones or far away.
constexpr std::size_t kTilesMax = 1024;

struct Box {
  glm::vec3 low, high;  // relative to the eye's place on the water
};

bool OutOfView(const Box& box, const FrameBlock& block) {
  std::array<int, 5> outside{};
  for (int n = 0; n < 8; ++n) {
    const glm::vec4 clip = block.clip_from_world * glm::vec4(n & 1 ? box.high.x : box.low.x,
                                                             n & 2 ? box.high.y : box.low.y,
                                                             n & 4 ? box.high.z : box.low.z, 1.0f);
    outside[0] += clip.x < -clip.w;
    outside[1] += clip.x > clip.w;
    outside[2] += clip.y < -clip.w;
    outside[3] += clip.y > clip.w;
    outside[4] += clip.w < 0.0f;
  }
  return *std::max_element(outside.begin(), outside.end()) == 8;
}

float DistanceTo(const Box& box, const FrameBlock& block) {
  const auto beyond = [](float at, float low, float high) {
    return std::max({low - at, at - high, 0.0f});
  };
  return std::hypot(beyond(0.0f, box.low.x, box.high.x), beyond(0.0f, box.low.y, box.high.y),
                    beyond(block.eye.z, box.low.z, box.high.z));
}

// Walks down the tree of tiles.
class TileChooser {
 public:
  TileChooser(const GroundTextures& ground, const FrameBlock& block, double lowest_m, double pixels)
      : ground_(ground),
        block_(block),
        lowest_m_(static_cast<float>(lowest_m)),
        texel_m_(static_cast<float>(ground.texel_m())),
        quad_rad_(static_cast<float>(pixels) * block.ray_forward.w) {}

  void Visit(int level, int column, int row) {
    const GroundTextures::Range range = ground_.RangeOf(level, column, row);
    const float level_m = block_.ground_noise.w;
    if (range.low_m > range.high_m || range.high_m - level_m < lowest_m_) return;
    const float quad_m = texel_m_ * static_cast<float>(1 << level);
    const float side_m = quad_m * kQuads;
    const glm::vec2 corner(block_.ground_area.x + side_m * static_cast<float>(column),
                           block_.ground_area.y + side_m * static_cast<float>(row));
    const Box box{{corner, range.low_m - level_m}, {corner + side_m, range.high_m - level_m}};
    // Room for skirts, cubics that overshoot, and the round earth.
    const Box roomy{box.low - glm::vec3(0.0f, 0.0f, 4.0f + 0.1f * side_m),
                    box.high + glm::vec3(0.0f, 0.0f, 1.0f)};
    if (OutOfView(roomy, block_)) return;
    if (level > 0 && quad_m > quad_rad_ * DistanceTo(box, block_)) {
      for (int n = 0; n < 4; ++n) Visit(level - 1, 2 * column + (n & 1), 2 * row + (n >> 1));
      return;
    }
    const auto mip = static_cast<float>(std::min(level, GroundTextures::kMips - 1));
    if (tiles.size() < kTilesMax) tiles.push_back({corner, quad_m, std::max(0.0f, mip - 1.0f)});
  }

  std::vector<TerrainTile> tiles;

 private:
  const GroundTextures& ground_;
  const FrameBlock& block_;
  const float lowest_m_, texel_m_, quad_rad_;
};

}  // namespace

std::vector<TerrainTile> ChooseTerrainTiles(const GroundTextures& ground, const FrameBlock& block,
                                            double lowest_m, double pixels) {
  TileChooser chooser(ground, block, lowest_m, pixels);
  if (ground.levels() > 0) chooser.Visit(ground.levels() - 1, 0, 0);
  return std::move(chooser.tiles);
}

absl::StatusOr<TerrainPass> TerrainPass::Create() {
  const std::string quads = absl::StrCat("kTileQuads ", kQuads);
  auto geometry =
      ShaderProgram::Build({"frame.glsl", "terrain.vert.glsl"}, {"depth.glsl", "terrain.frag.glsl"},
                           {quads, "kNearest 0.2"});
  if (!geometry.ok()) return geometry.status();
  auto shades = ShaderProgram::BuildForSamples(
      {"fullscreen.vert.glsl"},
      {"frame.glsl", "sky.glsl", "ground.glsl", "terrain_shade.frag.glsl"}, {"GROUND_COARSE 0"});
  if (!shades.ok()) return shades.status();
  return TerrainPass(std::move(*geometry), std::move((*shades)[0]), std::move((*shades)[1]));
}

TerrainPass::TerrainPass(ShaderProgram geometry, ShaderProgram one, ShaderProgram four)
    : geometry_(std::move(geometry)), one_(std::move(one)), four_(std::move(four)) {
  std::vector<std::uint16_t> indices;
  for (int j = 0; j + 1 < kSide; ++j) {
    for (int i = 0; i + 1 < kSide; ++i) {
      const auto a = static_cast<std::uint16_t>(j * kSide + i);
      const auto b = static_cast<std::uint16_t>(a + 1);
      const auto c = static_cast<std::uint16_t>(a + kSide), d = static_cast<std::uint16_t>(c + 1);
      indices.insert(indices.end(), {a, b, c, b, d, c});
    }
  }
  index_count_ = static_cast<GLsizei>(indices.size());
  glBindVertexArray(vertices_.id());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)), indices.data(),
               GL_STATIC_DRAW);
  glBindBuffer(GL_ARRAY_BUFFER, tile_buffer_.id());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(TerrainTile), nullptr);
  glVertexAttribDivisor(0, 1);
}

bool TerrainPass::Prepare(const GroundTextures& ground, const FrameBlock& block, double lowest_m,
                          double pixels) {
  tiles_ = ChooseTerrainTiles(ground, block, lowest_m, pixels);
  return !tiles_.empty();
}

void TerrainPass::DrawGeometry(const GroundTextures& ground) {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  geometry_.Use();
  BindTexture(0, GL_TEXTURE_2D, ground.ground());
  geometry_.SetSampler("ground_map", 0);
  glBindVertexArray(vertices_.id());
  glBindBuffer(GL_ARRAY_BUFFER, tile_buffer_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(tiles_.size() * sizeof(TerrainTile)),
               tiles_.data(), GL_STREAM_DRAW);
  glDrawElementsInstanced(GL_TRIANGLES, index_count_, GL_UNSIGNED_SHORT, nullptr,
                          static_cast<GLsizei>(tiles_.size()));
  glDisable(GL_DEPTH_TEST);
}

void TerrainPass::Shade(const VertexArray& empty, const ColorTarget& scene,
                        const SurfaceGridPass& geometry, const GroundTextures& ground,
                        const SkyPass& sky) {
  const bool one = geometry.target() == GL_TEXTURE_2D;
  const ShaderProgram& program = one ? one_ : four_;
  scene.Bind();
  program.Use();
  BindTexture(0, geometry.target(), geometry.surface());
  program.SetSampler("surface_map", 0);
  BindTexture(1, GL_TEXTURE_2D, ground.ground());
  program.SetSampler("ground_map", 1);
  BindTexture(2, GL_TEXTURE_2D, ground.grain());
  program.SetSampler("grain_map", 2);
  BindTexture(3, GL_TEXTURE_3D, sky.map());
  program.SetSampler("sky_map", 3);
  BindTexture(4, GL_TEXTURE_2D, sky.haze());
  program.SetSampler("haze_map", 4);
  glBindVertexArray(empty.id());
  ClassifyPass::ChooseLand(program, one ? 1 : 4);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  // Land's share of pixels that show more than land.
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  one ? ClassifyPass::ChooseSteps(program) : ClassifyPass::ChooseEdges(program);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDisable(GL_BLEND);
  ClassifyPass::ChooseAll();
}

}  // namespace onesea::render
