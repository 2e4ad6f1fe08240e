#include "client/net/channel.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>

namespace onesea::client {

ChannelFactory ConnectTo(std::string address) {
  return [address = std::move(address)] {
    grpc::ChannelArguments arguments;
    // Every try is a connection of its own; waiting between tries is Backoff's work, not gRPC's.
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 10'000);
    arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 5'000);
    // A reader that falls behind wants the newest frame: small windows leave the backlog to the
    // server, which drops it.
    arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
    return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
  };
}

}  // namespace onesea::client
