#pragma once

#include <functional>
#include <memory>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"

namespace grpc {
class Channel;
}

namespace onesea::client {

/// Makes a new connection; called once per try, from the client's thread.
using ChannelFactory = std::function<std::shared_ptr<grpc::Channel>()>;

/// OK if `address` is "HOST:PORT" ("[::1]:7310" for IPv6) with a port in [1, 65535];
/// InvalidArgument in words for people. Whether such a host exists only the connection tells.
absl::Status ValidateAddress(absl::string_view address);

/// Plaintext to "HOST:PORT". The connection notices a dead peer within 15 s.
ChannelFactory ConnectTo(std::string address);

}  // namespace onesea::client
