#include "client/model/helm.h"

#include <gtest/gtest.h>

namespace onesea::client {
namespace {

constexpr double kFrameS = 1.0 / 60.0;

void Hold(Helm& helm, const HelmKeys& keys, double seconds) {
  for (double t = 0; t < seconds - 1e-9; t += kFrameS) helm.Advance(keys, kFrameS);
}

TEST(Helm, TheFirstFrameAnswers) {
  Helm helm;
  helm.Advance({.ahead = true, .port = true}, kFrameS);
  EXPECT_GT(helm.order().throttle, 0.01);
  EXPECT_GT(helm.order().rudder, 0.03);
}

TEST(Helm, TheLeverStaysAndTheWheelReturns) {
  Helm helm;
  Hold(helm, {.ahead = true, .starboard = true}, 0.5);
  EXPECT_NEAR(helm.order().throttle, 0.5 * Helm::kThrottlePerS, 0.02);
  EXPECT_EQ(helm.order().rudder, -1.0);
  Hold(helm, {}, 0.5);
  EXPECT_NEAR(helm.order().throttle, 0.5 * Helm::kThrottlePerS, 0.02);
  EXPECT_EQ(helm.order().rudder, 0.0);
}

TEST(Helm, KeepsWithinItsRange) {
  Helm helm;
  Hold(helm, {.astern = true, .port = true}, 5.0);
  EXPECT_EQ(helm.order(), (HelmOrder{-1.0, 1.0}));
  Hold(helm, {.ahead = true, .astern = true, .port = true, .starboard = true}, 1.0);
  EXPECT_EQ(helm.order(), (HelmOrder{-1.0, 0.0}));  // both keys are none
}

TEST(Helm, StopsInNeutralUntilTheKeyIsPressedAnew) {
  Helm helm;
  Hold(helm, {.ahead = true}, 2.0);
  Hold(helm, {.astern = true}, 3.0);
  EXPECT_EQ(helm.order().throttle, 0.0);
  Hold(helm, {}, 0.1);
  Hold(helm, {.astern = true}, 0.5);
  EXPECT_LT(helm.order().throttle, -0.3);
}

TEST(Helm, ATurnOverTheMiddleIsNotSlowerThanLettingGo) {
  Helm over, back;
  for (Helm* helm : {&over, &back}) Hold(*helm, {.port = true}, 1.0);
  over.Advance({.starboard = true}, 0.1);
  back.Advance({}, 0.1);
  EXPECT_LE(over.order().rudder, back.order().rudder);
}

TEST(Helm, AStallOrABadClockDoesNotMoveItFar) {
  Helm helm;
  helm.Advance({.ahead = true}, 60.0);
  EXPECT_LE(helm.order().throttle, 0.5 * Helm::kThrottlePerS);
  const HelmOrder before = helm.order();
  helm.Advance({.ahead = true}, -1.0);
  helm.Advance({.ahead = true}, 0.0 / 0.0);
  EXPECT_EQ(helm.order(), before);
}

TEST(OrderTimer, ChangesGoOutAtMostTwentyTimesASecond) {
  OrderTimer timer;
  int sent = 0;
  for (int n = 0; n < 600; ++n) {  // ten seconds at 60 pictures, another order in each
    if (timer.MustSend({0.001 * n, 0.0}, 16'666'667LL * n)) ++sent;
  }
  EXPECT_LE(sent, 201);
  EXPECT_GE(sent, 140);  // every third or fourth picture
}

TEST(OrderTimer, TheLastChangeIsNeverLost) {
  OrderTimer timer;
  EXPECT_TRUE(timer.MustSend({0.5, 0.0}, 0));
  EXPECT_FALSE(timer.MustSend({0.0, 0.0}, 10'000'000));
  EXPECT_TRUE(timer.MustSend({0.0, 0.0}, 60'000'000));
  EXPECT_FALSE(timer.MustSend({0.0, 0.0}, 120'000'000));
}

// A spawner's lease lasts 60 s after its last use.
TEST(OrderTimer, RemindsBeforeALeaseEnds) {
  OrderTimer timer;
  ASSERT_TRUE(timer.MustSend({0.5, 0.0}, 0));
  int sent = 0;
  for (std::int64_t second = 1; second <= 60; ++second) {
    if (timer.MustSend({0.5, 0.0}, second * 1'000'000'000)) ++sent;
  }
  EXPECT_EQ(sent, 4);
  timer.SendAgain();
  EXPECT_TRUE(timer.MustSend({0.5, 0.0}, 60'000'000'001));
}

}  // namespace
}  // namespace onesea::client
