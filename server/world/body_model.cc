#include <algorithm>
#include <cmath>

#include "server/world/added_mass.h"
#include "server/world/body_spec.h"
#include "server/world/hull_shapes.h"

namespace onesea::world {
namespace {

// Shares of critical damping where the spec gives no matrix; typical of small craft.
constexpr double kRadiationShare[6] = {0, 0, 0.15, 0.05, 0.15, 0};
constexpr double kViscousShare[6] = {0, 0, 0.03, 0.03, 0.03, 0};
constexpr double kDriftStopS = 60.0;  // surge, sway and yaw, beside the quadratic drag

Mat6 ShareOfCritical(const double (&share)[6], const BodyModel& model) {
  const double stiffness[6] = {0,
                               0,
                               model.rest.heave_n_per_m,
                               std::abs(model.rest.roll_n_m_per_rad),
                               std::abs(model.rest.pitch_n_m_per_rad),
                               0};
  Mat6 out{};
  for (int i = 0; i < 6; ++i) {
    const double inertia = model.rigid_mass[i][i] + model.added_at_rest[i][i];
    out[i][i] = 2.0 * share[i] * std::sqrt(inertia * stiffness[i]);
  }
  return out;
}

Mat6 RigidMass(double mass_kg, const Mat3d& inertia_kg_m2) {
  Mat6 out{};
  for (int i = 0; i < 3; ++i) {
    out[i][i] = mass_kg;
    for (int j = 0; j < 3; ++j) out[3 + i][3 + j] = inertia_kg_m2(i, j);
  }
  return out;
}

// Finer faces than two for each sample of the water around a body (body_water.h) tell nothing.
constexpr double kFaceM = 0.5;

int CellsAlong(double size_m) {
  return std::clamp(static_cast<int>(std::ceil(size_m / kFaceM)), 2, 4);
}

}  // namespace

TriangleMesh MakeMesh(const BodyShape& shape) {
  switch (shape.kind) {
    case ShapeKind::kBox:
      return BoxMesh(shape.size_m, {CellsAlong(shape.size_m.x), CellsAlong(shape.size_m.y),
                                    CellsAlong(shape.size_m.z)});
    case ShapeKind::kSphere:
      return SphereMesh(shape.radius_m);
    case ShapeKind::kCylinder:
      return CylinderMesh(shape.radius_m, shape.length_m, shape.radius_m > 1.5 * kFaceM ? 24 : 16,
                          CellsAlong(shape.length_m));
    case ShapeKind::kCapsule:
      return CapsuleMesh(shape.radius_m, shape.length_m);
    case ShapeKind::kMesh:
      break;
  }
  return shape.mesh;
}

absl::StatusOr<std::shared_ptr<const BodyModel>> MakeBodyModel(BodySpec spec,
                                                               double density_kg_per_m3) {
  if (absl::Status s = ValidateBodySpec(spec); !s.ok()) return s;
  TriangleMesh mesh = MakeMesh(spec.shape);
  const SolidProperties solid = ComputeSolid(mesh);
  const Vec3d centre = spec.centre_of_mass_m.value_or(solid.centroid_m);
  WetHull hull(mesh, centre);
  const Hydrostatics rest = FloatUpright(hull, spec.mass_kg, density_kg_per_m3);
  auto model = std::make_shared<BodyModel>(BodyModel{.spec = std::move(spec),
                                                     .density_kg_per_m3 = density_kg_per_m3,
                                                     .mesh = std::move(mesh),
                                                     .solid = solid,
                                                     .centre_of_mass_m = centre,
                                                     .hull = std::move(hull),
                                                     .rest = rest});
  const BodySpec& given = model->spec;
  const Vec3d size = solid.high_m - solid.low_m;
  const double area_m2 = solid.volume_m3 / std::min({size.x, size.y, size.z});
  model->bare_heave_rad_per_s =
      std::sqrt(density_kg_per_m3 * sea::kGravity * area_m2 / given.mass_kg);
  Mat3d inertia = solid.inertia_per_kg;
  for (double& value : inertia.m) value *= given.mass_kg;
  model->rigid_mass = RigidMass(given.mass_kg, given.inertia_kg_m2.value_or(inertia));
  if (given.added_mass) {
    model->added_at_rest = model->added_submerged = *given.added_mass;
  } else {
    model->added_at_rest = EstimateAddedMass(rest, density_kg_per_m3);
    model->added_submerged = EstimateSubmergedAddedMass(solid, centre, density_kg_per_m3);
  }
  const bool is_round = given.shape.kind != ShapeKind::kBox && given.shape.kind != ShapeKind::kMesh;
  if (!is_round) model->stern = SternOf(model->mesh, solid, centre);
  model->radiation_damping =
      given.radiation_damping ? *given.radiation_damping : ShareOfCritical(kRadiationShare, *model);
  if (!given.heave_memory.kernel.empty()) {
    for (int i = 0; i < 6; ++i) {
      model->radiation_damping[2][i] = model->radiation_damping[i][2] = 0.0;
    }
    model->memory_damping = given.heave_memory.Damping();
  }
  if (given.viscous_damping) {
    model->viscous_damping = *given.viscous_damping;
  } else {
    model->viscous_damping = ShareOfCritical(kViscousShare, *model);
    for (int i : {0, 1, 5}) {
      model->viscous_damping[i][i] +=
          (model->rigid_mass[i][i] + model->added_at_rest[i][i]) / kDriftStopS;
    }
  }
  return std::shared_ptr<const BodyModel>(std::move(model));
}

}  // namespace onesea::world
