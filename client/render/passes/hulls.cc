#include "client/render/passes/hulls.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <span>

#include "client/render/hull_levels.h"
#include "client/render/pixel_boxes.h"
#include "common/base/check.h"

namespace onesea::render {
namespace {

constexpr int kSamples = 4;
constexpr int kHullsMax = 1024;  // in view
// Coarser meshes have so many cells along the diagonal of their box.
constexpr float kLevelCells[] = {36.0f, 18.0f, 9.0f, 4.5f};
// And are drawn when a cell covers at most so many pixels; in the mirror, which has half as many
// and is blurred by the waves, more.
// Hulls of fewer pixels are shaded without gloss and stains.
constexpr float kPlainPixels = 44.0f;
constexpr float kCellPixels = 2.2f, kImageCellPixels = 4.0f;

// `zero` is the eye's place on the water level.
glm::mat4 Placement(const HullInstance& hull, const Vec3d& zero) {
  const auto [w, x, y, z] = hull.rotation_wxyz;
  glm::dmat4 matrix(1.0);
  matrix[0] = {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), 0};
  matrix[1] = {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), 0};
  matrix[2] = {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y), 0};
  matrix[3] = {hull.position_m.x - zero.x, hull.position_m.y - zero.y, hull.position_m.z - zero.z,
               1};
  return glm::mat4(matrix);
}

void SetAttribute(GLuint location, GLint size, std::size_t offset) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(HullCorner),
                        reinterpret_cast<const void*>(offset));  // NOLINT: as OpenGL wants it
}

