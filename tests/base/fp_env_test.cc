#include "common/base/fp_env.h"

#include <gtest/gtest.h>

#include <cfenv>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace onesea {
namespace {

TEST(FpEnvironment, IsFineHere) { EXPECT_TRUE(CheckFpEnvironment().ok()) << CheckFpEnvironment(); }

TEST(FpEnvironment, NoticesAnotherRounding) {
  std::fesetround(FE_UPWARD);
  const absl::Status status = CheckFpEnvironment();
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
}

#if defined(__x86_64__)
TEST(FpEnvironment, NoticesFlushedSubnormals) {
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8000);  // flush to zero
  const absl::Status status = CheckFpEnvironment();
  _mm_setcsr(before);
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
}
#endif

}  // namespace
}  // namespace onesea
