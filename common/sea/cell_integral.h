#pragma once

#include <vector>

#include "common/sea/recipe.h"
#include "common/sea/wave_spectrum.h"

/// The lattice of a cascade and the energy that each of its waves carries.
namespace onesea::sea {

/// A cascade's lattice in numbers: wave (i, j) has k = cell · R (i, j).
class Lattice {
 public:
  struct Index {
    int i = 0;
    int j = 0;
  };

  explicit Lattice(const Cascade& cascade);

  /// Wave vector [rad/m] at lattice coordinates (x, y), which need not be whole.
  Vec2d WaveVector(double x, double y) const {
    return {cell_ * (cos_ * x - sin_ * y), cell_ * (sin_ * x + cos_ * y)};
  }

  /// Does the square cell about (i, j) meet the band?
  bool MeetsBand(Index index) const;
  /// All waves of the cascade: cells that meet the band, but for (0, 0); j outer, i inner,
  /// ascending.
  std::vector<Index> Waves() const;

  /// ∫ P d²k over cell ∩ band [m²], midpoint rule.
  ///
  /// Sub-cells are a tenth of |k| or finer, so a spectral peak of relative width 0.07 is seen by
  /// more than one; a cell at the rim of the band is cut by 8 x 8 sub-cells, whose errors cancel
  /// around the ring. Σ over a band is within 0.2 % of the integral (tests/sea/components_test.cc).
  double Variance(Index index, const SpectrumTable& table) const;

  double cell_rad_per_m() const { return cell_; }

 private:
  int SubdivisionOf(Index index) const;

  double cell_;  // 2π / length
  double cos_, sin_;
  double band_min_, band_max_;    // rad/m
  double index_min_, index_max_;  // the same in cells
};

}  // namespace onesea::sea
