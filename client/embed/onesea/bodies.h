#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"

/// What floats on a session's sea: see all of it, command your own.
///
/// World frame as in onesea.h. Body frame: x forward, y to port, z up, from the hull's origin,
/// which isn't the centre of mass.
namespace onesea {

struct Body {
  std::uint32_t id = 0;
  std::string name;
  std::string owner;                 ///< who brought it; empty: the session's file
  double position_m[3] = {0, 0, 0};  ///< of the centre of mass
  double turn[4] = {1, 0, 0, 0};     ///< body to world: unit quaternion w, x, y, z
  double velocity_m_per_s[3] = {0, 0, 0};
  double spin_rad_per_s[3] = {0, 0, 0};    ///< world frame
  double centre_of_mass_m[3] = {0, 0, 0};  ///< body frame
  double mass_kg = 0.0;

  /// Where in the world a point of the body frame is.
  void PointOf(double forward_m, double port_m, double up_m, double (&world_m)[3]) const;
  /// Of the bow, counter-clockwise from east.
  double HeadingRad() const;
};

struct SpawnOptions {
  std::string preset = "boat";  ///< one that `onesea presets` lists
  double x_m = 0.0, y_m = 0.0;  ///< it starts afloat
  double heading_rad = 0.0;     ///< of the bow, counter-clockwise from east
  std::string name = {};        ///< for people; at most 64 bytes
  bool wake = true;             ///< a region of the interaction layer goes with it
};

/// A body that this process commands. It holds the body's lease, so nobody else does, and asks for
/// it again if a lost connection let it run out. No call waits for the server, so a game may make
/// them in its frame; what the server said shows in status(). Thread-safe.
///
/// Letting go (the destructor): its motors stop, the lease ends, the body stays. After its Sea it
/// does nothing any more.
class OwnBody {
 public:
  virtual ~OwnBody() = default;

  /// For Sea::FindBody(); 0 until the server has made it: a round trip and a tick.
  virtual std::uint32_t id() const = 0;
  /// OK: it is there and obeys. Unavailable: the server has not answered yet, or can't be reached.
  /// NotFound: it is gone. Else why the server refused: PermissionDenied names the holder.
  virtual absl::Status status() const = 0;

  /// Both in [-1, 1]; positive rudder turns to port. Holds until the next one; of orders closer
  /// than 50 ms the last one goes. Every motor and every rudder gets the same. InvalidArgument.
  virtual absl::Status Drive(double throttle, double rudder) = 0;
  /// A kick at the centre of mass [N s], world frame, each within ±1e9. InvalidArgument.
  virtual absl::Status Impulse(double x, double y, double z) = 0;
  /// Takes it out of the water, with the region of its wake.
  virtual void Remove() = 0;
};

}  // namespace onesea
