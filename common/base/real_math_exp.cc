#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/base/double_double.h"
#include "common/base/real_math.h"

namespace onesea::real {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLog2e = 0x1.71547652b82fep+0;
// ln 2 = high + low; high has 21 zero bits at its end, so that k * high is exact for |k| < 2^21.
constexpr double kLn2High = 0x1.62e42feep-1;
constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
constexpr double kSqrtHalf = 0.70710678118654752440;

// y 2^k with one rounding, also when the result is subnormal. Pre: y in [1/2, 4], |k| <= 1100.
double Scale(double y, int k) {
  const int half = k / 2;
  const auto power = [](int n) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52);
  };
  return y * power(half) * power(k - half);
}

// exp(x + tail), |tail| < 1e-12 |x|; x in the range where the result is finite.
double ExpOfSum(double x, double tail) {
  if (!(x <= 709.8)) return x > 0.0 ? kInfinity : x;
  if (x < -745.2) return 0.0;
  const double k = std::floor(x * kLog2e + 0.5);
  const DoubleDouble r = TwoSum(x - k * kLn2High, -k * kLn2Low);
  const double z = r.hi;  // |z| <= 0.347: the Taylor series to z^14 is within 2e-19
  double p = 1.0 / 87178291200.0;
  p = 1.0 / 6227020800.0 + z * p;
  p = 1.0 / 479001600.0 + z * p;
  p = 1.0 / 39916800.0 + z * p;
  p = 1.0 / 3628800.0 + z * p;
  p = 1.0 / 362880.0 + z * p;
  p = 1.0 / 40320.0 + z * p;
  p = 1.0 / 5040.0 + z * p;
  p = 1.0 / 720.0 + z * p;
  p = 1.0 / 120.0 + z * p;
  p = 1.0 / 24.0 + z * p;
  p = 1.0 / 6.0 + z * p;
  p = 0.5 + z * p;
  const double rest = r.lo + tail;
  const DoubleDouble sum = FastTwoSum(1.0, z);
  const double curve = z * z * p;
  return Scale(sum.hi + (sum.lo + (curve + rest * (1.0 + (z + curve)))), static_cast<int>(k));
}

struct Binary {
  double mantissa;  // in [sqrt(1/2), sqrt(2))
  int exponent;
};

// Pre: x > 0 and finite.
Binary SplitAtSqrtHalf(double x) {
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52) - 1022;
  double mantissa = std::bit_cast<double>((bits & 0x000fffffffffffffULL) | 0x3fe0000000000000ULL);
  if (mantissa < kSqrtHalf) {
    mantissa *= 2.0;
    exponent -= 1;
  }
  return {mantissa, exponent};
}

// (ln((1+s)/(1-s)) - 2s - 2s³/3) / s⁵ as a series in z = s². |s| <= 0.1716: within 1e-18 of the
// logarithm.
double AtanhTail(double z) {
  double p = 2.0 / 25.0;
  p = 2.0 / 23.0 + z * p;
  p = 2.0 / 21.0 + z * p;
  p = 2.0 / 19.0 + z * p;
  p = 2.0 / 17.0 + z * p;
  p = 2.0 / 15.0 + z * p;
  p = 2.0 / 13.0 + z * p;
  p = 2.0 / 11.0 + z * p;
  p = 2.0 / 9.0 + z * p;
  p = 2.0 / 7.0 + z * p;
  return 2.0 / 5.0 + z * p;
}

// ln x with a relative error of 2^-64. Pre: x > 0 and finite.
DoubleDouble LogDoubleDouble(double x) {
  const Binary b = SplitAtSqrtHalf(x);
  const double f = b.mantissa - 1.0;
  const DoubleDouble denominator = TwoSum(b.mantissa, 1.0);
  const double s_hi = f / denominator.hi;
  const DoubleDouble back = TwoProduct(s_hi, denominator.hi);
  const double s_lo = (((f - back.hi) - back.lo) - s_hi * denominator.lo) / denominator.hi;
  const DoubleDouble s{s_hi, s_lo};
  const DoubleDouble z = Multiply(s, s);
  constexpr DoubleDouble kTwoThirds{0x1.5555555555555p-1, 0x1.5555555555555p-55};
  const DoubleDouble cubic = Multiply(Multiply(z, s), kTwoThirds);
  const double quintic = s_hi * z.hi * z.hi * AtanhTail(z.hi);
  const DoubleDouble series = FastTwoSum(2.0 * s_hi, cubic.hi);
  const double series_lo = series.lo + (2.0 * s_lo + (cubic.lo + quintic));
  const double e = static_cast<double>(b.exponent);
  const DoubleDouble power = TwoSum(e * kLn2High, e * kLn2Low);
  const DoubleDouble sum = TwoSum(power.hi, series.hi);
  return FastTwoSum(sum.hi, sum.lo + (power.lo + series_lo));
}

