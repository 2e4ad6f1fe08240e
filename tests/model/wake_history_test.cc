#include "client/model/wake_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace onesea::client {
namespace {

constexpr Vec2d kPlace{8.0, 8.0};
constexpr SimTime kStep{kFlicksPerSecond / 30};

SimTime Steps(double count) { return SimTime{static_cast<std::int64_t>(count * kStep.flicks)}; }

// All cells at one height: no interpolation in space.
wire::RegionField Region(std::uint32_t id, float height_m, std::int64_t west = 0,
                         double height_step_m = 1e-3) {
  wire::RegionField field;
  field.layout.id = id;
  field.layout.cells = {.west = west, .south = 0, .columns = 64, .rows = 64, .cell_m = 0.5};
  field.layout.height_step_m = height_step_m;
  field.height_m.assign(field.layout.cells.cells(), height_m);
  return field;
}

double HeightAt(const WakeHistory& history, SimTime time) {
  return WakeHistory::SampleAt(history.MomentAt(time), kPlace).height_m;
}

class WakeHistoryTest : public testing::Test {
 protected:
  // The next update, a step later.
  void Add(const std::vector<wire::RegionField>& fields) {
    history_.Add(Steps(++count_), fields, Steps(10));
  }
  SimTime last() const { return history_.time(); }

  WakeHistory history_;
  int count_ = 0;
};

TEST_F(WakeHistoryTest, GoesOnByTheLastChangeThenStandsThenFades) {
  Add({Region(1, 0.10F)});
  Add({Region(1, 0.11F)});
  // Known for one change only: that may have taken longer.
  EXPECT_NEAR(HeightAt(history_, last() + Steps(1)), 0.11, 1e-6);
  Add({Region(1, 0.12F)});
  EXPECT_NEAR(HeightAt(history_, last()), 0.12, 1e-6);
  EXPECT_NEAR(HeightAt(history_, last() + Steps(0.5)), 0.125, 1e-6);
  EXPECT_NEAR(HeightAt(history_, last() + Steps(2)), 0.14, 1e-6);
  EXPECT_NEAR(HeightAt(history_, last() + Steps(10)), 0.14, 1e-6);
  EXPECT_NEAR(HeightAt(history_, last() + Steps(30 * 1.5 * WakeHistory::kStandsS)), 0.07, 1e-5);
  EXPECT_FALSE(history_.MomentAt(last() + Steps(30 * 2.0 * WakeHistory::kStandsS)));
  EXPECT_NEAR(HeightAt(history_, Steps(1.5)), 0.105, 1e-6);
}

TEST_F(WakeHistoryTest, ARegionThatComesRarelyStandsStill) {
  for (const float height_m : {0.1F, 0.1F, 0.2F, 0.2F, 0.3F}) {
    Add({Region(1, height_m)});
    EXPECT_NEAR(HeightAt(history_, last() + Steps(1)), height_m, 1e-6);
  }
}

TEST_F(WakeHistoryTest, ARegionThatComesOrGoesLeavesNothingBehind) {
  for (const float height_m : {0.1F, 0.2F, 0.3F}) Add({Region(1, height_m)});
  Add({});
  EXPECT_EQ(HeightAt(history_, last() + Steps(1)), 0.0);
  EXPECT_FALSE(history_.MomentAt(last()));
  Add({Region(2, 0.5F)});
  EXPECT_NEAR(HeightAt(history_, last() + Steps(1)), 0.5, 1e-6);
  EXPECT_NEAR(HeightAt(history_, last() - Steps(0.5)), 0.25, 1e-6);
}

// The numbers of regions change places; each goes on by its own change.
TEST_F(WakeHistoryTest, RegionsAreKnownByTheirIds) {
  Add({Region(1, 0.1F), Region(2, 0.5F)});
  Add({Region(2, 0.5F), Region(1, 0.2F)});
  Add({Region(3, 0.0F), Region(1, 0.3F), Region(2, 0.5F)});
  EXPECT_NEAR(HeightAt(history_, last() + Steps(1)), 0.4 + 0.5, 1e-6);
}

TEST_F(WakeHistoryTest, WhatDidNotChangeIsTheSameObject) {
  Add({Region(1, 0.1F), Region(2, 0.2F)});
  const auto first = history_.newest();
  Add({Region(1, 0.1F), Region(2, 0.3F)});
  const auto second = history_.newest();
  EXPECT_EQ(first->fields[0], second->fields[0]);
  EXPECT_NE(first->fields[1], second->fields[1]);
  // A sea that stands still tells the same again and again.
  history_.Add(last(), std::vector{Region(1, 0.1F), Region(2, 0.3F)}, Steps(10));
  EXPECT_EQ(history_.newest(), second);
  history_.Add(last(), std::vector{Region(1, 0.1F), Region(2, 0.4F)}, Steps(10));
  EXPECT_NEAR(HeightAt(history_, last()), 0.5, 1e-6);
  EXPECT_NEAR(HeightAt(history_, last() - Steps(0.5)), 0.4, 1e-6);
}

// Steps add where regions overlap, the two cells beyond them included.
TEST_F(WakeHistoryTest, TheErrorIsThatOfTheRegionsThatMeet) {
  constexpr double kSpline = 25.0 / 16.0;
  Add({Region(1, 0.0F), Region(2, 0.0F, 1000, 4e-3)});
  EXPECT_NEAR(history_.MomentAt(last()).height_error_m, 4e-3 * kSpline, 1e-12);
  Add({Region(1, 0.0F), Region(2, 0.0F, 67, 4e-3)});
  EXPECT_NEAR(history_.MomentAt(last()).height_error_m, 5e-3 * kSpline, 1e-12);
  Add({Region(1, 0.0F), Region(2, 0.0F, 68, 4e-3)});
  EXPECT_NEAR(history_.MomentAt(last()).height_error_m, 4e-3 * kSpline, 1e-12);
}

}  // namespace
}  // namespace onesea::client
