#include "common/sea/point_query.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "common/base/check.h"
#include "common/base/only_owner.h"
#include "common/sea/constants.h"
#include "common/sea/query_kernel.h"
#include "common/sea/sheet_search.h"
#include "common/sea/spline.h"
#include "common/sea/wave_frame.h"

namespace onesea::sea {

namespace {

// Beyond this a double no longer resolves a tenth of a micrometre; far above kQueryCoordinateMaxM.
constexpr double kCoordinateMaxM = 1.0e9;

// Normals come from the gradients of the spline: only velocities need planes of their own.
FieldSet FieldsFor(QueryDetail detail) {
  return detail == QueryDetail::kVelocity ? kQueryFields | kVelocityFields : kQueryFields;
}

QueryRegular MakeRegular(const RegularAt& wave, const Recipe& recipe) {
  const double k =
      std::sqrt(wave.kx_rad_per_m * wave.kx_rad_per_m + wave.ky_rad_per_m * wave.ky_rad_per_m);
  const double ux = wave.kx_rad_per_m / k, uy = wave.ky_rad_per_m / k;
  const double decay = DepthDecay(k, recipe.depth_m);
  const double horizontal = wave.sigma_rad_per_s * (1.0 + decay) / (1.0 - decay);
  QueryRegular regular{.wave = wave,
                       .kx_turns_per_m = static_cast<float>(wave.kx_rad_per_m / (2.0 * kPi)),
                       .ky_turns_per_m = static_cast<float>(wave.ky_rad_per_m / (2.0 * kPi)),
                       .amplitude_m = static_cast<float>(wave.amplitude_m)};
  const auto set = [&](Field field, double factor) {
    regular.factors[static_cast<int>(field)] = static_cast<float>(wave.amplitude_m * factor);
  };
  const double lambda = recipe.choppiness;
  set(Field::kHeight, 1.0);
  set(Field::kDisplacementX, lambda * ux);
  set(Field::kDisplacementY, lambda * uy);
  set(Field::kSlopeX, wave.kx_rad_per_m);
  set(Field::kSlopeY, wave.ky_rad_per_m);
  set(Field::kJacobianXX, -lambda * wave.kx_rad_per_m * ux);
  set(Field::kJacobianYY, -lambda * wave.ky_rad_per_m * uy);
  set(Field::kJacobianXY, -lambda * wave.kx_rad_per_m * uy);
  set(Field::kVelocityX, horizontal * ux);
  set(Field::kVelocityY, horizontal * uy);
  set(Field::kVelocityZ, -wave.sigma_rad_per_s);
  return regular;
}

// HeightErrorBound. Between its samples a spline returns a wave of phase steps (a, b) times a
// factor g_a g_b that is 1 plus its images from beyond the sampling rate. |g - 1| is greatest at
// the centre between two samples, e = SplineError(); so the error at any point is a sum of waves,
// Gaussian with at most the variance σ² = Σ E (e_a + e_b + e_a e_b)². The displacement errs
// likewise by at most λσ along any direction, which moves the point and so changes the height by
// the slope of the surface in space, taken as at most 1 (a steeper sea folds): together
// σ √(1 + λ²). kBoundSigmas of that are exceeded by one point in 26 million. Rounding to the units
// of the records (query_records.h) moves each of height and displacement by at most half a unit a
// cascade, since the weights of a spline are positive and add up to one; the inversion and other
// rounding leave less than kInversionErrorM.
constexpr double kBoundSigmas = 5.5;
constexpr double kInversionErrorM = 1e-3;
// Second derivatives of the displacement beyond this many of their deviations are rare.
constexpr double kCurvatureSigmas = 4.0;

int GridSize(const CascadeComponents& waves, int coarser) {
  return std::max(waves.cascade.query_grid_size / coarser, kGridSizeMin);
}

// Of one weather entry.
struct EntryVariances {
  double interpolation_m2 = 0.0;  // σ²
  double curvature_per_m2 = 0.0;  // Σ E λ² k⁴: of D'' along the wave
};

EntryVariances VariancesOf(const Components& components, std::size_t entry, int coarser) {
  EntryVariances sum;
  const double lambda = components.recipe.choppiness;
  for (const CascadeComponents& waves : components.cascades) {
    const int size = GridSize(waves, coarser);
    for (std::size_t n = 0; n < waves.i.size(); ++n) {
      const double energy_m2 = waves.variance_m2[entry][n];
      const double a = SplineError(waves.i[n], size), b = SplineError(waves.j[n], size);
      const double error = a + b + a * b;
      sum.interpolation_m2 += error * error * energy_m2;
      const double kx = waves.kx_rad_per_m[n], ky = waves.ky_rad_per_m[n];
      const double bend = lambda * (kx * kx + ky * ky);
      sum.curvature_per_m2 += bend * bend * energy_m2;
    }
  }
  return sum;
}

}  // namespace

struct SeaSnapshot::Impl {
  SimTime time;
  QueryDetail detail = QueryDetail::kHeight;
  int coarser = 1;
  std::shared_ptr<const Components> components;
  std::vector<AlignedArray<std::uint32_t>> waves, velocities;  // records of grids.cascades
  QueryGrids grids;
  double height_error_bound_m = 0.0;
};

SeaSnapshot::SeaSnapshot(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
SeaSnapshot::~SeaSnapshot() = default;
SimTime SeaSnapshot::time() const { return impl_->time; }
QueryDetail SeaSnapshot::detail() const { return impl_->detail; }
const std::shared_ptr<const AttenuationGrid>& SeaSnapshot::attenuation() const {
  return impl_->grids.attenuation;
}
double SeaSnapshot::HeightErrorBound() const { return impl_->height_error_bound_m; }

void SeaSnapshot::CheckPoints(std::span<const Vec2d> points) const {
  for (const Vec2d& point : points) {
    ONESEA_CHECK(std::abs(point.x) <= kCoordinateMaxM && std::abs(point.y) <= kCoordinateMaxM)
        << "point (" << point.x << ", " << point.y << "); callers validate";
  }
}

// A block's heights and displacements.
void SeaSnapshot::Invert(std::span<const Vec2d> points, std::span<SurfaceSample> out) const {
  CheckPoints(points);
  std::array<bool, kQueryBlock> suspicious;
  SampleBlock(impl_->grids, points, out, std::span(suspicious).first(points.size()));
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (suspicious[n]) FindTopSheet(impl_->grids, points[n], out[n]);
  }
}

void SeaSnapshot::Sample(std::span<const Vec2d> points, std::span<SurfaceSample> out) const {
  ONESEA_CHECK(points.size() == out.size())
      << points.size() << " points, " << out.size() << " answers";
  for (std::size_t start = 0; start < points.size(); start += kQueryBlock) {
    const std::size_t count = std::min<std::size_t>(kQueryBlock, points.size() - start);
    const auto block_points = points.subspan(start, count);
    const auto block_out = out.subspan(start, count);
    Invert(block_points, block_out);
    if (impl_->detail != QueryDetail::kHeight) FinishBlock(impl_->grids, block_points, block_out);
  }
}

int SeaSnapshot::bands() const { return BandCount(impl_->grids); }

void SeaSnapshot::SampleBands(std::span<const Vec2d> points, std::span<float> out) const {
  ONESEA_CHECK(impl_->detail == QueryDetail::kVelocity);
  const std::size_t floats = 4 * static_cast<std::size_t>(bands());
  ONESEA_CHECK(out.size() == floats * points.size());
  std::array<SurfaceSample, kQueryBlock> samples;
  for (std::size_t start = 0; start < points.size(); start += kQueryBlock) {
    const std::size_t count = std::min<std::size_t>(kQueryBlock, points.size() - start);
    const auto block_points = points.subspan(start, count);
    const auto block_samples = std::span(samples).first(count);
    CheckPoints(block_points);
    ApproachBlock(impl_->grids, block_points, block_samples);
    BandBlock(impl_->grids, block_points, block_samples,
              out.subspan(floats * start, floats * count));
  }
}

struct SnapshotBuilder::Impl {
  // Of one cascade; the planes live until they are turned into records.
  struct Stage {
    Synthesiser synthesiser;
    CascadeFields planes;
  };

