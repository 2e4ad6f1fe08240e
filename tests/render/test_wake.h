#pragma once

#include <vector>

#include "client/render/hull_models.h"
#include "client/render/render_frame.h"
#include "tests/render/test_sea.h"

namespace onesea::render {

/// The steady wake of a small pressure source, in a square of cells that it has crossed.
///
///   eta(x, y) = amplitude ∫ cos(k (x cos θ + y sin θ)) exp(-k² size² / 2) dθ over |θ| < π/2,
///   k = g / (U cos θ)²: every plane wave that stands still beside the boat (Kelvin 1887).
class TestWake {
 public:
  /// A boat at `place_m` that runs to `heading_rad` at U = `speed_m_per_s`.
  TestWake(Vec2d place_m, double heading_rad, double speed_m_per_s, double size_m,
           double amplitude_m, int cells = 192, double cell_m = 0.4);

  WaterPatch Patch() const;
  double HeightAt(Vec2d place) const;  ///< of the nearest cell

 private:
  Vec2d first_m_;
  int cells_;
  double cell_m_;
  std::vector<float> height_m_, foam_;
};

/// Three boats and two wakes, a buoy, a crate, a barrel, a ball and a raft, afloat on `sea`; the
/// spans of `frame` are borrowed from `wakes`.
void FillHarbour(TestSea& sea, const std::vector<TestWake>& wakes, RenderFrame& frame);
std::vector<TestWake> HarbourWakes();

}  // namespace onesea::render
