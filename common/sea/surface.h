#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/base/sim_time.h"
#include "common/sea/components.h"

/// Synthesis: components -> fields on an N x N grid of each cascade at any time.
///
/// Layout of every plane: float, (N x N) row-major, element [y * N + x] belongs to the cascade's
/// local point (x, y) * length / N; world point = R(rotation) local. Vector fields are in *world*
/// axes. Planes are periodic.
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
  int grid_size_;
  FieldSet fields_;
  std::vector<std::vector<float>> planes_;
};

/// Evaluates one cascade. Not thread-safe (owns scratch); make one per thread and cascade.
class Synthesiser {
 public:
  /// `grid_size`: 64, 128, ..., 1024; waves at or above its Nyquist index are left out, see
  /// OmittedVariance(). CHECKs the arguments. Allocates everything it will ever need.
  Synthesiser(std::shared_ptr<const Components> components, int cascade, int grid_size,
              FieldSet fields, TransformKind transform = TransformKind::kOwn);
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
