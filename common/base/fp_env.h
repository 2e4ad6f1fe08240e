#pragma once

#include "absl/status/status.h"

namespace onesea {

/// OK if this thread's arithmetic is what determinism needs: round to nearest, subnormals kept, no
/// fused multiply-add slipped in by the compiler; otherwise FailedPrecondition saying which. Some
/// libraries built with fast-math switch subnormals off for the whole process when they are loaded.
/// Cost: some ns.
absl::Status CheckFpEnvironment();

}  // namespace onesea
