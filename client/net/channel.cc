#include "client/net/channel.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>

#include "absl/strings/numbers.h"
#include "absl/strings/str_format.h"
#include "common/base/limits.h"

namespace onesea::client {
namespace {

// Calls that change nothing may be made again when a connection fails under them. gRPC itself does
// the waiting; where no server is, it costs a tenth of a second.
constexpr char kRetryReads[] = R"({"methodConfig": [{
  "name": [{"service": "onesea.v1.OneSea", "method": "ListSessions"},
           {"service": "onesea.v1.OneSea", "method": "QueryPoints"},
           {"service": "onesea.v1.OneSea", "method": "SyncClock"},
           {"service": "onesea.v1.OneSea", "method": "GetStateHash"}],
  "retryPolicy": {"maxAttempts": 3, "initialBackoff": "0.03s", "maxBackoff": "0.1s",
                  "backoffMultiplier": 2, "retryableStatusCodes": ["UNAVAILABLE"]}}]})";

}  // namespace

absl::Status ValidateAddress(absl::string_view address) {
  const std::size_t colon = address.rfind(':');
  const absl::string_view host = address.substr(0, colon);
  const bool is_ipv6 = host.size() > 2 && host.front() == '[' && host.back() == ']';
  const bool is_name = !host.empty() && host.find_first_of(":/[] \t\n") == host.npos;
  int port = 0;
  if (colon != address.npos && (is_ipv6 || is_name) &&
      absl::SimpleAtoi(address.substr(colon + 1), &port) && port >= 1 && port <= 65535) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(
      absl::StrFormat("address is '%s', it must be HOST:PORT with a port in [1, 65535]", address));
}

ChannelFactory ConnectTo(std::string address) {
  return [address = std::move(address)] {
    grpc::ChannelArguments arguments;
    // Every try is a connection of its own; waiting between tries is Backoff's work, not gRPC's.
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    arguments.SetServiceConfigJSON(kRetryReads);
    arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 10'000);
    arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 5'000);
    // A reader that falls behind wants the newest frame: small windows leave the backlog to the
    // server, which drops it.
    arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
    // Hulls come in one piece (GetMesh).
    arguments.SetMaxReceiveMessageSize(static_cast<int>(kHullFileBytesMax) + (1 << 20));
    return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
  };
}

}  // namespace onesea::client
