#include "common/sea/max_entropy.h"

#include <cmath>

#include "common/base/real_math.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

constexpr double kResultantMax = 0.995;
constexpr double kSecondRatioMax = 0.98;

// Complex numbers by hand: std::complex multiplies through a library routine that differs.
struct Complex {
  double re = 0.0;
  double im = 0.0;
};

Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
Complex operator-(Complex a, Complex b) { return {a.re - b.re, a.im - b.im}; }
Complex operator*(Complex a, Complex b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
Complex operator*(double s, Complex a) { return {s * a.re, s * a.im}; }
Complex Conjugate(Complex a) { return {a.re, -a.im}; }
double SquaredNorm(Complex a) { return a.re * a.re + a.im * a.im; }

Complex Polar(double radius, double angle_rad) {
  const real::SinCosPair p = real::SinCos(angle_rad);
  return {radius * p.cos, radius * p.sin};
}

}  // namespace

void MaxEntropyDistribution(const DirectionalCoefficients& coefficients, std::span<double> out) {
  const double r1 = coefficients.r1 < kResultantMax ? coefficients.r1 : kResultantMax;
  const Complex c1 = Polar(r1, coefficients.mean_wave_to_rad);
  Complex c2 = Polar(coefficients.r2, 2.0 * coefficients.principal_wave_to_rad);
  const double room = 1.0 - SquaredNorm(c1);
  const Complex excess = c2 - c1 * c1;
  const double ratio = std::sqrt(SquaredNorm(excess)) / room;
  if (ratio > kSecondRatioMax) c2 = c1 * c1 + (kSecondRatioMax / ratio) * excess;
  const Complex phi1 = (1.0 / room) * (c1 - c2 * Conjugate(c1));
  const Complex phi2 = c2 - c1 * phi1;
  double sum = 0.0;
  const auto n = static_cast<double>(out.size());
  for (std::size_t m = 0; m < out.size(); ++m) {
    const Complex e = Polar(1.0, -2.0 * kPi * static_cast<double>(m) / n);
    const Complex denominator = Complex{1.0, 0.0} - phi1 * e - phi2 * (e * e);
    out[m] = 1.0 / SquaredNorm(denominator);  // the constant factor goes with the scaling
    sum += out[m];
  }
  const double scale = n / (2.0 * kPi * sum);
  for (double& d : out) d *= scale;
}

}  // namespace onesea::sea
