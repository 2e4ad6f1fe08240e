#pragma once

#include <cmath>
#include <vector>

#include "common/wire/tile_encoder.h"

/// Wakes to compress: the 2-D wave equation with moving sources, a frame every 1/30 s. Cells of
/// 1 m, 5 m/s, sponge along the edges; the scene of the codec's first measurements.
namespace onesea::wire {

class PoolScene {
 public:
  static constexpr int kSide = 256;

  /// 4 sources leave two thirds of the water below 1 mm; 16 are a busy harbour.
  explicit PoolScene(int sources) : sources_(sources) {
    for (int n = 0; n < 300; ++n) Step();
  }

  void Step() {
    constexpr float kCourantSquared = 25.0F / 900.0F;
    time_s_ += 1.0 / 30.0;
    for (int j = 1; j < kSide - 1; ++j) {
      for (int i = 1; i < kSide - 1; ++i) {
        const int n = j * kSide + i;
        const float laplacian =
            now_[n - 1] + now_[n + 1] + now_[n - kSide] + now_[n + kSide] - 4.0F * now_[n];
        const float next = 2.0F * now_[n] - past_[n] + kCourantSquared * laplacian;
        past_[n] = now_[n] + (next - now_[n]) * Damping(i, j);
      }
    }
    // past_ held what is next; cells are read two rows on before they are overwritten only in
    // now_, so a swap ends the step.
    now_.swap(past_);
    for (int source = 0; source < sources_; ++source) Push(source);
  }

  sea::CellRect cells() const {
    return {.west = -128, .south = -128, .columns = kSide, .rows = kSide, .cell_m = 1.0};
  }
  TileField field(double height_step_m = 1e-3) const {
    return {{.id = 1, .cells = cells(), .height_step_m = height_step_m}, now_, {}};
  }

 private:
  static float Damping(int i, int j) {
    const int edge = std::min(std::min(i, j), std::min(kSide - 1 - i, kSide - 1 - j));
    return edge >= 16 ? 0.998F : 0.998F - 0.01F * static_cast<float>(16 - edge);
  }

  // Where a source is: a boat on a circle at 8 m/s, one to and fro at 3 m/s, one that stands, a
  // shuttle at 6 m/s.
  Vec2d PlaceOf(int source, double t) const {
    const double phase = 1.7 * source;
    const Vec2d home{60.0 * std::cos(2.4 * source), 60.0 * std::sin(2.4 * source)};
    switch (source % 4) {
      case 0:
        return home +
               30.0 * Vec2d{std::cos(t * 8.0 / 30.0 + phase), std::sin(t * 8.0 / 30.0 + phase)};
      case 1:
        return home + Vec2d{40.0 * std::sin(t * 3.0 / 40.0 + phase), 0.0};
      case 2:
        return home;
      default:
        return home + Vec2d{0.0, 40.0 * std::sin(t * 6.0 / 40.0 + phase)};
    }
  }

  // A hull leaves its hole and makes another where it goes; the one that stands heaves at 0.8 Hz.
  void Push(int source) {
    if (source % 4 == 2) {
      Bump(PlaceOf(source, time_s_), kHeaveM * std::cos(6.283 * 0.8 * time_s_ + 1.7 * source));
      return;
    }
    Bump(PlaceOf(source, time_s_ - 1.0 / 30.0), kDraughtM);
    Bump(PlaceOf(source, time_s_), -kDraughtM);
  }

  void Bump(Vec2d place, double height_m) {
    const int i0 = static_cast<int>(std::lround(place.x)) + 128;
    const int j0 = static_cast<int>(std::lround(place.y)) + 128;
    for (int j = std::max(j0 - 6, 1); j <= std::min(j0 + 6, kSide - 2); ++j) {
      for (int i = std::max(i0 - 6, 1); i <= std::min(i0 + 6, kSide - 2); ++i) {
        const Vec2d off = Vec2d{i - 128.0, j - 128.0} - place;
        const auto bump_m = static_cast<float>(height_m * std::exp(-Dot(off, off) / 4.5));
        // In both, or the next step would take the bump for a velocity.
        now_[j * kSide + i] += bump_m;
        past_[j * kSide + i] += bump_m;
      }
    }
  }

  static constexpr double kDraughtM = 0.3, kHeaveM = 0.02;

  int sources_;
  double time_s_ = 0.0;
  std::vector<float> now_ = std::vector<float>(kSide * kSide);
  std::vector<float> past_ = std::vector<float>(kSide * kSide);
};

}  // namespace onesea::wire
