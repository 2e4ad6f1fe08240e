#include "common/sea/foam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "common/sea/components.h"
#include "hwy/targets.h"

namespace onesea::sea {
namespace {

std::shared_ptr<const Components> DevelopedSea(double u10, std::uint64_t seed = 1) {
  Recipe recipe;
  recipe.seed = seed;
  recipe.cascades = DefaultCascades();
  recipe.timeline.resize(1);
  PiersonMoskowitzSystem system;
  system.wind_speed_19_5_m_per_s = 1.026 * u10;
  recipe.timeline[0].sea.systems = {system};
  recipe.timeline[0].sea.wind_speed_m_per_s = u10;
  recipe.timeline[0].sea.wind_to_rad = 0.3;
  auto built = BuildComponents(recipe);
  EXPECT_TRUE(built.ok()) << built.status();
  return *built;
}

double Cover(const FoamWindow& window) {
  double sum = 0;
  for (const std::uint8_t cell : window.Cells()) sum += cell;
  return sum / 255.0 / static_cast<double>(window.Cells().size());
}

double MeanCover(double u10) {
  double sum = 0;
  int count = 0;
  for (const std::uint64_t seed : {1, 2}) {
    FoamWindow window(DevelopedSea(u10, seed), {.cells = 512});
    for (const double t : {0.0, 500.0}) {
      window.MoveTo(SimTime::FromSeconds(t), {1000.0 * t, 0});
      sum += Cover(window);
      ++count;
    }
  }
  return sum / count;
}

// Oracle: whitecap cover 2.95e-6 U^3.52 (Monahan & O'Muircheartaigh 1980) within a factor 1.5.
TEST(Foam, CoverFollowsTheWind) {
  for (const double u10 : {10.0, 15.0}) {
    const double want = 2.95e-6 * std::pow(u10, 3.52);
    const double cover = MeanCover(u10);
    std::printf("U10 %.0f m/s: cover %.4f, Monahan %.4f\n", u10, cover, want);
    EXPECT_GT(cover, want / 1.5);
    EXPECT_LT(cover, want * 1.5);
  }
}

TEST(Foam, CalmSeaHasNone) { EXPECT_LT(MeanCover(4.0), 1e-4); }

// Foam of both windows, cell by cell of the drifting frame where they overlap.
void ExpectAgreement(const FoamWindow& a, const FoamWindow& b, int n, Vec2d centre_a,
                     Vec2d centre_b) {
  ASSERT_EQ(a.OriginM(), b.OriginM());
  const Vec2d origin = a.OriginM();
  int compared = 0, foamy = 0;
  const auto inside = [&](Vec2d centre, std::int64_t i, std::int64_t j) {
    const double half = n / 2 - kFoamSlackCells - 2;
    return std::abs(origin.x + static_cast<double>(i) + 0.5 - centre.x) < half &&
           std::abs(origin.y + static_cast<double>(j) + 0.5 - centre.y) < half;
  };
  const auto i0 = static_cast<std::int64_t>(centre_a.x - origin.x) - n / 2;
  const auto j0 = static_cast<std::int64_t>(centre_a.y - origin.y) - n / 2;
  for (std::int64_t j = j0; j < j0 + n; ++j) {
    for (std::int64_t i = i0; i < i0 + n; ++i) {
      if (!inside(centre_a, i, j) || !inside(centre_b, i, j)) continue;
      const auto at = static_cast<std::size_t>((j & (n - 1)) * n + (i & (n - 1)));
      ASSERT_EQ(a.Cells()[at], b.Cells()[at]) << i << ", " << j;
      ++compared;
      foamy += a.Cells()[at] > 20;
    }
  }
  EXPECT_GT(compared, 2000);
  EXPECT_GT(foamy, 20);
}

TEST(Foam, TwoWindowsAgreeWhereverAndWheneverTheyBegan) {
  const auto sea = DevelopedSea(18.0);
  constexpr int kN = 128;
  FoamWindow walker(sea, {.cells = kN}), newcomer(sea, {.cells = kN});
  // One has been about for 20 s and travels; it skips instants, reverses and jumps.
  Vec2d centre{5000.0, -300.0};
  for (const double t : {100.0, 100.25, 101.0, 103.3, 103.5, 106.0, 110.0, 112.5, 120.0}) {
    centre = centre + Vec2d{9.0, -4.0};
    if (t == 110.0) centre = centre + Vec2d{-300.0, 0.0};
    if (t == 112.5) centre = centre + Vec2d{-30.0, 40.0};
    walker.MoveTo(SimTime::FromSeconds(t), centre);
  }
  const Vec2d elsewhere = centre + Vec2d{40.0, 25.0};
  newcomer.MoveTo(SimTime::FromSeconds(120.1), elsewhere);
  ExpectAgreement(walker, newcomer, kN, centre, elsewhere);
}

TEST(Foam, HasTheSameBitsOnEverySimdTarget) {
  const auto sea = DevelopedSea(16.0);
  std::vector<std::uint8_t> first;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    FoamWindow window(sea, {.cells = 64});
    window.MoveTo(SimTime::FromSeconds(77.7), {-2e5, 3e5});
    const std::vector<std::uint8_t> cells(window.Cells().begin(), window.Cells().end());
    if (first.empty()) first = cells;
    EXPECT_EQ(cells, first) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace onesea::sea
