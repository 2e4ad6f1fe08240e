#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "common/base/limits.h"
#include "common/base/vec.h"
#include "common/wire/body_gear.h"

/// What a floating body is, as commands, session files and viewers say it. Body frame: x forward, y
/// to port, z up, metres; its origin is the shape's, not the centre of mass.
namespace onesea::wire {

enum class ShapeKind : std::uint8_t {
  kBox = 1,
  kSphere = 2,
  kCylinder = 3,  ///< axis along z
  kCapsule = 4,   ///< axis along x
  kMesh = 5,      ///< closed, of triangles
};

struct BodyShape {
  ShapeKind kind = ShapeKind::kBox;
  Vec3d size_m{1.0, 1.0, 1.0};  ///< of a box
  double radius_m = 0.5;        ///< of round ones
  double length_m = 1.0;        ///< of a cylinder, and of a capsule without its ends
  std::string mesh{};           ///< of kMesh: a file's bytes, STL or OBJ; not streamed
  std::uint64_t mesh_hash = 0;  ///< of those bytes (MeshHash); what viewers ask for
  friend bool operator==(const BodyShape&, const BodyShape&) = default;
};
std::uint64_t MeshHash(const std::string& mesh);

enum class BodyControl : std::uint8_t {
  kIntegrated = 1,  ///< moved by the server
  kByOwner = 2,     ///< its owner streams poses (SetBodyPoses)
};
enum class Radiation : std::uint8_t {
  kCoefficients = 1,  ///< by the damping given or estimated
  kGrid = 2,          ///< by the wake in the interaction layer alone
};

/// (6 x 6) row-major: surge, sway, heave, roll, pitch, yaw about the centre of mass; SI units.
using Matrix6 = std::array<double, 36>;

inline constexpr std::uint32_t kBodyColourDefault = 0xC0C0C0;

/// What is none or empty is the preset's; without a preset, what the comment says.
struct BodyDescription {
  std::string preset;  ///< a ready-made body of the server's; at most 64 bytes; empty: none
  std::string name;    ///< at most 64 bytes
  std::string owner;   ///< at most 64 bytes
  std::optional<std::uint32_t> colour_rgb;             ///< none: kBodyColourDefault
  std::optional<BodyControl> control;                  ///< none: kIntegrated
  std::optional<Radiation> radiation;                  ///< none: kCoefficients
  std::optional<BodyShape> shape;                      ///< needed
  std::optional<double> mass_kg;                       ///< [1e-3, 1e9]; needed
  std::optional<Vec3d> centre_of_mass_m;               ///< none: of the uniform solid
  std::optional<std::array<double, 9>> inertia_kg_m2;  ///< row-major; none: of the uniform solid
  std::optional<Matrix6> added_mass;                   ///< none: estimated from the shape
  std::optional<Matrix6> radiation_damping;            ///< none: estimated
  std::optional<Matrix6> viscous_damping;              ///< none: estimated
  std::optional<Matrix6> quadratic_damping;            ///< none: nothing
  std::optional<Drag> drag;                            ///< none: Drag{}
  std::optional<Windage> windage;                      ///< none: Windage{}
  std::vector<Thruster> thrusters;                     ///< at most kThrustersMax
  std::vector<Rudder> rudders;                         ///< at most kRuddersMax
  std::optional<double> contact_friction;              ///< [0, 2]; none: 0.4
  std::optional<double> contact_restitution;           ///< [0, 1]; none: 0.1
  friend bool operator==(const BodyDescription&, const BodyDescription&) = default;
};

/// `base` with everything that `given` says in place of its own, field by field; the preset of
/// neither.
BodyDescription Overlaid(BodyDescription base, const BodyDescription& given);

/// Ranges of every number and text, and that nothing needed is missing; whether there is such a
/// preset, and whether the hull is closed and can float, is the server's to say. InvalidArgument
/// naming field, value and limit, each field after `prefix`.
absl::Status ValidateBodyDescription(const std::string& prefix, const BodyDescription& body);

/// What a viewer needs to draw and name a body.
struct BodyInfo {
  std::uint32_t id = 0;
  std::string name, owner;
  std::uint32_t colour_rgb = kBodyColourDefault;
  BodyShape shape;         ///< without the mesh's bytes
  Vec3d centre_of_mass_m;  ///< body frame: what BodyState::position_m is the place of
  double mass_kg = 0.0;
  friend bool operator==(const BodyInfo&, const BodyInfo&) = default;
};
absl::Status ValidateBodyInfo(const BodyInfo& info);

}  // namespace onesea::wire
