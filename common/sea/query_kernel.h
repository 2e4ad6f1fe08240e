#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/base/limits.h"
#include "common/base/vec.h"
#include "common/sea/point_query.h"
#include "common/sea/surface.h"
#include "common/sea/wave_frame.h"

/// The vectorised inside of SeaSnapshot::Sample().
namespace onesea::sea {

/// What the kernel reads of one cascade; float copies of the frame for the iteration, doubles for
/// the first reduction.
struct QueryCascade {
  int grid_size = 0;
  double cosine = 1.0, sine = 0.0;
  double cells_per_m = 1.0;
  /// ((N + 1) x (N + 1) x 2) displacement x, y; the last row and column repeat the first, so that a
  /// cell's corners are two runs of four floats. See InterleaveDisplacement().
  const float* displacement = nullptr;
  const float* planes[kFieldCount] = {};  ///< null where the snapshot has no such field
};

/// A regular wave at the snapshot's time.
struct QueryRegular {
  RegularAt wave;
  float kx_turns_per_m = 0.0f, ky_turns_per_m = 0.0f;
  float amplitude_m = 0.0f;
  float factors[kFieldCount] = {};  ///< amplitude · c or c/i, see evolve.h
};

struct QueryGrids {
  QueryDetail detail = QueryDetail::kHeight;
  std::vector<QueryCascade> cascades;
  std::vector<QueryRegular> regular;
  Vec2d current_m_per_s;
};

/// Points in flight at once.
inline constexpr int kQueryBlock = 64;

/// The sea at an undisplaced point, summed over cascades and regular waves.
struct QueryPoint {
  double height_m = 0, dx_m = 0, dy_m = 0;
  double height_x = 0, height_y = 0;              ///< gradient of the interpolated height
  double j_xx = 1, j_xy = 0, j_yx = 0, j_yy = 1;  ///< I + gradient of the interpolated displacement
};

/// Floats of QueryCascade::displacement.
inline std::size_t DisplacementFloats(int grid_size) {
  const auto side = static_cast<std::size_t>(grid_size) + 1;
  return 2 * side * side;
}
void InterleaveDisplacement(const CascadeFields& fields, float* displacement);

/// One point in double: for the few points that the vectorised path hands over. Bilinear as there.
QueryPoint EvaluateQueryPoint(const QueryGrids& grids, Vec2d undisplaced);

/// Answers up to kQueryBlock points; `suspicious[n]` is set where the fixed iteration may have
/// missed the top sheet: the residual is large, the iteration did not contract, or the surface is
/// close to folding.
void SampleBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                 std::span<SurfaceSample> out, std::span<bool> suspicious);

/// Fills everything that depends on the final undisplaced point alone (normal, velocity), from
/// displacement in `out`.
void FinishBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                 std::span<SurfaceSample> out);

}  // namespace onesea::sea
