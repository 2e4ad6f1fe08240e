#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "common/wire/session_spec.h"
#include "common/wire/world_update.h"

/// Frames of the Watch stream: domain structs and their bytes (proto onesea.v1.WatchResponse).
namespace onesea::wire {

struct Stamp {
  Tick tick = 0;
  std::int64_t server_monotonic_ns = 0;  ///< when `tick` was due, server's clock
  double speed = 1.0;  ///< sea seconds per real second from here on; 0 when held or in lock-step
  Pace pace = Pace::kRealTime;
  double actual_speed = 1.0;
};

struct ProbeHeights {
  Tick tick = 0;
  std::vector<float> height_m;
};

struct Welcome {
  sea::Recipe recipe;
  std::uint64_t component_hash = 0;
  SessionInfo session;
  std::vector<WaterLevel> water_level;  ///< see WaterLevelAt()
};

struct Frame {
  std::int64_t sequence = 0;
  bool keyframe = false;
  std::optional<Stamp> stamp;
  std::optional<ProbeHeights> probes;
  std::optional<Welcome> welcome;
  std::optional<std::string> farewell;
  std::optional<WorldUpdate> world;  ///< for viewers of every frame
};

std::string EncodeFrame(const Frame& frame);

/// InvalidArgument (DataLoss for bytes that do not parse) naming the field; never crashes on
/// hostile bytes. A welcome's recipe is validated; the packed parts of `world` are checked by those
/// who apply them.
absl::StatusOr<Frame> DecodeFrame(std::string_view bytes);

}  // namespace onesea::wire
