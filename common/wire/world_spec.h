#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "common/base/quaternion.h"
#include "common/base/sim_time.h"
#include "common/base/vec.h"
#include "common/wire/body_description.h"

/// What a session's world begins with.
namespace onesea::wire {

/// Where a body is and how it moves; world frame.
struct Kinematics {
  Vec3d position_m;  ///< centre of mass
  Quaternion turn;   ///< body to world, unit
  Vec3d velocity_m_per_s;
  Vec3d spin_rad_per_s;
  friend bool operator==(const Kinematics&, const Kinematics&) = default;
};

/// Regions with larger cells are far from anybody: unless told otherwise they come to viewers in
/// these steps and with every so manieth frame.
inline constexpr double kFarCellM = 1.0;
inline constexpr double kFarHeightStepM = 4e-3;
inline constexpr int kFarFramesPerUpdate = 3;

/// What those ask for who spawn a boat for somebody: whoever leaves his boat gives its region back.
inline constexpr double kRestAfterS = 60.0;

enum class RegionSolver : std::uint8_t { kIwave = 1, kWaveEquation = 2, kShallowWater = 3 };

/// A region of the interaction layer as it is asked for.
struct RegionSpec {
  RegionSolver solver = RegionSolver::kIwave;
  Vec2d middle_m;                 ///< rounded to whole cells by the server
  int columns = 256, rows = 256;  ///< multiples of kRegionSideStep
  double cell_m = 0.5;
  std::uint32_t follow_body_id = 0;  ///< the middle follows this body; 0: it stands
  double damping_per_s = 0.0;        ///< [0, 10], of energy, beside what every region has
  double height_step_m = 1e-3;       ///< on the wire: viewers are within one step
  int frames_per_update = 1;         ///< tiles go with every so manieth streamed frame, [1, 60]
  double rain_drops_per_m2_s = 0.0;  ///< [0, kRainMaxPerM2S]
  double rest_after_s = 0.0;  ///< [0, kRestAfterMaxS]; > 0: given back while its body is at rest
  friend bool operator==(const RegionSpec&, const RegionSpec&) = default;
};

struct StartBody {
  BodyDescription body;
  Kinematics start;
  friend bool operator==(const StartBody&, const StartBody&) = default;
};

struct WaterLevel {
  double time_s = 0.0;   ///< sea seconds since tick 0
  double level_m = 0.0;  ///< ±kWaterLevelMaxM
  friend bool operator==(const WaterLevel&, const WaterLevel&) = default;
};

struct RopeEnd {
  std::uint32_t body_id = 0;  ///< 0: `point_m` stands still in the world
  Vec3d point_m;              ///< body frame, or world
  friend bool operator==(const RopeEnd&, const RopeEnd&) = default;
};

/// A mooring line or a tow rope: a spring that only pulls.
struct RopeSpec {
  RopeEnd from, to;
  double length_m = 10.0;          ///< slack below; (0, 10000]
  double stiffness_n_per_m = 1e4;  ///< (0, 1e9]
  double damping_n_s_per_m = 1e3;  ///< [0, 1e9] while taut
  friend bool operator==(const RopeSpec&, const RopeSpec&) = default;
};

/// One that is tied.
struct TiedRope {
  std::uint32_t id = 0;  ///< > 0
  RopeSpec spec;
  friend bool operator==(const TiedRope&, const TiedRope&) = default;
};

struct WorldSpec {
  std::string terrain_path;                ///< a file beside the server; empty: no terrain
  std::vector<RegionSpec> regions;         ///< follow_body_id counts `bodies` from 1
  std::vector<StartBody> bodies;           ///< they get the ids 1, 2, ...
  std::vector<WaterLevel> water_level;     ///< ascending times; linear between, constant outside
  std::optional<Vec2d> body_wind_m_per_s;  ///< where it blows to; none: the sea's wind
  std::vector<RopeSpec> ropes;             ///< between `bodies`, counted from 1
  bool empty() const { return *this == WorldSpec{}; }
  friend bool operator==(const WorldSpec&, const WorldSpec&) = default;
};

/// InvalidArgument naming field, value and limit, each field after `prefix`.
absl::Status ValidateKinematics(const std::string& prefix, const Kinematics& kinematics);
absl::Status ValidateRegionSpec(const std::string& prefix, const RegionSpec& region);
absl::Status ValidateWaterLevel(const std::string& prefix, std::span<const WaterLevel> levels);
/// Also for ends on one and the same body, or both in the world.
absl::Status ValidateRopeSpec(const std::string& prefix, const RopeSpec& rope);
absl::Status ValidateWorldSpec(const std::string& prefix, const WorldSpec& world);

/// Of the whole sea above the mean [m]: linear between entries, constant outside, 0 without any.
/// The same bits on every machine. Pre: ValidateWaterLevel() is OK.
double WaterLevelAt(std::span<const WaterLevel> levels, SimTime time);

}  // namespace onesea::wire
