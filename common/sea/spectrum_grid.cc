#include "common/sea/spectrum_grid.h"

#include <algorithm>
#include <cmath>

#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "common/sea/dispersion.h"

namespace onesea::sea {
namespace {

constexpr double kTurn = 2.0 * kPi;

class TableSpectrum final : public WaveSpectrum {
 public:
  TableSpectrum(const DirectionTable& table, double depth_m)
      : frequency_hz_(table.frequency_hz),
        density_(table.density_m2_per_hz),
        directional_(table.distribution),
        add_tail_(table.add_tail),
        depth_m_(depth_m) {
    for (std::size_t n = 0; n < directional_.size(); ++n) {
      directional_[n] *= density_[n / kTableDirections];
    }
  }

  // radial = df/dk / k and the tail's factor; a = row, with its fraction.
  Node NodeAt(double k) const override {
    const double f = IntrinsicFrequency(k, depth_m_) / kTurn;
    return {RadialFactor(f) * GroupVelocity(k, depth_m_) / (kTurn * k), RowOf(f), 0.0, 0.0};
  }

  double Shape(const Node& node, Vec2d direction) const override {
    const double angle = real::Atan2(direction.y, direction.x);
    const double turns = angle < 0.0 ? angle / kTurn + 1.0 : angle / kTurn;
    const double x = turns * kTableDirections;
    const int column = std::min(static_cast<int>(x), kTableDirections - 1);
    const int next = column + 1 < kTableDirections ? column + 1 : 0;
    const double u = x - column;
    const int row = std::min(static_cast<int>(node.a), static_cast<int>(density_.size()) - 2);
    const double v = node.a - row;
    const double* low = &directional_[static_cast<std::size_t>(row * kTableDirections)];
    const double* high = low + kTableDirections;
    const double below = low[column] + u * (low[next] - low[column]);
    const double above = high[column] + u * (high[next] - high[column]);
    return below + v * (above - below);
  }

  double Omnidirectional(double k) const override {
    const double f = IntrinsicFrequency(k, depth_m_) / kTurn;
    const double a = RowOf(f);
    const auto row = static_cast<std::size_t>(
        std::min(static_cast<int>(a), static_cast<int>(density_.size()) - 2));
    const double v = a - static_cast<double>(row);
    const double density = density_[row] + v * (density_[row + 1] - density_[row]);
    return density * RadialFactor(f) * GroupVelocity(k, depth_m_) / kTurn;
  }

 private:
  double RowOf(double f) const {
    if (!(f > frequency_hz_.front())) return 0.0;
    if (f >= frequency_hz_.back()) return static_cast<double>(frequency_hz_.size() - 1);
    const auto above = std::upper_bound(frequency_hz_.begin(), frequency_hz_.end(), f);
    const double low = *(above - 1);
    return static_cast<double>(above - frequency_hz_.begin() - 1) + (f - low) / (*above - low);
  }

  double RadialFactor(double f) const {
    if (f < frequency_hz_.front()) return 0.0;
    if (f <= frequency_hz_.back()) return 1.0;
    if (!add_tail_) return 0.0;
    const double r = frequency_hz_.back() / f;
    const double r2 = r * r;
    return r2 * r2 * r;
  }

  std::vector<double> frequency_hz_;
  std::vector<double> density_;      // (n) S [m²/Hz]
  std::vector<double> directional_;  // (n x kTableDirections) E [m²/Hz/rad]
  bool add_tail_;
  double depth_m_;
};

// A row given at uneven directions, at any angle; linear around the turn.
class PeriodicRow {
 public:
  PeriodicRow(const GridSpectrum& spectrum, std::size_t row)
      : angle_(spectrum.wave_to_rad),
        value_(&spectrum.density_m2_per_hz_rad[row * spectrum.wave_to_rad.size()]) {}

  double At(double angle) const {
    const double first = angle_.front();
    const double turns = (angle - first) / kTurn;
    const double x = first + (turns - std::floor(turns)) * kTurn;  // in [first, first + 2π]
    const auto above = std::upper_bound(angle_.begin(), angle_.end(), x, [](double a, float b) {
      return a < static_cast<double>(b);
    });
    const auto high = static_cast<std::size_t>(above - angle_.begin());
    const std::size_t low = high - 1;  // x >= first, so high >= 1
    const bool wraps = high == angle_.size();
    const double next_angle = wraps ? first + kTurn : angle_[high];
    const double next_value = wraps ? value_[0] : value_[high];
    const double u = (x - angle_[low]) / (next_angle - angle_[low]);
    return value_[low] + u * (next_value - value_[low]);
  }

  // ∫ over the turn: the trapezoids of the straight lines above.
  double Integral() const {
    double sum = 0.0;
    const std::size_t m = angle_.size();
    for (std::size_t n = 0; n < m; ++n) {
      const bool wraps = n + 1 == m;
      const double next_angle = wraps ? angle_[0] + kTurn : angle_[n + 1];
      const double next_value = wraps ? value_[0] : value_[n + 1];
      sum += 0.5 * (value_[n] + next_value) * (next_angle - angle_[n]);
    }
    return sum;
  }

 private:
  const std::vector<float>& angle_;
  const float* value_;
};

}  // namespace

std::unique_ptr<const WaveSpectrum> MakeTableSpectrum(const DirectionTable& table, double depth_m) {
  return std::make_unique<TableSpectrum>(table, depth_m);
}

double VarianceOf(const DirectionTable& table) {
  double variance = 0.0;
  for (std::size_t n = 1; n < table.frequency_hz.size(); ++n) {
    variance += 0.5 * (table.density_m2_per_hz[n] + table.density_m2_per_hz[n - 1]) *
                (table.frequency_hz[n] - table.frequency_hz[n - 1]);
  }
  return variance;
}

void ScaleToHs(DirectionTable& table, double hs_m) {
  if (!(hs_m > 0.0)) return;
  const double variance = VarianceOf(table);
  if (!(variance > 0.0)) return;
  const double scale = hs_m * hs_m / 16.0 / variance;
  for (double& density : table.density_m2_per_hz) density *= scale;
}

DirectionTable TableOf(const GridSpectrum& spectrum) {
  DirectionTable table;
  table.add_tail = spectrum.add_tail;
  table.frequency_hz.assign(spectrum.frequency_hz.begin(), spectrum.frequency_hz.end());
  for (std::size_t row = 0; row < spectrum.frequency_hz.size(); ++row) {
    const PeriodicRow given(spectrum, row);
    table.density_m2_per_hz.push_back(given.Integral());
    double sum = 0.0;
    for (int n = 0; n < kTableDirections; ++n) {
      const double value = given.At(n * (kTurn / kTableDirections));
      table.distribution.push_back(value);
      sum += value;
    }
    const double scale = sum > 0.0 ? kTableDirections / (kTurn * sum) : 0.0;
    for (auto it = table.distribution.end() - kTableDirections; it != table.distribution.end();
         ++it) {
      *it *= scale;
    }
  }
  ScaleToHs(table, spectrum.hs_m);
  return table;
}

std::unique_ptr<const WaveSpectrum> MakeGridSpectrum(const GridSpectrum& spectrum, double depth_m) {
  return MakeTableSpectrum(TableOf(spectrum), depth_m);
}

}  // namespace onesea::sea