void Clear() {
  glDepthMask(GL_TRUE);
  glClearColor(0, 0, 0, 0);
  glClearDepth(1.0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

}  // namespace

absl::StatusOr<HullPass> HullPass::Create() {
  constexpr const char* kKinds[][2] = {
      {"SAMPLES 1", "MIRROR 0"}, {"SAMPLES 4", "MIRROR 0"}, {"SAMPLES 1", "MIRROR 1"}};
  std::array<ShaderProgram, 8> programs;
  for (std::size_t n = 0; n < programs.size(); ++n) {
    auto program =
        n < 6 ? ShaderProgram::Build(
                    {"frame.glsl", "hulls.vert.glsl"},
                    {"frame.glsl", "sky.glsl", "depth.glsl", "before_sea.glsl", "hulls.frag.glsl"},
                    {kKinds[n % 3][0], kKinds[n % 3][1], n < 3 ? "PLAIN 0" : "PLAIN 1",
                     "kNearest 0.2"})
        : n == 6 ? ShaderProgram::Build({"frame.glsl", "attenuation.glsl", "hulls_water.vert.glsl"},
                                        {"hulls_water.frag.glsl"}, {"kHulls 1024"})
                 : ShaderProgram::Build({"fullscreen.vert.glsl"}, {"hulls_place.frag.glsl"});
    if (!program.ok()) return program.status();
    programs[n] = std::move(*program);
  }
  return HullPass(std::move(programs));
}

HullPass::HullPass(std::array<ShaderProgram, 8> programs)
    : one_{std::move(programs[0]), std::move(programs[3])},
      four_{std::move(programs[1]), std::move(programs[4])},
      mirror_{std::move(programs[2]), std::move(programs[5])},
      water_(std::move(programs[6])),
      place_(std::move(programs[7])) {
  BindTexture(0, GL_TEXTURE_2D, water_map_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, kHullsMax, 1, 0, GL_RGBA, GL_FLOAT, nullptr);
  SetSampling(GL_TEXTURE_2D, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
  glBindFramebuffer(GL_FRAMEBUFFER, water_framebuffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, water_map_.id(), 0);
  ONESEA_CHECK(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
  glBindVertexArray(water_vertices_.id());
  glBindBuffer(GL_ARRAY_BUFFER, water_points_.id());
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
}

HullPass::Level HullPass::Upload(const HullMesh& mesh, float cell_m) {
  Level level;
  level.cell_m = cell_m;
  level.count = static_cast<GLsizei>(mesh.corners.size());
  glBindVertexArray(level.vertices.id());
  glBindBuffer(GL_ARRAY_BUFFER, level.corners.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.corners.size() * sizeof(HullCorner)),
               mesh.corners.data(), GL_STATIC_DRAW);
  SetAttribute(0, 3, offsetof(HullCorner, position_m));
  SetAttribute(1, 3, offsetof(HullCorner, normal));
  SetAttribute(2, 3, offsetof(HullCorner, albedo));
  SetAttribute(3, 2, offsetof(HullCorner, gloss));
  return level;
}

const HullPass::Mesh& HullPass::MeshFor(const std::shared_ptr<const HullMesh>& source) {
  Mesh& mesh = meshes_[source.get()];
  if (mesh.source == source) return mesh;
  mesh.source = source;
  mesh.low = glm::vec3(1e9f);
  mesh.high = -mesh.low;
  for (const HullCorner& corner : source->corners) {
    const glm::vec3 at = glm::make_vec3(corner.position_m.data());
    mesh.low = glm::min(mesh.low, at);
    mesh.high = glm::max(mesh.high, at);
  }
  mesh.levels.clear();
  mesh.levels.push_back(Upload(*source, 0.0f));
  HullMesh coarse;
  for (const float cells : kLevelCells) {
    const HullMesh& finer = mesh.levels.size() > 1 ? coarse : *source;
    const float cell_m = glm::distance(mesh.low, mesh.high) / cells;
    HullMesh next = CoarserHull(finer, cell_m);
    // One of few triangles stays as it is.
    if (next.corners.empty() || next.corners.size() > finer.corners.size() * 3 / 4) continue;
    coarse = std::move(next);
    mesh.levels.push_back(Upload(coarse, cell_m));
  }
  return mesh;
}

// Meshes that nobody else holds can't come back.
void HullPass::Forget() {
  std::erase_if(meshes_, [](const auto& entry) { return entry.second.source.use_count() == 1; });
}

bool HullPass::Prepare(const RenderFrame& frame, const FrameBlock& block, int width, int height) {
  visible_.clear();
  boxes_.clear();
  if (meshes_.size() > frame.hulls.size()) Forget();
  mirror_box_ = {width, height, 0, 0};
  const Vec3d zero{frame.camera.position_m.x, frame.camera.position_m.y, frame.water_level_m};
  for (const HullInstance& hull : frame.hulls) {
    if (hull.mesh == nullptr || hull.mesh->corners.empty()) continue;
    if (visible_.size() == kHullsMax) break;
    const Mesh& mesh = MeshFor(hull.mesh);
    const glm::mat4 placement = Placement(hull, zero);
    std::array<glm::vec3, 8> corners;
    std::array<glm::vec3, 16> image;
    for (std::size_t n = 0; n < corners.size(); ++n) {
      const glm::vec3 at(n & 1 ? mesh.high.x : mesh.low.x, n & 2 ? mesh.high.y : mesh.low.y,
                         n & 4 ? mesh.high.z : mesh.low.z);
      corners[n] = glm::vec3(placement * glm::vec4(at, 1.0f));
    }
    // The image stands on its head in the water below; waves draw it out to all sides.
    const glm::vec3 middle = 0.5f * (corners[0] + corners[7]);
    const float tall = glm::distance(mesh.low, mesh.high);
    for (std::size_t n = 0; n < image.size(); ++n) {
      const glm::vec3 wide = middle + 1.3f * (corners[n % 8] - middle);
      image[n] = glm::vec3(wide.x, wide.y, n < 8 ? middle.z : middle.z - 1.2f * tall);
    }
    const PixelBox box = PictureOf(corners, 0.3f, block, width, height);
    // Small images are lost among the waves.
    const PixelBox mirror = PictureOf(image, 8.0f, block, width, height);
    if (box.empty() && mirror.empty()) continue;
    if (!box.empty()) AddDisjoint(box, boxes_);
    if (!mirror.empty()) mirror_box_ = Union(mirror_box_, mirror);
    const float distance_m = glm::distance(glm::vec3(placement[3]), glm::vec3(block.eye));
    visible_.push_back({&mesh, placement, hull.colour, !box.empty(), !mirror.empty(),
                        distance_m * block.ray_forward.w});
  }
  // Near ones first: what they hide fails the depth test before it is shaded.
  std::sort(visible_.begin(), visible_.end(), [&](const Visible& a, const Visible& b) {
    return (block.clip_from_world * a.world_from_body[3]).w <
           (block.clip_from_world * b.world_from_body[3]).w;
  });
  return !visible_.empty();
}

void HullPass::Resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  BindTexture(0, GL_TEXTURE_2D_MULTISAMPLE, picture_);
  glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, kSamples, GL_RGBA16F, width, height, GL_TRUE);
  BindTexture(0, GL_TEXTURE_2D_MULTISAMPLE, depth_);
  glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, kSamples, GL_DEPTH_COMPONENT32F, width, height,
                          GL_TRUE);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE,
                         picture_.id(), 0);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D_MULTISAMPLE,
                         depth_.id(), 0);
  ONESEA_CHECK(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
}

void HullPass::FindWater(const SeaTextures& sea, const PatchTextures& patches,
                         const AttenuationTexture& attenuation) {
  std::vector<glm::vec4> points;
  for (const Visible& hull : visible_) {
    const glm::vec4& place = hull.world_from_body[3];
    points.emplace_back(place.x, place.y,
                        std::max(0.25f, 0.2f * glm::distance(hull.mesh->low, hull.mesh->high)),
                        static_cast<float>(points.size()));
  }
  glBindFramebuffer(GL_FRAMEBUFFER, water_framebuffer_.id());
  glViewport(0, 0, kHullsMax, 1);
  water_.Use();
  BindTexture(0, GL_TEXTURE_2D_ARRAY, sea.displacement());
  water_.SetSampler("displacement_map", 0);
  BindTexture(1, GL_TEXTURE_2D_ARRAY, patches.height());
  water_.SetSampler("patch_height_map", 1);
  BindTexture(2, GL_TEXTURE_2D_ARRAY, attenuation.factors());
  water_.SetSampler("attenuation_map", 2);
  glBindVertexArray(water_vertices_.id());
  glBindBuffer(GL_ARRAY_BUFFER, water_points_.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(points.size() * sizeof(glm::vec4)),
               points.data(), GL_STREAM_DRAW);
  glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(points.size()));
}

