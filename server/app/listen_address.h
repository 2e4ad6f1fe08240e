#pragma once

#include <string>

#include "absl/status/status.h"

namespace onesea::server {

/// OK for an address that only this machine can reach (127.0.0.0/8, localhost, [::1], unix:...), or
/// any other if `insecure_public`; else FailedPrecondition saying what to do. InvalidArgument if it
/// is no HOST:PORT.
absl::Status CheckListenAddress(const std::string& address, bool insecure_public);

}  // namespace onesea::server
