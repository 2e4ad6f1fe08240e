// Whitecaps of the spectral sea in a window that drifts with the water's skin.
//
// Problem: foam has a memory, yet every process must see the same foam, whenever it joined.
// Idea: the memory is finite. A cell keeps its growth at each of the last 48 lattice instants and
// its
//   foam is their weighted sum in integers, so it is a function of the recipe, the cell and the
// instant
//   alone: two windows agree to the bit. Growth is where the determinant of the total Jacobian
// (summed
//   over cascades first) at the undisplaced cell falls below a threshold.
// Limits: cascades with waves shorter than two cells are left out; what moves into the window is
//   synthesised again for 48 instants (some 15 ms), hence the slack before it moves.

#include "common/sea/foam.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "common/base/check.h"
#include "common/base/real_math.h"
#include "common/sea/constants.h"
#include "common/sea/foam_kernel.h"
#include "common/sea/surface.h"

namespace onesea::sea {

namespace {

constexpr std::int64_t kFlicksPerInstant = kFlicksPerSecond / kFoamRateHz;
constexpr int kInstants = static_cast<int>(kFoamMemoryS * kFoamRateHz);

// Calibrated with the default cascades and choppiness 1 so that the mean of the window over
// developed seas follows the whitecap cover 2.95e-6 U10^3.52 of Monahan & O'Muircheartaigh 1980
// (tests/sea/foam_test.cc).
constexpr float kGrowthThreshold = 0.68f;
constexpr float kGrowthGain = 80.0f;

// Deep-water caps fade with an e-folding time of 3.5-4 s (Monahan & Zietlow 1969).
constexpr double kDecayS = 4.0;

// The skin drifts with the current and with this share of the wind.
constexpr double kWindDrift = 0.03;

// e^{-age/4 s} lowered to reach 0 at the end of the memory, so that nothing is cut off.
std::array<std::uint32_t, kInstants> DecayWeights() {
  std::array<std::uint32_t, kInstants> weights;
  const double last = real::Exp(-kFoamMemoryS / kDecayS);
  for (int age = 0; age < kInstants; ++age) {
    const double decay = real::Exp(-age / (kDecayS * kFoamRateHz));
    weights[age] = static_cast<std::uint32_t>(std::lround(65536.0 * (decay - last) / (1.0 - last)));
  }
  return weights;
}

std::int64_t FloorDiv(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

// Where the drifting frame's origin lies at `time`. The drift is constant within a weather entry,
// so the path is a sum.
Vec2d DriftAt(const Recipe& recipe, SimTime time) {
  Vec2d at;
  for (std::size_t n = 0; n < recipe.timeline.size(); ++n) {
    const SeaState& sea = recipe.timeline[n].sea;
    const real::SinCosPair wind = real::SinCos(sea.wind_to_rad);
    const double drift_m_per_s = kWindDrift * sea.wind_speed_m_per_s;
    const Vec2d velocity = recipe.current_m_per_s + drift_m_per_s * Vec2d{wind.cos, wind.sin};
    const SimTime start =
        n == 0 ? SimTime{} : TimeOfTick(recipe.timeline[n].start_tick, recipe.tick_rate_hz);
    SimTime end = time;
    if (n + 1 < recipe.timeline.size()) {
      end = std::min(end, TimeOfTick(recipe.timeline[n + 1].start_tick, recipe.tick_rate_hz));
    }
    if (n == 0 || end > start) at = at + (end - start).Seconds() * velocity;
  }
  return at;
}

}  // namespace

struct FoamWindow::Impl {
  struct Region {  // cells [i_from, i_to) x [j_from, j_to)
    std::int64_t i_from, i_to, j_from, j_to;
  };

  std::shared_ptr<const Components> components;
  FoamWindowOptions options;
  std::vector<Synthesiser> synthesisers;
  std::vector<CascadeFields> fields;
  std::vector<FoamGrid> grids;
  std::vector<std::uint8_t> growth;  // (kInstants x n x n), instant mod kInstants first
  std::vector<std::uint8_t> cells;   // (n x n)
  std::vector<std::uint8_t> row;     // scratch
  bool begun = false;
  std::int64_t instant = 0;
  std::int64_t i0 = 0, j0 = 0;  // the window's lower left cell

