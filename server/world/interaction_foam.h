#pragma once

#include <span>
#include <utility>
#include <vector>

#include "common/sea/cell_rect.h"
#include "common/sea/interaction_field.h"

/// Foam on one region: a share of white in [0, 1] per cell.
namespace onesea::world {

struct FoamOptions {
  double life_s = 6.0;        ///< foam falls as exp(-t / life)
  double steep = 0.35;        ///< slope of the interaction surface from which it breaks
  double growth_per_s = 4.0;  ///< of foam, per unit of slope beyond `steep`
};

/// Foam changes slowly, so it is advanced once in so many steps.
inline constexpr int kFoamSteps = 6;

class InteractionFoam {
 public:
  InteractionFoam(const sea::CellRect& cells, const FoamOptions& options);

  /// Carries foam with the water (semi-Lagrangian, bilinear), lets it decay and makes new where the
  /// surface is steep. Rows without foam where the water is too calm to make any cost next to
  /// nothing, others half a microsecond each 256 cells. Pre: one number for each of these cells.
  void Advance(double span_s, std::span<const float> height_m, const sea::InteractionFlow& flow);

  std::span<float> shares() {
    any_ = changed_ = true;  // for all that is known here
    return shares_;
  }
  std::span<const float> shares() const { return shares_; }
  /// False: there is none anywhere.
  bool any() const { return any_; }
  /// Whether it may have changed since this was last asked.
  bool TakeChanged() { return std::exchange(changed_, false); }

 private:
  sea::CellRect cells_;
  FoamOptions options_;
  void AdvanceRow(int row, double span_s, std::span<const float> height_m,
                  const sea::InteractionFlow& flow);

  std::vector<float> shares_, next_;
  std::vector<float> heights_m_;  // of one row
  bool any_ = false, changed_ = false;
};

}  // namespace onesea::world
