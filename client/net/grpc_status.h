#pragma once

#include <grpcpp/support/status.h>

#include "absl/status/status.h"

namespace onesea::client {

/// The canonical codes have the same numbers in both libraries.
inline absl::Status FromGrpc(const grpc::Status& status) {
  return absl::Status(static_cast<absl::StatusCode>(status.error_code()), status.error_message());
}

}  // namespace onesea::client
