#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "common/base/sim_time.h"
#include "common/base/vec.h"
#include "common/sea/interaction_field.h"
#include "common/wire/body_table.h"
#include "common/wire/frame.h"
#include "common/wire/tile_store.h"

namespace onesea::client {

/// What the server alone computes, at one moment: interaction layer and bodies. Immutable; a
/// renderer takes one per picture.
class WorldView {
 public:
  /// Nothing is known of the time after the last update: the layer stands still for so long, then
  /// it fades away within as much again.
  static constexpr double kStandsS = wire::BodyTable::kExtrapolationMaxS;

  /// The interaction layer at some time, linear between the updates that are kept; points into the
  /// view.
  struct Moment {
    const sea::InteractionSnapshot* before = nullptr;  ///< null: nothing is known, or there is none
    const sea::InteractionSnapshot* after = nullptr;   ///< may be the same
    double share = 0.0;                                ///< of the way from one to the other, [0, 1]
    double strength = 1.0;                             ///< less than 1: fading
    /// Bound [m] of |height - the server's| at the time of an update, in regions that come with
    /// every frame; waves of ω add (ω span)²/8 of themselves in the middle of two.
    double height_error_m = 0.0;
    explicit operator bool() const { return before != nullptr; }
  };
  Moment MomentAt(SimTime time) const;
  /// At a place, to be added to the spectral sea. Velocities are not streamed: 0.
  static sea::InteractionSample SampleAt(const Moment& moment, Vec2d place);

  /// Heights and foam of the last update; for renderers that make textures of them.
  const sea::InteractionSnapshot& interaction() const { return *layers_.back().snapshot; }
  std::shared_ptr<const sea::InteractionSnapshot> shared_interaction() const {
    return layers_.back().snapshot;
  }
  /// One's place and motion at a time: Body::At. Ascending by id.
  std::span<const wire::BodyTable::Body> bodies() const { return bodies_.bodies(); }
  const wire::BodyTable::Body* FindBody(std::uint32_t id) const { return bodies_.Find(id); }
  double water_level_m() const { return water_level_m_; }
  /// Ids ascending. Ends may be on bodies that aren't there: see RopesAt().
  std::span<const wire::TiedRope> ropes() const { return *ropes_; }
  SimTime time() const { return layers_.back().time; }  ///< of the last update

 private:
  friend class LocalWorld;
  struct Layer {
    SimTime time;
    std::shared_ptr<const sea::InteractionSnapshot> snapshot;
    double height_error_m = 0.0;
  };
  // Of every update that is kept, ascending times; never empty.
  std::vector<Layer> layers_ = {{{}, std::make_shared<const sea::InteractionSnapshot>(), 0.0}};
  wire::BodyTable bodies_;
  double water_level_m_ = 0.0;
  wire::RopeList ropes_ = std::make_shared<const std::vector<wire::TiedRope>>();
};

/// Follows the world of one session from the frames of a Watch with `every_frame`.
///
/// Thread-safe: the network thread applies, render and game threads ask.
class LocalWorld {
 public:
  /// Keeps the interaction layer of the last `past` of sea time (4 bytes a cell and update, 8 with
  /// foam), and the last two updates at least.
  explicit LocalWorld(SimTime past = {}) : past_(past) {}

  /// Frames must come in order. A keyframe replaces everything, and without a world it empties
  /// everything. An error (InvalidArgument: bytes that no server sends; FailedPrecondition: a frame
  /// that is missing) leaves the view as it was and the world not current() until a keyframe
  /// comes: watch anew. Pre: IsTickRateExact(tick_rate_hz).
  absl::Status Apply(const wire::Frame& frame, int tick_rate_hz);

  /// Has it a keyframe and everything since?
  bool current() const;
  /// Never null.
  std::shared_ptr<const WorldView> view() const;
  /// Spray since the last call, oldest first; beyond kSprayMax the oldest are gone.
  std::vector<wire::Spray> TakeSpray();

 private:
  absl::Status ApplyWorld(const wire::WorldUpdate& update, bool keyframe, int tick_rate_hz)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void AddLayer(WorldView::Layer layer, WorldView& view) const;
  void AddSpray(const std::vector<wire::Spray>& spray) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const SimTime past_;
  mutable absl::Mutex mutex_;
  wire::TileStore tiles_ ABSL_GUARDED_BY(mutex_);
  std::shared_ptr<const WorldView> view_ ABSL_GUARDED_BY(mutex_) =
      std::make_shared<const WorldView>();
  std::vector<wire::Spray> spray_ ABSL_GUARDED_BY(mutex_);
  bool current_ ABSL_GUARDED_BY(mutex_) = false;
};

}  // namespace onesea::client
