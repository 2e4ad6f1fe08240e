// Bodies in the picture: their outline, what hides them, and the models' own geometry.
#include <array>
#include <cmath>

#include "client/render/hull_levels.h"
#include "client/render/hull_models.h"
#include "client/render/hull_painter.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_sea.h"

namespace onesea::render {
namespace {

constexpr int kWidth = 320, kHeight = 180;
constexpr double kEyeM = 3.0, kFov = 0.785;

class HullsTest : public GlTest {
 protected:
  HullsTest() : sea_(1e-4, 3.0, 2.6, 64) {
    sea_.FillFrame(12.0, frame_);
    frame_.camera = {{0, 0, kEyeM}, 0.0, 0.0, 0.0, kFov};
    frame_.weather.cloud_cover = 0.0;
    frame_.sun = {2.6, 0.7};
    frame_.quality.bloom = false;
  }

  // A white box without gloss: brighter than anything else in these pictures.
  static SharedHullMesh WhiteBox(Vec3d half) {
    HullPainter painter;
    painter.Box(-1.0 * half, half, {{1, 1, 1}, 0.0f, 0.0f});
    return std::make_shared<const HullMesh>(painter.Finish());
  }

  // The pixels whose colour a hull changes.
  std::vector<bool> Changed() {
    std::vector<HullInstance> hulls;
    std::swap(hulls, frame_.hulls);
    const Picture without = Draw(frame_, kWidth, kHeight);
    std::swap(hulls, frame_.hulls);
    const Picture with = Draw(frame_, kWidth, kHeight);
    std::vector<bool> changed;
    for (std::size_t n = 0; n < with.rgb.size(); n += 3) {
      int most = 0;
      for (std::size_t c = 0; c < 3; ++c)
        most = std::max(most, std::abs(with.rgb[n + c] - without.rgb[n + c]));
      changed.push_back(most > 12);
    }
    return changed;
  }

  static bool At(const std::vector<bool>& mask, double x, double y) {
    return mask[static_cast<std::size_t>(std::lround(y)) * kWidth +
                static_cast<std::size_t>(std::lround(x))];
  }

  // Pixel coordinates of a place straight ahead.
  static std::array<double, 2> Project(Vec3d p) {
    const double scale = 0.5 * kHeight / std::tan(0.5 * kFov) / p.x;
    return {0.5 * kWidth - 0.5 - scale * p.y, 0.5 * kHeight - 0.5 - scale * (p.z - kEyeM)};
  }

