#include "client/app/frame_builder.h"

#include <algorithm>
#include <cmath>

#include "common/sea/attenuation.h"
#include "common/sea/constants.h"

namespace onesea::client {
namespace {

constexpr sea::FoamWindowOptions kFoamOptions;

}  // namespace

void FrameBuilder::Adopt(const std::shared_ptr<const sea::Components>& components) {
  if (components == components_) return;
  components_ = components;
  synthesisers_.clear();
  fields_.clear();
  for (int c = 0; c < static_cast<int>(components->cascades.size()); ++c) {
    synthesisers_.emplace_back(components, c, grid_size_, sea::kRenderFields);
    fields_.emplace_back(grid_size_, sea::kRenderFields);
  }
  foam_ = std::make_unique<sea::FoamWindow>(components, kFoamOptions);
  snapshots_ = std::make_unique<sea::SnapshotBuilder>(components);
  snapshot_ = nullptr;
}

void FrameBuilder::FillWeather(render::RenderFrame& frame) const {
  const sea::Recipe& recipe = components_->recipe;
  const std::vector<double> weights = sea::WeatherWeights(recipe, time_);
  double unresolved_mss = 0.0;
  for (std::size_t n = 0; n < weights.size(); ++n) {
    unresolved_mss += weights[n] * components_->unresolved_mss[n];
  }
  const Vec2d wind = sea::WindAt(recipe, time_);
  frame.weather.wind_speed_m_per_s = Norm(wind);
  frame.weather.wind_to_rad = std::atan2(wind.y, wind.x);
  frame.unresolved_mss = unresolved_mss;
  frame.regular_waves.clear();
  for (const sea::RegularComponent& wave : components_->regular) {
    double variance = 0.0;
    for (std::size_t n = 0; n < weights.size(); ++n) variance += weights[n] * wave.variance_m2[n];
    const std::uint64_t turns =
        wave.phase_turns - wave.turns_per_flick * static_cast<std::uint64_t>(time_.flicks);
    frame.regular_waves.push_back({wave.kx_rad_per_m, wave.ky_rad_per_m, std::sqrt(2.0 * variance),
                                   2.0 * sea::kPi * 0x1p-64 * static_cast<double>(turns)});
  }
}

void FrameBuilder::SetInteraction(std::shared_ptr<const sea::InteractionSnapshot> interaction) {
  std::vector<std::uint64_t> versions;
  if (interaction != nullptr) {
    for (const auto& field : interaction->fields) {
      std::uint64_t version = 0;
      for (std::size_t n = 0; n < versions_.size(); ++n) {
        if (interaction_->fields[n] == field) version = versions_[n];
      }
      versions.push_back(version != 0 ? version : ++last_version_);
    }
  }
  interaction_ = std::move(interaction);
  versions_ = std::move(versions);
}

void FrameBuilder::FillPatches(render::RenderFrame& frame) const {
  frame.patches.clear();
  for (std::size_t n = 0; n < versions_.size(); ++n) {
    const sea::InteractionField& field = *interaction_->fields[n];
    const sea::CellRect& cells = field.cells;
    const auto foam =
        field.foam != nullptr ? std::span<const float>(*field.foam) : std::span<const float>();
    frame.patches.push_back({cells.PlaceOf(cells.west, cells.south), cells.cell_m, cells.columns,
                             cells.rows, versions_[n], field.height_m, foam});
  }
}

void FrameBuilder::Fill(const std::shared_ptr<const sea::Components>& components, SimTime time,
                        render::RenderFrame& frame) {
  Adopt(components);
  time_ = time;
  snapshot_ = nullptr;
  frame.cascades.clear();
  for (std::size_t c = 0; c < synthesisers_.size(); ++c) {
    synthesisers_[c].Evaluate(time, fields_[c]);
    frame.cascades.push_back(render::PlanesOf(fields_[c], components->recipe.cascades[c]));
  }
  foam_->MoveTo(time, {frame.camera.position_m.x, frame.camera.position_m.y});
  frame.foam = {foam_->Cells(), kFoamOptions.cells, kFoamOptions.cell_m, foam_->OriginM()};
  frame.time_s = time.Seconds();
  frame.seed = components->recipe.seed;
  frame.choppiness = components->recipe.choppiness;
  FillWeather(frame);
  FillPatches(frame);
  frame.terrain = sea::TerrainOf(*components);
  frame.attenuation = snapshots_->AttenuationAt(time);
  frame.water_level_m = water_level_m_;
}

double FrameBuilder::HeightAt(Vec2d place) {
  if (snapshots_ == nullptr) return 0.0;
  if (snapshot_ == nullptr) snapshot_ = snapshots_->At(time_, sea::QueryDetail::kHeight);
  sea::SurfaceSample sample;
  snapshot_->Sample({&place, 1}, {&sample, 1});
  const double height_m = water_level_m_ + sample.height_m;
  if (interaction_ == nullptr) return height_m;
  return height_m + sea::SampleInteraction(*interaction_, place).height_m;
}

SeaFigures FrameBuilder::Figures() const {
  SeaFigures figures;
  if (components_ == nullptr) return figures;
  const std::vector<double> weights = sea::WeatherWeights(components_->recipe, time_);
  std::vector<double> variance(SeaFigures::kBins, 0.0);
  const auto add = [&](double rad_per_s, double m2) {
    const int bin = static_cast<int>(std::abs(rad_per_s) / (2.0 * sea::kPi) / SeaFigures::kBinHz);
    if (bin < SeaFigures::kBins) variance[static_cast<std::size_t>(bin)] += m2;
  };
  for (std::size_t m = 0; m < weights.size(); ++m) {
    for (const sea::CascadeComponents& cascade : components_->cascades) {
      for (std::size_t n = 0; n < cascade.i.size(); ++n) {
        add(cascade.intrinsic_rad_per_s[n], weights[m] * cascade.variance_m2[m][n]);
      }
    }
    for (const sea::RegularComponent& wave : components_->regular) {
      add(wave.intrinsic_rad_per_s, weights[m] * wave.variance_m2[m]);
    }
  }
  for (double m2 : variance) {
    figures.density_m2_per_hz.push_back(static_cast<float>(m2 / SeaFigures::kBinHz));
  }
  const auto peak = std::max_element(variance.begin(), variance.end()) - variance.begin();
  figures.tp_s = 1.0 / ((static_cast<double>(peak) + 0.5) * SeaFigures::kBinHz);
  figures.hs_m = 4.0 * std::sqrt(sea::VarianceAt(*components_, time_));
  const auto heaviest = std::max_element(weights.begin(), weights.end()) - weights.begin();
  const sea::SeaState& sea = components_->recipe.timeline[static_cast<std::size_t>(heaviest)].sea;
  figures.name = sea.name;
  figures.wind_speed_m_per_s = sea.wind_speed_m_per_s;
  return figures;
}

}  // namespace onesea::client
