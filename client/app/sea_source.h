#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/app/mesh_fetcher.h"
#include "client/model/local_world.h"
#include "client/net/command_sender.h"
#include "common/base/sim_time.h"
#include "common/sea/components.h"
#include "common/wire/session_spec.h"

namespace onesea::client {

/// What the panel tells about where the sea comes from.
struct SourceReport {
  std::string where;  ///< "127.0.0.1:7310, session storm" or the file's name
  std::string link;   ///< "live", "waiting: ...", "offline"
  std::int64_t tick = 0;
  double speed = 1.0;
  double drift_m = -1.0;      ///< worst probe of the last comparison; negative: none yet
  std::string trouble;        ///< what can't be drawn, and why; empty: nothing
  double clock_error_s = -1;  ///< bound of the server clock's estimate; negative: own clock
};

/// A sea to look at. One thread uses it; implementations may have others behind.
class SeaSource {
 public:
  virtual ~SeaSource() = default;
  /// The waves in force, over their terrain if there is one (`attenuation`); another object after a
  /// change of weather and when the terrain has come.
  virtual std::shared_ptr<const sea::Components> components() const = 0;
  /// Mean level of the whole sea [m], to be added to every height.
  virtual double WaterLevelAt(SimTime /*time*/) const { return 0.0; }
  /// Wakes and bodies; null: this source has none.
  virtual std::shared_ptr<const WorldView> world() const { return nullptr; }
  /// The way for commands; null: there is none. Lives as long as this.
  virtual CommandSender* commands() { return nullptr; }
  /// Hulls from files; null: there are none. Lives as long as this.
  virtual MeshFetcher* meshes() { return nullptr; }
  /// Spray since the last call.
  virtual std::vector<wire::Spray> TakeSpray() { return {}; }
  /// The moment to draw now.
  virtual SimTime Now() = 0;
  virtual SourceReport Report() = 0;
  /// OK, or why this sea can't be followed any more.
  virtual absl::Status status() const = 0;
};

/// A session file, played from its tick 0 by this machine's clock; no server.
absl::StatusOr<std::unique_ptr<SeaSource>> OpenSessionFile(const std::string& path);

/// A session of a server; `session` empty: its only one. Waits up to 10 s for the welcome.
absl::StatusOr<std::unique_ptr<SeaSource>> JoinServer(const std::string& address,
                                                      const std::string& session);

}  // namespace onesea::client
