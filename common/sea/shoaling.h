#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/sea/components.h"

/// How much higher or lower the waves of each cascade are where the water is shallower.
///
/// A wave that comes from the recipe's depth D over a slow slope keeps its frequency and its flux
/// of energy, so its variance goes as cg(σ, D) / cg(σ, d), cg the group velocity at the depth d. Of
/// a cascade that is the mean over its waves, weighted with their variance:
///
///   K_c²(d) = Σ E cg(σ, D) / cg(σ, d) / Σ E
///
/// Waves that would stand too high in the water break: with Hs(d) = 4 √(Σ_c m0_c K_c²(d)) the whole
/// sea is multiplied by B(d) = (1 + (Hs / γd)⁴)^-¼, so that Hs never passes γ d, and all of it is
/// gone at the shore. The factor of an amplitude is K_c B; 0 on land.
///
///   symbol  unit   meaning
///   d       m      depth of the place below the mean water level
///   D       m      the recipe's depth; infinite if that is 0
///   σ       rad/s  intrinsic frequency
///   γ       -      kBreakerIndex
///
/// What it can't say: wavelengths and travel directions stay those of the flat bottom (a
/// component's ω and k don't depend on the place: neighbours would drift apart without bound), so
/// there is no refraction and crests don't bunch up; breaking is local, waves that broke on a bar
/// are whole behind it; currents are left out.
///
/// Bits: the same on every machine (base/real_math.h). Source: energy flux, e.g. R. G. Dean, R. A.
/// Dalrymple, "Water Wave Mechanics for Engineers and Scientists", 1991, section 4.8; γ: E. B.
/// Thornton, R. T. Guza, "Energy saturation and phase speeds measured on a natural beach", J.
/// Geophys. Res. 87(C12), 1982 (Hrms = 0.42 d; Hs = √2 Hrms).
namespace onesea::sea {

/// Hs / d of a sea that breaks.
inline constexpr double kBreakerIndex = 0.6;

/// The factors of one weather mix, tabulated over the depth.
class DepthFactors {
 public:
  static constexpr int kDepths = 129;
  /// Beyond this the factors stay what they are there.
  static constexpr double kDepthMaxM = 1000.0;
  /// Depths of the table: close together near the shore.
  static double DepthOf(int n) {
    const double share = static_cast<double>(n) / (kDepths - 1);
    return kDepthMaxM * share * share;
  }

  /// Where a depth lies in the table.
  struct Place {
    int n = -1;          ///< of the depth above; negative: no water
    double share = 0.0;  ///< of the way to the next
  };
  static Place PlaceOf(double depth_m);

  /// Linear between the table's depths: within 4e-3, and continuous.
  double At(int plane, Place depth) const;
  double At(int plane, double depth_m) const { return At(plane, PlaceOf(depth_m)); }
  int planes() const { return static_cast<int>(factor_.size()) / kDepths; }

 private:
  friend class Shoaling;
  std::vector<float> factor_;  // (planes x kDepths)
};

/// Tables for every weather entry of a recipe. One plane for each cascade, in their order, then one
/// for all regular waves if there are any. Immutable. Cost: some 20 ms to build.
class Shoaling {
 public:
  explicit Shoaling(const Components& components);

  int planes() const { return planes_; }
  /// Pre: one weight for each weather entry, see WeatherWeights(). Cost: some 10 µs.
  DepthFactors At(std::span<const double> weights) const;

 private:
  // Σ E cg(σ, D) / cg(σ, d) of a plane and an entry at every depth of the table; element 0 unused.
  double& Flux(int plane, std::size_t entry, int depth) {
    return flux_[(plane * entries_ + entry) * DepthFactors::kDepths + depth];
  }
  void AddPlane(std::span<const double> sigma_rad_per_s,
                std::span<const std::vector<double>> variance_m2, double depth_m, int plane);

  int planes_ = 0;
  std::size_t entries_ = 0;
  std::vector<double> flux_;      // (planes x entries x kDepths)
  std::vector<double> variance_;  // (planes x entries) Σ E
};

}  // namespace onesea::sea
