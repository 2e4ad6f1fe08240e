// Buoyancy against Archimedes and closed forms of stability; wave forces against the integral of
// the undisturbed wave's pressure.
#include "server/world/wet_hull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "common/ingest/file_bytes.h"
#include "common/ingest/mesh_file.h"
#include "common/sea/constants.h"
#include "hwy/targets.h"
#include "server/world/hull_shapes.h"
#include "server/world/hydrostatics.h"
#include "tests/world/regular_wave_patch.h"
#include "tests/world/wigley.h"

namespace onesea::world {
namespace {

using sea::kGravity;
using sea::kPi;
constexpr double kRho = 1000.0;
const wire::Drag kNoDrag{0, 0, 0, 0};

WetForces At(const WetHull& hull, Pose pose, const WaterPatch& water = {}) {
  WetScratch scratch;
  return hull.Evaluate({.pose = pose}, water, kRho, kNoDrag, scratch);
}

// Depth of the true body's lowest point, `below_m` under the origin, at rest.
double Draft(const TriangleMesh& mesh, double mass_kg, double below_m) {
  const Hydrostatics rest = FloatUpright(WetHull(mesh, {}), mass_kg, kRho);
  EXPECT_TRUE(rest.floats);
  return below_m - rest.centre_height_m;
}

TEST(WetHull, DraftsAreArchimedes) {
  EXPECT_NEAR(Draft(BoxMesh({4, 2, 1}), 0.5 * kRho * 8, 0.5), 0.5, 1e-9);
  EXPECT_NEAR(Draft(CylinderMesh(5, 20), kRho * kPi * 25 * 10, 10), 10.0, 1e-9);
  // (3x² - x³)/4 = s; the inscribed sphere is within 1 %.
  for (const auto& [s, x] :
       {std::pair(0.1, 0.3916), {0.25, 0.652704}, {0.5, 1.0}, {0.75, 1.3473}, {0.9, 1.6084}}) {
    const TriangleMesh sphere = SphereMesh(5.0, 16);
    EXPECT_NEAR(Draft(sphere, s * kRho * 4.0 / 3 * kPi * 125, 5) / 5.0, x, 0.01 * x) << s;
  }
  const double half_log = 0.5 * kRho * kPi * 0.25 * (2.0 + 2.0 / 3);
  EXPECT_NEAR(Draft(CapsuleMesh(0.5, 2.0), half_log, 0.5), 0.5, 0.005);
  EXPECT_FALSE(FloatUpright(WetHull(BoxMesh({1, 1, 1}), {}), 1001.0, kRho).floats);
}

// Turned any way, deep or half out: force = rho g V, straight up, through the volume's centre.
TEST(WetHull, PressureIsTheWeightOfTheDisplacedWater) {
  for (const TriangleMesh& mesh : {BoxMesh({4, 2, 1}), SphereMesh(1.5), BoatMesh({})}) {
    const Vec3d centre{0.3, -0.1, 0.2};
    const WetHull hull(mesh, centre);
    for (int n = 0; n < 20; ++n) {
      const Quaternion turn =
          Normalised({std::cos(1.0 + n), std::sin(2.0 * n), std::cos(3.0 * n), 0.4});
      const Pose pose{{5.0, -7.0, -2.0 + 0.2 * n}, turn};
      const WetForces got = At(hull, pose);
      const Vec3d force = ToMatrix(turn) * got.pressure_force_n;
      const double weight = kRho * kGravity * got.volume_m3;
      EXPECT_NEAR(force.x, 0.0, 1e-8 * kRho * kGravity);
      EXPECT_NEAR(force.y, 0.0, 1e-8 * kRho * kGravity);
      EXPECT_NEAR(force.z, weight, 1e-8 * kRho * kGravity);
      const Vec3d expected = Cross(got.volume_centre_m, got.pressure_force_n);
      EXPECT_NEAR(Norm(got.pressure_torque_n_m - expected), 0.0, 1e-7 * kRho * kGravity);
    }
    const WetForces deep = At(hull, {{0, 0, -50}, {}});
    EXPECT_NEAR(deep.volume_m3, ComputeSolid(mesh).volume_m3, 1e-9);
    EXPECT_NEAR(Norm(deep.volume_centre_m - (ComputeSolid(mesh).centroid_m - centre)), 0, 1e-8);
    EXPECT_EQ(At(hull, {{0, 0, 50}, {}}).wet_triangles, 0);
  }
}

// Righting arm of the heeled body at its displacement: torque over weight.
double RightingArm(const WetHull& hull, double mass_kg, double heel_rad) {
  double low = -10, high = 10;
  for (int n = 0; n < 60; ++n) {
    const double z = 0.5 * (low + high);
    const WetForces at = At(hull, {{0, 0, z}, AboutAxis({1, 0, 0}, heel_rad)});
    (at.volume_m3 * kRho > mass_kg ? low : high) = z;
  }
  const WetForces rest = At(hull, {{0, 0, low}, AboutAxis({1, 0, 0}, heel_rad)});
  return -rest.pressure_torque_n_m.x / (mass_kg * kGravity);
}

// Wall-sided: GZ = (GM + BM tan²/2) sin, until the deck's edge goes under at 26.57 degrees.
TEST(WetHull, RightingArmOfTheWallSidedBox) {
  const WetHull box(BoxMesh({4, 2, 1}), {});
  for (const auto& [degrees, arm_m] :
       {std::pair(5, 0.0365373), {10, 0.0741531}, {15, 0.114035}, {20, 0.157611}}) {
    EXPECT_NEAR(RightingArm(box, 4000.0, degrees * kPi / 180), arm_m, 1e-6) << degrees;
  }
  const Hydrostatics rest = FloatUpright(box, 4000.0, kRho);
  EXPECT_NEAR(rest.roll_n_m_per_rad / (4000.0 * kGravity), 0.416667, 1e-5);
  EXPECT_NEAR(rest.pitch_n_m_per_rad / (4000.0 * kGravity), 2.41667, 1e-4);
  EXPECT_NEAR(rest.heave_n_per_m, kRho * kGravity * 8.0, 1e-3);
}

// A uniform cube floats upright only outside 0.2113 < s < 0.7887.
TEST(WetHull, CubeIsUnstableInItsRange) {
  const WetHull cube(BoxMesh({1, 1, 1}), {});
  const auto stiffness = [&](double s) {
    return FloatUpright(cube, s * kRho, kRho).roll_n_m_per_rad;
  };
  EXPECT_GT(stiffness(0.205), 0.0);
  EXPECT_LT(stiffness(0.218), 0.0);
  EXPECT_LT(stiffness(0.5), 0.0);
  EXPECT_LT(stiffness(0.782), 0.0);
  EXPECT_GT(stiffness(0.795), 0.0);
}

TEST(WetHull, HullsOfKnownDisplacement) {
  const WetHull wigley(WigleyMesh(10, 1, 0.625, 0.3), {});
  const WetForces at = At(wigley, {});
  EXPECT_NEAR(at.volume_m3 / 2.777778, 1.0, 0.003);  // the mesh is inscribed
  EXPECT_NEAR(at.volume_centre_m.z, -0.234375, 0.001);

  const auto bytes = ingest::ReadFileBytes("tests/data/bodies/viking_ship.stl");
  ASSERT_TRUE(bytes.ok());
  const WetForces viking = At(WetHull(ingest::ReadStl(*bytes).value(), {0, 0, 0.3}), {});
  EXPECT_NEAR(viking.volume_m3, 0.405229, 1e-6);
  EXPECT_NEAR(viking.volume_centre_m.z + 0.3, 0.182540, 1e-6);

  // Open above the water: refused as a body, but what is wet is right.
  const auto text = ingest::ReadFileBytes("tests/data/bodies/boat_200.mar");
  ASSERT_TRUE(text.ok());
  std::istringstream in(*text);
  TriangleMesh boat;
  double skip, x, y, z;
  in >> skip >> skip;
  while (in >> skip >> x >> y >> z && skip != 0) boat.vertices.push_back({x, y, z});
  in >> skip;  // the fifth zero
  std::array<std::uint32_t, 4> q;
  while (in >> q[0] >> q[1] >> q[2] >> q[3] && q[0] != 0) {
    boat.triangles.push_back({q[0] - 1, q[1] - 1, q[2] - 1});
    boat.triangles.push_back({q[0] - 1, q[2] - 1, q[3] - 1});
  }
  Weld(boat);
  EXPECT_NE(std::string(ValidateMesh(boat).message()).find("12 open edges"), std::string::npos)
      << ValidateMesh(boat);
  const WetForces wet = At(WetHull(boat, {}), {});
  EXPECT_NEAR(wet.volume_m3, 933.768, 0.01);
  EXPECT_NEAR(wet.volume_centre_m.x, -2.7089, 1e-3);
  EXPECT_NEAR(wet.volume_centre_m.z, -1.7299, 1e-3);
}

// A fixed box of length L and draft T in a wave along it: the undisturbed wave's pressure gives
//   heave  rho g a B e^{-kT} (2/k) sin(kL/2) cos wt,
//   surge  -rho g a B 2 sin(kL/2) (1 - e^{-kT})/k sin wt, for small a.
TEST(WetHull, FroudeKrylovForceOfABox) {
  const double length = 10, beam = 4, draft = 2, a = 0.01;
  const WetHull hull(BoxMesh({length, beam, 3}, 24), {});
  for (const double wavelength : {20.0, 40.0, 100.0}) {
    const RegularWave wave{.amplitude_m = a, .wavenumber_rad_per_m = 2 * kPi / wavelength};
    const double k = wave.wavenumber_rad_per_m;
    const double unit = kRho * kGravity * a * beam * 2 / k * std::sin(k * length / 2);
    for (const double turn : {0.0, 1.0, 2.5}) {  // wt
      WaterPatch patch;
      PatchAround({}, 8, 65, wave, turn / wave.Omega(), patch);
      const Pose pose{{0, 0, 1.5 - draft}, {}};
      const Vec3d force = At(hull, pose, patch).pressure_force_n - At(hull, pose).pressure_force_n;
      EXPECT_NEAR(force.z, unit * std::exp(-k * draft) * std::cos(turn), 0.01 * unit) << wavelength;
      EXPECT_NEAR(force.x, -unit * (1 - std::exp(-k * draft)) * std::sin(turn), 0.01 * unit)
          << wavelength;
    }
  }
}

// In shallow water the pressure hardly fades: cosh k(H - T)/cosh kH in place of e^{-kT}.
TEST(WetHull, FroudeKrylovFeelsTheBottom) {
  const double length = 4, beam = 4, draft = 2, a = 0.01, k = 0.1, depth = 4;
  const WetHull hull(BoxMesh({length, beam, 3}, 16), {});
  const RegularWave wave{.amplitude_m = a, .wavenumber_rad_per_m = k, .depth_m = depth};
  WaterPatch patch;
  PatchAround({}, 4, 33, wave, 0.0, patch);
  const Pose pose{{0, 0, 1.5 - draft}, {}};
  const double lift = At(hull, pose, patch).pressure_force_n.z - At(hull, pose).pressure_force_n.z;
  const double unit = kRho * kGravity * a * beam * 2 / k * std::sin(k * length / 2);
  EXPECT_NEAR(lift / unit, std::cosh(k * (depth - draft)) / std::cosh(k * depth), 0.01);
  EXPECT_GT(lift / unit, std::exp(-k * draft) + 0.05);
}

// Several bands at once, finite depth and deep, against the definition in double.
TEST(WaterPatch, SamplesAreTheDefinition) {
  for (const double depth : {std::numeric_limits<double>::infinity(), 6.0}) {
    WaterPatch patch;
    patch.cell_m = 0.5, patch.corner_m = {-8, -8}, patch.depth_m = depth;
    patch.level_m = 0.25, patch.current_m_per_s = {0.5, -0.25, 0};
    patch.Resize(33, 33, 9);
    std::array<RegularWave, 9> waves;
    for (int b = 0; b < 9; ++b) {
      waves[b] = {.amplitude_m = 0.3 / (1 + b),
                  .wavenumber_rad_per_m = 0.02 * std::pow(1.7, b),
                  .to_rad = 0.7 * b,
                  .depth_m = depth};
      waves[b].Fill(3.0, patch, b);
    }
    const WaterSampler sampler(patch);
    for (int n = 0; n < 60; ++n) {
      const Vec3d place{-8 + 0.5 * (n % 30), -8 + 0.5 * ((7 * n) % 30), 0.5 - 0.09 * n};
      double height = 0, felt = 0, u = 0, w = 0;
      for (const RegularWave& wave : waves) {
        const double k = wave.wavenumber_rad_per_m;
        height += wave.amplitude_m *
                  std::cos(k * (std::cos(wave.to_rad) * place.x + std::sin(wave.to_rad) * place.y) -
                           3.0 * wave.Omega());
      }
      const double d = height + 0.25 - place.z;
      for (const RegularWave& wave : waves) {
        const double k = wave.wavenumber_rad_per_m, kh = k * depth, z = std::max(0.0, d);
        const double phase =
            k * (std::cos(wave.to_rad) * place.x + std::sin(wave.to_rad) * place.y) -
            3.0 * wave.Omega();
        const double c = kh > 50 ? std::exp(-k * z) : std::cosh(k * (depth - z)) / std::cosh(kh);
        const double s = kh > 50 ? std::exp(-k * z) : std::sinh(k * (depth - z)) / std::sinh(kh);
        const double coth = kh > 50 ? 1.0 : 1 / std::tanh(kh);
        felt += c * wave.amplitude_m * std::cos(phase);
        u += c * wave.amplitude_m * wave.Omega() * coth * std::cos(phase) * std::cos(wave.to_rad);
        w += s * wave.amplitude_m * wave.Omega() * std::sin(phase);
      }
      const WaterPoint got = SampleWater(sampler, place);
      EXPECT_NEAR(got.depth_m, d, 1e-6);
      EXPECT_NEAR(got.head_m, d > 0 ? d - height + felt : 0.0, 2e-6) << n;
      EXPECT_NEAR(got.velocity_m_per_s.x, 0.5 + u, 2e-6) << n;
      EXPECT_NEAR(got.velocity_m_per_s.z, w, 2e-6) << n;
    }
  }
}

// A band that doesn't fade (k = 0), as the interaction layer is given, over any depth of water: the
// head grows by its whole height.
TEST(WaterPatch, ABandWithoutDecayLiftsTheWholeColumn) {
  for (const double depth : {std::numeric_limits<double>::infinity(), 6.0}) {
    WaterPatch patch;
    patch.depth_m = depth;
    patch.Resize(2, 2, 1);
    patch.samples.assign(patch.samples.size(), 0.25f);
    const WaterPoint got = SampleWater(WaterSampler(patch), {0.5, 0.5, -3.0});
    EXPECT_NEAR(got.head_m, 3.25, 1e-4);
    EXPECT_NEAR(got.velocity_m_per_s.x, 0.25, 1e-4);
    EXPECT_TRUE(std::isfinite(got.velocity_m_per_s.z));
  }
}

// Drag: a towed plate has rho/2 (c_p + c_s) A V²; friction acts along; nothing acts where the water
// moves with the hull.
TEST(WetHull, DragIsQuadraticAndRelative) {
  const WetHull plate(BoxMesh({0.01, 2, 1}), {});
  WetScratch scratch;
  const auto drag = [&](Vec3d velocity, Vec3d current, wire::Drag c) {
    WaterPatch water;
    water.current_m_per_s = current;
    return plate
        .Evaluate({.pose = {{0, 0, -5}, {}}, .velocity_m_per_s = velocity}, water, kRho, c, scratch)
        .drag_force_n;
  };
  EXPECT_NEAR(drag({3, 0, 0}, {}, {0, 0.8, 0.4, 0}).x, -0.5 * kRho * 1.2 * 2 * 9, 1e-6);
  EXPECT_NEAR(drag({0, 2, 0}, {}, {0.01, 0, 0, 0}).y, -0.5 * kRho * 0.01 * 4.04 * 4, 0.5);
  EXPECT_NEAR(Norm(drag({1, 2, 0}, {1, 2, 0}, {0.01, 1, 1, 1})), 0.0, 1e-12);
  EXPECT_NEAR(drag({}, {-3, 0, 0}, {0, 0.8, 0.4, 0}).x, -0.5 * kRho * 1.2 * 2 * 9, 1e-6);
}

// Nine bands of waves about the origin.
WaterPatch Chop(double depth_m) {
  WaterPatch patch;
  patch.cell_m = 0.5, patch.corner_m = {-6, -6}, patch.depth_m = depth_m;
  patch.level_m = 0.1, patch.current_m_per_s = {0.3, 0.1, 0};
  patch.Resize(25, 25, 9);
  for (int b = 0; b < 9; ++b) {
    const RegularWave wave{.amplitude_m = 0.2 / (1 + b),
                           .wavenumber_rad_per_m = 0.05 * std::pow(1.6, b),
                           .to_rad = 0.7 * b,
                           .depth_m = depth_m};
    wave.Fill(3.0, patch, b);
  }
  return patch;
}
const HullMotion kMoving{.pose = {{0.3, -0.4, 0.1}, AboutAxis({0.6, 0.8, 0}, 0.3)},
                         .velocity_m_per_s = {3, 1, -1},
                         .spin_rad_per_s = {0.1, 0.4, 0.2}};

std::vector<double> Everything(const WetForces& f) {
  std::vector<double> out{f.volume_m3, f.wet_area_m2, 1.0 * f.wet_triangles};
  for (const Vec3d& v : {f.pressure_force_n, f.pressure_torque_n_m, f.drag_force_n,
                         f.drag_torque_n_m, f.volume_centre_m, f.water_velocity_m_per_s}) {
    for (double value : {v.x, v.y, v.z}) out.push_back(value);
  }
  return out;
}

// Not one bit differs between vector widths.
TEST(WetHull, SameBitsOnEverySimdTarget) {
  for (const TriangleMesh& mesh : {BoatMesh({}), SphereMesh(2, 9), BoxMesh({1, 2, 3}, 1)}) {
    for (const double depth : {std::numeric_limits<double>::infinity(), 4.0}) {
      const WaterPatch patch = Chop(depth);
      const WetHull hull(mesh, {0.1, 0, 0.3});
      WetScratch scratch;
      std::vector<double> first;
      for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        const WetForces got = hull.Evaluate(kMoving, patch, kRho, {0.01, 0.8, 0.4, 0.3}, scratch);
        if (first.empty()) first = Everything(got);
        EXPECT_EQ(Everything(got), first) << hwy::TargetName(target);
      }
      hwy::SetSupportedTargetsForTest(0);
      EXPECT_GT(first[0], 0.0);
    }
  }
}

// Whatever way the samples lie: the same wave, the same forces.
TEST(WetHull, ATurnedPatchIsTheSameWater) {
  const WetHull hull(BoatMesh({}), {0.1, 0, 0.3});
  WetScratch scratch;
  const RegularWave wave{.amplitude_m = 0.3, .wavenumber_rad_per_m = 0.3, .to_rad = 0.7};
  WaterPatch patch;
  PatchAround({}, 8, 161, wave, 1.0, patch);
  const WetForces straight = hull.Evaluate(kMoving, patch, kRho, {0.01, 0.8, 0.4, 0.3}, scratch);
  patch.along = {0.8, -0.6};
  patch.corner_m = {};
  patch.corner_m = patch.PlaceOf(-80, -80);
  wave.Fill(1.0, patch, 0);
  const WetForces turned = hull.Evaluate(kMoving, patch, kRho, {0.01, 0.8, 0.4, 0.3}, scratch);
  EXPECT_NEAR(Norm(turned.pressure_force_n - straight.pressure_force_n), 0.0,
              1e-3 * Norm(straight.pressure_force_n));
  EXPECT_NEAR(Norm(turned.drag_force_n - straight.drag_force_n), 0.0,
              1e-3 * Norm(straight.drag_force_n));
  EXPECT_NEAR(Norm(turned.water_velocity_m_per_s - straight.water_velocity_m_per_s), 0.0, 1e-3);
}

// What vertices get of the waves is SampleWater's, but for the waves being linear between the
// depths of a profile: 2 % of each band, and nothing at the surface.
TEST(WetHull, VerticesAreSampleWaters) {
  const TriangleMesh mesh = SphereMesh(2, 9);
  constexpr double kHeadM = 2e-3, kSpeedMPerS = 4e-3;
  for (const double depth : {std::numeric_limits<double>::infinity(), 4.0}) {
    const WaterPatch patch = Chop(depth);
    const WetHull hull(mesh, {});
    WetScratch scratch;
    hull.Evaluate(kMoving, patch, kRho, {}, scratch);
    const Mat3d turn = ToMatrix(kMoving.pose.turn);
    int wet = 0;
    for (std::size_t n = 0; n < mesh.vertices.size(); ++n) {
      const WaterPoint point =
          SampleWater(WaterSampler(patch), kMoving.pose.centre_m + turn * mesh.vertices[n]);
      if (point.depth_m < 0.0) {
        EXPECT_LT(scratch.depth[n], 0.0);
        EXPECT_EQ(scratch.head[n], 0.0);
        continue;
      }
      ++wet;
      EXPECT_NEAR(scratch.depth[n], point.depth_m, 1e-6);
      EXPECT_NEAR(scratch.head[n], point.head_m, kHeadM * std::min(1.0, 10 * point.depth_m) + 1e-6);
      const Vec3d relative = turn.TransposeTimes(point.velocity_m_per_s) -
                             turn.TransposeTimes(kMoving.velocity_m_per_s) -
                             Cross(turn.TransposeTimes(kMoving.spin_rad_per_s), mesh.vertices[n]);
      EXPECT_NEAR(scratch.rx[n], relative.x, kSpeedMPerS);
      EXPECT_NEAR(scratch.ry[n], relative.y, kSpeedMPerS);
      EXPECT_NEAR(scratch.rz[n], relative.z, kSpeedMPerS);
    }
    EXPECT_GT(wet, 50);
  }
}

// Every triangle cut into 144 and summed by their middles: what is left are the waves within a
// triangle.
TEST(WetHull, ForcesAreTheIntegralOverTheWettedSurface) {
  const TriangleMesh mesh = SphereMesh(2, 9);
  const WaterPatch patch = Chop(std::numeric_limits<double>::infinity());
  const WaterSampler sampler(patch);
  WetScratch scratch;
  const WetForces got = WetHull(mesh, {}).Evaluate(kMoving, patch, kRho, {}, scratch);
  const Mat3d turn = ToMatrix(kMoving.pose.turn);
  Vec3d force;
  constexpr int kFine = 12;
  for (const auto& t : mesh.triangles) {
    const Vec3d a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    const Vec3d piece = (0.5 / (kFine * kFine)) * Cross(b - a, c - a);
    for (int i = 0; i < kFine; ++i) {
      for (int j = 0; j < 2 * (kFine - i) - 1; ++j) {
        const double u = (i + (j % 2 ? 2.0 : 1.0) / 3) / kFine;
        const double v = (j / 2 + (j % 2 ? 2.0 : 1.0) / 3) / kFine;
        const Vec3d at = a + u * (b - a) + v * (c - a);
        const double head = SampleWater(sampler, kMoving.pose.centre_m + turn * at).head_m;
        force = force - (kRho * kGravity * head) * piece;
      }
    }
  }
  EXPECT_NEAR(Norm(got.pressure_force_n - force) / Norm(force), 0.0, 0.01);
}

}  // namespace
}  // namespace onesea::world
