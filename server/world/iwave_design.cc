#include "server/world/iwave_design.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/base/check.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"

namespace onesea::world {
namespace {

constexpr int kRadii = 44, kAngles = 6;  // samples of the wavenumber plane's octant
constexpr double kBandEnd = 2.4;         // rad/cell; beyond it the weight falls
constexpr double kRidge = 1e-4;          // of the mean diagonal: keeps the levels from fighting

double DispersionSymbol(double q, double depth_cells, double step_number) {
  const double exact = std::isinf(depth_cells) ? q : q * real::Tanh(q * depth_cells);
  if (!(step_number > 0.0)) return exact;
  const double half_turn = std::min(0.5 * std::sqrt(step_number * exact), 0.5 * sea::kPi);
  const double sine = real::Sin(half_turn);
  return 4.0 / step_number * sine * sine;
}

// cos(n q) for n = 0..4, and the symbol of R's factor along this axis.
struct Axis {
  explicit Axis(double q) {
    cosine[0] = 1.0;
    cosine[1] = real::Cos(q);
    for (int n = 2; n <= kIwaveRadius; ++n) {
      cosine[n] = 2.0 * cosine[1] * cosine[n - 1] - cosine[n - 2];
    }
    const double half = 0.5 * (1.0 + cosine[1]);
    low_pass = half * half * half;
  }
  double cosine[kIwaveRadius + 1];
  double low_pass;
};

// The symbols of all taps of one level: sum over the places that a tap holds for.
void TapSymbols(const Axis& x, const Axis& y, double scale, double* symbols) {
  for (int i = 0; i <= kIwaveRadius; ++i) {
    for (int j = 0; j <= i; ++j) {
      const double fold = scale * (i > 0 ? 2.0 : 1.0) * (j > 0 ? 2.0 : 1.0);
      double sum = x.cosine[i] * y.cosine[j];
      if (i != j) sum += x.cosine[j] * y.cosine[i];
      *symbols++ = fold * sum;
    }
  }
}

void AllSymbols(double qx, double qy, int levels, double* symbols) {
  double through = 1.0;
  for (int level = 0; level < levels; ++level) {
    const double scale = static_cast<double>(1 << level);
    const Axis x(qx * scale), y(qy * scale);
    TapSymbols(x, y, through, symbols + level * kIwaveTaps);
    through *= x.low_pass * x.low_pass * y.low_pass * y.low_pass;
  }
}

// Solves A x = b for a symmetric positive A (n x n, row-major); both are overwritten.
void SolveInPlace(std::vector<double>& a, std::vector<double>& b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    ONESEA_CHECK(a[k * n + k] > 0.0);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[k * n + i] / a[k * n + k];
      for (std::size_t j = i; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k * n + j] * b[j];
    b[k] /= a[k * n + k];
  }
}

struct NormalEquations {
  explicit NormalEquations(std::size_t n) : a(n * n), b(n), row(n) {}

  // `row` times the unknowns should be 1, with this weight.
  void Add(double weight) {
    const std::size_t n = b.size();
    const double square = weight * weight;
    for (std::size_t i = 0; i < n; ++i) {
      const double left = square * row[i];
      for (std::size_t j = i; j < n; ++j) a[i * n + j] += left * row[j];
      b[i] += left;
    }
  }
  void AddRidge() {
    const std::size_t n = b.size();
    double trace = 0.0;
    for (std::size_t i = 0; i < n; ++i) trace += a[i * n + i];
    for (std::size_t i = 0; i < n; ++i) {
      a[i * n + i] += kRidge * trace / static_cast<double>(n);
    }
  }

  std::vector<double> a, b;
  std::vector<double> row;
};

}  // namespace

int IwaveLevelsFor(int columns, int rows) {
  int levels = 1;
  for (int side = std::min(columns, rows); side >= 16 && levels < kIwaveLevelsMax; side /= 2) {
    ++levels;
  }
  return levels;
}

IwaveKernels DesignIwave(double depth_cells, double step_number, int levels_max) {
  ONESEA_CHECK(depth_cells > 0.0 && levels_max >= 1 && levels_max <= kIwaveLevelsMax);
  IwaveKernels kernels;
  kernels.levels = 1;
  for (double reach = 1.0; reach < depth_cells && kernels.levels < levels_max; reach *= 2.0) {
    ++kernels.levels;
  }
  const std::size_t unknowns = kernels.levels * kIwaveTaps;
  // Unknowns in the size that each level's taps have, so that the ridge treats them alike.
  double size[kIwaveLevelsMax];
  for (int level = 0; level < kernels.levels; ++level) {
    const double scale = static_cast<double>(1 << level);
    size[level] = DispersionSymbol(1.0 / scale, depth_cells, step_number) * scale * scale;
  }
  NormalEquations equations(unknowns);
  // The coarsest kernel can't hold waves longer than 9 of its cells, unless the bottom is near.
  const double coarsest = static_cast<double>(1 << (levels_max - 1));
  const double first = depth_cells <= 0.5 * coarsest ? 0.1 / depth_cells : 0.7 / coarsest;
  const double ratio = real::Log(sea::kPi * 1.41 / first) / (kRadii - 1);
  for (int n = 0; n < kRadii; ++n) {
    const double q = first * real::Exp(ratio * n);
    for (int m = 0; m < kAngles; ++m) {
      const auto [sine, cosine] = real::SinCos((m + 0.5) / kAngles * 0.25 * sea::kPi);
      const double qx = q * cosine, qy = q * sine;
      if (qx > sea::kPi) continue;
      const double sx = real::Sin(0.5 * qx), sy = real::Sin(0.5 * qy);
      const double target =
          DispersionSymbol(q, depth_cells, step_number) / (4.0 * (sx * sx + sy * sy));
      AllSymbols(qx, qy, kernels.levels, equations.row.data());
      for (std::size_t i = 0; i < unknowns; ++i) {
        equations.row[i] *= size[i / kIwaveTaps] / target;
      }
      const double beyond = q / kBandEnd;
      const double second = beyond * beyond, fourth = second * second;
      equations.Add(1.0 / std::sqrt(std::sqrt(1.0 + fourth * fourth)));
    }
  }
  equations.AddRidge();
  SolveInPlace(equations.a, equations.b);
  for (std::size_t i = 0; i < unknowns; ++i) {
    kernels.taps[i / kIwaveTaps][i % kIwaveTaps] =
        static_cast<float>(equations.b[i] * size[i / kIwaveTaps]);
  }
  return kernels;
}

double IwaveSymbol(const IwaveKernels& kernels, double qx, double qy) {
  double symbols[kIwaveLevelsMax * kIwaveTaps];
  AllSymbols(qx, qy, kernels.levels, symbols);
  double sum = 0.0;
  for (std::size_t i = 0; i < kernels.levels * kIwaveTaps; ++i) {
    sum += symbols[i] * kernels.taps[i / kIwaveTaps][i % kIwaveTaps];
  }
  return sum;
}

}  // namespace onesea::world