  std::int64_t Side() const { return options.cells; }
  Vec2d OriginAt(std::int64_t at) const {
    return DriftAt(components->recipe, SimTime{at * kFlicksPerInstant});
  }
  void Synthesise(std::int64_t at);
  void Grow(std::int64_t at, const Region& region);
  void Roll(std::int64_t from, std::int64_t to, std::span<const Region> regions);
  void Sum();
};

void FoamWindow::Impl::Synthesise(std::int64_t at) {
  for (std::size_t c = 0; c < synthesisers.size(); ++c) {
    synthesisers[c].Evaluate(SimTime{at * kFlicksPerInstant}, fields[c]);
    grids[c].Fill(fields[c]);
  }
}

// Growth of a region at the instant that was synthesised last.
void FoamWindow::Impl::Grow(std::int64_t at, const Region& region) {
  const std::int64_t n = Side(), mask = n - 1;
  const auto slot = static_cast<std::size_t>(at - FloorDiv(at, kInstants) * kInstants);
  std::uint8_t* plane = growth.data() + slot * static_cast<std::size_t>(n * n);
  const auto count = static_cast<std::size_t>(region.i_to - region.i_from);
  FoamRow run{OriginAt(at), options.cell_m, region.i_from, 0};
  for (std::int64_t j = region.j_from; j < region.j_to; ++j) {
    run.j = j;
    FoamGrowth(grids, run, kGrowthThreshold, kGrowthGain, std::span(row).first(count));
    std::uint8_t* to = plane + (j & mask) * n;
    // The run wraps round the storage at most once.
    const std::int64_t first = region.i_from & mask;
    const std::int64_t before_wrap =
        std::min<std::int64_t>(n - first, static_cast<std::int64_t>(count));
    std::copy_n(row.data(), before_wrap, to + first);
    std::copy(row.data() + before_wrap, row.data() + count, to);
  }
}

void FoamWindow::Impl::Roll(std::int64_t from, std::int64_t to, std::span<const Region> regions) {
  for (std::int64_t at = from; at <= to; ++at) {
    Synthesise(at);
    for (const Region& region : regions) Grow(at, region);
  }
}

void FoamWindow::Impl::Sum() {
  static const std::array<std::uint32_t, kInstants> kWeights = DecayWeights();
  constexpr std::size_t kChunk = 1024;
  const std::size_t total = cells.size();
  std::array<std::uint32_t, kChunk> sum;
  for (std::size_t start = 0; start < total; start += kChunk) {
    sum.fill(32768);
    for (int age = 0; age < kInstants; ++age) {
      const std::int64_t at = instant - age;
      const auto slot = static_cast<std::size_t>(at - FloorDiv(at, kInstants) * kInstants);
      const std::uint8_t* from = growth.data() + slot * total + start;
      const std::uint32_t weight = kWeights[age];
      for (std::size_t n = 0; n < kChunk; ++n) sum[n] += weight * from[n];
    }
    for (std::size_t n = 0; n < kChunk; ++n) {
      cells[start + n] = static_cast<std::uint8_t>(std::min<std::uint32_t>(255, sum[n] >> 16));
    }
  }
}

FoamWindow::FoamWindow(std::shared_ptr<const Components> components, FoamWindowOptions options)
    : impl_(std::make_unique<Impl>()) {
  ONESEA_CHECK(components != nullptr);
  ONESEA_CHECK(options.cells >= 64 && options.cells <= 2048 &&
               std::has_single_bit(static_cast<unsigned>(options.cells)))
      << "cells " << options.cells;
  ONESEA_CHECK(options.cell_m >= 0.01 && options.cell_m <= 100.0) << "cell_m " << options.cell_m;
  Impl& impl = *impl_;
  impl.components = std::move(components);
  impl.options = options;
  const double k_max_rad_per_m = kPi / options.cell_m;
  for (std::size_t c = 0; c < impl.components->cascades.size(); ++c) {
    const Cascade& cascade = impl.components->cascades[c].cascade;
    if (cascade.wavenumber_max_rad_per_m > k_max_rad_per_m) continue;
    impl.synthesisers.emplace_back(impl.components, static_cast<int>(c), cascade.query_grid_size,
                                   kFoamFields);
    impl.fields.emplace_back(cascade.query_grid_size, kFoamFields);
    impl.grids.emplace_back(cascade);
  }
  const auto side = static_cast<std::size_t>(options.cells);
  impl.growth.resize(kInstants * side * side);
  impl.cells.resize(side * side);
  impl.row.resize(side);
}

FoamWindow::~FoamWindow() = default;

void FoamWindow::MoveTo(SimTime time, Vec2d centre) {
  ONESEA_CHECK(std::abs(centre.x) <= 1e9 && std::abs(centre.y) <= 1e9)
      << "centre (" << centre.x << ", " << centre.y << ")";
  Impl& impl = *impl_;
  const std::int64_t instant = FloorDiv(time.flicks, kFlicksPerInstant);
  const Vec2d origin = impl.OriginAt(instant);
  const std::int64_t n = impl.Side();
  const auto corner = [&](double centre_m, double origin_m) {
    return static_cast<std::int64_t>(std::floor((centre_m - origin_m) / impl.options.cell_m)) -
           n / 2;
  };
  std::int64_t i0 = corner(centre.x, origin.x), j0 = corner(centre.y, origin.y);
  const bool near =
      std::abs(i0 - impl.i0) <= kFoamSlackCells && std::abs(j0 - impl.j0) <= kFoamSlackCells;
  if (impl.begun && near) i0 = impl.i0, j0 = impl.j0;
  const std::int64_t di = i0 - impl.i0, dj = j0 - impl.j0;
  const bool moved = di != 0 || dj != 0;
  if (impl.begun && instant == impl.instant && !moved) return;

  const Impl::Region all = {i0, i0 + n, j0, j0 + n};
  const std::int64_t oldest = instant - kInstants + 1;
  const bool afresh = !impl.begun || instant < impl.instant || oldest > impl.instant ||
                      std::abs(di) >= n || std::abs(dj) >= n;
  if (afresh) {
    impl.Roll(oldest, instant, {&all, 1});
  } else {
    if (moved) {
      // What the window uncovers: a band of columns over its full height and a band of rows beside
      // it.
      const Impl::Region columns = {di > 0 ? i0 + n - di : i0, di > 0 ? i0 + n : i0 - di, j0,
                                    j0 + n};
      const Impl::Region rows = {std::max(i0, impl.i0), std::min(i0, impl.i0) + n,
                                 dj > 0 ? j0 + n - dj : j0, dj > 0 ? j0 + n : j0 - dj};
      const Impl::Region bands[2] = {columns, rows};
      impl.Roll(oldest, impl.instant, bands);
    }
    impl.Roll(impl.instant + 1, instant, {&all, 1});
  }
  impl.begun = true;
  impl.instant = instant;
  impl.i0 = i0;
  impl.j0 = j0;
  impl.Sum();
}

std::span<const std::uint8_t> FoamWindow::Cells() const { return impl_->cells; }

Vec2d FoamWindow::OriginM() const { return impl_->OriginAt(impl_->instant); }

}  // namespace onesea::sea
