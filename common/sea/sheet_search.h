#pragma once

#include "common/base/vec.h"
#include "common/sea/query_kernel.h"

namespace onesea::sea {

/// Answers one point with care, for the few where the vectorised iteration may have missed the top
/// sheet.
///
/// Converges from the guess in `sample` by damped Newton steps, then walks along the direction in
/// which the surface folds, up to kSheetSearchM either way, for further solutions of p + D(p) = x;
/// the highest answers, and with more than one `folded` is set. Scalar double arithmetic without
/// libm: same bits on every machine. Cost: about 10 µs.
void FindTopSheet(const QueryGrids& grids, Vec2d point, SurfaceSample& sample);

inline constexpr double kSheetSearchM = 10.0;

}  // namespace onesea::sea
