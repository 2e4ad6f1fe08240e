#pragma once

#include <functional>
#include <memory>
#include <string>

namespace grpc {
class Channel;
}

namespace onesea::client {

/// Makes a new connection; called once per try, from the client's thread.
using ChannelFactory = std::function<std::shared_ptr<grpc::Channel>()>;

/// Plaintext to "HOST:PORT". The connection notices a dead peer within 15 s.
ChannelFactory ConnectTo(std::string address);

}  // namespace onesea::client
