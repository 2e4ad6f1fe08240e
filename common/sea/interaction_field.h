#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/base/vec.h"
#include "common/sea/cell_rect.h"

/// The interaction layer between its cells: what every process takes it for. It adds to the
/// spectral sea.
namespace onesea::sea {

/// Velocity of the water at the surface [m/s], (rows x columns) row-major each.
struct InteractionFlow {
  std::vector<float> x, y, z;
};

/// One region at one instant. Arrays are (rows x columns) row-major.
struct InteractionField {
  CellRect cells;
  std::vector<float> height_m;                  ///< up, relative to the mean water level
  std::shared_ptr<const InteractionFlow> flow;  ///< shared while it stays; null: not known
  /// Share of the surface that is white, 0..1; shared while it stays; null: nowhere.
  std::shared_ptr<const std::vector<float>> foam;
};

/// All regions at one instant; never changes once made, so threads may share it.
struct InteractionSnapshot {
  std::int64_t tick = 0;
  std::vector<std::shared_ptr<const InteractionField>> fields;
};

struct InteractionSample {
  double height_m = 0.0;
  Vec2d slope;        ///< ∂height/∂x, ∂height/∂y
  Vec3d velocity;     ///< [m/s]
  double foam = 0.0;  ///< 0..1
};

/// The sum over the fields. Heights and velocities are interpolated by Catmull-Rom splines of 4 x 4
/// cells: exact at cells, slopes continuous. Cells beyond a field count as 0, so a field fades
/// smoothly within two cells outside. Foam is interpolated bilinearly. Places that are not finite
/// get zeros. The same bits on every machine. Cost of a height: 20 ns for a field.
InteractionSample SampleInteraction(const InteractionSnapshot& snapshot, Vec2d place);

/// The upward unit normal of a surface when this slope is added to its own.
Vec3d Tilted(Vec3d normal, Vec2d slope);

/// Heights alone, to the same bits. Pre: equal sizes.
void InteractionHeights(const InteractionSnapshot& snapshot, std::span<const Vec2d> places,
                        std::span<double> height_m);

/// What a hull feels of the layer at one place: a height, and the water's horizontal velocity.
struct InteractionFelt {
  double height_m = 0.0;
  Vec2d velocity_m_per_s;
};

/// Adds to `sum` the heights of one field, by the same interpolation, those of `more_m` added to
/// them at each cell (or none), and the flow, which is interpolated bilinearly (or none: null).
/// Cost: 2 ns for a place beyond the field, else 20, 35 with `more_m`.
void AddFelt(const CellRect& cells, std::span<const float> height_m, std::span<const float> more_m,
             const InteractionFlow* flow, std::span<const Vec2d> places,
             std::span<InteractionFelt> sum);

/// The sample of one field.
InteractionSample SampleInteraction(const InteractionField& field, Vec2d place);

}  // namespace onesea::sea
