#pragma once

#include "absl/status/status.h"
#include "absl/strings/string_view.h"

namespace onesea::client {

/// FailedPrecondition of the one kind that no retry mends: this process would build another sea
/// than the server.
absl::Status OtherSeaError(absl::string_view message);

/// Whether `status` was made by OtherSeaError().
bool IsOtherSea(const absl::Status& status);

}  // namespace onesea::client
