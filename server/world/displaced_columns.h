#pragma once

#include <span>
#include <vector>

#include "common/sea/cell_rect.h"
#include "server/world/hull.h"
#include "server/world/rigid_math.h"

/// The water that a hull displaces, on the cells of a region.
namespace onesea::world {

/// Heights of a surface around a body, bilinear between samples and flat beyond them.
struct HeightPatch {
  double west_m = 0.0, south_m = 0.0, cell_m = 1.0;
  int columns = 0, rows = 0;      ///< both 0: flat, at `flat_m`
  std::vector<float> height_m{};  ///< (rows x columns) row-major from the south-west
  double flat_m = 0.0;

  double At(double x, double y) const;
};

/// Adds to `head_m` (one per cell of `cells`) the thickness of the part of the hull below
/// `surface`, averaged over each cell: the pressure head under which still water would make room
/// for the hull. The sum over all cells times the area of one is the displaced volume, whatever the
/// cell size and wherever the hull lies, so a gliding hull makes no waves of its own; what lies
/// outside `cells` is left out.
///
/// Each wetted piece of a face is a column of water up to the surface, counted down for faces that
/// look up, and spread over the nine cells around its middle; pieces longer than most of a cell are
/// split. `share` scales all of it.
void AddDisplacedColumns(const TriangleMesh& mesh, Vec3d centre_of_mass_m, const Pose& pose,
                         const HeightPatch& surface, const sea::CellRect& cells,
                         std::span<float> head_m, double share = 1.0);

/// The columns of a hull that lies upright, lumped together: what AddDisplacedColumns would spread
/// anew each time, for a hull that presses with its shape at rest.
struct LumpedColumn {
  double x_m = 0.0, y_m = 0.0;  ///< from the centre of mass, bow to the east
  double volume_m3 = 0.0;
};
/// Below the level z = 0 for a centre of mass at `centre_height_m`; lumps about a cell apart.
/// Spread as the surface sees them: water that is displaced z below it makes waves of wavenumber k
/// lower by exp(-kz), as in Michell's theory of thin ships (1898). So a column's lumps lie up to
/// three times its depth T around it, by Poisson's kernel averaged over the column: within 0.07 of
/// (1 - exp(-kT)) / kT from kT = 1 on, 0.13 above it at kT = 0.5.
std::vector<LumpedColumn> ColumnsAtRest(const TriangleMesh& mesh, Vec3d centre_of_mass_m,
                                        double centre_height_m, double cell_m);

/// The same for a hull at `place_m` with this heading: its volume comes out exactly. `turn` is
/// about the vertical. Cost: some 10 ns a lump.
void AddColumns(std::span<const LumpedColumn> columns, Vec2d place_m, const Quaternion& turn,
                const sea::CellRect& cells, std::span<float> head_m, double share);

}  // namespace onesea::world
