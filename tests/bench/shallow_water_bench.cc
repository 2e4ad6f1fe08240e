// Shallow water: one step on one core, beside the loops that the literature prints: line by line,
// scalar, one tridiagonal system after the other (the Thomas algorithm), in the same run.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "common/base/hash.h"
#include "common/sea/constants.h"
#include "server/world/shallow_water.h"
#include "tests/bench/thread_seconds.h"

namespace onesea::world {
namespace {

// Kass and Miller's own solver: h and its last value, θ = 1, x then y. Errata: (dt)² multiplies
// both brackets, and the extrapolation 2h - h_last is done once, before the two directions.
class ScalarKassMiller {
 public:
  ScalarKassMiller(int side, float depth_m, float step_s)
      : side_(side), factor_(static_cast<float>(sea::kGravity) * step_s * step_s) {
    const std::size_t cells = static_cast<std::size_t>(side) * side;
    bottom_.assign(cells, -depth_m);
    h_.assign(cells, 0.0f);
    last_ = h_;
    gain_.resize(side);
    offset_.resize(side);
  }
  void Disturb(std::size_t cell) { h_[cell] += 0.01f; }
  void Step() {
    for (std::size_t n = 0; n < h_.size(); ++n) {
      const float next = 2.0f * h_[n] - last_[n];
      last_[n] = h_[n];
      h_[n] = next;
    }
    for (int j = 0; j < side_; ++j) Line(static_cast<std::size_t>(j) * side_, 1);
    for (int i = 0; i < side_; ++i) Line(i, side_);
  }
  float sum() const { return h_[h_.size() / 2]; }

 private:
  float Depth(std::size_t n) const { return std::max(0.0f, last_[n] - bottom_[n]); }
  void Line(std::size_t start, std::size_t stride) {
    float before = 0.0f, gain = 0.0f, offset = 0.0f;
    for (int i = 0; i < side_; ++i) {
      const std::size_t n = start + i * stride;
      const float after = i + 1 < side_ ? factor_ * 0.5f * (Depth(n) + Depth(n + stride)) : 0.0f;
      const float inverse = 1.0f / (1.0f + before + after - before * gain);
      gain_[i] = gain = after * inverse;
      offset_[i] = offset = (h_[n] + before * offset) * inverse;
      before = after;
    }
    float next = 0.0f;
    for (int i = side_ - 1; i >= 0; --i) {
      next = offset_[i] + gain_[i] * next;
      h_[start + i * stride] = next;
    }
  }

  int side_;
  float factor_;
  std::vector<float> bottom_, h_, last_, gain_, offset_;
};

// The product's scheme as a scalar program: (η, u) and (η, v) with the theta scheme, fluxes, and
// the check that no cell gives more than it has.
class ScalarSweeps {
 public:
  ScalarSweeps(int side, float depth_m, float step_s) : side_(side), step_(step_s) {
    const std::size_t cells = static_cast<std::size_t>(side) * side;
    bottom_.assign(cells, -depth_m);
    level_.assign(cells, 0.0f);
    u_ = v_ = height_ = level_;
    gain_.resize(side);
    offset_ = depth_ = moved_ = share_ = gain_;
    flux_.resize(side + 1);
  }
  void Disturb(std::size_t cell) { level_[cell] += 0.01f; }
  void Step() {
    for (int j = 0; j < side_; ++j) Line(static_cast<std::size_t>(j) * side_, 1, u_);
    for (int i = 0; i < side_; ++i) Line(i, side_, v_);
    for (std::size_t n = 0; n < level_.size(); ++n) {
      height_[n] = level_[n] - bottom_[n] > 1e-3f ? level_[n] : 0.0f;
    }
  }
  float sum() const { return height_[height_.size() / 2]; }

