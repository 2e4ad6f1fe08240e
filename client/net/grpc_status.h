#pragma once

#include <grpcpp/support/status.h>

#include "absl/status/status.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"

namespace onesea::client {

/// The canonical codes have the same numbers in both libraries; the words are the other side's.
inline absl::Status FromGrpc(const grpc::Status& status) {
  return absl::Status(static_cast<absl::StatusCode>(status.error_code()),
                      wire::Printable(status.error_message(), kErrorLengthMax));
}

}  // namespace onesea::client
