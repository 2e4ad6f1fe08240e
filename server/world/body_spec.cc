#include "server/world/body_spec.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "common/base/limits.h"
#include "common/base/range_check.h"

namespace onesea::world {
namespace {

constexpr double kDensityMaxKgPerM3 = 25'000.0;

// Cholesky's pivots of a + shift: all positive, so no direction has negative energy.
bool IsPositive(const Mat6& a, double relative_shift) {
  double l[6][6] = {};
  double scale = 0.0;
  for (int i = 0; i < 6; ++i) scale = std::max(scale, std::abs(a[i][i]));
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      double sum = a[i][j] + (i == j ? relative_shift * scale : 0.0);
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (i == j && !(sum > 0.0)) return false;
      l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
    }
  }
  return true;
}

absl::Status CheckMatrix(const std::string& field, const Mat6& a) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      absl::Status s =
          CheckInRange(absl::StrCat(field, "[", i, "][", j, "]"), a[i][j], -1e15, 1e15);
      if (!s.ok()) return s;
    }
  }
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < i; ++j) {
      const double scale = std::sqrt(std::abs(a[i][i] * a[j][j]));
      if (!(std::abs(a[i][j] - a[j][i]) <= 1e-6 * scale + 1e-9)) {
        return absl::InvalidArgumentError(absl::StrCat(field, " is not symmetric: [", j, "][", i,
                                                       "] = ", a[j][i], ", [", i, "][", j,
                                                       "] = ", a[i][j]));
      }
    }
  }
  Mat6 zero{};
  if (a != zero && !IsPositive(a, 1e-9)) {
    return absl::InvalidArgumentError(
        absl::StrCat(field, " has a direction of negative energy: it must be positive"));
  }
  return absl::OkStatus();
}

absl::Status CheckShape(const BodyShape& shape) {
  const auto size = [](const char* field, double value) {
    return CheckInRange(field, value, kHullSizeMinM, kHullSizeMaxM);
  };
  switch (shape.kind) {
    case ShapeKind::kBox:
      for (double side : {shape.size_m.x, shape.size_m.y, shape.size_m.z}) {
        if (absl::Status s = size("shape.size_m", side); !s.ok()) return s;
      }
      return absl::OkStatus();
    case ShapeKind::kSphere:
      return size("shape.radius_m", shape.radius_m);
    case ShapeKind::kCylinder:
    case ShapeKind::kCapsule:
      if (absl::Status s = size("shape.radius_m", shape.radius_m); !s.ok()) return s;
      return size("shape.length_m", shape.length_m);
    case ShapeKind::kMesh:
      return ValidateMesh(shape.mesh);
  }
  return absl::InvalidArgumentError(
      absl::StrCat("shape.kind = ", static_cast<int>(shape.kind), " is unknown"));
}

absl::Status CheckInertia(const Mat3d& inertia) {
  Mat6 wide{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) wide[i][j] = inertia(i, j);
    wide[3 + i][3 + i] = std::abs(inertia(i, i));
  }
  if (absl::Status s = CheckMatrix("inertia_kg_m2", wide); !s.ok()) return s;
  if (!IsPositive(wide, -1e-9)) {
    return absl::InvalidArgumentError("inertia_kg_m2 must be positive about every axis");
  }
  return absl::OkStatus();
}

// The direction must be a unit vector here; the rest is as in descriptions.
absl::Status CheckThruster(const std::string& field, const wire::Thruster& t) {
  if (absl::Status s = wire::ValidateThruster(field + ".", t); !s.ok()) return s;
  return CheckInRange(field + ".direction (its length)", Norm(t.direction), 0.999, 1.001);
}

absl::Status CheckGear(const BodySpec& spec) {
  for (const absl::Status& s :
       {wire::ValidateDrag("drag.", spec.drag), wire::ValidateWindage("windage.", spec.windage),
        CheckInRange("contact_friction", spec.contact_friction, 0.0, 2.0),
        CheckInRange("contact_restitution", spec.contact_restitution, 0.0, 1.0),
        CheckInRange("thrusters (count)", static_cast<double>(spec.thrusters.size()), 0,
                     kThrustersMax),
        CheckInRange("rudders (count)", static_cast<double>(spec.rudders.size()), 0, kRuddersMax),
        CheckInRange("heave_memory (steps)", static_cast<double>(spec.heave_memory.kernel.size()),
                     0, 4097)}) {
    if (!s.ok()) return s;
  }
  for (double value : spec.heave_memory.kernel) {
    if (absl::Status s = CheckInRange("heave_memory", value, -1e15, 1e15); !s.ok()) return s;
  }
  for (std::size_t n = 0; n < spec.thrusters.size(); ++n) {
    absl::Status s = CheckThruster(absl::StrCat("thrusters[", n, "]"), spec.thrusters[n]);
    if (!s.ok()) return s;
  }
  for (std::size_t n = 0; n < spec.rudders.size(); ++n) {
    absl::Status s = wire::ValidateRudder(absl::StrCat("rudders[", n, "]."), spec.rudders[n],
                                          static_cast<int>(spec.thrusters.size()));
    if (!s.ok()) return s;
  }
  return absl::OkStatus();
}

absl::Status CheckKinds(const BodySpec& spec) {
  if (spec.control != BodyControl::kIntegrated && spec.control != BodyControl::kByOwner) {
    return absl::InvalidArgumentError(
        absl::StrCat("control = ", static_cast<int>(spec.control), " is unknown"));
  }
  if (spec.radiation != Radiation::kCoefficients && spec.radiation != Radiation::kGrid) {
    return absl::InvalidArgumentError(
        absl::StrCat("radiation = ", static_cast<int>(spec.radiation), " is unknown"));
  }
  return absl::OkStatus();
}

}  // namespace

absl::Status ValidateBodySpec(const BodySpec& spec) {
  for (const absl::Status& s :
       {CheckKinds(spec), CheckInRange("mass_kg", spec.mass_kg, kBodyMassMinKg, kBodyMassMaxKg),
        CheckShape(spec.shape), CheckGear(spec)}) {
    if (!s.ok()) return s;
  }
  const double volume = ComputeSolid(MakeMesh(spec.shape)).volume_m3;
  if (!(spec.mass_kg <= kDensityMaxKgPerM3 * volume)) {
    return absl::InvalidArgumentError(absl::StrCat("mass_kg = ", spec.mass_kg, " in ", volume,
                                                   " m³ is denser than ", kDensityMaxKgPerM3,
                                                   " kg/m³"));
  }
  if (spec.centre_of_mass_m) {
    absl::Status s = wire::CheckOffset("", "centre_of_mass_m", *spec.centre_of_mass_m);
    if (!s.ok()) return s;
  }
  if (spec.inertia_kg_m2) {
    if (absl::Status s = CheckInertia(*spec.inertia_kg_m2); !s.ok()) return s;
  }
  for (const auto& [field, matrix] : {std::pair("added_mass", &spec.added_mass),
                                      std::pair("radiation_damping", &spec.radiation_damping),
                                      std::pair("viscous_damping", &spec.viscous_damping)}) {
    if (!*matrix) continue;
    if (absl::Status s = CheckMatrix(field, **matrix); !s.ok()) return s;
  }
  return CheckMatrix("quadratic_damping", spec.quadratic_damping);
}

}  // namespace onesea::world
