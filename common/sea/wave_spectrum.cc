#include "common/sea/wave_spectrum.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include "common/sea/spectrum_buoy.h"
#include "common/sea/spectrum_elfouhaily.h"
#include "common/sea/spectrum_grid.h"
#include "common/sea/spectrum_jonswap.h"
#include "common/sea/spectrum_phillips.h"
#include "common/sea/spectrum_pierson_moskowitz.h"

namespace onesea::sea {
namespace {

// A double's top bits are its exponent and the start of its mantissa: as an integer they count
// wavenumbers, 2^8 to the octave, evenly spaced within each.
constexpr int kNodeShift = 52 - 8;
constexpr std::uint64_t kFractionMask = (std::uint64_t{1} << kNodeShift) - 1;

std::int64_t NodeIndex(double k) {
  return static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(k) >> kNodeShift);
}

double NodeWavenumber(std::int64_t index) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(index) << kNodeShift);
}

double Power(double x, int n) {
  double result = 1.0;
  for (int m = 0; m < n; ++m) result *= x;
  return result;
}

struct Maker {
  double depth_m;

  std::unique_ptr<const WaveSpectrum> operator()(const PhillipsSystem& s) const {
    return MakePhillipsSpectrum(s);
  }
  std::unique_ptr<const WaveSpectrum> operator()(const PiersonMoskowitzSystem& s) const {
    return MakePiersonMoskowitzSpectrum(s, depth_m);
  }
  std::unique_ptr<const WaveSpectrum> operator()(const JonswapSystem& s) const {
    return MakeJonswapSpectrum(s, depth_m);
  }
  std::unique_ptr<const WaveSpectrum> operator()(const FetchJonswapSystem& s) const {
    return MakeFetchJonswapSpectrum(s, depth_m);
  }
  std::unique_ptr<const WaveSpectrum> operator()(const ElfouhailySystem& s) const {
    return MakeElfouhailySpectrum(s);
  }
  std::unique_ptr<const WaveSpectrum> operator()(const BuoySpectrum& s) const {
    return MakeBuoySpectrum(s, depth_m);
  }
  std::unique_ptr<const WaveSpectrum> operator()(const GridSpectrum& s) const {
    return MakeGridSpectrum(s, depth_m);
  }
};

}  // namespace

std::unique_ptr<const WaveSpectrum> MakeWaveSpectrum(const WaveSystem& system, double depth_m) {
  return std::visit(Maker{depth_m}, system);
}

double RadialMoment(const WaveSpectrum& spectrum, double k_low, double k_high, int power) {
  // Nodes of the same kind as the table's, every second of them: 128 to the octave.
  double sum = 0.0;
  double k = k_low;
  double value = Power(k, power) * spectrum.Omnidirectional(k);
  std::int64_t index = NodeIndex(k_low) | 1;
  while (k < k_high) {
    index += 2;
    double next = NodeWavenumber(index);
    if (next > k_high) next = k_high;
    const double next_value = Power(next, power) * spectrum.Omnidirectional(next);
    sum += 0.5 * (value + next_value) * (next - k);
    k = next;
    value = next_value;
  }
  return sum;
}

SpectrumTable::SpectrumTable(const WaveSpectrum& spectrum, double k_low, double k_high)
    : spectrum_(spectrum), first_(NodeIndex(k_low)) {
  const std::int64_t last = NodeIndex(k_high) + 1;
  nodes_.reserve(static_cast<std::size_t>(last - first_ + 1));
  for (std::int64_t index = first_; index <= last; ++index) {
    nodes_.push_back(spectrum.NodeAt(NodeWavenumber(index)));
  }
}

double SpectrumTable::Density(Vec2d wave_vector, double k) const {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(k);
  const auto index =
      static_cast<std::size_t>(static_cast<std::int64_t>(bits >> kNodeShift) - first_);
  const WaveSpectrum::Node& low = nodes_[index];
  const WaveSpectrum::Node& high = nodes_[index + 1];
  const double u = static_cast<double>(bits & kFractionMask) / 0x1p44;
  const auto mix = [u](double x, double y) { return x + u * (y - x); };
  const double radial = mix(low.radial, high.radial);
  if (!(radial > 0.0)) return 0.0;
  const double inverse = 1.0 / k;
  const WaveSpectrum::Node node{radial, mix(low.a, high.a), mix(low.b, high.b), mix(low.c, high.c)};
  return radial * spectrum_.Shape(node, inverse * wave_vector);
}

}  // namespace onesea::sea
