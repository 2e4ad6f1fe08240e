#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "client/model/wake_history.h"
#include "common/base/sim_time.h"
#include "common/sea/interaction_field.h"
#include "common/wire/body_table.h"
#include "common/wire/frame.h"
#include "common/wire/tile_store.h"

namespace onesea::client {

/// What the server alone computes, at one moment: interaction layer and bodies. Immutable; a
/// renderer takes one per picture.
class WorldView {
 public:
  /// The interaction layer, of some time.
  const WakeHistory& wakes() const { return wakes_; }

  /// Heights and foam of the last update; for renderers that make textures of them.
  const sea::InteractionSnapshot& interaction() const { return *wakes_.newest(); }
  std::shared_ptr<const sea::InteractionSnapshot> shared_interaction() const {
    return wakes_.newest();
  }
  /// One's place and motion at a time: Body::At. Ascending by id.
  std::span<const wire::BodyTable::Body> bodies() const { return bodies_.bodies(); }
  const wire::BodyTable::Body* FindBody(std::uint32_t id) const { return bodies_.Find(id); }
  double water_level_m() const { return water_level_m_; }
  /// Ids ascending. Ends may be on bodies that aren't there: see RopesAt().
  std::span<const wire::TiedRope> ropes() const { return *ropes_; }
  SimTime time() const { return wakes_.time(); }  ///< of the last update

 private:
  friend class LocalWorld;
  WakeHistory wakes_;
  wire::BodyTable bodies_;
  double water_level_m_ = 0.0;
  wire::RopeList ropes_ = std::make_shared<const std::vector<wire::TiedRope>>();
};

/// Follows the world of one session from the frames of a Watch with `every_frame`.
///
/// Thread-safe: the network thread applies, render and game threads ask.
class LocalWorld {
 public:
  /// Keeps the interaction layer of the last `past` of sea time (8 bytes a cell and update), and
  /// the last two updates at least.
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
