#pragma once

#include <vector>

#include "client/render/render_frame.h"

namespace onesea::render {

/// A sea of its own for picture tests: a JONSWAP-like spectrum on four tiles, by a plain radix-2
/// transform. Independent of common/sea, so that pictures change only when the renderer does.
class TestSea {
 public:
  TestSea(double hs_m, double tp_s, double wave_to_rad, int grid_size = 256);

  /// Fields at `time_s`; the frame borrows them until the next call.
  void FillFrame(double time_s, RenderFrame& frame);

  /// Height of the surface [m] above a place, at the time of the last FillFrame().
  double HeightAt(Vec2d place) const;

 private:
  struct Tile {
    double length_m, rotation_rad, wavenumber_min, wavenumber_max;
    std::vector<double> amplitude_re, amplitude_im;  // (N x N) h0
    std::vector<std::vector<float>> planes;          // 8
  };
  void FillTile(int tile, double scale, double peak, double wave_to_rad, std::uint64_t& random);
  void Synthesise(Tile& tile, double time_s);

  int grid_size_;
  double unresolved_mss_ = 0.0;
  std::vector<Tile> tiles_;
};

}  // namespace onesea::render
