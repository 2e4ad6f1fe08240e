#include "common/wire/tile_kernel.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "common/base/check.h"

namespace onesea::wire {
namespace {

// Wide enough for every vector; a reduction over lanes needs no reordering by the compiler.
constexpr int kLanes = 16;

template <typename Held>
float LargestDifferenceOf(const TileFloats& values, const Held& held) {
  float largest[kLanes] = {};
  for (int n = 0; n < kTileCells; n += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const float difference = std::fabs(values[n + lane] - static_cast<float>(held[n + lane]));
      largest[lane] = difference > largest[lane] ? difference : largest[lane];
    }
  }
  return *std::max_element(largest, largest + kLanes);
}

// Adding 1.5 * 2^23 leaves the nearest whole number in the low bits of the sum.
std::int32_t NearestWhole(float value) {
  constexpr float kShift = 12582912.0F;
  return std::bit_cast<std::int32_t>(value + kShift) - std::bit_cast<std::int32_t>(kShift);
}

template <typename Levels>
void QuantiseTo(const TileFloats& values, float low, float high, Levels& out) {
  for (int n = 0; n < kTileCells; ++n) {
    const float value = values[n];
    const float limited = value > low ? (value < high ? value : high) : low;
    out[n] = static_cast<typename Levels::value_type>(NearestWhole(limited));
  }
}

std::uint16_t ZigZag16(std::uint16_t difference) {
  return static_cast<std::uint16_t>((difference << 1) ^ -(difference >> 15));
}
std::uint16_t UnZigZag16(std::uint16_t residual) {
  return static_cast<std::uint16_t>((residual >> 1) ^ -(residual & 1));
}
std::uint16_t Residual(int value, int predicted) {
  return ZigZag16(static_cast<std::uint16_t>(value - predicted));
}

std::int16_t Wrap(int value) { return static_cast<std::int16_t>(value); }

void Laplacian(const TileSteps& steps, TileSteps& out) {
  for (int row = 0; row < kTileSide; ++row) {
    const std::int16_t* here = steps.data() + row * kTileSide;
    const std::int16_t* south = row > 0 ? here - kTileSide : here;
    const std::int16_t* north = row < kTileSide - 1 ? here + kTileSide : here;
    std::int16_t* to = out.data() + row * kTileSide;
    for (int n = 1; n < kTileSide - 1; ++n) {
      to[n] = Wrap(here[n - 1] + here[n + 1] + south[n] + north[n] - 4 * here[n]);
    }
    constexpr int kLast = kTileSide - 1;
    to[0] = Wrap(here[1] + south[0] + north[0] - 3 * here[0]);
    to[kLast] = Wrap(here[kLast - 1] + south[kLast] + north[kLast] - 3 * here[kLast]);
  }
}

// Of the cells before n, in row-major order.
int PredictedBeside(const TileSteps& steps, int n) {
  const bool south = n >= kTileSide, west = n % kTileSide != 0;
  return (west ? steps[n - 1] : 0) + (south ? steps[n - kTileSide] : 0) -
         (west && south ? steps[n - kTileSide - 1] : 0);
}

int PredictedWave(const Tile& tile, const WaveTerms& terms, WaveFit fit, int n) {
  const int sum =
      fit.a * terms.change[n] + fit.b * terms.laplacian[n] + fit.c * terms.laplacian_before[n];
  return tile.height[n] + ((sum + 32) >> 6);
}

// 64ths; anything that is no number becomes 0.
std::int8_t Sixtyfourths(double value) {
  const double scaled = 64.0 * value;
  if (!(scaled > -127.0)) return scaled <= -127.0 ? -127 : 0;
  return static_cast<std::int8_t>(scaled < 127.0 ? std::lround(scaled) : 127);
}

// The normal equations of three unknowns, by Gauss and Jordan; the sums of squares are never 0.
std::array<double, 3> Solve(std::array<std::array<double, 4>, 3> rows) {
  for (int pivot = 0; pivot < 3; ++pivot) {
    for (int row = 0; row < 3; ++row) {
      if (row == pivot) continue;
      const double factor = rows[row][pivot] / rows[pivot][pivot];
      for (int column = 0; column < 4; ++column) {
        rows[row][column] -= factor * rows[pivot][column];
      }
    }
  }
  return {rows[0][3] / rows[0][0], rows[1][3] / rows[1][1], rows[2][3] / rows[2][2]};
}

}  // namespace

void Gather(const sea::CellRect& field, std::span<const float> values, const sea::CellRect& tile,
            float scale, TileFloats& out) {
  const sea::CellRect common = sea::Intersection(field, tile);
  if (common.cells() < kTileCells) out.fill(0.0F);
  for (int row = 0; row < common.rows; ++row) {
    const std::int64_t j = common.south + row;
    const float* from =
        values.data() + (j - field.south) * field.columns + common.west - field.west;
    float* to = out.data() + (j - tile.south) * kTileSide + common.west - tile.west;
    for (int column = 0; column < common.columns; ++column) to[column] = from[column] * scale;
  }
}

