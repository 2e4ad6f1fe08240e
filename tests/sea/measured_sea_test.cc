// From a published file to the waves of a process: the figures that the file states come back.

#include <gtest/gtest.h>

#include <cmath>

#include "common/ingest/spectrum_file.h"
#include "common/sea/component_statistics.h"
#include "common/sea/constants.h"

namespace onesea::sea {
namespace {

constexpr double kDeg = kPi / 180.0;

struct Pair {
  SpectrumStatistics file, sea;
  double tail_free_hs_m;  // of the waves below the file's last frequency
};

Pair Compare(const std::string& path, const std::string& time) {
  const auto records = ingest::ReadSpectrumFile(path);
  EXPECT_TRUE(records.ok()) << records.status();
  const auto record = ingest::FindRecord(*records, time);
  EXPECT_TRUE(record.ok()) << record.status();
  Recipe recipe;
  recipe.cascades = DefaultCascades();
  recipe.timeline.push_back({0, 0, {"", {(*record)->system}, {}, 0.0, 0.0}});
  Pair pair;
  const auto with_tail = *BuildComponents(recipe);
  pair.sea = ComputeStatistics(*with_tail, {0});
  std::visit(
      [&](auto& spectrum) {
        if constexpr (requires { spectrum.add_tail; }) {
          pair.file = ComputeStatistics(spectrum);
          spectrum.add_tail = false;
        }
      },
      recipe.timeline[0].sea.systems[0]);
  const auto without = *BuildComponents(recipe);
  pair.tail_free_hs_m = 4.0 * std::sqrt(VarianceAt(*without, {0}) + without->lost_variance_m2[0]);
  return pair;
}

double AngleBetween(double a, double b) { return std::fabs(std::remainder(a - b, 2.0 * kPi)); }

// The storm of 2019-02-10 off Cape Canaveral: Hs 4.71 m, peak period 10.0 s.
TEST(MeasuredSea, TheStormOf41010ComesBack) {
  const Pair p = Compare("deploy/sessions/41010/41010w2019part.txt.gz", "2019-02-10T05:40");
  EXPECT_NEAR(p.file.hs_m, 4.71, 0.01);
  EXPECT_NEAR(p.tail_free_hs_m / p.file.hs_m, 1.0, 0.005);
  EXPECT_NEAR(p.sea.hs_m / p.file.hs_m, 1.0, 0.01);  // the tail above 0.485 Hz adds some mm
  EXPECT_NEAR(p.sea.tp_parabola_s / p.file.tp_parabola_s, 1.0, 0.05);
  EXPECT_NEAR(p.sea.te_s / p.file.te_s, 1.0, 0.02);
  EXPECT_LT(AngleBetween(p.sea.mean_wave_to_rad, p.file.mean_wave_to_rad), 2.0 * kDeg);
  EXPECT_NEAR(p.sea.spread_rad, p.file.spread_rad, 1.5 * kDeg);
}

TEST(MeasuredSea, SwanAndWavewatchSpectraComeBack) {
  for (const auto& [path, time] :
       {std::pair{"tests/data/spectra/swanfile.spec", "2016-10-15T00:00"},
        {"tests/data/spectra/ww3station.spec", "2022-09-12T07:00"}}) {
    const Pair p = Compare(path, time);
    EXPECT_NEAR(p.tail_free_hs_m / p.file.hs_m, 1.0, 0.005) << path;
    EXPECT_LT(AngleBetween(p.sea.mean_wave_to_rad, p.file.mean_wave_to_rad), 2.0 * kDeg) << path;
    EXPECT_NEAR(p.sea.spread_rad, p.file.spread_rad, 1.5 * kDeg) << path;
    EXPECT_NEAR(p.sea.te_s / p.file.te_s, 1.0, 0.02) << path;
  }
}

}  // namespace
}  // namespace onesea::sea
