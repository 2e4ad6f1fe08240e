#pragma once

#include <span>

#include "common/base/vec.h"

namespace onesea::render {

/// A rope of `length_m` between two places, hanging by its own weight: the catenary
///
///   z = a cosh((x - x0)/a) + c,   2 a sinh(h / 2a) = √(L² - v²)
///
/// with h and v the distance of the ends across and up, L the length. Writes points.size() >= 2
/// places, evenly spread along it; the first and the last are the ends. Straight where the ends are
/// further apart than `length_m`; where one is above the other it hangs down and comes up again.
/// The length is met within 1e-3 of it. Pre: finite. Allocates nothing.
void HangingLine(Vec3d from_m, Vec3d to_m, double length_m, std::span<Vec3d> points);

}  // namespace onesea::render