float LargestDifference(const TileFloats& values, const TileSteps& held) {
  return LargestDifferenceOf(values, held);
}
float LargestDifference(const TileFloats& values, const TileBytes& held) {
  return LargestDifferenceOf(values, held);
}

void Quantise(const TileFloats& values, TileSteps& out) {
  QuantiseTo(values, -32767.0F, 32767.0F, out);
}
void Quantise(const TileFloats& values, TileBytes& out) { QuantiseTo(values, 0.0F, 255.0F, out); }

WaveTerms::WaveTerms(const Tile& tile) {
  for (int n = 0; n < kTileCells; ++n) change[n] = Wrap(tile.height[n] - tile.before[n]);
  Laplacian(tile.height, laplacian);
  Laplacian(tile.before, laplacian_before);
}

WaveFit FitWave(const Tile& tile, const WaveTerms& terms, const TileSteps& steps) {
  constexpr int kSums = 9;
  constexpr int kFitLanes = 4;  // more would not fit the registers of the smallest machine
  float sums[kSums][kFitLanes] = {};
  for (int at = 0; at < kTileCells / 2; at += kFitLanes) {
    const int n = at + at / kTileSide * kTileSide;
    for (int lane = 0; lane < kFitLanes; ++lane) {
      const auto u = static_cast<float>(terms.change[n + lane]);
      const auto v = static_cast<float>(terms.laplacian[n + lane]);
      const auto w = static_cast<float>(terms.laplacian_before[n + lane]);
      const auto d = static_cast<float>(steps[n + lane] - tile.height[n + lane]);
      sums[0][lane] += u * u;
      sums[1][lane] += u * v;
      sums[2][lane] += u * w;
      sums[3][lane] += v * v;
      sums[4][lane] += v * w;
      sums[5][lane] += w * w;
      sums[6][lane] += u * d;
      sums[7][lane] += v * d;
      sums[8][lane] += w * d;
    }
  }
  double total[kSums] = {};
  for (int sum = 0; sum < kSums; ++sum) {
    for (const float lane : sums[sum]) total[sum] += static_cast<double>(lane);
  }
  // The ones keep flat tiles solvable.
  const std::array<double, 3> fit = Solve({{{total[0] + 1.0, total[1], total[2], total[6]},
                                            {total[1], total[3] + 1.0, total[4], total[7]},
                                            {total[2], total[4], total[5] + 1.0, total[8]}}});
  return {Sixtyfourths(fit[0]), Sixtyfourths(fit[1]), Sixtyfourths(fit[2])};
}

void PredictHold(const Tile& tile, const TileSteps& steps, TileResiduals& out) {
  for (int n = 0; n < kTileCells; ++n) out[n] = Residual(steps[n], tile.height[n]);
}

void PredictFitted(const Tile& tile, const WaveTerms& terms, WaveFit fit, const TileSteps& steps,
                   TileResiduals& out) {
  for (int n = 0; n < kTileCells; ++n) {
    out[n] = Residual(steps[n], PredictedWave(tile, terms, fit, n));
  }
}

void PredictSpatial(const TileSteps& steps, TileResiduals& out) {
  for (int n = 0; n < kTileCells; ++n) out[n] = Residual(steps[n], PredictedBeside(steps, n));
}

std::uint32_t Cost(const TileResiduals& residuals) {
  std::uint32_t sum = 0;
  for (const std::uint16_t residual : residuals) sum += residual;
  return sum;
}

void Undo(Prediction prediction, WaveFit fit, const Tile& tile, const TileResiduals& residuals,
          TileSteps& steps) {
  const auto set = [&](int n, int predicted) {
    steps[n] =
        static_cast<std::int16_t>(static_cast<std::uint16_t>(predicted + UnZigZag16(residuals[n])));
  };
  switch (prediction) {
    case Prediction::kHold:
      for (int n = 0; n < kTileCells; ++n) set(n, tile.height[n]);
      return;
    case Prediction::kFitted: {
      ONESEA_CHECK(tile.heights_known == 2);
      const WaveTerms terms(tile);
      for (int n = 0; n < kTileCells; ++n) set(n, PredictedWave(tile, terms, fit, n));
      return;
    }
    case Prediction::kSpatial:
      for (int n = 0; n < kTileCells; ++n) set(n, PredictedBeside(steps, n));
      return;
  }
}

void FoamResiduals(const TileBytes& held, const TileBytes& levels, std::uint8_t* out) {
  for (int n = 0; n < kTileCells; ++n) {
    const auto difference = static_cast<std::uint8_t>(levels[n] - held[n]);
    out[n] = static_cast<std::uint8_t>((difference << 1) ^ -(difference >> 7));
  }
}

void UndoFoam(const std::uint8_t* residuals, TileBytes& held) {
  for (int n = 0; n < kTileCells; ++n) {
    const auto difference = static_cast<std::uint8_t>((residuals[n] >> 1) ^ -(residuals[n] & 1));
    held[n] = static_cast<std::uint8_t>(held[n] + difference);
  }
}

}  // namespace onesea::wire
