#include "common/base/real_math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/base/rng.h"

// Oracle: the C library in long double, whose 64-bit mantissa shows errors far below one ulp of
// double.
static_assert(LDBL_MANT_DIG >= 64, "the oracle needs more bits than double");

namespace onesea::real {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kSamples = 200'000;

double UlpError(double got, long double want) {
  const double rounded = static_cast<double>(want);
  if (std::isnan(rounded)) return std::isnan(got) ? 0.0 : kInf;
  if (std::isinf(rounded) || std::isinf(got)) return got == rounded ? 0.0 : kInf;
  if (rounded == 0.0 && got == 0.0) return std::signbit(got) == std::signbit(rounded) ? 0.0 : kInf;
  const double magnitude = std::max(std::fabs(rounded), DBL_MIN);
  const int exponent = std::ilogb(magnitude);
  return static_cast<double>(std::fabs(static_cast<long double>(got) - want) /
                             std::ldexp(1.0L, exponent - 52));
}

// Doubles with uniform random bits: every exponent, sign, subnormal, infinity and NaN.
double AnyDouble(std::uint32_t n, std::uint32_t stream) {
  const auto w = Philox4x32({n, stream, 0, 0}, {17, 0});
  return std::bit_cast<double>((std::uint64_t{w[0]} << 32) | w[1]);
}

double Uniform(std::uint32_t n, std::uint32_t stream, double low, double high) {
  const auto w = Philox4x32({n, stream, 1, 0}, {17, 0});
  return low + (high - low) * UnitInterval(w[0], w[1]);
}

template <typename Function, typename Oracle>
double GreatestError(Function function, Oracle oracle, double low, double high) {
  double worst = 0.0;
  for (std::uint32_t n = 0; n < kSamples; ++n) {
    for (const double x : {AnyDouble(n, 0), Uniform(n, 1, low, high), Uniform(n, 2, -2.0, 2.0)}) {
      const double error = UlpError(function(x), oracle(static_cast<long double>(x)));
      EXPECT_LT(error, 10.0) << "x = " << x;
      worst = std::max(worst, error);
    }
  }
  for (const double x :
       {0.0, -0.0, kInf, -kInf, kNan, DBL_MIN, -DBL_MIN, DBL_TRUE_MIN, DBL_MAX, -DBL_MAX}) {
    EXPECT_LT(UlpError(function(x), oracle(static_cast<long double>(x))), 2.0) << "x = " << x;
  }
  return worst;
}

TEST(RealMath, ExpIsWithinItsBound) {
  const double worst = GreatestError(
      Exp, [](long double x) { return std::exp(x); }, -750.0, 715.0);
  RecordProperty("ulp", std::to_string(worst));
  EXPECT_LE(worst, 0.75);
}

TEST(RealMath, LogIsWithinItsBound) {
  const double worst = GreatestError(
      Log, [](long double x) { return std::log(x); }, 0.4, 3.0);
  RecordProperty("ulp", std::to_string(worst));
  EXPECT_LE(worst, 0.95);
}

TEST(RealMath, SinIsWithinItsBound) {
  const double worst = GreatestError(
      Sin, [](long double x) { return std::sin(x); }, -1e4, 1e4);
  RecordProperty("ulp", std::to_string(worst));
  EXPECT_LE(worst, 0.80);
}

TEST(RealMath, CosIsWithinItsBound) {
  const double worst = GreatestError(
      Cos, [](long double x) { return std::cos(x); }, -1e4, 1e4);
  RecordProperty("ulp", std::to_string(worst));
  EXPECT_LE(worst, 0.80);
}

TEST(RealMath, SinhIsWithinItsBound) {
  const double worst = GreatestError(
      Sinh, [](long double x) { return std::sinh(x); }, -715.0, 715.0);
  RecordProperty("ulp", std::to_string(worst));
  EXPECT_LE(worst, 1.8);
}

TEST(RealMath, TanhIsWithinItsBound) {
  const double worst = GreatestError(
      Tanh, [](long double x) { return std::tanh(x); }, -25.0, 25.0);
  RecordProperty("ulp", std::to_string(worst));
  EXPECT_LE(worst, 2.4);
}

TEST(RealMath, Atan2IsWithinItsBound) {
  double worst = 0.0;
  const auto check = [&worst](double y, double x) {
    const double error =
        UlpError(Atan2(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
    EXPECT_LT(error, 10.0) << "y = " << y << ", x = " << x;
    worst = std::max(worst, error);
  };
  for (std::uint32_t n = 0; n < kSamples; ++n) {
    check(AnyDouble(n, 3), AnyDouble(n, 4));
    check(Uniform(n, 5, -3.0, 3.0), Uniform(n, 6, -3.0, 3.0));
  }
  RecordProperty("ulp", std::to_string(worst));
  EXPECT_LE(worst, 2.1);
  const double special[] = {0.0, -0.0, 1.0, -1.0, kInf, -kInf, kNan, DBL_TRUE_MIN, -DBL_MAX};
  for (const double y : special) {
    for (const double x : special) check(y, x);
  }
}

TEST(RealMath, PowIsWithinItsBound) {
  double worst = 0.0;
  const auto check = [&worst](double x, double y) {
    const double error =
        UlpError(Pow(x, y), std::pow(static_cast<long double>(x), static_cast<long double>(y)));
    EXPECT_LT(error, 10.0) << "x = " << x << ", y = " << y;
    worst = std::max(worst, error);
  };
  for (std::uint32_t n = 0; n < kSamples; ++n) {
    check(AnyDouble(n, 7), AnyDouble(n, 8));
    check(std::fabs(AnyDouble(n, 9)), Uniform(n, 10, -2.0, 2.0));
    check(Uniform(n, 11, 0.0, 10.0), Uniform(n, 12, -300.0, 300.0));
    check(Uniform(n, 13, 0.999, 1.001), Uniform(n, 14, -7e5, 7e5));
    check(Uniform(n, 15, -10.0, 10.0), std::floor(Uniform(n, 16, -30.0, 30.0)));
  }
  RecordProperty("ulp", std::to_string(worst));
  EXPECT_LE(worst, 0.75);
  const double special[] = {0.0, -0.0, 1.0,   -1.0, 2.0,   -3.0,
                            0.5, kInf, -kInf, kNan, 1e300, 9007199254740993.0};
  for (const double x : special) {
    for (const double y : special) check(x, y);
  }
}

TEST(RealMath, SinCosEqualsItsParts) {
  for (std::uint32_t n = 0; n < 1000; ++n) {
    const double x = Uniform(n, 20, -100.0, 100.0);
    EXPECT_EQ(SinCos(x).sin, Sin(x));
    EXPECT_EQ(SinCos(x).cos, Cos(x));
  }
}

}  // namespace
}  // namespace onesea::real
