#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/base/limits.h"
#include "common/base/vec.h"
#include "common/sea/attenuation.h"
#include "common/sea/point_query.h"
#include "common/sea/query_records.h"
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
  float cosine_cells_per_m = 1.0f, sine_cells_per_m = 0.0f;  ///< products of the above
  QueryRecords waves = {};                                   ///< displacement x, y and height
  QueryRecords velocities = {};  ///< x, y, z; none where the snapshot has none
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
  float curvature_per_m = 0.0f;  ///< rarely exceeded second derivative of the displacement
  std::shared_ptr<const AttenuationGrid> attenuation;  ///< over terrain; null: the open sea
};

/// Points in flight at once.
inline constexpr int kQueryBlock = 64;

/// The sea at an undisplaced point, summed over cascades and regular waves.
struct QueryPoint {
  double height_m = 0, dx_m = 0, dy_m = 0;
  double height_x = 0, height_y = 0;              ///< gradient of the height
  double j_xx = 1, j_xy = 0, j_yx = 0, j_yy = 1;  ///< I + gradient of the displacement
};

/// By how much each cascade is multiplied, then the regular waves together; all 1 in the open sea.
using PlaneFactors = std::array<float, kCascadesMax + 1>;
PlaneFactors FactorsAt(const QueryGrids& grids, Vec2d place);

/// One point in double: for the few points that the vectorised path hands over. The same spline.
QueryPoint EvaluateQueryPoint(const QueryGrids& grids, const PlaneFactors& factors,
                              Vec2d undisplaced);

/// Answers up to kQueryBlock points; `suspicious[n]` is set where the fixed iteration may have
/// missed the top sheet: the residual is large, the iteration did not contract, or the surface is
/// close to folding.
void SampleBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                 std::span<SurfaceSample> out, std::span<bool> suspicious);

/// Displacements alone, to about a centimetre: what SampleBlock begins with.
void ApproachBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                   std::span<SurfaceSample> out);

/// Fills everything that depends on the final undisplaced point alone (normal, velocity), from
/// displacement in `out`.
void FinishBlock(const QueryGrids& grids, std::span<const Vec2d> points,
                 std::span<SurfaceSample> out);

/// One per cascade, one more for all regular waves together if there are any.
inline int BandCount(const QueryGrids& grids) {
  return static_cast<int>(grids.cascades.size()) + (grids.regular.empty() ? 0 : 1);
}

/// Height and velocity x, y, z of each band at points whose displacement stands in `samples`; out:
/// (points x bands x 4). Pre: the grids have velocities.
void BandBlock(const QueryGrids& grids, std::span<const Vec2d> points,
               std::span<const SurfaceSample> samples, std::span<float> out);

}  // namespace onesea::sea
