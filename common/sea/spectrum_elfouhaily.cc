#include "common/sea/spectrum_elfouhaily.h"

#include <cmath>

#include "common/base/real_math.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

constexpr double kDragCoefficient = 0.00144;
constexpr double kSlowestRadPerM = 370.0;  // k_m
constexpr double kSlowestMPerS = 0.23;     // c_m
constexpr double kLn2 = 0.69314718055994530942;
constexpr double kLn10 = 2.30258509299404568402;

double PhaseSpeed(double k) {
  const double r = k / kSlowestRadPerM;
  return std::sqrt(kGravity / k * (1.0 + r * r));
}

class ElfouhailySpectrum final : public WaveSpectrum {
 public:
  explicit ElfouhailySpectrum(const ElfouhailySystem& system) : age_(system.inverse_wave_age) {
    const real::SinCosPair d = real::SinCos(system.wave_to_rad);
    wave_to_ = {d.cos, d.sin};
    const double u = system.wind_speed_m_per_s;
    friction_ = std::sqrt(kDragCoefficient) * u / kSlowestMPerS;
    peak_ = kGravity * (age_ * age_) / (u * u);
    peak_speed_ = PhaseSpeed(peak_);
    log_gamma_ = real::Log(age_ <= 1.0 ? 1.7 : 1.7 + 6.0 * (real::Log(age_) / kLn10));
    width_ = 0.08 * (1.0 + 4.0 / (age_ * age_ * age_));
    // Below about 1.8 m/s of wind the logarithm makes it negative: no ripples then.
    const double slope = friction_ <= 1.0 ? 1.0 : 3.0;
    const double alpha = 0.01 * (1.0 + slope * real::Log(friction_));
    alpha_m_ = alpha > 0.0 ? alpha : 0.0;
  }

  Node NodeAt(double k) const override {
    const double ratio = kSlowestMPerS / PhaseSpeed(k);
    const double wave_age = PhaseSpeed(k) / peak_speed_;
    const double delta = real::Tanh(0.25 * kLn2 + 4.0 * real::Pow(wave_age, 2.5) +
                                    0.13 * friction_ * real::Pow(ratio, 2.5));
    return {Omnidirectional(k) / k, delta, 0.0, 0.0};
  }

  double Shape(const Node& node, Vec2d direction) const override {
    const double c = Dot(direction, wave_to_);
    return c > 0.0 ? (1.0 + node.a * (2.0 * c * c - 1.0)) / kPi : 0.0;
  }

  double Omnidirectional(double k) const override {
    const double root = std::sqrt(k / peak_) - 1.0;
    const double inverse = peak_ / k;
    const double z = root / width_;
    const double common =
        real::Exp(-1.25 * (inverse * inverse) + log_gamma_ * real::Exp(-0.5 * (z * z)));
    const double speed = PhaseSpeed(k);
    const double low = 0.5 * (0.006 * std::sqrt(age_)) * (peak_speed_ / speed) *
                       real::Exp(-age_ / std::sqrt(10.0) * root);
    const double r = k / kSlowestRadPerM - 1.0;
    const double high = 0.5 * alpha_m_ * (kSlowestMPerS / speed) * real::Exp(-0.25 * (r * r));
    return common * (low + high) / (k * k * k);
  }

  double EndRadPerM() const override { return 2e4; }

 private:
  double age_;  // Ω
  Vec2d wave_to_;
  double friction_;    // u*/c_m
  double peak_;        // k_p [rad/m]
  double peak_speed_;  // c_p [m/s]
  double log_gamma_;
  double width_;
  double alpha_m_;
};

}  // namespace

std::unique_ptr<const WaveSpectrum> MakeElfouhailySpectrum(const ElfouhailySystem& system) {
  return std::make_unique<ElfouhailySpectrum>(system);
}

}  // namespace onesea::sea
