#include "common/sea/spectrum_phillips.h"

#include <cmath>

#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "common/sea/spreading.h"

namespace onesea::sea {
namespace {

class PhillipsSpectrum final : public WaveSpectrum {
 public:
  explicit PhillipsSpectrum(const PhillipsSystem& system) : system_(system) {
    const real::SinCosPair d = real::SinCos(system.wind_to_rad);
    wind_to_ = {d.cos, d.sin};
    largest_m_ = system.wind_speed_m_per_s * system.wind_speed_m_per_s / kGravity;
    // ∫ |cos|^p over a turn is 2 √π Γ((p+1)/2) / Γ(p/2+1).
    const double turn = 2.0 * std::sqrt(kPi) / GammaHalfRatio(0.5 * system.directional_exponent);
    angular_integral_ = system.one_sided ? 0.5 * turn : turn;
  }

  Node NodeAt(double k) const override {
    const double kl = k * largest_m_;
    const double cut = k * system_.small_wave_cutoff_m;
    const double k2 = k * k;
    const double scale = system_.alpha / (2.0 * kPi);
    return {scale * real::Exp(-1.0 / (kl * kl) - cut * cut) / (k2 * k2), 0.0, 0.0, 0.0};
  }

  double Shape(const Node&, Vec2d direction) const override {
    const double c = Dot(direction, wind_to_);
    if (system_.one_sided && c < 0.0) return 0.0;
    const double magnitude = std::fabs(c);
    if (system_.directional_exponent == 2.0) return c * c;
    return real::Pow(magnitude, system_.directional_exponent);
  }

  double Omnidirectional(double k) const override {
    return NodeAt(k).radial * k * angular_integral_;
  }

 private:
  PhillipsSystem system_;
  Vec2d wind_to_;
  double largest_m_;
  double angular_integral_;
};

}  // namespace

std::unique_ptr<const WaveSpectrum> MakePhillipsSpectrum(const PhillipsSystem& system) {
  return std::make_unique<PhillipsSpectrum>(system);
}

}  // namespace onesea::sea
