#include "common/wire/session_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/wire/proto_session.h"

namespace onesea::wire {
namespace {

using ::testing::HasSubstr;

std::string Message(const absl::Status& status) { return std::string(status.message()); }

constexpr char kSwell[] = R"(
  name: "swell"
  sea { systems { jonswap { hs_m: 2 tp_s: 12 direction { from_deg: 270 } } } }
)";

TEST(SessionText, FillsInEveryDefault) {
  const absl::StatusOr<SessionSpec> spec = ParseSessionText(kSwell, "");
  ASSERT_TRUE(spec.ok()) << spec.status();
  EXPECT_EQ(spec->name, "swell");
  EXPECT_EQ(spec->recipe.tick_rate_hz, 60);
  EXPECT_EQ(spec->stream_rate_hz, 30);
  EXPECT_EQ(spec->recipe.seed, 1u);
  EXPECT_EQ(spec->recipe.choppiness, 1.0);
  EXPECT_EQ(spec->recipe.cascades, sea::DefaultCascades());
  EXPECT_EQ(spec->pace, Pace::kRealTime);
  EXPECT_EQ(spec->speed, 1.0);
  EXPECT_EQ(spec->probes_m.size(), 8u);
  ASSERT_EQ(spec->recipe.timeline.size(), 1u);
  const sea::SeaState& sea = spec->recipe.timeline[0].sea;
  EXPECT_EQ(std::get<sea::JonswapSystem>(sea.systems[0]).wave_to_rad, 0.0);
  // A wind that nobody states: sqrt(9.81 · 2 / 0.22) = 9.44 m/s along the waves.
  EXPECT_NEAR(sea.wind_speed_m_per_s, 9.4436, 1e-4);
  EXPECT_EQ(sea.wind_to_rad, 0.0);
}

// Such a name would be written into a welcome that no client can read.
TEST(SessionText, ANameMustBePrintableUtf8) {
  const auto read = [](const std::string& name) {
    return ParseSeaText("name: \"" + name + "\" beaufort: 3", "").status();
  };
  for (const char* good :
       {"Stärke 5", "", "波", "\xf0\x9f\x8c\x8a", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_TRUE(read(good).ok()) << read(good);
  }
  // Latin-1; cut; an overlong slash; half of a pair; beyond Unicode; a tail alone; escapes.
  for (const char* bad :
       {"St\xe4rke", "\xe6\xb3", "\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80",
        "\xf8\x88\x80\x80\x80", "\x80", "\\033[2J", "\\n", "\\177"}) {
    EXPECT_THAT(Message(read(bad)), HasSubstr("name: '")) << bad;
  }
}

TEST(SessionText, StatedWindStands) {
  const absl::StatusOr<sea::SeaState> sea = ParseSeaText(
      "systems { jonswap { hs_m: 2 tp_s: 12 } } wind_speed_m_per_s: 0 wind { from_deg: 180 }", "");
  ASSERT_TRUE(sea.ok()) << sea.status();
  EXPECT_EQ(sea->wind_speed_m_per_s, 0.0);
  EXPECT_NEAR(sea->wind_to_rad, 1.5707963267948966, 1e-15);
}

// Beaufort 6: 0.836 · 6^1.5 = 12.29 m/s from the north, so towards -y.
TEST(SessionText, ShorthandsBecomeASystem) {
  const absl::StatusOr<sea::SeaState> sea = ParseSeaText("beaufort: 6 wind { from_deg: 0 }", "");
  ASSERT_TRUE(sea.ok()) << sea.status();
  EXPECT_EQ(sea->systems.size(), 1u);
  EXPECT_NEAR(sea->wind_speed_m_per_s, 12.29, 0.01);
  EXPECT_NEAR(sea->wind_to_rad, 4.71238898038469, 1e-12);
  EXPECT_TRUE(ParseSeaText("wmo_sea_state: 4", "").ok());
}

TEST(SessionText, ShorthandsAreChecked) {
  EXPECT_THAT(Message(ParseSeaText("beaufort: 13", "").status()),
              HasSubstr("beaufort: 13 is outside [0, 12]"));
  EXPECT_THAT(Message(ParseSeaText("wmo_sea_state: -1", "").status()),
              HasSubstr("wmo_sea_state: -1 is outside [0, 9]"));
  EXPECT_THAT(Message(ParseSeaText("beaufort: 3 wmo_sea_state: 3", "").status()),
              HasSubstr("not several"));
  EXPECT_THAT(
      Message(ParseSeaText("beaufort: 3 systems { jonswap { hs_m: 1 tp_s: 5 } }", "").status()),
      HasSubstr("not several"));
}

TEST(SessionText, SpecRoundTripsThroughProto) {
  SessionSpec spec = *ParseSessionText(kSwell, "");
  spec.epoch_utc_ns = -1;  // a nanosecond before 1970
  spec.latitude_deg = -33.0;
  spec.pace = Pace::kLockStep;
  spec.lock_step_participants = 3;
  v1::SessionSpec proto;
  ToProto(spec, &proto);
  const absl::StatusOr<SessionSpec> again = FromProto(proto);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ(again->recipe, spec.recipe);
  EXPECT_EQ(again->epoch_utc_ns, -1);
  EXPECT_EQ(again->latitude_deg, spec.latitude_deg);
  EXPECT_FALSE(again->longitude_deg.has_value());
  EXPECT_EQ(again->pace, Pace::kLockStep);
  EXPECT_EQ(again->lock_step_participants, 3);
  EXPECT_EQ(again->probes_m, spec.probes_m);
}

TEST(SessionText, SyntaxErrorsNameTheLine) {
  EXPECT_THAT(Message(ParseSessionText("name: \"a\"\nsea {\n  sytems { }\n}\n", "").status()),
              HasSubstr("line 3"));
  EXPECT_THAT(Message(ParseSessionText("name: \"a\"\nsea {\n  sytems { }\n}\n", "").status()),
              HasSubstr("sytems"));
}

struct BadCase {
  const char* text;  // put after a good sea and name
  const char* message;
};

TEST(SessionText, RangeErrorsNameFieldValueAndLimit) {
  const BadCase cases[] = {
      {"tick_rate_hz: 59", "59"},
      {"tick_rate_hz: -1", "-1"},
      {"tick_rate_hz: 2000", "2000"},
      {"stream_rate_hz: 7", "stream_rate_hz: 7 does not divide tick_rate_hz 60"},
      {"stream_rate_hz: 120", "stream_rate_hz: 120 is outside [1, 60]"},
      {"speed: 0", "speed: 0 is outside [0.01, 100]"},
      {"speed: nan", "speed: nan"},
      {"depth_m: -3", "-3"},
      {"depth_m: nan", "nan"},
      {"choppiness: 2", "2"},
      {"latitude_deg: 91", "latitude_deg: 91 is outside [-90, 90]"},
      {"lock_step_participants: 65", "lock_step_participants: 65 is outside [1, 64]"},
      {"lock_step_deadline_s: nan", "lock_step_deadline_s: nan"},
      {"lock_step_deadline_s: 3601", "lock_step_deadline_s: 3601"},
      {"probes { x_m: 1 y_m: inf }", "probes[0].y_m: inf is outside [-1e+07, 1e+07]"},
      {"epoch_time { nanos: -1 }", "epoch_time.nanos: -1 is outside [0, 999999999]"},
      {"epoch_time { seconds: 99999999999 }", "epoch_time.seconds: 99999999999"},
  };
  for (const BadCase& bad : cases) {
    const absl::Status status = ParseSessionText(std::string(kSwell) + bad.text, "").status();
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << bad.text;
    EXPECT_THAT(Message(status), HasSubstr(bad.message)) << bad.text;
  }
}

TEST(SessionText, NamesAreChecked) {
  const std::string sea = "sea { systems { jonswap { hs_m: 2 tp_s: 12 } } }";
  for (const char* name : {"", "Storm", "a b", "../x"}) {
    const absl::Status status = ParseSessionText(sea + " name: \"" + name + "\"", "").status();
    EXPECT_THAT(Message(status), HasSubstr("[a-z0-9-]{1,64}")) << name;
  }
  EXPECT_FALSE(ParseSessionText(sea + " name: \"" + std::string(65, 'a') + "\"", "").ok());
  EXPECT_TRUE(ParseSessionText(sea + " name: \"" + std::string(64, 'a') + "\"", "").ok());
  EXPECT_THAT(Message(ParseSessionText("name: \"a\"", "").status()), HasSubstr("sea: is missing"));
}

TEST(SessionFile, ErrorsNameTheFile) {
  EXPECT_EQ(ReadSessionFile("no/such/file").status().code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(Message(ReadSessionFile("no/such/file").status()), HasSubstr("no/such/file"));
  const std::string path = ::testing::TempDir() + "/bad.textproto";
  std::ofstream(path) << "name: \"a\"\nsea { systems { jonswap { hs_m: -2 tp_s: 12 } } }";
  const absl::Status status = ReadSessionFile(path).status();
  EXPECT_THAT(Message(status), HasSubstr("bad.textproto: "));
  EXPECT_THAT(Message(status), HasSubstr("sea.systems[0]"));
  EXPECT_THAT(Message(status), HasSubstr("-2"));
}

// The published values of the record: Hs 4.71 m at 64 (47 since 2008) frequencies, all four
// moments.
TEST(SessionFile, ReadsTheMeasuredStorm) {
  const absl::StatusOr<SessionSpec> spec = ReadSessionFile("deploy/sessions/storm-41010.textproto");
  ASSERT_TRUE(spec.ok()) << spec.status();
  const sea::SeaState& sea = spec->recipe.timeline[0].sea;
  ASSERT_EQ(sea.systems.size(), 1u);
  const auto& buoy = std::get<sea::BuoySpectrum>(sea.systems[0]);
  EXPECT_EQ(buoy.frequency_hz.size(), buoy.r2.size());
  EXPECT_NEAR(buoy.hs_m, 4.71, 0.005);
  EXPECT_EQ(spec->epoch_utc_ns, 1549777200LL * 1'000'000'000);  // 2019-02-10T05:40:00Z
}

TEST(SessionFile, EverySessionInTheRepositoryIsValid) {
  for (const char* name : {"storm-41010", "calm-swell", "trade-wind", "tank"}) {
    const absl::StatusOr<SessionSpec> spec =
        ReadSessionFile(std::string("deploy/sessions/") + name + ".textproto");
    ASSERT_TRUE(spec.ok()) << spec.status();
    EXPECT_EQ(spec->name, name);
  }
}

}  // namespace
}  // namespace onesea::wire
