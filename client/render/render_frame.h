#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/base/vec.h"
#include "common/sea/attenuation.h"
#include "common/sea/surface.h"
#include "common/sea/terrain.h"

/// Everything one picture needs, as plain data: the renderer knows no session, no network and no
/// clock. World frame: ENU, z up, metres, radians, seconds. Spans are borrowed for one Draw() call.
namespace onesea::render {

struct Camera {
  Vec3d position_m{0, 0, 3};        ///< double; the renderer rebases to it before going to float
  double yaw_rad = 0.0;             ///< direction of view, counter-clockwise from east
  double pitch_rad = 0.0;           ///< up is positive, in (-π/2, π/2)
  double roll_rad = 0.0;            ///< right side down is positive
  double vertical_fov_rad = 0.785;  ///< in (0.1, 2.0)
};

struct Sun {
  double azimuth_rad = 0.0;    ///< where the sun stands, counter-clockwise from east
  double elevation_rad = 0.5;  ///< in [-0.2, π/2]
  friend bool operator==(const Sun&, const Sun&) = default;
};

/// Jerlov's optical water types: open ocean I to III, coastal 1C to 5C.
enum class WaterType : std::uint8_t { kI, kIB, kII, kIII, k1C, k3C, k5C };

struct Weather {
  double wind_speed_m_per_s = 8.0;  ///< U10; how much of the sea is white, how fast foam ages
  double wind_to_rad = 0.0;
  double visibility_m = 35'000.0;  ///< meteorological range, in [500, 200000]
  double cloud_cover = 0.25;       ///< in [0, 1]; 1 = overcast, no sun
};

/// One cascade of the sea at the time of the picture. Planes as in sea/surface.h: (N x N),
/// vector components in world axes. All cascades of a frame have the same N.
struct CascadePlanes {
  int grid_size = 0;
  double length_m = 0.0;
  double rotation_rad = 0.0;
  std::span<const float> height, displacement_x, displacement_y, slope_x, slope_y;
  std::span<const float> jacobian_xx, jacobian_yy;
};

/// eta = amplitude cos(k·x + phase): an explicit wave, its phase already at the picture's time.
struct RegularWaveNow {
  double kx_rad_per_m = 0.0, ky_rad_per_m = 0.0;
  double amplitude_m = 0.0;
  double phase_rad = 0.0;
};

/// Foam as sea::FoamWindow gives it; empty cells: cover is estimated from the folding alone.
struct FoamCells {
  std::span<const std::uint8_t> cells;  ///< (side x side), wrap-around, 255 = all white
  int side = 0;
  double cell_m = 1.0;
  Vec2d origin_m;  ///< corner of drifting cell (0, 0)
};

/// A rectangle of the interaction layer (wakes, splashes), added to the spectral sea. Samples are
/// row-major from the most southern row, the most western column; outside, heights and foam are 0.
/// Towards the rim the picture fades both out over a few cells.
struct WaterPatch {
  Vec2d first_cell_m;  ///< place of the sample in row 0, column 0
  double cell_m = 0.5;
  int columns = 0, rows = 0;
  /// The same place, size and version as in the last picture: the same samples, not uploaded anew.
  std::uint64_t version = 0;
  std::span<const float> height_m;  ///< (rows x columns)
  std::span<const float> foam;      ///< (rows x columns), share that is white, 0..1; or empty
};

/// One corner of a painted triangle, in the body frame.
struct HullCorner {
  std::array<float, 3> position_m{};
  std::array<float, 3> normal{};  ///< unit, outwards
  std::array<float, 3> albedo{};  ///< linear sRGB, 0..1
  float gloss = 0.0f;             ///< 0 chalk .. 1 glass
  float tinted = 0.0f;            ///< 1: albedo is multiplied by the instance's colour
};

/// What is drawn of a body; never changes once it has been drawn (renderers keep a copy).
struct HullMesh {
  std::vector<HullCorner> corners;  ///< three a triangle, counter-clockwise seen from outside
};

struct HullInstance {
  std::shared_ptr<const HullMesh> mesh;
  Vec3d position_m;                                 ///< of the body frame's origin
  std::array<double, 4> rotation_wxyz{1, 0, 0, 0};  ///< unit quaternion, body to world
  std::array<float, 3> colour{1, 1, 1};             ///< linear sRGB, of the tinted parts
};

/// Water thrown into the air at one place and moment: a burst of drops and mist that flies on by
/// itself. Which drops it has follows from the seed.
struct SprayBurst {
  Vec3d position_m;        ///< where it was thrown up
  Vec3d velocity_m_per_s;  ///< mean of its drops at that moment
  double mass_kg = 1.0;    ///< > 0; how many drops and how wide they fly
  double age_s = 0.0;      ///< since then; after kSprayLifeS nothing is left
  std::uint32_t seed = 1;
};

/// A mooring or a tow, hanging between two places (hanging_line.h).
struct RopeLine {
  Vec3d from_m, to_m;       ///< finite
  double length_m = 1.0;    ///< straight where the ends are further apart
  double radius_m = 0.018;  ///< > 0
};

struct Quality {
  int samples = 0;  ///< of the geometry pass: 4, 1 with edges smoothed afterwards, or 0 for
                    ///< 1 on a software renderer and 4 on a graphics card
  double pixels_per_column = 9.0;  ///< grid density, in [2, 64]; less is finer and dearer
  bool ripples = true;             ///< cosmetic waves shorter than the last cascade
  bool bloom = true;
};

struct RenderFrame {
  Camera camera;
  Sun sun;
  Weather weather;
  WaterType water = WaterType::kIB;
  double time_s = 0.0;     ///< sea time; drives ripples and clouds only
  std::uint64_t seed = 1;  ///< of the cosmetic detail, so that neighbours agree
  double choppiness = 1.0;
  double unresolved_mss = 0.0;  ///< slope variance of all waves shorter than the last cascade
  std::vector<CascadePlanes> cascades;        ///< 1..kRenderCascadesMax, longest first
  std::vector<RegularWaveNow> regular_waves;  ///< at most kRenderRegularWavesMax are drawn
  FoamCells foam;
  std::vector<WaterPatch> patches;  ///< the first kRenderPatchesMax in view are drawn
  std::vector<HullInstance> hulls;
  /// Land and seabed, drawn where it is in view and seen through shallow water; null: neither.
  /// Renderers keep a copy until the pointer changes.
  std::shared_ptr<const sea::Terrain> terrain;
  /// What the cascades and, last, the regular waves are multiplied with; null or without cells: 1.
  /// Kept until the pointer changes. Its planes: at least as many as there are cascades.
  std::shared_ptr<const sea::AttenuationGrid> attenuation;
  double water_level_m = 0.0;     ///< of the whole sea above z = 0; waves and patches are added
  std::vector<SprayBurst> spray;  ///< the last kRenderSprayMax are drawn
  std::vector<RopeLine> ropes;    ///< the first kRenderRopesMax are drawn
  double exposure_stops = 0.0;    ///< on top of the metered exposure
  Quality quality;
};

inline constexpr int kRenderCascadesMax = 8;
inline constexpr int kRenderRegularWavesMax = 32;
inline constexpr int kRenderPatchesMax = 6;
inline constexpr int kRenderSprayMax = 512;
inline constexpr int kRenderRopesMax = 1024;
inline constexpr double kSprayLifeS = 3.0;

/// Borrows the planes of `fields`, which must hold sea::kRenderFields.
CascadePlanes PlanesOf(const sea::CascadeFields& fields, const sea::Cascade& cascade);

}  // namespace onesea::render
