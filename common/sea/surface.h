#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "common/base/sim_time.h"
#include "common/sea/aligned.h"
#include "common/sea/components.h"

/// Synthesis: components -> fields on an N x N grid of each cascade at any time.
///
/// Layout of every plane: float, (N x N) row-major, element [y * N + x] belongs to the cascade's
/// local point (x, y) * length / N; world point = R(rotation) local. Vector fields are in *world*
/// axes. Planes are periodic.
///
/// Regular waves (Components::regular) lie off every lattice: they are not in the planes. Point
/// queries and direct sums add them at each point, a renderer at each vertex.
///
/// Bits: with TransformKind::kOwn every plane has the same bits on every machine and SIMD width
/// (fixed order of operations, no fused multiply-add). With kFftw within 2e-6 of the field's RMS of
/// that.
namespace onesea::sea {

enum class Field : std::uint8_t {
  kHeight,         ///< eta [m]
  kDisplacementX,  ///< choppiness * D_x [m]; the surface point is (x + D_x, y + D_y, eta)
  kDisplacementY,
  kSlopeX,  ///< ∂eta/∂x [-], with respect to the undisplaced point
  kSlopeY,
  kJacobianXX,  ///< ∂D_x/∂x [-], choppiness included
  kJacobianYY,
  kJacobianXY,
  kVelocityX,  ///< orbital velocity of the water at the surface [m/s], without the current
  kVelocityY,
  kVelocityZ,
};
inline constexpr int kFieldCount = 11;

using FieldSet = std::uint32_t;
constexpr FieldSet Bit(Field field) { return FieldSet{1} << static_cast<unsigned>(field); }
inline constexpr FieldSet kQueryFields =
    Bit(Field::kHeight) | Bit(Field::kDisplacementX) | Bit(Field::kDisplacementY);
inline constexpr FieldSet kNormalFields = Bit(Field::kSlopeX) | Bit(Field::kSlopeY) |
                                          Bit(Field::kJacobianXX) | Bit(Field::kJacobianYY) |
                                          Bit(Field::kJacobianXY);
inline constexpr FieldSet kRenderFields = kQueryFields | kNormalFields;
inline constexpr FieldSet kVelocityFields =
    Bit(Field::kVelocityX) | Bit(Field::kVelocityY) | Bit(Field::kVelocityZ);

enum class TransformKind : std::uint8_t { kOwn = 1, kFftw = 2 };

/// What the planes hold. kSplineCoefficients: coefficients of the cubic B-spline through the
/// samples, for whoever reads between them (see spline.h); free, since they differ from the samples
/// by a factor per wave.
enum class PlaneKind : std::uint8_t { kSamples = 1, kSplineCoefficients = 2 };

/// False for kFftw in a build without ONESEA_WITH_FFTW; asking for it there is a CHECK failure.
bool TransformAvailable(TransformKind kind);

/// "own", or "fftw <version> wisdom <hash>": whatever decides the bits of the planes. Pre:
/// TransformAvailable(kind).
std::string TransformName(TransformKind kind);

/// The fields of one cascade at one time.
class CascadeFields {
 public:
  CascadeFields(int grid_size, FieldSet fields);
  int grid_size() const { return grid_size_; }
  FieldSet fields() const { return fields_; }
  bool Has(Field field) const { return (fields_ & Bit(field)) != 0; }
  /// (N x N) row-major. Pre: Has(field).
  std::span<const float> Plane(Field field) const;
  std::span<float> MutablePlane(Field field);

 private:
  std::size_t plane_floats() const { return static_cast<std::size_t>(grid_size_) * grid_size_; }

  int grid_size_;
  FieldSet fields_;
  AlignedArray<float> planes_;  // one after another in the order of Field
};

/// Evaluates one cascade. Not thread-safe (owns scratch); make one per thread and cascade.
class Synthesiser {
 public:
  /// `grid_size`: 64, 128, ..., 1024; waves at or above its Nyquist index are left out, see
  /// OmittedVariance(). CHECKs the arguments. Allocates everything it will ever need.
  Synthesiser(std::shared_ptr<const Components> components, int cascade, int grid_size,
              FieldSet fields, TransformKind transform = TransformKind::kOwn,
              PlaneKind planes = PlaneKind::kSamples);
  ~Synthesiser();
  Synthesiser(Synthesiser&&) noexcept;
  Synthesiser& operator=(Synthesiser&&) noexcept;

  /// Writes every field at `time` into `out`. Allocates nothing. Pre: out has this grid size and
  /// these fields.
  void Evaluate(SimTime time, CascadeFields& out);

  /// Variance [m²] at `time` of the waves that this grid is too coarse for.
  double OmittedVariance(SimTime time) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onesea::sea
