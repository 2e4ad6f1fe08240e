// What every reader stands on: lines, numbers, times, directions, packed bytes.

#include <zlib.h>

#include "common/ingest/spreading_moments.h"
#include "common/ingest/text_lines.h"
#include "common/ingest/utc_time.h"
#include "tests/ingest/spectrum_test_util.h"

namespace onesea::ingest {
namespace {

TEST(ParseReal, ReadsFortransForms) {
  EXPECT_DOUBLE_EQ(ParseReal("0.261E-17").value(), 0.261e-17);
  EXPECT_DOUBLE_EQ(ParseReal("1.5D+03").value(), 1500.0);
  EXPECT_DOUBLE_EQ(ParseReal("0.123-104").value(), 0.123e-104);
  EXPECT_DOUBLE_EQ(ParseReal(".0325").value(), 0.0325);
  EXPECT_DOUBLE_EQ(ParseReal("-99").value(), -99.0);
  EXPECT_DOUBLE_EQ(ParseReal("+7.").value(), 7.0);
  EXPECT_DOUBLE_EQ(ParseReal("0.1-999").value(), 0.0);
}

TEST(ParseReal, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"", "nan", "inf", "-inf", "1e999", "*******", "0x1p3", "1.2.3", "1 2",
                           "1e", "--1", "+-1", "1,5", "e5"}) {
    EXPECT_FALSE(ParseReal(text).has_value()) << text;
  }
  EXPECT_FALSE(ParseReal(std::string(1000, '1')).has_value());
}

TEST(TextLines, CountsLinesWithEitherEnd) {
  TextLines lines("f", "a\r\n\n b\t \nlast");
  ASSERT_TRUE(lines.NextNotBlank());
  EXPECT_EQ(lines.line(), "a");
  ASSERT_TRUE(lines.NextNotBlank());
  EXPECT_EQ(lines.number(), 3);
  ASSERT_TRUE(lines.NextNotBlank());
  EXPECT_EQ(lines.line(), "last");
  EXPECT_FALSE(lines.NextNotBlank());
  EXPECT_EQ(lines.Bad("hs", "x\n", "a number").message(), "f:4: hs: 'x\\n' is not a number");
}

TEST(UtcTime, KnowsTheCalendar) {
  EXPECT_EQ(FormatUtc({2019, 2, 10, 5, 40, 0}).value(), "2019-02-10T05:40");
  EXPECT_EQ(FormatUtc({2020, 2, 29, 23, 59, 30}).value(), "2020-02-29T23:59:30");
  EXPECT_FALSE(FormatUtc({2019, 2, 29, 0, 0, 0}).has_value());
  EXPECT_FALSE(FormatUtc({2019, 13, 1, 0, 0, 0}).has_value());
  EXPECT_FALSE(FormatUtc({2019, 1, 1, 24, 0, 0}).has_value());
  EXPECT_FALSE(FormatUtc({2019, 1, -1, 0, 0, 0}).has_value());
  EXPECT_EQ(UnixSeconds({2019, 2, 10, 5, 40, 0}), 1549777200);
}

TEST(UtcTime, ReadsWhatPeopleType) {
  for (const char* text :
       {"2019-02-10T05:40", "2019-02-10 05:40", "2019-02-10T05:40Z", "2019-02-10T05:40:00Z"}) {
    ASSERT_TRUE(ParseUtc(text).has_value()) << text;
    EXPECT_EQ(FormatUtc(*ParseUtc(text)).value(), "2019-02-10T05:40");
  }
  for (const char* text : {"", "2019", "2019-02-10", "2019-02-30T05:40", "2019-02-10T05:40x",
                           "10.2.2019 05:40", "2019-02-10T05:40:"}) {
    EXPECT_FALSE(ParseUtc(text).has_value()) << text;
  }
}

// A wave from the west (270) travels east; one from the north travels south.
TEST(Direction, NauticalFromBecomesTravelFromEast) {
  EXPECT_NEAR(WaveToFromNautical(270.0), 0.0, 1e-12);
  EXPECT_NEAR(WaveToFromNautical(0.0), 1.5 * sea::kPi, 1e-12);
  EXPECT_NEAR(WaveToFromNautical(360.0), 1.5 * sea::kPi, 1e-12);
  EXPECT_NEAR(WaveToFromNautical(180.0), 0.5 * sea::kPi, 1e-12);
  EXPECT_NEAR(WaveToFromCompass(0.5 * sea::kPi), 0.0, 1e-12);
  for (double deg = 0.0; deg < 360.0; deg += 7.0) {
    EXPECT_NEAR(NauticalFromWaveTo(WaveToFromNautical(deg)), deg, 1e-9);
  }
}

// s = 9: r1 = 9/10, r2 = 9·8/(10·11).
TEST(SpreadingMoments, SecondFollowsFromFirst) {
  EXPECT_NEAR(SecondMomentOfCosine2s(0.9), 72.0 / 110.0, 1e-12);
  EXPECT_EQ(SecondMomentOfCosine2s(1.0), 1.0);
  EXPECT_EQ(SecondMomentOfCosine2s(0.0), 0.0);
  EXPECT_EQ(SecondMomentOfCosine2s(0.3), 0.0);  // s < 1 would be negative
}

std::string Gzip(const std::string& text) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, text.size()) + 64, '\0');
  std::string source = text;
  stream.next_in = reinterpret_cast<Bytef*>(source.data());
  stream.avail_in = static_cast<uInt>(source.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

TEST(InflateGzip, JoinsMembersAndIgnoresPadding) {
  EXPECT_EQ(InflateGzip("f", Gzip("one ") + Gzip("two")).value(), "one two");
  EXPECT_EQ(InflateGzip("f", Gzip("one") + std::string(512, '\0')).value(), "one");
}

TEST(InflateGzip, RefusesEveryCutAndEveryFlippedByte) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += std::to_string(i * i) + " ";
  const std::string packed = Gzip(text);
  for (std::size_t size = 2; size < packed.size(); ++size) {
    EXPECT_FALSE(InflateGzip("f", packed.substr(0, size)).ok()) << size;
  }
  for (std::size_t i = 0; i < packed.size(); ++i) {
    std::string damaged = packed;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x40);
    const auto result = InflateGzip("f", damaged);
    // Header bytes such as the time stamp carry no text.
    if (result.ok()) {
      EXPECT_EQ(*result, text) << i;
    }
  }
}

// A bomb: 65 MB of zeros in 64 KB.
TEST(InflateGzip, StopsAtTheLimit) {
  const auto result = InflateGzip("bomb", Gzip(std::string(65 * 1024 * 1024, '\0')));
  EXPECT_EQ(result.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(result.status().message().find("limit"), absl::string_view::npos);
}

TEST(ReadFileBytes, SaysWhatIsWrong) {
  EXPECT_EQ(ReadFileBytes("tests/no such file").status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(ReadFileBytes("tests").status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(ReadFileBytes("/dev/zero").status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace onesea::ingest
