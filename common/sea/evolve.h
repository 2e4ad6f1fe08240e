#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "common/sea/aligned.h"
#include "common/sea/components.h"
#include "common/sea/surface.h"

namespace onesea::sea {

/// Turns the waves of one cascade into the Hermitian spectra of its fields at any time.
///
/// With A(k) = a e^{iθ}, θ = φ - ωt, of the wave on lattice point k (0 where there is none), every
/// field is F(k) = c(k) ½(A(k) ± conj A(-k)): plus and c = 1, λ i k̂, i k, -λ k k̂ for height,
/// displacement, slope and Jacobian; minus and c = -iσ, σ k̂ coth kh for the vertical and
/// horizontal velocity, whose sign turns with the wave's travel. (D̂ = +i k̂ λ ĥ sharpens crests;
/// the papers print the other sign.)
///
/// For PlaneKind::kSplineCoefficients every factor is divided by the spline's response to the wave.
///
/// Only lattice points with |i|, |j| <= index_max() are held: a dense half plane i >= 0, since the
/// spectra are Hermitian. Waves with max(|i|, |j|) >= grid_size / 2 are left out. Bits: the same on
/// every machine. Not thread-safe.
class Evolver {
 public:
  Evolver(std::shared_ptr<const Components> components, int cascade, int grid_size, FieldSet fields,
          PlaneKind planes = PlaneKind::kSamples);

  /// Largest |i|, |j| held, at least 1.
  int index_max() const { return index_max_; }
  /// Floats from one row of a spectrum to the next, see StripTransform::Pitch().
  int pitch() const { return pitch_; }
  /// Size of the arrays that Pack() fills.
  std::size_t spectrum_floats() const {
    return static_cast<std::size_t>(2 * index_max_ + 1) * static_cast<std::size_t>(pitch_);
  }

  /// Moves every wave to `time`. Cost: about 5 µs for 3200 waves, more while the weather changes.
  void SetTime(SimTime time);

  /// Z = F + iG, or F alone: row i + index_max(), column j + index_max(). The transform's real part
  /// is then the field F and its imaginary part G. Pre: both are in `fields`; the arrays were zero
  /// at first and have kStripLanes floats of room in front of re and im (the kernel writes zeros
  /// there).
  void Pack(Field f, std::optional<Field> g, float* re, float* im);

  /// Σ w_m E_m [m²] at `time` of the waves left out.
  double OmittedVariance(SimTime time) const;

  /// Dense half-plane arrays of `count` = (index_max + 1) x pitch elements; the kernels in
  /// evolve.cc read them.
  struct Dense {
    std::size_t count = 0;
    bool needs_odd = false;
    FloatArray half_amplitude;          ///< (2 x count) a/2 of k, then of -k
    AlignedArray<std::uint32_t> turns;  ///< (2 x count) θ in 2⁻³² turn of k, then of -k
    FloatArray even_re, even_im;        ///< ½(A(k) + conj A(-k))
    FloatArray odd_re, odd_im;          ///< ½(A(k) - conj A(-k))
  };
  /// One real field on the half plane: factor times (re, im), or i times that.
  struct FieldSource {
    const float* re = nullptr;
    const float* im = nullptr;
    const float* factor = nullptr;  ///< null: no field
    bool imaginary = false;
  };

 private:
  // A wave's place in the dense arrays. Waves with i = 0 have two: their -k lies on the half plane
  // too.
  struct Entry {
    std::uint64_t turns_per_flick;
    std::uint64_t phase;  // 2⁻⁶⁴ turn
    std::uint32_t wave;
    std::uint32_t slot;
  };
  void AddEntry(std::uint32_t wave, int sign, double gain);
  void UpdateAmplitudes();

  std::shared_ptr<const Components> components_;
  const CascadeComponents& waves_;
  int index_max_ = 1;
  int pitch_ = 0;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> omitted_;
  std::vector<double> weights_;                  // for which the amplitudes were computed
  std::vector<double> new_weights_;              // scratch
  std::array<FloatArray, kFieldCount> factors_;  // real part of c or of c/i, like the dense arrays
  Dense dense_;
};

}  // namespace onesea::sea
