#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "client/model/boat_predictor.h"
#include "client/model/helm.h"
#include "client/model/local_world.h"
#include "client/net/command_sender.h"
#include "common/sea/terrain.h"

namespace onesea::client {

/// What a person asks of the sea, beside looking at it.
struct SkipperInput {
  HelmKeys helm = {};                                                  ///< held
  bool spawn = false, crate = false, explode = false, remove = false;  ///< pressed since the last
};

/// Where the camera is and looks.
struct Outlook {
  Vec2d place_m;
  double heading_rad = 0.0;
};

/// For the panel.
struct HelmReport {
  bool aboard = false;
  std::uint32_t boat = 0;
  double throttle = 0.0, rudder = 0.0, speed_m_per_s = 0.0;
  std::string line;  ///< what happened last, or what is wrong; empty: nothing to say
};

/// The person at this viewer: has at most one boat, drives it, drops crates, sets off explosions.
///
/// Ashore --spawn--> launching --answer--> aboard --remove, or the boat vanishes--> ashore.
/// Never waits: commands go by a CommandSender, and what the server answers shows in report(). One
/// thread.
class Skipper {
 public:
  /// `sender` outlives this; null: there is no server, and every wish says so.
  explicit Skipper(CommandSender* sender);
  /// Stops the boat's motor and lets go of its lease; waits for at most a second.
  ~Skipper();
  Skipper(const Skipper&) = delete;
  Skipper& operator=(const Skipper&) = delete;

  struct Moment {
    SimTime now;  ///< of the picture
    int tick_rate_hz = 60;
    double seconds = 0.0;  ///< real ones since the last call
    std::int64_t now_ns = 0;
    const sea::Terrain* terrain = nullptr;  ///< null: water everywhere
  };
  /// Once a picture.
  void Update(const SkipperInput& input, const Outlook& outlook, const WorldView& world,
              const Moment& moment);

  /// The own boat at the moment of the last Update(), to be drawn instead of the streamed one.
  const std::optional<wire::BodyState>& own() const { return own_; }
  HelmReport report() const;

 private:
  enum class Kind : std::uint8_t {
    kSpawn,
    kRegion,
    kOrder,
    kLease,
    kCrate,
    kExplosion,
    kRemove,
    kOther
  };
  struct Boat {
    std::uint32_t id = 0, region = 0;
    std::string lease;
    BoatPredictor predictor;
    Helm helm = {};
    OrderTimer timer = {};
    std::int64_t launched_ns = 0;
    bool seen = false, asks_for_lease = false;
    // The newest order that the server did.
    std::int64_t done_number = 0;
    Tick done_tick = 0;
  };

  void Send(Kind kind, wire::WorldCommand command, bool with_lease = false);
  void TakeOutcomes(const Moment& moment);
  void Done(Kind kind, std::int64_t number, const CommandAnswer& answer, const Moment& moment);
  void Refused(Kind kind, std::int64_t number, const absl::Status& status);
  void AskForLease();
  void Follow(const WorldView& world, const Moment& moment);
  void ObeyKeys(const SkipperInput& input, const Outlook& outlook, const WorldView& world,
                const Moment& moment);
  void Launch(const Outlook& outlook, const WorldView& world, const Moment& moment);
  void Steer(const HelmKeys& keys, const Moment& moment);
  void Say(std::string line);

  CommandSender* const sender_;
  const std::uint32_t colour_rgb_;
  std::map<std::int64_t, Kind> under_way_;
  bool launching_ = false;
  std::unique_ptr<Boat> boat_;
  std::optional<wire::BodyState> own_;
  std::string line_;
  std::int64_t line_until_ns_ = 0, now_ns_ = 0;
};

}  // namespace onesea::client
