#include "client/model/local_sea.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_format.h"
#include "client/model/other_sea.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/sea/attenuation.h"

namespace onesea::client {
namespace {

absl::Status CheckVersion(const wire::Welcome& welcome) {
  const int version = welcome.recipe.sea_model_version;
  if (version == sea::kSeaModelVersion) return absl::OkStatus();
  return OtherSeaError(absl::StrFormat(
      "session '%s' has sea_model_version %d, this program knows %d: use the server's release",
      welcome.session.name, version, sea::kSeaModelVersion));
}

absl::StatusOr<std::shared_ptr<const sea::Components>> BuildSameComponents(
    const wire::Welcome& welcome) {
  ONESEA_RETURN_IF_ERROR(CheckVersion(welcome));
  ONESEA_ASSIGN_OR_RETURN(auto components, sea::BuildComponents(welcome.recipe));
  if (components->hash == welcome.component_hash) return components;
  return OtherSeaError(absl::StrFormat(
      "session '%s': this program's component_hash is %016x, the server's is %016x; "
      "it would show another sea and refuses: use the server's release",
      welcome.session.name, components->hash, welcome.component_hash));
}

// What every height gets; the server adds it in the same way.
void AddLevel(double level_m, std::span<sea::SurfaceSample> samples) {
  for (sea::SurfaceSample& sample : samples) sample.height_m += static_cast<float>(level_m);
}

}  // namespace

absl::StatusOr<std::unique_ptr<LocalSea>> LocalSea::Make(const wire::Welcome& welcome) {
  auto sea = std::unique_ptr<LocalSea>(new LocalSea);
  ONESEA_RETURN_IF_ERROR(sea->Follow(welcome));
  return sea;
}

absl::Status LocalSea::Follow(const wire::Welcome& welcome) {
  absl::MutexLock one_at_a_time(&change_mutex_);
  const std::uint64_t wanted = welcome.session.terrain_hash;
  const std::shared_ptr<const sea::Terrain> terrain =
      wanted != 0 && wanted == terrain_hash_ ? terrain_ : nullptr;
  auto next = std::make_shared<Version>();
  next->session = welcome.session;
  next->water_level = welcome.water_level;
  next->missing_terrain = terrain == nullptr ? wanted : 0;
  const std::shared_ptr<const Version> current = version();
  if (current != nullptr && current->components->hash == welcome.component_hash &&
      current->components->recipe == welcome.recipe &&
      sea::TerrainOf(*current->components) == terrain) {
    next->components = current->components;
    next->snapshots = current->snapshots;
  } else {
    ONESEA_ASSIGN_OR_RETURN(next->components, BuildSameComponents(welcome));
    next->components = sea::OverTerrain(std::move(next->components), terrain);
    next->snapshots = std::make_shared<SnapshotCache>(next->components);
  }
  Install(std::move(next));
  return absl::OkStatus();
}

void LocalSea::SetTerrain(std::shared_ptr<const sea::Terrain> terrain) {
  ONESEA_CHECK(terrain != nullptr);
  absl::MutexLock one_at_a_time(&change_mutex_);
  terrain_ = std::move(terrain);
  terrain_hash_ = sea::TerrainHash(*terrain_);
  const std::shared_ptr<const Version> current = version();
  if (current->missing_terrain == 0 || current->missing_terrain != terrain_hash_) return;
  auto next = std::make_shared<Version>(*current);
  next->components = sea::OverTerrain(std::move(next->components), terrain_);
  next->snapshots = std::make_shared<SnapshotCache>(next->components);
  next->missing_terrain = 0;
  Install(std::move(next));
}

void LocalSea::Install(std::shared_ptr<const Version> next) {
  absl::MutexLock lock(&mutex_);
  version_ = std::move(next);
}

std::uint64_t LocalSea::missing_terrain() const { return version()->missing_terrain; }

std::shared_ptr<const sea::Terrain> LocalSea::terrain() const {
  return sea::TerrainOf(*version()->components);
}

double LocalSea::WaterLevelAt(SimTime time) const {
  return wire::WaterLevelAt(version()->water_level, time);
}

std::shared_ptr<const LocalSea::Version> LocalSea::version() const {
  absl::MutexLock lock(&mutex_);
  return version_;
}

std::shared_ptr<const sea::SeaSnapshot> LocalSea::SnapshotAt(SimTime time,
                                                             sea::QueryDetail detail) const {
  return version()->snapshots->At(time, detail);
}

std::uint32_t LocalSea::Sample(std::span<const Vec2d> places, SimTime time, sea::QueryDetail detail,
                               std::span<sea::SurfaceSample> out) const {
  const std::shared_ptr<const Version> version = this->version();
  version->snapshots->At(time, detail)->Sample(places, out);
  std::uint32_t layers = sea::kLayerSpectral;
  if (TerrainOf(*version->components) != nullptr) layers |= sea::kLayerTerrain;
  const double level_m = wire::WaterLevelAt(version->water_level, time);
  if (level_m == 0.0) return layers;
  AddLevel(level_m, out);
  return layers | sea::kLayerWaterLevel;
}

void LocalSea::SampleAtDepth(std::span<const Vec2d> places, std::span<const double> depth_m,
                             SimTime time, std::span<sea::DepthSample> out) const {
  const std::shared_ptr<const Version> version = this->version();
  // Waves fade from the level on.
  const double level_m = wire::WaterLevelAt(version->water_level, time);
  std::vector<double> below_m(depth_m.begin(), depth_m.end());
  for (double& depth : below_m) depth = std::max(0.0, depth + level_m);
  const auto snapshot = version->snapshots->At(time, sea::QueryDetail::kHeight);
  sea::SampleAtDepth(*version->components, time, places, below_m, out,
                     snapshot->attenuation().get());
}

double LocalSea::HeightAt(Vec2d place, SimTime time) const {
  sea::SurfaceSample sample;
  Sample({&place, 1}, time, sea::QueryDetail::kHeight, {&sample, 1});
  return sample.height_m;
}

double LocalSea::HeightNear(Vec2d place, SimTime time) const {
  std::int64_t step = time.flicks / kLatticeStep.flicks;
  if (time.flicks % kLatticeStep.flicks < 0) --step;
  const SimTime before{step * kLatticeStep.flicks};
  const double share = static_cast<double>((time - before).flicks) / kLatticeStep.flicks;
  const std::shared_ptr<const Version> version = this->version();
  const auto height = [&](SimTime at) {
    sea::SurfaceSample sample;
    version->snapshots->At(at, sea::QueryDetail::kHeight)->Sample({&place, 1}, {&sample, 1});
    return static_cast<double>(sample.height_m);
  };
  const double level_m = wire::WaterLevelAt(version->water_level, time);
  if (share == 0.0) return level_m + height(before);
  return level_m + (1.0 - share) * height(before) + share * height(before + kLatticeStep);
}

absl::StatusOr<double> LocalSea::CompareProbes(const wire::ProbeHeights& probes) {
  const std::shared_ptr<const Version> version = this->version();
  const std::vector<Vec2d>& places = version->session.probes_m;
  if (probes.height_m.size() != places.size()) {
    return absl::InvalidArgumentError(
        absl::StrFormat("probes.height_m has %d values, the session has %d probes",
                        probes.height_m.size(), places.size()));
  }
  if (version->missing_terrain != 0) {
    return absl::FailedPreconditionError("the session's terrain has not come yet");
  }
  const int tick_rate_hz = version->components->recipe.tick_rate_hz;
  if (!IsTickInRange(probes.tick, tick_rate_hz)) {
    return absl::InvalidArgumentError(
        absl::StrFormat("probes.tick is %d, at most %.0f s of sea time either way can be asked",
                        probes.tick, kQueryTimeMaxS));
  }
  const SimTime time = TimeOfTick(probes.tick, tick_rate_hz);
  std::vector<sea::SurfaceSample> samples(places.size());
  version->snapshots->At(time, sea::QueryDetail::kHeight)->Sample(places, samples);
  AddLevel(wire::WaterLevelAt(version->water_level, time), samples);
  double worst_m = 0.0;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const double error_m = std::abs(samples[n].height_m - double{probes.height_m[n]});
    // NaN from the network is as wrong as can be, and must not hide behind a comparison that is
    // false.
    worst_m = std::max(worst_m, std::isnan(error_m) ? HUGE_VAL : error_m);
  }
  absl::MutexLock lock(&mutex_);
  ++drift_.comparisons;
  drift_.last_m = worst_m;
  drift_.worst_m = std::max(drift_.worst_m, worst_m);
  return worst_m;
}

Drift LocalSea::drift() const {
  absl::MutexLock lock(&mutex_);
  return drift_;
}

std::shared_ptr<const sea::Components> LocalSea::components() const {
  return version()->components;
}

SessionInfo LocalSea::session() const { return version()->session; }

std::vector<double> LocalSea::WeatherWeightsAt(SimTime time) const {
  return sea::WeatherWeights(version()->components->recipe, time);
}

double LocalSea::SignificantWaveHeightAt(SimTime time) const {
  return 4.0 * std::sqrt(sea::VarianceAt(*version()->components, time));
}

}  // namespace onesea::client
