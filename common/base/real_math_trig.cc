#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/base/double_double.h"
#include "common/base/real_math.h"

namespace onesea::real {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr DoubleDouble kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr DoubleDouble kPi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

// 2/π, 64 zero bits and then 1216 bits of the fraction, most significant first.
constexpr std::uint64_t kTwoOverPi[] = {0,
                                        0xa2f9836e4e441529,
                                        0xfc2757d1f534ddc0,
                                        0xdb6295993c439041,
                                        0xfe5163abdebbc561,
                                        0xb7246e3a424dd2e0,
                                        0x06492eea09d1921c,
                                        0xfe1deb1cb129a73e,
                                        0xe88235f52ebb4484,
                                        0xe99c7026b45f7e41,
                                        0x3991d639835339f4,
                                        0x9c845f8bbdf9283b,
                                        0x1ff897ffde05980f,
                                        0xef2f118b5a0a6d1f,
                                        0x6d367ecf27cb09b7,
                                        0x4f463f669e5fea2d,
                                        0x7527bac7ebe5f17b,
                                        0x3d0739f78a5292ea,
                                        0x6bfb5fb11f8d5d08,
                                        0x56033046fc7b6bab};

struct Reduced {
  DoubleDouble rest_rad;  // in [-π/4, π/4]
  unsigned quadrant;      // x = rest + quadrant π/2 (mod 2π)
};

// 192 bits, least significant limb first.
struct Bits192 {
  std::uint64_t limb[3];
};

// |f| 2^-190 as a double-double; f != 0.
DoubleDouble FractionOf(Bits192 f) {
  int shift = 0;
  while (f.limb[2] == 0 && shift < 128) {
    f = {{0, f.limb[0], f.limb[1]}};
    shift += 64;
  }
  const int more = std::countl_zero(f.limb[2]);
  if (more > 0) {
    f.limb[2] = (f.limb[2] << more) | (f.limb[1] >> (64 - more));
    f.limb[1] = (f.limb[1] << more) | (f.limb[0] >> (64 - more));
  }
  shift += more;
  const auto hi = static_cast<double>(f.limb[2] >> 11);
  const auto lo = static_cast<double>(((f.limb[2] & 0x7ff) << 42) | (f.limb[1] >> 22));
  const auto unit = std::bit_cast<double>(static_cast<std::uint64_t>(1023 + 2 - 53 - shift) << 52);
  return {hi * unit, lo * (unit * 0x1p-53)};
}

// Payne & Hanek 1983 in integers: x = m 2^e with a 53-bit m; only 192 bits of 2/π matter, since
// higher ones give whole turns and lower ones less than 2^-137. One path serves every |x| >= π/4,
// up to 1.8e308.
Reduced ReduceByHalfPi(double x) {
  using Wide = unsigned __int128;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int e = static_cast<int>((bits >> 52) & 0x7ff) - 1075;
  const std::uint64_t m = (bits & 0x000fffffffffffffULL) | 0x0010000000000000ULL;
  const int first_bit = e + 62;  // its weight times 2^e is 2: quadrants count modulo 4
  const int word = first_bit / 64;
  const int offset = first_bit % 64;
  std::uint64_t window[3];
  for (int n = 0; n < 3; ++n) {
    const std::uint64_t high = kTwoOverPi[word + n];
    const std::uint64_t low = kTwoOverPi[word + n + 1];
    window[2 - n] = offset == 0 ? high : (high << offset) | (low >> (64 - offset));
  }
  const Wide p0 = static_cast<Wide>(m) * window[0];
  const Wide p1 = static_cast<Wide>(m) * window[1] + static_cast<std::uint64_t>(p0 >> 64);
  const std::uint64_t p2 = m * window[2] + static_cast<std::uint64_t>(p1 >> 64);
  const std::uint64_t rounded = p2 + (std::uint64_t{1} << 61);
  unsigned quadrant = static_cast<unsigned>(rounded >> 62);
  Bits192 f{{static_cast<std::uint64_t>(p0), static_cast<std::uint64_t>(p1),
             p2 - (static_cast<std::uint64_t>(quadrant) << 62)}};
  const bool negative = (f.limb[2] >> 63) != 0;
  if (negative) {
    f = {{~f.limb[0] + 1, ~f.limb[1], ~f.limb[2]}};
    if (f.limb[0] == 0 && ++f.limb[1] == 0) ++f.limb[2];
  }
  DoubleDouble rest = Multiply(FractionOf(f), kHalfPi);
  if (negative != std::signbit(x)) rest = {-rest.hi, -rest.lo};
  if (std::signbit(x)) quadrant = (4 - quadrant) % 4;
  return {rest, quadrant};
}

// |x| <= π/4: the Taylor series to x^17 is within 1e-19 of sine.
double SinKernel(DoubleDouble x) {
  const double z = x.hi * x.hi;
  double p = 1.0 / 355687428096000.0;
  p = -1.0 / 1307674368000.0 + z * p;
  p = 1.0 / 6227020800.0 + z * p;
  p = -1.0 / 39916800.0 + z * p;
  p = 1.0 / 362880.0 + z * p;
  p = -1.0 / 5040.0 + z * p;
  p = 1.0 / 120.0 + z * p;
  p = -1.0 / 6.0 + z * p;
  return x.hi + (x.hi * (z * p) + x.lo * (1.0 - 0.5 * z));
}

// |x| <= π/4: the Taylor series to x^18 is within 1e-20 of cosine.
double CosKernel(DoubleDouble x) {
  const double z = x.hi * x.hi;
  double p = -1.0 / 6402373705728000.0;
  p = 1.0 / 20922789888000.0 + z * p;
  p = -1.0 / 87178291200.0 + z * p;
  p = 1.0 / 479001600.0 + z * p;
  p = -1.0 / 3628800.0 + z * p;
  p = 1.0 / 40320.0 + z * p;
  p = -1.0 / 720.0 + z * p;
  p = 1.0 / 24.0 + z * p;
  const DoubleDouble leading = FastTwoSum(1.0, -0.5 * z);
  return leading.hi + (leading.lo + (z * (z * p) - x.hi * x.lo));
}

// atan t for t in [0, 1], as a sum: about a tabulated arc tangent of the nearest quarter.
DoubleDouble AtanOfUnit(double t) {
  static constexpr DoubleDouble kAtanOfQuarter[] = {{0.0, 0.0},
                                                    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                                    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                                    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                                    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
  const int quarter = static_cast<int>(std::floor(4.0 * t + 0.5));
  const double c = 0.25 * quarter;
  const double u = (t - c) / (1.0 + t * c);  // |u| <= 1/8: the series to u^17 is within 1e-18
  const double z = u * u;
  double p = 1.0 / 17.0;
  p = -1.0 / 15.0 + z * p;
  p = 1.0 / 13.0 + z * p;
  p = -1.0 / 11.0 + z * p;
  p = 1.0 / 9.0 + z * p;
  p = -1.0 / 7.0 + z * p;
  p = 1.0 / 5.0 + z * p;
  p = -1.0 / 3.0 + z * p;
  const DoubleDouble base = kAtanOfQuarter[quarter];
  const DoubleDouble sum = TwoSum(base.hi, u);
  return FastTwoSum(sum.hi, sum.lo + (base.lo + u * (z * p)));
}

double WithSign(double magnitude, double sign) {
  return std::signbit(sign) ? -magnitude : magnitude;
}

}  // namespace

SinCosPair SinCos(double x_rad) {
  if (!(std::fabs(x_rad) < std::numeric_limits<double>::infinity())) return {kNan, kNan};
  if (std::fabs(x_rad) < 1e-8) return {x_rad, 1.0};  // keeps the sign of zero
  if (std::fabs(x_rad) < 0.78539816339744828) {
    return {SinKernel({x_rad, 0.0}), CosKernel({x_rad, 0.0})};
  }
  const Reduced r = ReduceByHalfPi(x_rad);
  const double s = SinKernel(r.rest_rad);
  const double c = CosKernel(r.rest_rad);
  switch (r.quadrant) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double Sin(double x_rad) { return SinCos(x_rad).sin; }
double Cos(double x_rad) { return SinCos(x_rad).cos; }

double Atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return kNan;
  const double ax = std::fabs(x);
  const double ay = std::fabs(y);
  double small = ay < ax ? ay : ax;
  double large = ay < ax ? ax : ay;
  if (large == 0.0) return WithSign(std::signbit(x) ? kPi.hi : 0.0, y);
  if (std::isinf(large)) {
    small = std::isinf(small) ? 1.0 : 0.0;
    large = 1.0;
  }
  DoubleDouble angle = AtanOfUnit(small / large);
  if (ay >= ax) angle = FastTwoSum(kHalfPi.hi - angle.hi, kHalfPi.lo - angle.lo);
  if (std::signbit(x)) {
    const DoubleDouble rest = TwoSum(kPi.hi, -angle.hi);
    angle = {rest.hi, rest.lo + (kPi.lo - angle.lo)};
  }
  return WithSign(angle.hi + angle.lo, y);
}

}  // namespace onesea::real
