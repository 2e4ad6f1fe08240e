#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "client/model/local_world.h"
#include "client/net/command_sender.h"
#include "common/wire/world_command.h"
#include "onesea/bodies.h"

namespace onesea::client {

/// The bodies that this process commands in one session, on a thread of their own. Threads and
/// connection come with the first body. Thread-safe.
class Fleet {
 public:
  using View = std::function<std::shared_ptr<const WorldView>()>;

  /// `call` as CommandSender's; `view` is asked from any thread, never after the destructor.
  Fleet(std::string session, CommandSender::Call call, View view);
  /// Lets go of every body; waits for that for at most kPartingS, and for calls under way.
  ~Fleet();

  /// Neither waits. Pre: valid (wire::ValidateCommand).
  std::unique_ptr<OwnBody> Spawn(wire::SpawnBody spawn, bool wake);
  std::unique_ptr<OwnBody> Take(std::uint32_t id, std::string holder);

 private:
  static constexpr double kPartingS = 0.5;
  struct Shared;
  class Body;

  template <typename... Arguments>
  std::unique_ptr<OwnBody> Add(Arguments&&... arguments);
  void Run();

  const std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace onesea::client
