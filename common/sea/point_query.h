#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/base/vec.h"
#include "common/sea/components.h"
#include "common/sea/surface.h"

/// Point queries: the sea at a place and any time, choppy displacement inverted.
namespace onesea::sea {

struct AttenuationGrid;

/// Layers that an answer contains. Bit set, sent on the wire.
inline constexpr std::uint32_t kLayerSpectral = 1;
inline constexpr std::uint32_t kLayerInteraction = 2;  ///< wakes and splashes
inline constexpr std::uint32_t kLayerTerrain = 4;      ///< the spectral sea lowered over terrain
inline constexpr std::uint32_t kLayerWaterLevel = 8;   ///< a mean level that is not 0

enum class QueryDetail : std::uint8_t {
  kHeight = 1,   ///< height, displacement, residual, folded
  kNormal = 2,   ///< also the normal
  kVelocity = 3  ///< also the surface velocity
};

struct SurfaceSample {
  float height_m = 0.0f;          ///< of the top sheet above (x, y)
  float displacement_x_m = 0.0f;  ///< from the undisplaced point to (x, y)
  float displacement_y_m = 0.0f;
  float residual_m = 0.0f;  ///< horizontal miss of the inversion, estimated to second order
  float normal_x = 0.0f, normal_y = 0.0f, normal_z = 1.0f;
  float velocity_x_m_per_s = 0.0f, velocity_y_m_per_s = 0.0f,
        velocity_z_m_per_s = 0.0f;  ///< with the current
  bool folded = false;              ///< the surface is multi-valued here; the top sheet answers
};

struct DepthSample {
  Vec3d velocity_m_per_s;  ///< of the water particle, with the current (Airy)
  double dynamic_pressure_pa =
      0;  ///< rho g Σ a cosh k(z+h)/cosh kh cos(...), hydrostatic part excluded
};

/// The sea at one instant, ready for many points. Immutable, thread-safe, share it.
/// Built by SnapshotBuilder::At().
class SeaSnapshot {
 public:
  struct Impl;
  explicit SeaSnapshot(std::unique_ptr<const Impl> impl);
  ~SeaSnapshot();

  SimTime time() const;
  QueryDetail detail() const;
  /// How the terrain lowers each cascade; in every answer. Null: the open sea.
  const std::shared_ptr<const AttenuationGrid>& attenuation() const;

  /// out[n] answers points[n]. Coordinates within ±1e9 m only (CHECK). Vectorised over points;
  /// allocates nothing.
  void Sample(std::span<const Vec2d> points, std::span<SurfaceSample> out) const;

  /// The sea at the same places in its bands, which reach down to different depths: one band per
  /// cascade, one more for all regular waves together if there are any. `out`: (points x bands x
  /// 4), height and velocity x, y, z of the water at the surface, without the current [m, m/s].
  /// Pre: detail() is kVelocity. Points are found to about a centimetre, so heights to some
  /// millimetres, and where the surface folds any of its sheets may answer. Cost: about 0.2 µs a
  /// point.
  int bands() const;
  void SampleBands(std::span<const Vec2d> points, std::span<float> out) const;

  /// Bound [m] of |height_m - exact| for unfolded points: spline interpolation plus inversion, some
  /// millimetres even in a storm; see point_query.cc for its derivation and for the probability
  /// with which it holds.
  double HeightErrorBound() const;

 private:
  friend class SnapshotBuilder;
  void CheckPoints(std::span<const Vec2d> points) const;
  void Invert(std::span<const Vec2d> points, std::span<SurfaceSample> out) const;

  std::unique_ptr<const Impl> impl_;
};

/// Makes snapshots at any time by synthesis on the recipe's query grids; over terrain if the
/// components are. Not thread-safe.
class SnapshotBuilder {
 public:
  /// `coarser` 2: on grids of half as many samples a side, for a quarter of the cost. The shortest
  /// waves of each cascade, 4 samples long then, come out 3 % low along an axis (2 (a/(2π - a))⁴ of
  /// a phase step a); HeightErrorBound() knows.
  explicit SnapshotBuilder(std::shared_ptr<const Components> components,
                           TransformKind transform = TransformKind::kOwn, int coarser = 1);
  ~SnapshotBuilder();
  /// Cost: about 0.6 ms for kHeight with the default cascades, one core. Reuses the storage of
  /// `recycle` if it is the only owner of it.
  std::shared_ptr<const SeaSnapshot> At(SimTime time, QueryDetail detail,
                                        std::shared_ptr<const SeaSnapshot> recycle = nullptr);
  /// What a snapshot of that time says by attenuation(), without making one.
  const std::shared_ptr<const AttenuationGrid>& AttenuationAt(SimTime time);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The wavenumber [rad/m] that stands for each band of SeaSnapshot::SampleBands() at `time`: the
/// mean over its waves, weighted by variance; of an empty band that of its middle.
std::vector<double> BandWavenumbers(const Components& components, SimTime time);

/// Below the surface: the direct sum over every component, exact; about 15 µs a point. `depth_m` >=
/// 0 below z = 0. `attenuation`: of a snapshot of that time; each cascade fades with depth as over
/// the recipe's flat bottom.
void SampleAtDepth(const Components& components, SimTime time, std::span<const Vec2d> points,
                   std::span<const double> depth_m, std::span<DepthSample> out,
                   const AttenuationGrid* attenuation = nullptr);

/// The direct sum in double over every component at undisplaced points in the open sea: the oracle
/// of the two above. Slow.
struct DirectSample {
  double height_m = 0, displacement_x_m = 0, displacement_y_m = 0;
  double slope_x = 0, slope_y = 0, jacobian_xx = 0, jacobian_yy = 0, jacobian_xy = 0;
  Vec3d velocity_m_per_s;
};
DirectSample SumDirectly(const Components& components, SimTime time, Vec2d undisplaced);

}  // namespace onesea::sea
