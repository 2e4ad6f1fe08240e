#include "common/sea/interaction_past.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/base/sim_time.h"

namespace onesea::sea {
namespace {

constexpr int kRate = 60;
constexpr double kOmega = 3.14159265358979;  // a wave of 2 s

double Height(double tick, Vec2d place) {
  return 0.5 * std::cos(0.6 * place.x - kOmega * tick / kRate);
}

// A wave on 64 x 64 cells, with its velocities.
std::shared_ptr<const InteractionSnapshot> Wave(Tick tick) {
  auto field = std::make_shared<InteractionField>();
  field->cells = {.west = -32, .south = -32, .columns = 64, .rows = 64, .cell_m = 0.5};
  const auto flow = std::make_shared<InteractionFlow>();
  for (int n = 0; n < 64 * 64; ++n) {
    const Vec2d place = field->cells.PlaceOfIndex(n);
    const double phase = 0.6 * place.x - kOmega * static_cast<double>(tick) / kRate;
    field->height_m.push_back(static_cast<float>(0.5 * std::cos(phase)));
    flow->x.push_back(static_cast<float>(0.5 * kOmega * std::cos(phase)));
    flow->y.push_back(0.0f);
    flow->z.push_back(static_cast<float>(0.5 * kOmega * std::sin(phase)));
  }
  field->flow = flow;
  auto snapshot = std::make_shared<InteractionSnapshot>();
  snapshot->tick = tick;
  snapshot->fields = {field};
  return snapshot;
}

class Past : public ::testing::Test {
 protected:
  std::optional<InteractionMoment> At(double tick) const {
    return FindMoment(past_, *present_, tick, kRate);
  }
  InteractionPast past_{Wave(100), Wave(106), Wave(112)};
  std::shared_ptr<const InteractionSnapshot> present_ = Wave(115);
};

TEST_F(Past, AnswersFromTheOldestToThePresentAndNoFurther) {
  EXPECT_FALSE(At(99.99).has_value());
  EXPECT_FALSE(At(115.01).has_value());
  EXPECT_FALSE(At(std::nan("")).has_value());
  EXPECT_FALSE(FindMoment({}, *present_, 114.0, kRate).has_value());
  ASSERT_TRUE(At(100.0).has_value());
  EXPECT_EQ(At(100.0)->before->tick, 100);
  EXPECT_EQ(At(100.0)->after->tick, 100);
  EXPECT_EQ(At(115.0)->before->tick, 115);
  EXPECT_EQ(At(113.0)->before->tick, 112);
  EXPECT_EQ(At(113.0)->after->tick, 115);
  EXPECT_NEAR(At(113.0)->share, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(At(113.0)->span_s, 0.05, 1e-12);
}

TEST_F(Past, FollowsAWaveBetweenWhatIsKept) {
  for (double tick = 100.0; tick <= 115.0; tick += 0.25) {
    for (const Vec2d place : {Vec2d{0.0, 0.0}, Vec2d{2.5, 1.0}, Vec2d{-7.0, 3.0}}) {
      const InteractionSample sample = SampleInteraction(*At(tick), place);
      // On cells, so that only time is interpolated: (0.314)⁴/384 of half a metre is 13 µm.
      EXPECT_NEAR(sample.height_m, Height(tick, place), 2e-5) << tick;
      const double phase = 0.6 * place.x - kOmega * tick / kRate;
      EXPECT_NEAR(sample.velocity.z, 0.5 * kOmega * std::sin(phase), 0.013 * 0.5 * kOmega) << tick;
    }
  }
}

}  // namespace
}  // namespace onesea::sea
