#include "common/sea/sea_codes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

const JonswapSystem& SystemOf(const SeaState& sea) {
  return std::get<JonswapSystem>(sea.systems.at(0));
}

TEST(SeaOfBeaufort, HasTheTablesWindAndHeight) {
  struct Row {
    int force;
    double wind_low, wind_high, hs;  // WMO's ranges
  };
  for (const Row& row :
       {Row{1, 0.3, 1.6, 0.1}, Row{3, 3.4, 5.5, 0.6}, Row{5, 8.0, 10.8, 2.0},
        Row{8, 17.2, 20.8, 5.5}, Row{10, 24.5, 28.5, 9.0}, Row{12, 32.7, 60.0, 14.0}}) {
    const auto sea = SeaOfBeaufort(row.force, 0.7);
    ASSERT_TRUE(sea.ok()) << sea.status();
    EXPECT_GT(sea->wind_speed_m_per_s, row.wind_low);
    EXPECT_LT(sea->wind_speed_m_per_s, row.wind_high);
    EXPECT_EQ(SystemOf(*sea).hs_m, row.hs);
    EXPECT_EQ(SystemOf(*sea).wave_to_rad, 0.7);
    EXPECT_EQ(sea->wind_to_rad, 0.7);
  }
}

// Real wind seas have a steepness Hs/L of 1/60 to 1/15 (L = g Tp²/2π).
TEST(SeaOfBeaufort, HasAPlausibleSteepness) {
  for (int force = 1; force <= 12; ++force) {
    const SeaState sea = *SeaOfBeaufort(force, 0.0);
    const double length = kGravity * std::pow(SystemOf(sea).tp_s, 2) / (2.0 * kPi);
    EXPECT_GT(SystemOf(sea).hs_m / length, 1.0 / 90.0) << force;
    EXPECT_LT(SystemOf(sea).hs_m / length, 1.0 / 15.0) << force;
  }
}

TEST(SeaOfWmoCode, LiesWithinItsRange) {
  constexpr double kUpper[] = {0.0, 0.1, 0.5, 1.25, 2.5, 4.0, 6.0, 9.0, 14.0};
  for (int code = 1; code <= 8; ++code) {
    const SeaState sea = *SeaOfWmoCode(code, 0.0);
    EXPECT_GT(SystemOf(sea).hs_m, kUpper[code - 1]);
    EXPECT_LT(SystemOf(sea).hs_m, kUpper[code]);
  }
  EXPECT_GE(SystemOf(*SeaOfWmoCode(9, 0.0)).hs_m, 14.0);
}

TEST(SeaCodes, ZeroIsFlat) {
  EXPECT_TRUE(SeaOfBeaufort(0, 0.0)->systems.empty());
  EXPECT_TRUE(SeaOfWmoCode(0, 0.0)->systems.empty());
}

TEST(SeaCodes, OthersAreRefused) {
  EXPECT_FALSE(SeaOfBeaufort(-1, 0.0).ok());
  EXPECT_FALSE(SeaOfBeaufort(13, 0.0).ok());
  EXPECT_FALSE(SeaOfWmoCode(10, 0.0).ok());
  EXPECT_FALSE(SeaOfBeaufort(4, std::numeric_limits<double>::quiet_NaN()).ok());
}

}  // namespace
}  // namespace onesea::sea