 private:
  void Line(std::size_t start, std::size_t stride, std::vector<float>& velocity) {
    const float theta = static_cast<float>(kShallowTheta), g = static_cast<float>(sea::kGravity);
    float before = 0.0f, gain = 0.0f, offset = 0.0f, inflow = 0.0f;
    for (int i = 0; i < side_; ++i) {
      const std::size_t n = start + i * stride, m = n + stride;
      float outflow = 0.0f, after = 0.0f;
      if (i + 1 < side_) {
        const float bed = std::max(bottom_[n], bottom_[m]);
        const float low = std::max(level_[n], bed), high = std::max(level_[m], bed);
        const float weir = std::max(low, high) - bed;
        const float upstream = velocity[n] > 0.0f ? level_[n] : level_[m];
        const float mean_bed = 0.5f * (bottom_[n] + bottom_[m]);
        depth_[i] = weir > 1e-6f ? std::min(upstream - mean_bed, 2.0f * weir) : 0.0f;
        const float push = g * step_ * (high - low);
        outflow = depth_[i] * (velocity[n] - theta * push);
        after = theta * theta * g * step_ * step_ * depth_[i];
        moved_[i] = velocity[n] - push;
      }
      const float inverse = 1.0f / (1.0f + before + after - before * gain);
      gain_[i] = gain = after * inverse;
      offset_[i] = offset = (step_ * (inflow - outflow) + before * offset) * inverse;
      before = after;
      inflow = outflow;
    }
    float rise = offset_[side_ - 1];
    flux_[0] = flux_[side_] = 0.0f;
    for (int i = side_ - 2; i >= 0; --i) {
      const std::size_t n = start + i * stride;
      const float next = rise;
      rise = offset_[i] + gain_[i] * next;
      const float fresh = depth_[i] > 0.0f ? moved_[i] - theta * g * step_ * (next - rise) : 0.0f;
      flux_[i + 1] = depth_[i] * (theta * fresh + (1.0f - theta) * velocity[n]);
      velocity[n] = fresh;
    }
    for (int i = 0; i < side_; ++i) {
      const std::size_t n = start + i * stride;
      const float out = step_ * (std::max(flux_[i + 1], 0.0f) - std::min(flux_[i], 0.0f));
      const float water = level_[n] - bottom_[n];
      share_[i] = out > water ? water / out : 1.0f;
    }
    for (int i = 1; i < side_; ++i) flux_[i] *= flux_[i] > 0.0f ? share_[i - 1] : share_[i];
    for (int i = 0; i < side_; ++i) {
      const std::size_t n = start + i * stride;
      level_[n] = std::max(bottom_[n], level_[n] + step_ * (flux_[i] - flux_[i + 1]));
    }
  }

  int side_;
  float step_;
  std::vector<float> bottom_, level_, u_, v_, height_, gain_, offset_, depth_, moved_, share_,
      flux_;
};

void Compare(int side) {
  SolverSpec spec;
  spec.kind = SolverKind::kShallowWater;
  spec.cells = {.columns = side, .rows = side, .cell_m = 1.0};
  spec.depth_m = 5.0;
  const auto solver = *MakeShallowWater(spec);
  const std::size_t cells = spec.cells.cells();
  std::vector<float> source(cells), head(cells), solid(cells), x(cells), y(cells), z(cells);
  for (std::size_t n = 0; n < cells; n += 997) source[n] = 0.01f;
  for (std::size_t n = 0; n < cells; n += 613) head[n] = 0.01f;
  for (std::size_t n = 0; n < cells; n += 419) solid[n] = 0.5f;
  solver->Step({.source_m = source});
  ScalarKassMiller published(side, 5.0f, 1.0f / 60.0f);
  ScalarSweeps scalar(side, 5.0f, 1.0f / 60.0f);
  for (std::size_t n = 0; n < cells; n += 997) published.Disturb(n);
  for (std::size_t n = 0; n < cells; n += 997) scalar.Disturb(n);

  const double own_s = MedianThreadSeconds([&] { solver->Step({}); });
  const double forced_s =
      MedianThreadSeconds([&] { solver->Step({.pressure_head_m = head, .solid = solid}); });
  const double velocity_s = MedianThreadSeconds([&] { solver->Velocity(x, y, z); });
  const double published_s = MedianThreadSeconds([&] { published.Step(); });
  const double scalar_s = MedianThreadSeconds([&] { scalar.Step(); });
  Hash64 hash;
  for (const float h : solver->height_m()) hash.Add(h);
  std::printf("%d x %d cells: step %.0f us, with pressure and solids %.0f us, velocity %.0f us\n",
              side, side, own_s * 1e6, forced_s * 1e6, velocity_s * 1e6);
  std::printf(
      "  scalar Kass-Miller (h alone) %.0f us: %.1f x; the same scheme, scalar %.0f us: "
      "%.1f x   [%g %g %016llx]\n",
      published_s * 1e6, published_s / own_s, scalar_s * 1e6, scalar_s / own_s,
      static_cast<double>(published.sum()), static_cast<double>(scalar.sum()),
      static_cast<unsigned long long>(hash.value()));
}

}  // namespace
}  // namespace onesea::world

int main() {
  for (const int side : {128, 256, 512}) onesea::world::Compare(side);
}
