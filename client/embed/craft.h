#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "client/model/helm.h"
#include "client/model/local_world.h"
#include "client/net/command_sender.h"

namespace onesea::client {

/// What it takes to command one body: its lease, kept and asked for again; its orders, as often as
/// they are needed; the region of its wake.
///
///   asked --answer--> held --released, removed, vanished--> over
///   asked --refusal--> over
///
/// Commands leave by `send`, which is as CommandSender::Send; outcomes and times are arguments. Not
/// thread-safe.
class Craft {
 public:
  using Send = std::function<std::int64_t(wire::WorldCommand command, std::string lease)>;

  /// Asks for a new body, for `spawn.body.owner`.
  Craft(Send send, wire::SpawnBody spawn, bool wake);
  /// Asks for the lease of one that is there.
  Craft(Send send, std::uint32_t id, std::string holder);

  // What is said before the answer has come waits for it.
  void Drive(const HelmOrder& order) { order_ = order; }
  void Impulse(Vec3d impulse_n_s);
  void Remove() { remove_ = true; }
  /// Stops the motors, then lets go of the lease.
  void LetGo() { parting_ = true; }

  /// Sends what is due. Often, and after each of the above for no delay.
  void Advance(std::int64_t now_ns, const WorldView& world);
  /// False: the outcome isn't of a command of this craft.
  bool Take(const CommandSender::Outcome& outcome);

  std::uint32_t id() const { return id_; }  ///< 0: not known yet
  bool over() const { return over_ && under_way_.empty(); }
  /// OK while it is held and obeys; Unavailable while asked; else why not.
  const absl::Status& status() const { return status_; }

 private:
  enum class Kind : std::uint8_t {
    kSpawn,
    kLease,
    kRegion,
    kOrder,
    kImpulse,
    kRemove,
    kRelease,
    kOther
  };

  void Order(Kind kind, wire::WorldCommand command);
  void Done(Kind kind, std::int64_t number, const CommandAnswer& answer);
  void Refused(Kind kind, const absl::Status& status);
  void AskForLease();
  void Part();
  void End(absl::Status status);
  bool IsUnderWay(Kind kind) const;

  const Send send_;
  const std::string holder_;
  const bool wake_;
  std::map<std::int64_t, Kind> under_way_;
  std::uint32_t id_ = 0, region_ = 0;
  std::string lease_;
  bool held_ = false, seen_ = false, over_ = false;
  bool remove_ = false, parting_ = false, stopped_ = false;
  absl::Status status_;
  std::optional<HelmOrder> order_;
  OrderTimer timer_;
  std::vector<Vec3d> impulses_n_s_;
  std::optional<std::int64_t> renewed_ns_;  // the lease, of a body that is given no orders
  // The newest order that the server did.
  std::int64_t done_number_ = 0;
  Tick done_tick_ = 0;
};

}  // namespace onesea::client
