#pragma once

#include "client/render/render_frame.h"

namespace onesea::render {

/// The same hull in fewer triangles, for when it is far away: all corners within a cube of side
/// `cell_m` become one, and triangles that this folds away are left out (vertex clustering,
/// Rossignac & Borrel 1993). Paint is a mean by area.
/// Cost: about 0.3 µs a corner.
HullMesh CoarserHull(const HullMesh& mesh, float cell_m);

}  // namespace onesea::render