// Those that are large in the picture, then the others; texture unit 0 is what `before` names.
void HullPass::DrawMeshes(const Programs& programs, const char* before, bool image,
                          const SkyPass& sky) {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glEnable(GL_CULL_FACE);
  BindTexture(1, GL_TEXTURE_2D, water_map_);
  BindTexture(2, GL_TEXTURE_3D, sky.map());
  BindTexture(3, GL_TEXTURE_2D, sky.haze());
  BindTexture(4, GL_TEXTURE_2D, sky.clouds());
  for (const bool plain : {false, true}) {
    const ShaderProgram& program = plain ? programs.plain : programs.full;
    program.Use();
    if (before != nullptr) program.SetSampler(before, 0);
    program.SetSampler("water_map", 1);
    program.SetSampler("sky_map", 2);
    program.SetSampler("haze_map", 3);
    program.SetSampler("stain_map", 4);
    DrawInstances(program, image, plain);
  }
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
}

void HullPass::DrawInstances(const ShaderProgram& program, bool image, bool plain) {
  const GLint matrix = program.Uniform("world_from_body"), colour = program.Uniform("colour");
  const GLint index = program.Uniform("hull");
  for (std::size_t n = 0; n < visible_.size(); ++n) {
    const Visible& hull = visible_[n];
    const float size_m = glm::distance(hull.mesh->low, hull.mesh->high);
    if (!(image ? hull.has_image : hull.in_view)) continue;
    if ((size_m < kPlainPixels * hull.pixel_m) != plain) continue;
    glUniform1i(index, static_cast<GLint>(n));
    glUniformMatrix4fv(matrix, 1, GL_FALSE, glm::value_ptr(hull.world_from_body));
    glUniform3fv(colour, 1, hull.colour.data());
    const float cell_max_m = hull.pixel_m * (image ? kImageCellPixels : kCellPixels);
    const auto coarser = std::find_if(hull.mesh->levels.begin() + 1, hull.mesh->levels.end(),
                                      [&](const Level& l) { return l.cell_m > cell_max_m; });
    const Level& level = *(coarser - 1);
    glBindVertexArray(level.vertices.id());
    glDrawArrays(GL_TRIANGLES, 0, level.count);
  }
}

HullMirror HullPass::DrawMirror(int width, int height, const SeaTextures& sea,
                                const PatchTextures& patches, const AttenuationTexture& attenuation,
                                const SkyPass& sky) {
  FindWater(sea, patches, attenuation);
  const int columns = (width + 1) / 2, rows = (height + 1) / 2;
  if (columns != mirror_picture_.width || rows != mirror_picture_.height) {
    mirror_picture_.Resize(columns, rows, GL_RGBA16F);
    glBindRenderbuffer(GL_RENDERBUFFER, mirror_depth_.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, columns, rows);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                              mirror_depth_.id());
    BindTexture(0, GL_TEXTURE_2D, mirror_distance_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R16F, columns, rows, 0, GL_RED, GL_FLOAT, nullptr);
    SetSampling(GL_TEXTURE_2D, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D,
                           mirror_distance_.id(), 0);
    constexpr GLenum kTargets[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glDrawBuffers(2, kTargets);
    ONESEA_CHECK(glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE);
  }
  mirror_picture_.Bind();
  Clear();
  glFrontFace(GL_CW);  // as mirrors have it
  DrawMeshes(mirror_, nullptr, true, sky);
  glFrontFace(GL_CCW);
  return {&mirror_picture_.texture, &mirror_distance_, mirror_box_};
}

void HullPass::Draw(const VertexArray& empty, const ColorTarget& scene,
                    const SurfaceGridPass& geometry, const SkyPass& sky,
                    std::span<const PixelBox> depth_boxes) {
  if (boxes_.empty()) return;
  Resize(scene.width, scene.height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  glViewport(0, 0, width_, height_);
  glEnable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  glClearDepth(1.0);
  for (const PixelBox& box : depth_boxes) {
    box.Scissor();
    glClear(GL_DEPTH_BUFFER_BIT);
  }
  PixelBox around = boxes_.front();
  for (const PixelBox& box : boxes_) {
    around = Union(around, box);
    box.Scissor();
    Clear();
  }
  around.Scissor();
  const bool one = geometry.target() == GL_TEXTURE_2D;
  BindTexture(0, geometry.target(), one ? geometry.depth() : geometry.surface());
  DrawMeshes(one ? one_ : four_, one ? "depth_map" : "surface_map", false, sky);

  scene.Bind();
  place_.Use();
  BindTexture(0, GL_TEXTURE_2D_MULTISAMPLE, picture_);
  place_.SetSampler("hulls", 0);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glBindVertexArray(empty.id());
  for (const PixelBox& box : boxes_) {
    box.Scissor();
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace onesea::render
