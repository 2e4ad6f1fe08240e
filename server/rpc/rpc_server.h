#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "common/base/clock.h"
#include "common/sea/surface.h"

namespace grpc {
class Channel;
}

/// The gRPC server: the service, health, reflection, limits. Nothing of gRPC's shows here but the
/// name of a channel, so that server/app needs none of its headers.
namespace onesea::server {

class Registry;

struct RpcServerOptions {
  std::string listen_address = "127.0.0.1:7310";  ///< port 0: any free one; empty: in process only
  sea::TransformKind transform = sea::TransformKind::kOwn;  ///< of queries
  int watch_shards = 0;  ///< threads that send frames; 0: one less than the machine's cores
};

class RpcServer {
 public:
  /// Unavailable if the address can't be bound. `registry` and `clock` outlive the server.
  static absl::StatusOr<std::unique_ptr<RpcServer>> Start(const RpcServerOptions& options,
                                                          Registry& registry,
                                                          const Clock& clock = SystemClock());
  /// Shuts down.
  ~RpcServer();

  /// Bound; 0 without a listen address.
  int port() const;

  /// A channel without sockets; for tests and for programs that hold the server inside.
  std::shared_ptr<grpc::Channel> InProcessChannel();

  /// Closes every session of the registry (viewers get the farewell), gives calls under way
  /// `grace_s` seconds, then cancels them. Idempotent.
  void Shutdown(double grace_s = 2.0);

 private:
  struct Impl;
  explicit RpcServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace onesea::server
