#include "tests/render/test_sea.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace onesea::render {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kGravity = 9.81;
constexpr int kIndexMax = 32;
constexpr double kLengthM[] = {1931.0, 367.0, 69.7, 13.25};
constexpr double kRotationRad[] = {0.0, 0.297, -0.506, 0.716};
using Complex = std::complex<double>;

std::uint64_t Next(std::uint64_t& state) {  // SplitMix64
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

// In place, exponent sign +1, unscaled; n a power of two, elements `stride` apart.
void Transform(Complex* data, int n, int stride) {
  for (int i = 1, j = 0; i < n; ++i) {
    int bit = n >> 1;
    for (; (j & bit) != 0; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(data[i * stride], data[j * stride]);
  }
  for (int half = 1; half < n; half *= 2) {
    const Complex turn = std::polar(1.0, kPi / half);
    for (int start = 0; start < n; start += 2 * half) {
      Complex w = 1.0;
      for (int k = 0; k < half; ++k, w *= turn) {
        Complex& a = data[(start + k) * stride];
        Complex& b = data[(start + k + half) * stride];
        const Complex t = w * b;
        b = a - t;
        a += t;
      }
    }
  }
}

// Variance per rad/s, not yet scaled to Hs.
double Jonswap(double omega, double peak) {
  const double width = omega <= peak ? 0.07 : 0.09;
  const double r = std::exp(-std::pow((omega - peak) / (width * peak), 2) / 2);
  return std::pow(omega, -5) * std::exp(-1.25 * std::pow(peak / omega, 4)) * std::pow(3.3, r);
}

double Spread(double angle, double omega, double peak) {
  const double s = std::max(1.0, 9.8 * std::pow(omega / peak, omega < peak ? 4.0 : -2.3));
  const double norm = std::tgamma(s + 1) / (2 * std::sqrt(kPi) * std::tgamma(s + 0.5));
  return norm * std::pow(std::abs(std::cos(0.5 * angle)), 2 * s);
}

std::size_t Bin(int i, int j, int n) {
  return static_cast<std::size_t>(((j + n) % n) * n + (i + n) % n);
}

}  // namespace

TestSea::TestSea(double hs_m, double tp_s, double wave_to_rad, int grid_size)
    : grid_size_(grid_size) {
  const double peak = 2 * kPi / tp_s;
  double m0 = 0.0;
  for (double omega = 0.05; omega < 20; omega += 0.002) m0 += Jonswap(omega, peak) * 0.002;
  const double scale = hs_m * hs_m / 16.0 / m0;
  std::uint64_t random = 7;
  for (int c = 0; c < 4; ++c) FillTile(c, scale, peak, wave_to_rad, random);
  for (double k = tiles_.back().wavenumber_max; k < 400; k *= 1.01) {
    const double omega = std::sqrt(kGravity * k);
    unresolved_mss_ += k * k * scale * Jonswap(omega, peak) * 0.5 * kGravity / omega * 0.01 * k;
  }
}

void TestSea::FillTile(int index, double scale, double peak, double wave_to_rad,
                       std::uint64_t& random) {
  const int n = grid_size_;
  const double length = kLengthM[index], dk = 2 * kPi / length;
  Tile tile{length,
            kRotationRad[index],
            index == 0 ? 0.0 : tiles_.back().wavenumber_max,
            dk * kIndexMax,
            {},
            {},
            {}};
  tile.amplitude_re.assign(static_cast<std::size_t>(n * n), 0.0);
  tile.amplitude_im = tile.amplitude_re;
  for (int j = -kIndexMax; j <= kIndexMax; ++j) {
    for (int i = -kIndexMax; i <= kIndexMax; ++i) {
      const double k = dk * std::hypot(i, j);
      if (k <= 0 || k < tile.wavenumber_min || k >= tile.wavenumber_max) continue;
      const double omega = std::sqrt(kGravity * k);
      const double angle =
          std::remainder(std::atan2(j, i) + tile.rotation_rad - wave_to_rad, 2 * kPi);
      const double density =
          scale * Jonswap(omega, peak) * Spread(angle, omega, peak) * 0.5 * kGravity / omega / k;
      const double phase = 2 * kPi * static_cast<double>(Next(random) >> 11) * 0x1p-53;
      const double amplitude = std::sqrt(0.5 * density * dk * dk);
      tile.amplitude_re[Bin(i, j, n)] = amplitude * std::cos(phase);
      tile.amplitude_im[Bin(i, j, n)] = amplitude * std::sin(phase);
    }
  }
  tile.planes.assign(8, std::vector<float>(static_cast<std::size_t>(n * n)));
  tiles_.push_back(std::move(tile));
}

void TestSea::Synthesise(Tile& tile, double time_s) {
  const int n = grid_size_;
  const double c = std::cos(tile.rotation_rad), s = std::sin(tile.rotation_rad);
  const Complex imaginary(0, 1);
  std::vector<Complex> grid(static_cast<std::size_t>(n * n));
  for (std::size_t plane = 0; plane < 8; plane += 2) {
    std::fill(grid.begin(), grid.end(), Complex(0));
    for (int j = -kIndexMax; j <= kIndexMax; ++j) {
      for (int i = -kIndexMax; i <= kIndexMax; ++i) {
        if (i == 0 && j == 0) continue;
        const std::size_t at = Bin(i, j, n), opposite = Bin(-i, -j, n);
        const double lx = 2 * kPi / tile.length_m * i, ly = 2 * kPi / tile.length_m * j;
        const double kx = c * lx - s * ly, ky = s * lx + c * ly, k = std::hypot(kx, ky);
        const Complex turn = std::polar(1.0, -std::sqrt(kGravity * k) * time_s);
        const Complex h = Complex(tile.amplitude_re[at], tile.amplitude_im[at]) * turn +
                          Complex(tile.amplitude_re[opposite], -tile.amplitude_im[opposite]) / turn;
        const Complex fields[8] = {h,
                                   imaginary * (kx / k) * h,
                                   imaginary * (ky / k) * h,
                                   imaginary * kx * h,
                                   imaginary * ky * h,
                                   -(kx * kx / k) * h,
                                   -(ky * ky / k) * h,
                                   -(kx * ky / k) * h};
        grid[at] += fields[plane] + imaginary * fields[plane + 1];
      }
    }
    for (int row = 0; row < n; ++row) Transform(&grid[static_cast<std::size_t>(row * n)], n, 1);
    for (int column = 0; column < n; ++column) {
      Transform(&grid[static_cast<std::size_t>(column)], n, n);
    }
    for (std::size_t m = 0; m < grid.size(); ++m) {
      tile.planes[plane][m] = static_cast<float>(grid[m].real());
      tile.planes[plane + 1][m] = static_cast<float>(grid[m].imag());
    }
  }
}

void TestSea::FillFrame(double time_s, RenderFrame& frame) {
  frame.cascades.clear();
  for (Tile& tile : tiles_) {
    Synthesise(tile, time_s);
    const auto& p = tile.planes;
    frame.cascades.push_back(
        {grid_size_, tile.length_m, tile.rotation_rad, p[0], p[1], p[2], p[3], p[4], p[5], p[6]});
  }
  frame.time_s = time_s;
  frame.unresolved_mss = unresolved_mss_;
}

double TestSea::HeightAt(Vec2d place) const {
  Vec2d from = place;
  double height = 0.0;
  for (int step = 0; step < 6; ++step) {  // until the displaced point lies above the place
    Vec2d moved;
    height = 0.0;
    for (const Tile& tile : tiles_) {
      const double c = std::cos(tile.rotation_rad), s = std::sin(tile.rotation_rad);
      const double scale = grid_size_ / tile.length_m;
      const double u = (c * from.x + s * from.y) * scale, v = (c * from.y - s * from.x) * scale;
      const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
      const auto at = [&](std::size_t plane) {
        const auto texel = [&](int di, int dj) {
          const std::size_t n = Bin((i + di) % grid_size_, (j + dj) % grid_size_, grid_size_);
          return static_cast<double>(tile.planes[plane][n]);
        };
        const double a = u - i, b = v - j;
        return (1 - b) * ((1 - a) * texel(0, 0) + a * texel(1, 0)) +
               b * ((1 - a) * texel(0, 1) + a * texel(1, 1));
      };
      height += at(0);
      moved = moved + Vec2d{at(1), at(2)};
    }
    from = place - moved;
  }
  return height;
}

}  // namespace onesea::render
