#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/base/sim_time.h"
#include "common/base/vec.h"
#include "common/sea/interaction_field.h"
#include "common/wire/body_table.h"
#include "common/wire/tile_store.h"

namespace onesea::client {

/// The interaction layer as streamed, over a while. Cheap to copy: fields are shared.
///
/// Problem: news of wakes are a frame and half a round trip old, and some regions come with every
/// other frame only. Idea: between news linear in time; after the last ones on by the last change,
/// for regions that changed in each of the last two updates (of one that comes rarely the change
/// took longer than a frame); by no more than kAheadUpdates, then standing still, then fading. A
/// boat at 5 m/s: 0.3 mm rms off around it, standing still at once 1.5 mm.
class WakeHistory {
 public:
  static constexpr double kAheadUpdates = 2.0;  ///< errors of a step become five at most
  static constexpr double kAheadMaxS = 0.1;
  /// So long after the last news the layer stands, and within as much again it fades away.
  static constexpr double kStandsS = wire::BodyTable::kExtrapolationMaxS;

  /// The layer at some time; points into the history.
  struct Moment {
    const sea::InteractionSnapshot* before = nullptr;  ///< null: nothing is known, or there is none
    const sea::InteractionSnapshot* after = nullptr;   ///< may be the same
    double share = 0.0;                                ///< of the way from one to the other, [0, 1]
    double strength = 1.0;                             ///< less than 1: fading
    /// After the last news: what the regions that go on were and are, and how many such steps on.
    const sea::InteractionSnapshot* was = nullptr;
    const sea::InteractionSnapshot* is = nullptr;
    double ahead = 0.0;
    /// Bound [m] of |height - the server's| at the time of an update, in regions that come with
    /// every frame; waves of ω add (ω span)²/8 of themselves in the middle of two.
    double height_error_m = 0.0;
    explicit operator bool() const { return before != nullptr; }
  };

  WakeHistory();

  Moment MomentAt(SimTime time) const;
  /// At a place, to be added to the spectral sea. Velocities are not streamed: 0.
  static sea::InteractionSample SampleAt(const Moment& moment, Vec2d place);

  /// A field that did not change is the same object as in the update before.
  const std::shared_ptr<const sea::InteractionSnapshot>& newest() const {
    return updates_.back().snapshot;
  }
  SimTime time() const { return updates_.back().time; }  ///< of the last update

  /// Forgets all: the next update begins anew.
  void Clear() { updates_.clear(); }
  /// The fields at `time`, not before the last update's. Keeps what is needed for `past`, and the
  /// last two at least.
  void Add(SimTime time, std::span<const wire::RegionField> fields, SimTime past);

 private:
  struct Region {
    std::uint32_t id = 0;
    std::shared_ptr<const sea::InteractionField> field;
    bool changed = false;  // since the update before; a new one has not
  };
  struct Update {
    SimTime time;
    std::shared_ptr<const sea::InteractionSnapshot> snapshot;
    std::vector<Region> regions;  // those of the snapshot
    std::shared_ptr<const sea::InteractionSnapshot> was, is;
    double height_error_m = 0.0;
  };
  const Update* Last() const;  // null: none
  Update Compared(std::span<const wire::RegionField> fields) const;
  const Region* Find(std::uint32_t id) const;  // of the last update; null: none
  Moment AfterLast(SimTime time) const;

  std::vector<Update> updates_;  // ascending times; empty only between Clear() and Add()
};

}  // namespace onesea::client