  TestSea sea_;
  RenderFrame frame_;
};

TEST_F(HullsTest, BoxCoversThePixelsOfItsProjection) {
  for (int samples : {1, 4}) {
    frame_.quality.samples = samples;
    // Its front face at x = 20 hides the rest: from y = -2 to 2, z = 0 (the water) to 4.
    frame_.hulls = {{WhiteBox({2, 2, 4}), {22, 0, 0}, {1, 0, 0, 0}, {1, 1, 1}}};
    const std::vector<bool> changed = Changed();
    const auto [left, top] = Project({20, 2, 4});
    const auto [right, bottom] = Project({20, -2, 0});
    for (int x = static_cast<int>(left) - 8; x <= right + 8; ++x) {
      for (int y = static_cast<int>(top) - 8; y <= bottom - 2; ++y) {
        const bool inside = x > left + 1 && x < right - 1 && y > top + 1 && y < bottom - 1;
        const bool outside = x < left - 1 || x > right + 1 || y < top - 1;
        if (inside) {
          EXPECT_TRUE(At(changed, x, y)) << x << " " << y << ", samples " << samples;
        } else if (outside && y < kHeight / 2) {
          EXPECT_FALSE(At(changed, x, y)) << x << " " << y << ", samples " << samples;
        }
      }
    }
    // The waterline: what lies deeper is behind the sea.
    EXPECT_TRUE(At(changed, 0.5 * kWidth, bottom - 2));
  }
}

TEST_F(HullsTest, SunkBoxIsNotSeen) {
  frame_.hulls = {{WhiteBox({2, 2, 2}), {20, 0, -3}, {1, 0, 0, 0}, {1, 1, 1}}};
  const std::vector<bool> changed = Changed();
  EXPECT_EQ(std::count(changed.begin(), changed.end(), true), 0);
}

// A wave that stands between the eye and a low box hides it; in its trough the box is seen.
TEST_F(HullsTest, CrestHidesWhatIsBehindIt) {
  frame_.camera.position_m.z = 1.6;
  frame_.choppiness = 0.0;
  frame_.hulls = {{WhiteBox({0.5, 2, 0.5}), {40, 0, 0}, {1, 0, 0, 0}, {1, 1, 1}}};
  for (const auto& [crest_m, seen] : {std::pair{20.0, false}, std::pair{40.0, true}}) {
    // Crests at crest_m + 40 n: 1.2 m high 20 m before the box, or under it.
    const double k = 2.0 * 3.14159265358979 / 40.0;
    frame_.regular_waves = {{k, 0, 1.2, -k * crest_m}};
    frame_.hulls[0].position_m.z = seen ? 1.4 : -1.0;
    const std::vector<bool> changed = Changed();
    const auto count = std::count(changed.begin(), changed.end(), true);
    EXPECT_TRUE(seen ? count > 60 : count == 0) << crest_m << " m: " << count;
  }
}

TEST_F(HullsTest, NearerHullHidesTheFarther) {
  const SharedHullMesh box = WhiteBox({1, 1, 1});
  const HullInstance red{box, {10, 0, 1}, {1, 0, 0, 0}, {1, 1, 1}};
  HullInstance behind{BallModel(1.0), {20, 0, 2}, {1, 0, 0, 0}, {1, 0, 0}};
  frame_.hulls = {red};
  const Picture one = Draw(frame_, kWidth, kHeight);
  frame_.hulls = {behind, red};
  const Picture two = Draw(frame_, kWidth, kHeight);
  const auto [x, y] = Project({10, 0, 1.5});
  const auto at = static_cast<std::size_t>((std::lround(y) * kWidth + std::lround(x)) * 3);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(one.rgb[at + c], two.rgb[at + c]);
}

TEST_F(HullsTest, EdgesAreSmooth) {
  // A mast leaning by a little against the sky: with stairs, every pixel would be hull or sky.
  frame_.quality.samples = 1;
  const double lean = 0.05;
  frame_.hulls = {{WhiteBox({0.5, 1, 8}),
                   {20, 0, 5},
                   {std::cos(lean / 2), std::sin(lean / 2), 0, 0},
                   {1, 1, 1}}};
  const Picture picture = Draw(frame_, kWidth, kHeight);
  int partial = 0, rows = 0;
  for (int y = 20; y < 80; ++y, ++rows) {
    const auto luma = [&](int x) {
      return picture.rgb[static_cast<std::size_t>((y * kWidth + x) * 3)];
    };
    for (int x = 130; x < 160; ++x) {
      const int sky = luma(130), hull = luma(160), here = luma(x);
      if (hull - sky < 15) continue;
      partial += here > sky + (hull - sky) / 5 && here < hull - (hull - sky) / 5;
    }
  }
  EXPECT_GT(partial, rows / 3);
}

TEST_F(HullsTest, HundredBodiesSeenFromEverywhereGiveNoError) {
  const SharedHullMesh meshes[] = {BoatModel(), BuoyModel(), CrateModel(), BarrelModel(),
                                   RaftModel()};
  for (int n = 0; n < 100; ++n) {
    frame_.hulls.push_back({meshes[n % 5],
                            {15.0 * std::cos(n), 3.0 * (n % 10) - 15.0, 0.3},
                            {std::cos(0.1 * n), 0, 0, std::sin(0.1 * n)},
                            {0.5f, 0.1f, 0.1f}});
  }
  for (double height : {-2.0, 0.2, 2.0, 60.0}) {
    for (double pitch : {-1.2, 0.0, 0.7}) {
      frame_.camera.position_m.z = height;
      frame_.camera.pitch_rad = pitch;
      Draw(frame_, 96, 54);
      ASSERT_EQ(glGetError(), GLenum{GL_NO_ERROR});
    }
  }
}

// Enclosed volume by the divergence theorem: right if closed and facing outwards.
double VolumeOf(const HullMesh& mesh) {
  double sum = 0.0;
  for (std::size_t n = 0; n + 2 < mesh.corners.size(); n += 3) {
    const auto at = [&](std::size_t m) {
      const auto& p = mesh.corners[n + m].position_m;
      return Vec3d{p[0], p[1], p[2]};
    };
    const Vec3d a = at(0), b = at(1), c = at(2);
    sum += (a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
            a.z * (b.x * c.y - b.y * c.x)) /
           6.0;
  }
  return sum;
}

// Half as many cells a side, a quarter of the triangles or so; never outside of the hull's own box,
// and closed still.
TEST(HullLevelsTest, CoarserHullsAreTheSameHullInFewerTriangles) {
  for (const SharedHullMesh& mesh : {BoatModel(), BuoyModel(), BarrelModel(), BallModel()}) {
    Vec3d low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    const auto widen = [](const HullMesh& m, Vec3d& l, Vec3d& h) {
      for (const HullCorner& c : m.corners) {
        const auto& p = c.position_m;
        l = {std::min<double>(l.x, p[0]), std::min<double>(l.y, p[1]), std::min<double>(l.z, p[2])};
        h = {std::max<double>(h.x, p[0]), std::max<double>(h.y, p[1]), std::max<double>(h.z, p[2])};
      }
    };
    widen(*mesh, low, high);
    const double diagonal = Norm(high - low);
    std::size_t corners = mesh->corners.size();
    for (double cells : {16.0, 8.0}) {
      const HullMesh coarse = CoarserHull(*mesh, static_cast<float>(diagonal / cells));
      EXPECT_LT(coarse.corners.size(), corners * 2 / 3);
      EXPECT_GE(coarse.corners.size(), 3u * 8u);
      corners = coarse.corners.size();
      Vec3d l{1e9, 1e9, 1e9}, h{-1e9, -1e9, -1e9};
      widen(coarse, l, h);
      for (double inside :
           {l.x - low.x, l.y - low.y, l.z - low.z, high.x - h.x, high.y - h.y, high.z - h.z}) {
        EXPECT_GE(inside, -1e-5);
        EXPECT_LE(inside, 1.01 * diagonal / cells);
      }
      EXPECT_NEAR(VolumeOf(coarse), VolumeOf(*mesh), 0.45 * VolumeOf(*mesh));
    }
  }
  // Of what is smaller than a cell nothing but what crosses the cells' borders is left.
  EXPECT_LE(CoarserHull(*BallModel(0.1), 10.0f).corners.size(), 3u * 24u);
}

// Far boats cover about the pixels that they would in full.
TEST_F(HullsTest, FarHullsKeepTheirPlaceInThePicture) {
  frame_.hulls = {
      {BoatModel(6, 2.2, 1.1), {150, 0, 0.2}, {0.7071, 0, 0, 0.7071}, {0.9f, 0.9f, 0.9f}}};
  frame_.camera.vertical_fov_rad = 0.2;
  const std::vector<bool> near = Changed();  // 100 pixels long
  frame_.camera.vertical_fov_rad = kFov;
  const std::vector<bool> far = Changed();
  const auto count = [](const std::vector<bool>& m) {
    return static_cast<double>(std::count(m.begin(), m.end(), true));
  };
  const double ratio = std::pow(std::tan(0.5 * kFov) / std::tan(0.1), 2);
  EXPECT_GT(count(far), 10.0);
  EXPECT_NEAR(count(far) * ratio, count(near), 0.6 * count(near));
}

TEST(HullModelsTest, FacesLookOutwards) {
  const struct {
    const char* name;
    SharedHullMesh mesh;
    double volume_m3, tolerance;
  } kModels[] = {
      {"ball", BallModel(1.0), 4.18879, 0.06},
      {"barrel", BarrelModel(0.5, 2.0), 3.14159 * 0.25 * 2.0, 0.15},
      {"capsule", CapsuleModel(0.5, 2.0), 3.14159 * (0.25 * 2.0 + 4.0 / 3.0 * 0.125), 0.06},
  };
  for (const auto& model : kModels) {
    EXPECT_NEAR(VolumeOf(*model.mesh), model.volume_m3, model.tolerance) << model.name;
  }
  for (const SharedHullMesh& mesh : {BoatModel(), BuoyModel(), CrateModel(), BarrelModel(),
                                     BallModel(), CapsuleModel(), RaftModel()}) {
    EXPECT_GT(VolumeOf(*mesh), 0.0);
    for (const HullCorner& corner : mesh->corners) {
      const auto& n = corner.normal;
      ASSERT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1.0, 1e-4);
    }
  }
}

// The faces of a closed body, each as a vector along its outward normal, add up to nothing: one
// that looks inwards would not be drawn.
TEST(HullModelsTest, FacesAddUpToNothing) {
  for (const SharedHullMesh& mesh : {BoatModel(), BuoyModel(), CrateModel(), BarrelModel(),
                                     BallModel(), CapsuleModel(), RaftModel()}) {
    Vec3d sum;
    double area = 0.0;
    for (std::size_t n = 0; n + 2 < mesh->corners.size(); n += 3) {
      const auto at = [&](std::size_t m) {
        const auto& p = mesh->corners[n + m].position_m;
        return Vec3d{p[0], p[1], p[2]};
      };
      const Vec3d u = at(1) - at(0), v = at(2) - at(0);
      const Vec3d face{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
      sum = sum + face;
      area += Norm(face);
    }
    EXPECT_LT(Norm(sum), 0.01 * area);
  }
}

TEST(HullModelsTest, CreaseSeparatesNormals) {
  // A cube's corners keep their faces' normals; a fine ball's are those of the sphere.
  const std::vector<Vec3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::array<std::uint32_t, 3>> faces = {
      {0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const SharedHullMesh tetrahedron = PlainModel(corners, faces);
  EXPECT_NEAR(tetrahedron->corners[0].normal[2], -1.0, 1e-6);
  EXPECT_NEAR(tetrahedron->corners[3].normal[1], -1.0, 1e-6);
  const SharedHullMesh ball = BallModel(2.0);
  for (const HullCorner& c : ball->corners) {
    for (std::size_t n = 0; n < 3; ++n) EXPECT_NEAR(c.normal[n], 0.5 * c.position_m[n], 0.05);
  }
}

}  // namespace
}  // namespace onesea::render
