#pragma once

#include <memory>
#include <string_view>

#include "common/wire/frame.h"
#include "server/world/world.h"

/// How a session's output leaves it.
namespace onesea::server {

/// One tick done, or a heartbeat while the session stands still (then `stamp.tick` is that of the
/// event before).
struct TickEvent {
  wire::Stamp stamp;  ///< always filled in
  bool stream_instant =
      false;  ///< a frame for viewers that asked for every frame: stream_rate_hz of sea time
  bool stamp_instant =
      false;  ///< everybody wants it: once a second of real time (the first also right after
              ///< joining an observer), and whenever pace, speed, schedule or weather changed, and
              ///< at the last tick of every completed lock-step request
  const wire::ProbeHeights* probes =
      nullptr;  ///< set about once a second at a stamp instant; valid during the call
  std::shared_ptr<const world::WorldView> world;  ///< at stamp.tick
  std::shared_ptr<const sea::Components> components;
};

/// Calls of one session come one at a time and in order, with the session's lock held: return
/// quickly (hand over, encode, wake somebody), and never call the SessionLoop from inside.
class SessionObserver {
 public:
  virtual ~SessionObserver() = default;
  /// First call, from inside SessionLoop::AddObserver; then again whenever the weather changed.
  /// What the welcome says of tick and speed holds at that moment.
  virtual void OnWelcomeChanged(std::shared_ptr<const wire::Welcome> welcome) = 0;
  virtual void OnTick(const TickEvent& event) = 0;
  /// Last call.
  virtual void OnClosed(std::string_view reason) = 0;
};

}  // namespace onesea::server
