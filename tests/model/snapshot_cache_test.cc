#include "client/model/snapshot_cache.h"

#include <gtest/gtest.h>

#include "tests/model/welcome_for_tests.h"

namespace onesea::client {
namespace {

using sea::QueryDetail;

SimTime Second(double seconds) { return SimTime::FromSeconds(seconds); }

float HeightIn(const sea::SeaSnapshot& snapshot) {
  const Vec2d place{17.0, 3.0};
  sea::SurfaceSample sample;
  snapshot.Sample({&place, 1}, {&sample, 1});
  return sample.height_m;
}

TEST(SnapshotCache, SameMomentIsSynthesisedOnce) {
  SnapshotCache cache(*sea::BuildComponents(ChoppyRecipe()));
  const auto first = cache.At(Second(1), QueryDetail::kHeight);
  EXPECT_EQ(cache.At(Second(1), QueryDetail::kHeight), first);
  EXPECT_NE(cache.At(Second(2), QueryDetail::kHeight), first);
}

TEST(SnapshotCache, MoreDetailServesLessButNotTheOtherWay) {
  SnapshotCache cache(*sea::BuildComponents(ChoppyRecipe()));
  const auto plain = cache.At(Second(1), QueryDetail::kHeight);
  const auto full = cache.At(Second(1), QueryDetail::kVelocity);
  EXPECT_NE(full, plain);
  EXPECT_GE(full->detail(), QueryDetail::kVelocity);
  EXPECT_EQ(cache.At(Second(1), QueryDetail::kNormal)->detail(), QueryDetail::kVelocity);
}

TEST(SnapshotCache, TheMomentLeastRecentlyUsedMakesRoom) {
  SnapshotCache cache(*sea::BuildComponents(ChoppyRecipe()));
  const auto kept = cache.At(Second(0), QueryDetail::kHeight);
  const std::weak_ptr<const sea::SeaSnapshot> dropped = cache.At(Second(0.5), QueryDetail::kHeight);
  for (int n = 1; n < SnapshotCache::kSnapshotsHeld; ++n) {
    cache.At(Second(n), QueryDetail::kHeight);
    EXPECT_EQ(cache.At(Second(0), QueryDetail::kHeight), kept);
  }
  const auto again = cache.At(Second(0.5), QueryDetail::kHeight);
  EXPECT_EQ(again->time(), Second(0.5));
}

// Storage is reused, so a snapshot that somebody still holds must not be written over.
TEST(SnapshotCache, HeldSnapshotNeverChanges) {
  SnapshotCache cache(*sea::BuildComponents(ChoppyRecipe()));
  const auto held = cache.At(Second(1), QueryDetail::kHeight);
  const float height_m = HeightIn(*held);
  for (int n = 2; n < 4 * SnapshotCache::kSnapshotsHeld; ++n) {
    cache.At(Second(n), QueryDetail::kHeight);
  }
  EXPECT_EQ(held->time(), Second(1));
  EXPECT_EQ(HeightIn(*held), height_m);
}

}  // namespace
}  // namespace onesea::client
