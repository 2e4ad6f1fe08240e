#include "common/base/fp_env.h"

#include <cfenv>

namespace onesea {

absl::Status CheckFpEnvironment() {
  if (std::fegetround() != FE_TONEAREST) {
    return absl::FailedPreconditionError("floating point does not round to nearest");
  }
  volatile double tiny = 0x1p-1000;
  volatile double subnormal = tiny * 0x1p-60;
  volatile double kept = subnormal * 0x1p60;
  if (!(kept == tiny)) {
    return absl::FailedPreconditionError(
        "subnormal numbers are flushed to zero; a library built with fast-math does that");
  }
  // (1 + e)(1 - e) - 1 is 0 in two roundings and -e² in one.
  volatile double e = 0x1p-30;
  const double above = 1.0 + e;
  const double below = 1.0 - e;
  volatile double difference = above * below - 1.0;
  if (difference != 0.0) {
    return absl::FailedPreconditionError(
        "multiplications and additions are fused; build with -ffp-contract=off");
  }
  return absl::OkStatus();
}

}  // namespace onesea
