#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/base/vec.h"
#include "common/sea/sea_state.h"

/// One wave system as a density over wave vectors, whatever the family it comes from.
///
///   P(k⃗) = radial(k) · Shape(k, direction)   [m⁴/rad²],   m0 = ∫ P d²k = ∫ F(k) dk
///
/// A family in frequency becomes one in wavenumber by F(k) = S(σ) dσ/dk with the intrinsic σ(k) of
/// the recipe's depth: the spectrum is what an observer who drifts with the current measures.
namespace onesea::sea {

/// Gravity-wave spectra mean nothing beyond the slowest wave, k = √(gρ/γ), 1.7 cm: they end there.
inline constexpr double kGravityWavesEndRadPerM = 364.0;

class WaveSpectrum {
 public:
  /// All that depends on |k| alone. Tabulated over k and interpolated linearly (SpectrumTable).
  struct Node {
    double radial = 0.0;               ///< density but for the factor of Shape()
    double a = 0.0, b = 0.0, c = 0.0;  ///< the family's parameters of Shape()
  };

  virtual ~WaveSpectrum() = default;
  virtual Node NodeAt(double k_rad_per_m) const = 0;
  /// The factor that depends on direction; `direction` is the unit vector of k⃗.
  virtual double Shape(const Node& node, Vec2d direction) const = 0;
  /// F(k) [m³/rad].
  virtual double Omnidirectional(double k_rad_per_m) const = 0;
  /// Where the spectrum ends [rad/m].
  virtual double EndRadPerM() const { return kGravityWavesEndRadPerM; }
};

/// Pre: ValidateSeaState() is OK for the sea that contains `system`. depth_m: 0 = infinitely deep.
std::unique_ptr<const WaveSpectrum> MakeWaveSpectrum(const WaveSystem& system, double depth_m);

/// ∫ k^power F(k) dk over [k_low, k_high], trapezoids of 1/128 octave. Pre: 0 < k_low.
double RadialMoment(const WaveSpectrum& spectrum, double k_low, double k_high, int power);

/// A WaveSpectrum whose nodes are tabulated at 256 wavenumbers per octave and interpolated by exact
/// operations: the relative error at a JONSWAP peak is below 1e-4, and a lookup costs 3 ns.
class SpectrumTable {
 public:
  /// Serves k in [k_low, k_high]. Keeps a reference to `spectrum`. Cost: 1 ms for 18 octaves.
  SpectrumTable(const WaveSpectrum& spectrum, double k_low, double k_high);

  /// P(k⃗) [m⁴/rad²]. `k` is the norm of `wave_vector`. Pre: k within the range.
  double Density(Vec2d wave_vector, double k) const;

 private:
  const WaveSpectrum& spectrum_;
  std::int64_t first_;
  std::vector<WaveSpectrum::Node> nodes_;
};

}  // namespace onesea::sea