bool IsInteger(double y) { return std::floor(y) == y; }
bool IsOdd(double y) { return IsInteger(y) && std::floor(0.5 * y) != 0.5 * y; }

}  // namespace

double Exp(double x) { return ExpOfSum(x, 0.0); }

double Log(double x) {
  if (!(x > 0.0)) return x == 0.0 ? -kInfinity : kNan;
  if (x == kInfinity) return x;
  const Binary b = SplitAtSqrtHalf(x);
  const double f = b.mantissa - 1.0;
  const double s = f / (2.0 + f);
  const double z = s * s;
  const double rest = z * (2.0 / 3.0 + z * AtanhTail(z));  // ln(1+f) = 2s + s rest, 2s = f - s f
  const double e = static_cast<double>(b.exponent);
  return e * kLn2High + (f - (s * (f - rest) - e * kLn2Low));
}

double Pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (std::isnan(x) || std::isnan(y)) return kNan;
  const double magnitude = std::fabs(x);
  if (std::isinf(y)) {
    if (magnitude == 1.0) return 1.0;
    return (magnitude > 1.0) == (y > 0.0) ? kInfinity : 0.0;
  }
  const double sign = std::signbit(x) && IsOdd(y) ? -1.0 : 1.0;
  if (magnitude == 0.0 || std::isinf(magnitude)) {
    return sign * ((magnitude == 0.0) == (y > 0.0) ? 0.0 : kInfinity);
  }
  if (x < 0.0 && !IsInteger(y)) return kNan;
  const DoubleDouble log = LogDoubleDouble(magnitude);
  const double estimate = y * log.hi;
  if (!(std::fabs(estimate) < 800.0)) return sign * (estimate > 0.0 ? kInfinity : 0.0);
  const DoubleDouble product = TwoProduct(y, log.hi);
  return sign * ExpOfSum(product.hi, product.lo + y * log.lo);
}

double Sinh(double x) {
  const double magnitude = std::fabs(x);
  if (magnitude < 1.0) {
    const double z = x * x;  // the Taylor series to x^19 is within 2e-20
    double p = 1.0 / 121645100408832000.0;
    p = 1.0 / 355687428096000.0 + z * p;
    p = 1.0 / 1307674368000.0 + z * p;
    p = 1.0 / 6227020800.0 + z * p;
    p = 1.0 / 39916800.0 + z * p;
    p = 1.0 / 362880.0 + z * p;
    p = 1.0 / 5040.0 + z * p;
    p = 1.0 / 120.0 + z * p;
    p = 1.0 / 6.0 + z * p;
    return x + x * (z * p);
  }
  // exp(x)/2 as a square above 700, since exp(x) alone overflows before sinh does.
  double result = 0.0;
  if (magnitude > 700.0) {
    const double root = Exp(0.5 * magnitude);
    result = (0.5 * root) * root;
  } else {
    const double e = Exp(magnitude);
    result = 0.5 * (e - 1.0 / e);
  }
  return std::signbit(x) ? -result : result;
}

double Tanh(double x) {
  const double magnitude = std::fabs(x);
  if (magnitude < 0.6) {
    const double z = x * x;  // cosh by its Taylor series to x^16: within 1e-20
    double p = 1.0 / 20922789888000.0;
    p = 1.0 / 87178291200.0 + z * p;
    p = 1.0 / 479001600.0 + z * p;
    p = 1.0 / 3628800.0 + z * p;
    p = 1.0 / 40320.0 + z * p;
    p = 1.0 / 720.0 + z * p;
    p = 1.0 / 24.0 + z * p;
    p = 0.5 + z * p;
    return Sinh(x) / (1.0 + z * p);
  }
  if (std::isnan(x)) return x;
  const double result = magnitude > 20.0 ? 1.0 : 1.0 - 2.0 / (Exp(2.0 * magnitude) + 1.0);
  return std::signbit(x) ? -result : result;
}

}  // namespace onesea::real
