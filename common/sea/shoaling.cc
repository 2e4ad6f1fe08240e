#include "common/sea/shoaling.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/check.h"
#include "common/base/real_math.h"
#include "common/sea/dispersion.h"

namespace onesea::sea {
namespace {

// Waves whose frequencies lie within this ratio count as one.
constexpr double kBinRatio = 1.04;

double GroupVelocityOf(double sigma_rad_per_s, double depth_m) {
  return GroupVelocity(WavenumberOf(sigma_rad_per_s, depth_m), depth_m);
}

struct Plane {
  std::vector<double> sigma_rad_per_s;           // (waves)
  std::vector<std::vector<double>> variance_m2;  // (entries x waves)
};

Plane PlaneOf(const CascadeComponents& waves) {
  Plane plane;
  plane.sigma_rad_per_s.assign(waves.intrinsic_rad_per_s.begin(), waves.intrinsic_rad_per_s.end());
  for (const std::vector<float>& variance : waves.variance_m2) {
    plane.variance_m2.emplace_back(variance.begin(), variance.end());
  }
  return plane;
}

Plane PlaneOf(const std::vector<RegularComponent>& regular, std::size_t entries) {
  Plane plane;
  plane.variance_m2.resize(entries);
  for (const RegularComponent& wave : regular) {
    plane.sigma_rad_per_s.push_back(wave.intrinsic_rad_per_s);
    for (std::size_t m = 0; m < entries; ++m) plane.variance_m2[m].push_back(wave.variance_m2[m]);
  }
  return plane;
}

}  // namespace

DepthFactors::Place DepthFactors::PlaceOf(double depth_m) {
  if (!(depth_m > 0.0)) return {};
  const double place = std::sqrt(std::min(depth_m / kDepthMaxM, 1.0)) * (kDepths - 1);
  const int n = std::min(static_cast<int>(place), kDepths - 2);
  return {n, (place * place - n * n) / (2 * n + 1)};
}

double DepthFactors::At(int plane, Place depth) const {
  if (depth.n < 0) return 0.0;
  const float* at = &factor_[static_cast<std::size_t>(plane) * kDepths + depth.n];
  return at[0] + depth.share * (at[1] - at[0]);
}

Shoaling::Shoaling(const Components& components)
    : planes_(static_cast<int>(components.cascades.size()) + (components.regular.empty() ? 0 : 1)),
      entries_(components.recipe.timeline.size()),
      flux_(planes_ * entries_ * DepthFactors::kDepths),
      variance_(planes_ * entries_) {
  for (int plane = 0; plane < planes_; ++plane) {
    const bool is_cascade = plane < static_cast<int>(components.cascades.size());
    const Plane waves =
        is_cascade ? PlaneOf(components.cascades[plane]) : PlaneOf(components.regular, entries_);
    AddPlane(waves.sigma_rad_per_s, waves.variance_m2, components.recipe.depth_m, plane);
  }
}

void Shoaling::AddPlane(std::span<const double> sigma_rad_per_s,
                        std::span<const std::vector<double>> variance_m2, double depth_m,
                        int plane) {
  const double log_ratio = real::Log(kBinRatio);
  std::map<int, std::vector<double>> bins;  // variance of every entry
  for (std::size_t n = 0; n < sigma_rad_per_s.size(); ++n) {
    if (!(sigma_rad_per_s[n] > 0.0)) continue;
    const int bin = static_cast<int>(std::floor(real::Log(sigma_rad_per_s[n]) / log_ratio));
    std::vector<double>& sums = bins.try_emplace(bin, entries_, 0.0).first->second;
    for (std::size_t m = 0; m < entries_; ++m) sums[m] += variance_m2[m][n];
  }
  for (const auto& [bin, sums] : bins) {
    const double sigma = real::Exp((bin + 0.5) * log_ratio);
    const double from = GroupVelocityOf(sigma, depth_m);
    for (std::size_t m = 0; m < entries_; ++m) variance_[plane * entries_ + m] += sums[m];
    for (int d = 1; d < DepthFactors::kDepths; ++d) {
      const double gain = from / GroupVelocityOf(sigma, DepthFactors::DepthOf(d));
      for (std::size_t m = 0; m < entries_; ++m) Flux(plane, m, d) += sums[m] * gain;
    }
  }
}

DepthFactors Shoaling::At(std::span<const double> weights) const {
  ONESEA_CHECK(weights.size() == entries_) << weights.size() << " weights";
  constexpr int kDepths = DepthFactors::kDepths;
  DepthFactors factors;
  factors.factor_.resize(static_cast<std::size_t>(planes_) * kDepths);
  for (int d = 1; d < kDepths; ++d) {
    double whole_m2 = 0.0;
    for (int plane = 0; plane < planes_; ++plane) {
      double flux = 0.0, variance = 0.0;
      for (std::size_t m = 0; m < entries_; ++m) {
        flux += weights[m] * flux_[(plane * entries_ + m) * kDepths + d];
        variance += weights[m] * variance_[plane * entries_ + m];
      }
      whole_m2 += flux;
      factors.factor_[static_cast<std::size_t>(plane) * kDepths + d] =
          variance > 0.0 ? static_cast<float>(std::sqrt(flux / variance)) : 1.0f;
    }
    const double ratio = 4.0 * std::sqrt(whole_m2) / (kBreakerIndex * DepthFactors::DepthOf(d));
    const double breaking = 1.0 / std::sqrt(std::sqrt(1.0 + ratio * ratio * ratio * ratio));
    for (int plane = 0; plane < planes_; ++plane) {
      float& factor = factors.factor_[static_cast<std::size_t>(plane) * kDepths + d];
      factor = static_cast<float>(factor * breaking);
    }
  }
  return factors;
}

}  // namespace onesea::sea
