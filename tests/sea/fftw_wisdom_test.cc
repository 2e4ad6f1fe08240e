// Stored plans of FFTW: measured on request, named in the session's record, refused when damaged.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/sea/fft_fftw.h"
#include "common/sea/fft_strip.h"

namespace onesea::sea {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

// One test, since FFTW's wisdom is the process's: what is named what is planned go together.
TEST(FftwWisdom, IsMeasuredStoredNamedAndUsed) {
  EXPECT_THAT(FftwTransform::Name(), EndsWith(" estimate"));
  EXPECT_EQ(FftwTransform::UseWisdom("(fftw-3.3.10 no wisdom at all").code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(FftwTransform::Name(), EndsWith(" estimate")) << "a refused text changes nothing";

  const std::string wisdom = FftwTransform::MeasureWisdom(64);
  ASSERT_TRUE(FftwTransform::UseWisdom(wisdom).ok());
  const std::string name = FftwTransform::Name();
  EXPECT_THAT(name, HasSubstr(" wisdom "));
  ASSERT_TRUE(FftwTransform::UseWisdom(wisdom).ok());
  EXPECT_EQ(FftwTransform::Name(), name) << "the same text, the same name";

  // A plan from wisdom computes what the own transform does: one wave of index (3, -5).
  constexpr int kN = 64, kIndexMax = 8;
  const int pitch = StripTransform::PitchFor(kIndexMax);
  std::vector<float> re(static_cast<std::size_t>(2 * kIndexMax + 1) * pitch), im(re.size());
  re[static_cast<std::size_t>(3 + kIndexMax) * pitch + (-5 + kIndexMax)] = 1.0f;
  std::vector<float> out_re(kN * kN), out_im(kN * kN);
  FftwTransform(kN, kIndexMax).Inverse(re.data(), im.data(), out_re.data(), out_im.data());
  for (int y = 0; y < kN; y += 7) {
    for (int x = 0; x < kN; x += 5) {
      const double phase = 2.0 * M_PI * (3.0 * x - 5.0 * y) / kN;
      EXPECT_NEAR(out_re[y * kN + x], std::cos(phase), 1e-5);
      EXPECT_NEAR(out_im[y * kN + x], std::sin(phase), 1e-5);
    }
  }
}

}  // namespace
}  // namespace onesea::sea
