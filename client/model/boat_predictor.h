#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "client/model/boat_figures.h"
#include "client/model/helm.h"
#include "common/base/sim_time.h"
#include "common/wire/body_state.h"

/// The driver's own boat at the present time.
///
/// Problem: what the server says of a boat is as old as the way from there, and an order acts a
/// whole round trip before the driver sees it: a boat driven from afar feels asleep.
/// Idea: go on from the last state with the orders given since, by the same kind of equations that
/// the server has (boat_figures.h). An order acts here from the moment it is given; once the server
/// has told at which tick it acted there, from that tick. So the boat answers at once, by as much
/// as it will answer in the time that the news need, and then goes as the server's boat does.
/// What the equations get wrong (a hull's lift, waves, current) shows as an acceleration that the
/// states have and the equations don't; its running mean over kLearnS is added. What news change is
/// not jumped to but eased into, over kEaseS.
/// Limits: good for round trips below half a second; a collision is seen when the news come; heave
/// and tilt go on by their velocities, fading.
///
/// Pure; one thread. Times are sea times.
namespace onesea::client {

class BoatPredictor {
 public:
  static constexpr double kLearnS = 0.25;
  static constexpr double kEaseS = 0.08;
  static constexpr double kAheadMaxS = 1.5;  ///< older news are shown standing, as all bodies are
  static constexpr double kEaseMaxM = 3.0;   ///< farther is another place: no easing

  explicit BoatPredictor(const BoatFigures& figures) : figures_(figures) {}

  /// An order given at `time`. Numbers ascend; so do times.
  void Give(std::int64_t number, SimTime time, const HelmOrder& order);
  /// The server did it: it acts from `time` on.
  void Confirm(std::int64_t number, SimTime time);
  /// It never acts: refused, or replaced by a newer one before it was sent.
  void Withdraw(std::int64_t number);
  /// The server's boat at `time`; older than what is known is ignored.
  void Learn(SimTime time, const wire::BodyState& state);

  bool ready() const { return anchor_.has_value(); }
  /// The boat at `time`, as it is to be drawn. Times ascend from call to call. Pre: ready().
  wire::BodyState At(SimTime time);

 private:
  struct Given {
    std::int64_t number = 0;
    SimTime given;
    std::optional<SimTime> acts;  // none: not known yet
    HelmOrder order;
  };
  struct Anchor {
    SimTime time;
    wire::BodyState state;
    BoatDrive drive;
  };
  struct Offset {
    Vec3d place_m, turn_rad;  // what is shown minus what is reckoned
  };

  BoatDrive DriveAt(SimTime time) const;
  wire::BodyState Reckon(SimTime time) const;
  void Settle(SimTime time);
  template <typename Change>
  void Ease(const Change& change);

  const BoatFigures figures_;
  std::deque<Given> given_;
  // Before everything in given_.
  SimTime settled_time_;
  BoatDrive settled_;
  HelmOrder settled_order_;
  std::optional<Anchor> anchor_;
  PlaneMotion missing_;  // acceleration that the equations lack
  std::optional<SimTime> shown_;
  Offset offset_;
};

}  // namespace onesea::client
