#include "common/sea/query_records.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/sea/aligned.h"

namespace onesea::sea {
namespace {

constexpr int kN = 64;
constexpr Field kPlanes[] = {Field::kDisplacementX, Field::kDisplacementY, Field::kHeight};

// Every sample stands twice, as a lower and as an upper row, within half a unit of its value, and
// the margins repeat the plane.
TEST(QueryRecords, HoldThePlanesPeriodically) {
  CascadeFields fields(kN, kQueryFields);
  for (int f = 0; f < 3; ++f) {
    const auto plane = fields.MutablePlane(kPlanes[f]);
    for (int n = 0; n < kN * kN; ++n) {
      plane[n] = static_cast<float>((f + 1) * std::sin(0.37 * n + f));
    }
  }
  fields.MutablePlane(Field::kHeight)[5 * kN + 9] = -4.0f;  // the largest: all of the range
  const auto storage = AllocateZeros<std::uint32_t>(RecordWords(kN));
  const QueryRecords records = WriteRecords(fields, kPlanes, storage.get());
  EXPECT_FLOAT_EQ(records.unit, 4.0f / 32767.0f);
  EXPECT_EQ(RecordHalf(records.words[6 * RecordPitchWords(kN) + 4 * 10 + 2], 0), -32767);
  for (int r = 0; r < kN + 2; ++r) {
    for (int c = 0; c < kN + 4; ++c) {
      const std::uint32_t* record = records.words + r * RecordPitchWords(kN) + 4 * c;
      EXPECT_EQ(record[3], 0u);
      for (int half = 0; half < 2; ++half) {
        const int row = (r - 1 + half + kN) % kN, column = (c - 1 + kN) % kN;
        for (int f = 0; f < 3; ++f) {
          const float want = fields.Plane(kPlanes[f])[row * kN + column];
          ASSERT_NEAR(records.unit * static_cast<float>(RecordHalf(record[f], half)), want,
                      0.501f * records.unit)
              << r << " " << c << " " << f;
        }
      }
    }
  }
}

TEST(QueryRecords, OfACalmSeaAreZero) {
  const CascadeFields fields(kN, kQueryFields);
  const auto storage = AllocateZeros<std::uint32_t>(RecordWords(kN));
  const QueryRecords records = WriteRecords(fields, kPlanes, storage.get());
  EXPECT_EQ(records.unit, 0.0f);
  for (std::size_t n = 0; n < RecordWords(kN); ++n) ASSERT_EQ(storage[n], 0u);
}

}  // namespace
}  // namespace onesea::sea
