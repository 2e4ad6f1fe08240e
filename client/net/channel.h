#pragma once

#include <memory>
#include <string>

#include "absl/status/status.h"

namespace grpc {
class Channel;
class Status;
}  // namespace grpc

namespace onesea::client {

/// A channel to "HOST:PORT", without TLS, that keeps itself alive and notices a dead server within
/// 15 s. Connects when first used.
std::shared_ptr<grpc::Channel> MakeChannel(const std::string& address);

/// The same code and message; Unavailable says what to do. `address` is for that message.
absl::Status ToAbsl(const grpc::Status& status, const std::string& address);

}  // namespace onesea::client
