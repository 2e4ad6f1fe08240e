#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client/render/render_frame.h"
#include "common/sea/components.h"
#include "common/sea/foam.h"
#include "common/sea/interaction_field.h"
#include "common/sea/point_query.h"
#include "common/sea/surface.h"
#include "common/sea/terrain.h"

namespace onesea::client {

/// Figures of the sea for the panel.
struct SeaFigures {
  std::string name;
  double hs_m = 0.0;
  double tp_s = 0.0;  ///< of the highest bin of `density_m2_per_hz`
  double wind_speed_m_per_s = 0.0;
  static constexpr int kBins = 60;
  static constexpr double kBinHz = 0.01;
  std::vector<float> density_m2_per_hz;  ///< (kBins) of the components, frequency without current
};

/// From components and a time to the fields of a RenderFrame: synthesis, foam, wind. One thread.
class FrameBuilder {
 public:
  /// `grid_size` N of the synthesis: 64, 128, ..., 1024.
  explicit FrameBuilder(int grid_size) : grid_size_(grid_size) {}

  /// Fills the sea's part of `frame` (waves, foam, wind, time, and the terrain of the components);
  /// the camera's place must be set. The frame borrows from this object until the next call. Cost:
  /// about 5 ms at N = 256; the first call and each change of weather: up to 1 s for the foam's
  /// past.
  void Fill(const std::shared_ptr<const sea::Components>& components, SimTime time,
            render::RenderFrame& frame);

  /// From the next Fill() on, adds these wakes and splashes (null: none) to the picture and to
  /// HeightAt(). A field that the last snapshot held too is not uploaded anew.
  void SetInteraction(std::shared_ptr<const sea::InteractionSnapshot> interaction);

  void SetWaterLevel(double level_m) { water_level_m_ = level_m; }

  /// Height of the sea at a place at the time of the last Fill().
  double HeightAt(Vec2d place);

  SeaFigures Figures() const;

 private:
  void Adopt(const std::shared_ptr<const sea::Components>& components);
  void FillWeather(render::RenderFrame& frame) const;
  void FillPatches(render::RenderFrame& frame) const;

  int grid_size_;
  SimTime time_;
  std::shared_ptr<const sea::Components> components_;
  std::vector<sea::Synthesiser> synthesisers_;
  std::vector<sea::CascadeFields> fields_;
  std::unique_ptr<sea::FoamWindow> foam_;
  std::unique_ptr<sea::SnapshotBuilder> snapshots_;
  std::shared_ptr<const sea::SeaSnapshot> snapshot_;
  std::shared_ptr<const sea::InteractionSnapshot> interaction_;
  std::vector<std::uint64_t> versions_;  // of each field of interaction_
  std::uint64_t last_version_ = 0;
  double water_level_m_ = 0.0;
};

}  // namespace onesea::client
