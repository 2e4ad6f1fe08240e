#include "common/sea/spectrum_jonswap.h"

#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "common/sea/dispersion.h"
#include "common/sea/spectrum_tma.h"

namespace onesea::sea {
namespace {

constexpr double kFullyDeveloped = 0.84;  // U10/c_p
constexpr double kYoungest = 5.0;

class JonswapSpectrum final : public WaveSpectrum {
 public:
  JonswapSpectrum(const JonswapShape& shape, const SpreadingModel& spreading, double wave_to_rad,
                  double depth_m)
      : shape_(shape), spreading_(spreading), depth_m_(depth_m) {
    const real::SinCosPair d = real::SinCos(wave_to_rad);
    wave_to_ = {d.cos, d.sin};
  }

  Node NodeAt(double k) const override {
    const double omega = IntrinsicFrequency(k, depth_m_);
    const SpreadingModel::Shape s = spreading_.At(omega);
    return {Omnidirectional(k) / k, s.width, s.swell, s.normaliser};
  }

  double Shape(const Node& node, Vec2d direction) const override {
    return spreading_.Density({node.a, node.b, node.c}, Dot(direction, wave_to_));
  }

  double Omnidirectional(double k) const override {
    return shape_.Density(IntrinsicFrequency(k, depth_m_), k) * GroupVelocity(k, depth_m_);
  }

 private:
  JonswapShape shape_;
  SpreadingModel spreading_;
  double depth_m_;
  Vec2d wave_to_;
};

}  // namespace

double JonswapShape::Density(double omega_rad_per_s, double k_rad_per_m) const {
  const double ratio = omega_p_rad_per_s / omega_rad_per_s;
  const double ratio2 = ratio * ratio;
  const double omega2 = omega_rad_per_s * omega_rad_per_s;
  double exponent = -1.25 * (ratio2 * ratio2);
  if (gamma != 1.0) {
    const double width = omega_rad_per_s <= omega_p_rad_per_s ? 0.07 : 0.09;
    const double z = (omega_rad_per_s - omega_p_rad_per_s) / (width * omega_p_rad_per_s);
    exponent += real::Log(gamma) * real::Exp(-0.5 * (z * z));
  }
  const double tail = alpha * (kGravity * kGravity) / (omega2 * omega2 * omega_rad_per_s);
  return tail * real::Exp(exponent) * TmaDepthFactor(k_rad_per_m, tma_depth_m);
}

double JonswapShape::Variance() const {
  // Simpson in ln ω on both sides of the peak, where the width jumps; from 0.3 ω_p, where
  // exp(-154) is left, to 1000 ω_p, beyond which the tail is α g²/(4 ω⁴).
  constexpr int kIntervals = 1024;
  const auto integrand = [this](double omega) {
    const double k = tma_depth_m > 0.0 ? WavenumberOf(omega, tma_depth_m) : 0.0;
    return omega * Density(omega, k);
  };
  const auto simpson = [&](double from, double to) {
    const double step = real::Log(to / from) / kIntervals;
    double sum = 0.0;
    for (int n = 0; n <= kIntervals; ++n) {
      const double weight = n == 0 || n == kIntervals ? 1.0 : (n % 2 == 1 ? 4.0 : 2.0);
      sum += weight * integrand(from * real::Exp(step * n));
    }
    return sum * step / 3.0;
  };
  const double p = omega_p_rad_per_s;
  const double end = 1000.0 * p;
  const double tail = alpha * (kGravity * kGravity) / (4.0 * end * end * end * end);
  return simpson(0.3 * p, p) + simpson(p, end) + tail;
}

std::unique_ptr<const WaveSpectrum> MakeSpectrum(const JonswapShape& shape,
                                                 const SpreadingModel& spreading,
                                                 double wave_to_rad, double depth_m) {
  return std::make_unique<JonswapSpectrum>(shape, spreading, wave_to_rad, depth_m);
}

double InverseWaveAgeOfAlpha(double alpha) {
  const double age = 7.0 * kPi * real::Pow(alpha / 0.076, 1.5);
  return age > kFullyDeveloped ? (age < kYoungest ? age : kYoungest) : kFullyDeveloped;
}

JonswapShape JonswapShapeOf(const JonswapSystem& system, double depth_m) {
  JonswapShape shape{1.0, 2.0 * kPi / system.tp_s, system.gamma, system.use_depth ? depth_m : 0.0};
  shape.alpha = system.hs_m * system.hs_m / 16.0 / shape.Variance();
  return shape;
}

std::unique_ptr<const WaveSpectrum> MakeJonswapSpectrum(const JonswapSystem& system,
                                                        double depth_m) {
  const JonswapShape shape = JonswapShapeOf(system, depth_m);
  // The wave age is that of the sea in deep water: the depth factor says nothing of the wind.
  JonswapSystem deep = system;
  deep.use_depth = false;
  const double age = InverseWaveAgeOfAlpha(JonswapShapeOf(deep, depth_m).alpha);
  return MakeSpectrum(shape, {system.spreading, shape.omega_p_rad_per_s, age}, system.wave_to_rad,
                      depth_m);
}

JonswapShape FetchJonswapShape(const FetchJonswapSystem& system) {
  const double u = system.wind_speed_m_per_s;
  const double chi = kGravity * system.fetch_m / (u * u);
  return {0.076 * real::Pow(chi, -0.22), 7.0 * kPi * (kGravity / u) * real::Pow(chi, -0.33),
          system.gamma, 0.0};
}

std::unique_ptr<const WaveSpectrum> MakeFetchJonswapSpectrum(const FetchJonswapSystem& system,
                                                             double depth_m) {
  JonswapShape shape = FetchJonswapShape(system);
  if (system.use_depth) shape.tma_depth_m = depth_m;
  const double age = system.wind_speed_m_per_s * shape.omega_p_rad_per_s / kGravity;
  return MakeSpectrum(shape, {system.spreading, shape.omega_p_rad_per_s, age}, system.wave_to_rad,
                      depth_m);
}

}  // namespace onesea::sea
