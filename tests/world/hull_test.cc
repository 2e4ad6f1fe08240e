#include "server/world/hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "common/base/limits.h"
#include "common/ingest/file_bytes.h"
#include "common/ingest/mesh_file.h"
#include "common/sea/constants.h"
#include "server/world/hull_shapes.h"

namespace onesea::world {
namespace {

using sea::kPi;

std::string Refusal(const TriangleMesh& mesh) { return std::string(ValidateMesh(mesh).message()); }

void ExpectNear(Vec3d a, Vec3d b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// V = abc, I = m (b² + c²) / 12, exactly, wherever the origin lies.
TEST(Hull, BoxHasClosedFormProperties) {
  TriangleMesh mesh = BoxMesh({4, 2, 1}, 3);
  for (Vec3d& v : mesh.vertices) v = v + Vec3d{10, -20, 5};
  ASSERT_TRUE(ValidateMesh(mesh).ok()) << ValidateMesh(mesh);
  EXPECT_EQ(mesh.triangles.size(), 6u * 9 * 2);
  const SolidProperties solid = ComputeSolid(mesh);
  EXPECT_NEAR(solid.volume_m3, 8.0, 1e-12);
  EXPECT_NEAR(solid.area_m2, 28.0, 1e-12);
  ExpectNear(solid.centroid_m, {10, -20, 5}, 1e-12);
  EXPECT_NEAR(solid.inertia_per_kg(0, 0), (4.0 + 1.0) / 12, 1e-12);
  EXPECT_NEAR(solid.inertia_per_kg(1, 1), (16.0 + 1.0) / 12, 1e-12);
  EXPECT_NEAR(solid.inertia_per_kg(2, 2), (16.0 + 4.0) / 12, 1e-12);
  EXPECT_NEAR(solid.inertia_per_kg(0, 1), 0.0, 1e-12);
}

// Volumes are exact by construction; the inertia of the polyhedron is within its facets' error.
TEST(Hull, RoundBodiesHaveTheVolumeOfTheTrueOnes) {
  const TriangleMesh sphere = SphereMesh(5.0, 16);
  ASSERT_TRUE(ValidateMesh(sphere).ok()) << ValidateMesh(sphere);
  SolidProperties solid = ComputeSolid(sphere);
  EXPECT_NEAR(solid.volume_m3, 4.0 / 3 * kPi * 125, 1e-9);
  EXPECT_NEAR(solid.inertia_per_kg(0, 0) / (0.4 * 25), 1.0, 0.01);

  const TriangleMesh cylinder = CylinderMesh(2.0, 3.0, 32);
  ASSERT_TRUE(ValidateMesh(cylinder).ok()) << ValidateMesh(cylinder);
  solid = ComputeSolid(cylinder);
  EXPECT_NEAR(solid.volume_m3, kPi * 12, 1e-9);
  EXPECT_NEAR(solid.inertia_per_kg(2, 2) / 2.0, 1.0, 0.01);
  EXPECT_NEAR(solid.inertia_per_kg(0, 0) / (1.0 + 9.0 / 12), 1.0, 0.01);

  const TriangleMesh capsule = CapsuleMesh(0.5, 2.0);
  ASSERT_TRUE(ValidateMesh(capsule).ok()) << ValidateMesh(capsule);
  solid = ComputeSolid(capsule);
  EXPECT_NEAR(solid.volume_m3, kPi * 0.25 * (2.0 + 2.0 / 3), 1e-9);
  EXPECT_NEAR(solid.high_m.x, 1.5, 1e-9);
}

// Between the prism of its midship section and half of it; closed, symmetric, pointed at the bow.
TEST(Hull, BoatIsClosedAndSymmetric) {
  const BoatLines lines;
  const TriangleMesh mesh = BoatMesh(lines);
  ASSERT_TRUE(ValidateMesh(mesh).ok()) << ValidateMesh(mesh);
  const SolidProperties solid = ComputeSolid(mesh);
  const double block = lines.length_m * lines.beam_m * lines.depth_m;
  EXPECT_GT(solid.volume_m3, 0.4 * block);
  EXPECT_LT(solid.volume_m3, 0.8 * block);
  EXPECT_NEAR(solid.centroid_m.y, 0.0, 1e-12);
  EXPECT_LT(solid.centroid_m.x, 0.0);  // fuller aft
  EXPECT_NEAR(solid.high_m.x - solid.low_m.x, lines.length_m, 0.05 * lines.length_m);
}

TEST(Hull, RefusalsSayWhatIsWrong) {
  const TriangleMesh good = BoxMesh({1, 1, 1}, 2);
  TriangleMesh bad = good;
  bad.triangles.pop_back();
  EXPECT_TRUE(absl::StrContains(Refusal(bad), "not closed: 3 open edges")) << Refusal(bad);
  bad = good;
  std::swap(bad.triangles[5][0], bad.triangles[5][1]);
  EXPECT_TRUE(absl::StrContains(Refusal(bad), "opposite sense")) << Refusal(bad);
  bad = good;
  for (auto& t : bad.triangles) std::swap(t[0], t[1]);
  EXPECT_TRUE(absl::StrContains(Refusal(bad), "inwards")) << Refusal(bad);
  bad = good;
  bad.vertices[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(absl::StrContains(Refusal(bad), "vertex 3")) << Refusal(bad);
  bad = good;
  bad.triangles[0][0] = 1000;
  EXPECT_TRUE(absl::StrContains(Refusal(bad), "names vertex 1000")) << Refusal(bad);
  bad = good;
  for (Vec3d& v : bad.vertices) v.z = 0.0;
  EXPECT_TRUE(absl::StrContains(Refusal(bad), "no volume")) << Refusal(bad);
  bad = good;
  for (Vec3d& v : bad.vertices) v = 1e-4 * v;
  EXPECT_TRUE(absl::StrContains(Refusal(bad), "unit")) << Refusal(bad);
  EXPECT_TRUE(absl::StrContains(Refusal(TriangleMesh{}), "no triangles"));
  bad = SphereMesh(1.0, 80);
  EXPECT_TRUE(absl::StrContains(Refusal(bad), "at most")) << Refusal(bad);
}

// Independent numpy figures, tests/data/bodies/README.md.
TEST(HullFile, ReadsABinaryStlOfKnownVolume) {
  const auto bytes = ingest::ReadFileBytes("tests/data/bodies/viking_ship.stl");
  ASSERT_TRUE(bytes.ok()) << bytes.status();
  const auto mesh = ingest::ReadMeshFile(*bytes);
  ASSERT_TRUE(mesh.ok()) << mesh.status();
  ASSERT_TRUE(ValidateMesh(*mesh).ok()) << ValidateMesh(*mesh);
  EXPECT_NEAR(ComputeSolid(*mesh).volume_m3, 0.736426, 2e-6);
}

std::string AsTextStl(const TriangleMesh& mesh) {
  std::string text = "solid box\n";
  for (const auto& t : mesh.triangles) {
    absl::StrAppend(&text, " facet normal 0 0 0\r\n  outer loop\n");
    for (auto corner : t) {
      const Vec3d v = mesh.vertices[corner];
      absl::StrAppend(&text, "   vertex ", v.x, " ", v.y, "\t", v.z, "\n");
    }
    absl::StrAppend(&text, "  endloop\n endfacet\n");
  }
  return absl::StrCat(text, "endsolid box\n");
}

TEST(HullFile, ReadsTextStlAndObj) {
  const TriangleMesh box = BoxMesh({4, 2, 1}, 2);
  const auto text = ingest::ReadMeshFile(AsTextStl(box));
  ASSERT_TRUE(text.ok()) << text.status();
  EXPECT_TRUE(ValidateMesh(*text).ok()) << ValidateMesh(*text);
  EXPECT_NEAR(ComputeSolid(*text).volume_m3, 8.0, 1e-9);

  // Quads, relative indices, and indices with texture and normals.
  const auto cube = ingest::ReadMeshFile(
      "# cube\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nvn 0 0 1\n"
      "o cube\nf 1 4 3 2\nf -4 -3 -2 -1\nf 1//1 2//1 6//1 5//1\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  ASSERT_TRUE(cube.ok()) << cube.status();
  ASSERT_TRUE(ValidateMesh(*cube).ok()) << ValidateMesh(*cube);
  EXPECT_NEAR(ComputeSolid(*cube).volume_m3, 1.0, 1e-12);
}

// Whatever the bytes are: a status or a mesh that ValidateMesh judges, never a crash.
TEST(HullFile, DamagedFilesAreRefusedOrJudged) {
  const std::string text = AsTextStl(BoxMesh({1, 1, 1}, 1));
  EXPECT_FALSE(ingest::ReadMeshFile("solid\nfacet\nouter loop\nvertex 1 2\n").ok());
  EXPECT_FALSE(ingest::ReadMeshFile("solid\nvertex 0 0 0\nvertex 1 0 0\nendloop\n").ok());
  EXPECT_FALSE(ingest::ReadStl("xyz").ok());
  EXPECT_FALSE(ingest::ReadStl(std::string(200, '\x7f')).ok());
  EXPECT_FALSE(ingest::ReadMeshFile(std::string(kHullFileBytesMax + 1, ' ')).ok());
  for (const char* obj :
       {"f 1 2 3\n", "v 0 0 0\nf 1 2 3\n", "v nan nan nan\nf 1 1 1\n", "f\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4 5 6\n", "f -9 -8 -7\n", "v\nf 0 0 0\n",
        "mtllib none.mtl\nusemtl x\n", "", "\xff\xfe", "f 1 2 99999999999999999\n"}) {
    const auto mesh = ingest::ReadMeshFile(obj);
    EXPECT_FALSE(mesh.ok() && ValidateMesh(*mesh).ok()) << obj;
  }
  std::uint64_t random = 7;
  for (int n = 0; n < 300; ++n) {
    std::string damaged = text;
    for (int k = 0; k < 5; ++k) {
      random = random * 6364136223846793005u + 1442695040888963407u;
      damaged[(random >> 33) % damaged.size()] = static_cast<char>(random >> 56);
    }
    const auto mesh = ingest::ReadMeshFile(damaged);
    if (mesh.ok()) (void)ValidateMesh(*mesh);
  }
}

}  // namespace
}  // namespace onesea::world
