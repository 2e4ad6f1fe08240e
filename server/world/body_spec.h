#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "common/sea/constants.h"
#include "common/wire/body_description.h"
#include "server/world/hydrostatics.h"
#include "server/world/propulsion.h"
#include "server/world/radiation_memory.h"
#include "server/world/stern_flow.h"
#include "server/world/wet_hull.h"

/// What a floating body is.
namespace onesea::world {

using wire::BodyControl;
using wire::Radiation;
using wire::ShapeKind;

struct BodyShape {
  ShapeKind kind = ShapeKind::kBox;
  Vec3d size_m{1.0, 1.0, 1.0};  ///< of a box
  double radius_m = 0.5;        ///< of round ones
  double length_m = 1.0;        ///< of a cylinder, and of a capsule without its ends
  TriangleMesh mesh{};          ///< of kMesh
  friend bool operator==(const BodyShape&, const BodyShape&) = default;
};

struct BodySpec {
  BodyControl control = BodyControl::kIntegrated;
  Radiation radiation = Radiation::kCoefficients;
  BodyShape shape;
  double mass_kg = 1.0;
  /// Body frame; none: of the uniform solid.
  std::optional<Vec3d> centre_of_mass_m;
  /// kg m² about the centre of mass; none: of the uniform solid.
  std::optional<Mat3d> inertia_kg_m2;
  /// Symmetric, about the centre of mass, body axes, at rest; none: EstimateAddedMass.
  std::optional<Mat6> added_mass;
  /// Linear damping by waves made, N per m/s and so on; none: 15 % of critical in heave and pitch,
  /// 5 % in roll.
  std::optional<Mat6> radiation_damping;
  /// Linear damping by friction and eddies; none: 3 % of critical in heave, roll and pitch, and
  /// what stops surge, sway and yaw in a minute.
  std::optional<Mat6> viscous_damping;
  /// Quadratic: force i = -sum_j q_ij sqrt|v_i v_j| v_j, which can only take energy.
  Mat6 quadratic_damping{};
  /// Heave radiation with memory in place of radiation_damping's heave; empty: none.
  RadiationKernel heave_memory;
  wire::Drag drag;
  wire::Windage windage;
  std::vector<wire::Thruster> thrusters;
  std::vector<wire::Rudder> rudders;
  double contact_friction = 0.4;     ///< [0, 2]
  double contact_restitution = 0.1;  ///< [0, 1]
  friend bool operator==(const BodySpec&, const BodySpec&) = default;
};

/// OK, or InvalidArgument naming field, value and limit. Matrices must be symmetric, damping must
/// not give energy, mass with added mass must be positive. A body may be heavier than water, but
/// not than osmium (25 000 kg/m³).
absl::Status ValidateBodySpec(const BodySpec& spec);

/// A validated spec with all that stepping needs; immutable, shared, safe from any thread.
struct BodyModel {
  BodySpec spec;
  double density_kg_per_m3 = sea::kWaterDensityKgPerM3;
  TriangleMesh mesh;
  SolidProperties solid;
  Vec3d centre_of_mass_m;  ///< body frame
  WetHull hull;
  Hydrostatics rest;
  double bare_heave_rad_per_s = 0.0;  ///< of its mass alone on the largest water plane
  Mat6 rigid_mass{};                  ///< mass and inertia about the centre of mass
  Mat6 added_at_rest{}, added_submerged{};
  Stern stern = {};
  Mat6 radiation_damping{}, viscous_damping{};
  double memory_damping = 0.0;  ///< of heave_memory within one step, taken implicitly
};
absl::StatusOr<std::shared_ptr<const BodyModel>> MakeBodyModel(
    BodySpec spec, double density_kg_per_m3 = sea::kWaterDensityKgPerM3);

/// Closed mesh of a shape. Pre: valid.
TriangleMesh MakeMesh(const BodyShape& shape);

}  // namespace onesea::world