  std::shared_ptr<const Components> components;
  TransformKind transform;
  int coarser = 1;
  // Without and with velocities, each per cascade, made when first asked for.
  std::array<std::vector<Stage>, 2> stages;
  std::vector<double> weights;
  std::vector<EntryVariances> variances;  // per weather entry
  std::vector<RegularAt> regular;
  std::optional<MovingAttenuation> attenuation;

  // Regular waves, and how far off answers may be.
  void SetBounds(SeaSnapshot::Impl& snapshot);
};

void SnapshotBuilder::Impl::SetBounds(SeaSnapshot::Impl& snapshot) {
  WeatherWeights(components->recipe, snapshot.time, weights);
  EntryVariances now;
  for (std::size_t m = 0; m < weights.size(); ++m) {
    now.interpolation_m2 += weights[m] * variances[m].interpolation_m2;
    now.curvature_per_m2 += weights[m] * variances[m].curvature_per_m2;
  }
  const double lambda = components->recipe.choppiness;
  snapshot.height_error_bound_m =
      kBoundSigmas * std::sqrt(now.interpolation_m2 * (1.0 + lambda * lambda)) + kInversionErrorM;
  for (const QueryCascade& cascade : snapshot.grids.cascades) {
    snapshot.height_error_bound_m += (0.5 + std::numbers::sqrt2 / 2.0) * cascade.waves.unit;
  }
  double curvature_per_m = kCurvatureSigmas * std::sqrt(now.curvature_per_m2);
  RegularWavesAt(*components, snapshot.time, weights, regular);
  for (const RegularAt& wave : regular) {
    if (!(wave.amplitude_m > 0.0)) continue;
    snapshot.grids.regular.push_back(MakeRegular(wave, components->recipe));
    curvature_per_m +=
        lambda * wave.amplitude_m *
        (wave.kx_rad_per_m * wave.kx_rad_per_m + wave.ky_rad_per_m * wave.ky_rad_per_m);
  }
  // Shoaling makes waves higher, and with them every error of theirs.
  if (snapshot.grids.attenuation != nullptr) {
    const double largest = snapshot.grids.attenuation->largest;
    curvature_per_m *= largest;
    snapshot.height_error_bound_m =
        kInversionErrorM + largest * (snapshot.height_error_bound_m - kInversionErrorM);
  }
  snapshot.grids.curvature_per_m = static_cast<float>(curvature_per_m);
}

SnapshotBuilder::SnapshotBuilder(std::shared_ptr<const Components> components,
                                 TransformKind transform, int coarser)
    : impl_(std::make_unique<Impl>()) {
  ONESEA_CHECK(components != nullptr);
  ONESEA_CHECK(coarser == 1 || coarser == 2) << coarser;
  impl_->weights.resize(components->recipe.timeline.size());
  for (std::size_t m = 0; m < impl_->weights.size(); ++m) {
    impl_->variances.push_back(VariancesOf(*components, m, coarser));
  }
  impl_->attenuation.emplace(components);
  impl_->components = std::move(components);
  impl_->transform = transform;
  impl_->coarser = coarser;
}

SnapshotBuilder::~SnapshotBuilder() = default;

const std::shared_ptr<const AttenuationGrid>& SnapshotBuilder::AttenuationAt(SimTime time) {
  return impl_->attenuation->At(time);
}

// By value, so that the caller can give away the only owner.
std::shared_ptr<const SeaSnapshot> SnapshotBuilder::At(
    SimTime time, QueryDetail detail,
    // NOLINTNEXTLINE(performance-unnecessary-value-param)
    std::shared_ptr<const SeaSnapshot> recycle) {
  const Components& components = *impl_->components;
  const bool with_velocity = detail == QueryDetail::kVelocity;
  std::vector<Impl::Stage>& stages = impl_->stages[with_velocity ? 1 : 0];
  const FieldSet wanted = FieldsFor(detail);
  if (stages.empty()) {
    for (std::size_t c = 0; c < components.cascades.size(); ++c) {
      const int size = GridSize(components.cascades[c], impl_->coarser);
      stages.push_back({Synthesiser(impl_->components, static_cast<int>(c), size, wanted,
                                    impl_->transform, PlaneKind::kSplineCoefficients),
                        CascadeFields(size, wanted)});
    }
  }
  auto snapshot = std::make_unique<SeaSnapshot::Impl>();
  if (recycle != nullptr && IsOnlyOwner(recycle) && recycle->detail() == detail &&
      recycle->impl_->components == impl_->components &&
      recycle->impl_->coarser == impl_->coarser) {
    // Nobody else can see it, so its storage is ours.
    auto& old = const_cast<SeaSnapshot::Impl&>(*recycle->impl_);
    snapshot->waves = std::move(old.waves);
    snapshot->velocities = std::move(old.velocities);
  } else {
    for (const CascadeComponents& cascade : components.cascades) {
      const int size = GridSize(cascade, impl_->coarser);
      snapshot->waves.push_back(AllocateZeros<std::uint32_t>(RecordWords(size)));
      if (with_velocity) {
        snapshot->velocities.push_back(AllocateZeros<std::uint32_t>(RecordWords(size)));
      }
    }
  }
  snapshot->time = time;
  snapshot->detail = detail;
  snapshot->coarser = impl_->coarser;
  snapshot->components = impl_->components;
  snapshot->grids.detail = detail;
  snapshot->grids.current_m_per_s = components.recipe.current_m_per_s;
  snapshot->grids.attenuation = impl_->attenuation->At(time);
  for (std::size_t c = 0; c < components.cascades.size(); ++c) {
    CascadeFields& planes = stages[c].planes;
    stages[c].synthesiser.Evaluate(time, planes);
    const CascadeFrame frame(components.cascades[c].cascade);
    QueryCascade grid{.grid_size = GridSize(components.cascades[c], impl_->coarser),
                      .cosine = frame.cosine,
                      .sine = frame.sine};
    grid.cells_per_m = grid.grid_size / frame.length_m;
    grid.cosine_cells_per_m = static_cast<float>(grid.cosine * grid.cells_per_m);
    grid.sine_cells_per_m = static_cast<float>(grid.sine * grid.cells_per_m);
    grid.waves =
        WriteRecords(planes, {Field::kDisplacementX, Field::kDisplacementY, Field::kHeight},
                     snapshot->waves[c].get());
    if (with_velocity) {
      grid.velocities =
          WriteRecords(planes, {Field::kVelocityX, Field::kVelocityY, Field::kVelocityZ},
                       snapshot->velocities[c].get());
    }
    snapshot->grids.cascades.push_back(grid);
  }
  impl_->SetBounds(*snapshot);
  return std::make_shared<const SeaSnapshot>(std::move(snapshot));
}

}  // namespace onesea::sea
