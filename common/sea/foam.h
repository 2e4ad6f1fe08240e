#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "common/sea/components.h"

/// Spectral foam in a world-anchored square window: where the surface folds foam grows, it decays
/// and drifts with the wind. Foam at a place is a function of the recipe and of the last
/// kFoamMemoryS seconds on the foam lattice alone, so two windows over the same place agree,
/// whenever each began (docs/determinism.md).
namespace onesea::sea {

inline constexpr int kFoamRateHz = 4;  // lattice: foam instants are multiples of 1/4 s of sea time
inline constexpr double kFoamMemoryS = 12.0;  // three e-foldings of the slow decay

/// The window follows its centre only when that is further off than this: what it uncovers must be
/// synthesised again.
inline constexpr int kFoamSlackCells = 8;

struct FoamWindowOptions {
  int cells = 512;      ///< side, power of two
  double cell_m = 1.0;  ///< foam cells are anchored at multiples of this in the drifting frame
};

class FoamWindow {
 public:
  FoamWindow(std::shared_ptr<const Components> components, FoamWindowOptions options);
  ~FoamWindow();

  /// Brings the window to the last lattice instant at or before `time`, centred within
  /// kFoamSlackCells of `centre`. Cost: a step of one lattice instant is a few ms; a jump (the
  /// first call too) pre-rolls kFoamMemoryS: <= 1 s of CPU.
  void MoveTo(SimTime time, Vec2d centre);

  /// (cells x cells) uint8, wrap-around storage: the foam of drifting cell (i, j) is at [(j mod n)
  /// * n + (i mod n)].
  std::span<const std::uint8_t> Cells() const;
  /// World position of drifting cell (0, 0)'s lower-left corner now; cell (i, j) lies at origin +
  /// (i, j) * cell_m.
  Vec2d OriginM() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onesea::sea
