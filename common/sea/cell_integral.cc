#include "common/sea/cell_integral.h"

#include <cmath>

#include "common/base/real_math.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

constexpr int kSubdivisionMax = 16;
constexpr int kSubdivisionMin = 3;
constexpr int kSubdivisionRim = 8;
constexpr double kHalfDiagonal = 0.70710678118654752440;

}  // namespace

Lattice::Lattice(const Cascade& cascade)
    : cell_(2.0 * kPi / cascade.length_m),
      band_min_(cascade.wavenumber_min_rad_per_m),
      band_max_(cascade.wavenumber_max_rad_per_m),
      index_min_(cascade.wavenumber_min_rad_per_m / cell_),
      index_max_(cascade.wavenumber_max_rad_per_m / cell_) {
  const real::SinCosPair rotation = real::SinCos(cascade.rotation_rad);
  cos_ = rotation.cos;
  sin_ = rotation.sin;
}

bool Lattice::MeetsBand(Index index) const {
  const double x = std::abs(index.i);
  const double y = std::abs(index.j);
  const double near_x = x > 0.0 ? x - 0.5 : 0.0;
  const double near_y = y > 0.0 ? y - 0.5 : 0.0;
  const double near2 = near_x * near_x + near_y * near_y;
  const double far2 = (x + 0.5) * (x + 0.5) + (y + 0.5) * (y + 0.5);
  return near2 < index_max_ * index_max_ && far2 > index_min_ * index_min_;
}

std::vector<Lattice::Index> Lattice::Waves() const {
  const int reach = static_cast<int>(std::ceil(index_max_ + 0.5));
  std::vector<Index> waves;
  waves.reserve(static_cast<std::size_t>(4 * (reach + 1) * (reach + 1)));
  for (int j = -reach; j <= reach; ++j) {
    for (int i = -reach; i <= reach; ++i) {
      if ((i != 0 || j != 0) && MeetsBand({i, j})) waves.push_back({i, j});
    }
  }
  return waves;
}

int Lattice::SubdivisionOf(Index index) const {
  const double r = std::sqrt(static_cast<double>(index.i * index.i + index.j * index.j));
  const bool rim =
      std::fabs(r - index_min_) < kHalfDiagonal || std::fabs(r - index_max_) < kHalfDiagonal;
  const int floor = rim ? kSubdivisionRim : kSubdivisionMin;
  if (32.0 >= kSubdivisionMax * r) return kSubdivisionMax;
  const int wanted = static_cast<int>(std::ceil(32.0 / r));
  return wanted > floor ? wanted : floor;
}

double Lattice::Variance(Index index, const SpectrumTable& table) const {
  const int n = SubdivisionOf(index);
  const double step = 1.0 / n;
  const double min2 = band_min_ * band_min_;
  const double max2 = band_max_ * band_max_;
  double sum = 0.0;
  for (int q = 0; q < n; ++q) {
    const double y = index.j - 0.5 + (q + 0.5) * step;
    for (int p = 0; p < n; ++p) {
      const double x = index.i - 0.5 + (p + 0.5) * step;
      const Vec2d wave_vector = WaveVector(x, y);
      const double k2 = Dot(wave_vector, wave_vector);
      if (k2 < min2 || k2 >= max2) continue;
      sum += table.Density(wave_vector, std::sqrt(k2));
    }
  }
  return sum * (cell_ * step) * (cell_ * step);
}

}  // namespace onesea::sea
