#include "common/sea/spreading.h"

#include <array>
#include <cmath>

#include "common/base/real_math.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

constexpr double kTwoSqrtPi = 3.54490770181103205460;
// s beyond this is a pencil of 2.6°; Mitsuyasu's x^5 law has no such limit of its own.
constexpr double kExponentMax = 1000.0;

double Sech2(double x) {
  const double t = real::Tanh(x);
  return 1.0 - t * t;
}

// cos^2s(Δ/2).
double HalfCosinePower(double cos_delta, double s) {
  const double half = 0.5 * (1.0 + cos_delta);
  if (!(half > 1e-300)) return s > 0.0 ? 0.0 : 1.0;
  return real::Exp(s * real::Log(half));
}

double DonelanBannerShape(double beta, double swell, double cos_delta) {
  const double c = cos_delta < -1.0 ? -1.0 : (cos_delta > 1.0 ? 1.0 : cos_delta);
  const double delta = real::Atan2(std::sqrt(1.0 - c * c), c);
  const double base = Sech2(beta * delta);
  return swell > 0.0 ? base * HalfCosinePower(c, swell) : base;
}

// 1 / ∫ sech²(βΔ) cos^2s(Δ/2) dΔ over a turn, midpoints of [0, π]: at π a small s has a cusp.
double DonelanBannerNormaliser(double beta, double swell) {
  if (!(swell > 0.0)) return beta / (2.0 * real::Tanh(beta * kPi));
  constexpr int kIntervals = 64;
  static const std::array<double, kIntervals> log_half_cosine = [] {  // ln cos²(Δ/2)
    std::array<double, kIntervals> logs{};
    for (int n = 0; n < kIntervals; ++n) {
      logs[static_cast<std::size_t>(n)] =
          real::Log(0.5 * (1.0 + real::Cos(kPi * (n + 0.5) / kIntervals)));
    }
    return logs;
  }();
  double sum = 0.0;
  for (int n = 0; n < kIntervals; ++n) {
    sum += Sech2(beta * (kPi * (n + 0.5) / kIntervals)) *
           real::Exp(swell * log_half_cosine[static_cast<std::size_t>(n)]);
  }
  return 1.0 / (2.0 * sum * kPi / kIntervals);
}

}  // namespace

double GammaHalfRatio(double s) {
  // Γ(s+1)/Γ(s+1/2) = Γ(s+2)/Γ(s+3/2) · (s+1/2)/(s+1)
  double factor = 1.0;
  double x = s;
  for (; x < 32.0; x += 1.0) factor *= (x + 0.5) / (x + 1.0);
  const double y = 1.0 / x;
  const double series =
      1.0 + y * (1.0 / 8.0 +
                 y * (1.0 / 128.0 +
                      y * (-5.0 / 1024.0 + y * (-21.0 / 32768.0 + y * (399.0 / 262144.0 +
                                                                       y * (869.0 / 4194304.0))))));
  return factor * std::sqrt(x) * series;
}

double SpreadingExponent(SpreadingKind kind, double x, double inverse_wave_age) {
  double s = 0.0;
  if (kind == SpreadingKind::kMitsuyasu) {
    s = 11.5 * real::Pow(inverse_wave_age, -2.5) * real::Pow(x, x <= 1.0 ? 5.0 : -2.5);
  } else if (x <= 1.05) {
    s = 6.97 * real::Pow(x, 4.06);
  } else {
    s = 9.77 * real::Pow(x, -2.33 - 1.45 * (inverse_wave_age - 1.17));
  }
  return s < kExponentMax ? s : kExponentMax;
}

double DonelanBannerBeta(double x) {
  if (x < 0.95) return 2.61 * real::Pow(x < 0.56 ? 0.56 : x, 1.3);
  if (x < 1.6) return 2.28 * real::Pow(x, -1.3);
  constexpr double kLog10 = 2.30258509299404568402;
  return real::Exp(kLog10 * (-0.4 + 0.8393 * real::Exp(-0.567 * real::Log(x * x))));
}

SpreadingModel::Shape SpreadingModel::At(double omega_rad_per_s) const {
  const double x = omega_rad_per_s / omega_p_rad_per_s;
  const double swell = 16.0 * real::Tanh(1.0 / x) * (spreading.swell * spreading.swell);
  if (spreading.kind == SpreadingKind::kDonelanBanner) {
    const double beta = DonelanBannerBeta(x);
    return {beta, swell, DonelanBannerNormaliser(beta, swell)};
  }
  const double base = spreading.kind == SpreadingKind::kCosine2s
                          ? spreading.exponent_s
                          : SpreadingExponent(spreading.kind, x, inverse_wave_age);
  const double s = base + swell;
  return {s, 0.0, GammaHalfRatio(s) / kTwoSqrtPi};
}

double SpreadingModel::Density(const Shape& shape, double cos_delta) const {
  if (spreading.kind == SpreadingKind::kDonelanBanner) {
    return shape.normaliser * DonelanBannerShape(shape.width, shape.swell, cos_delta);
  }
  return shape.normaliser * HalfCosinePower(cos_delta, shape.width);
}

}  // namespace onesea::sea
