#include "server/stream/frame_builder.h"

#include <gtest/gtest.h>

#include "server/stream/broadcast.h"
#include "tests/stream/sample_welcome.h"

namespace onesea::server {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr int kTickRateHz = 60;

wire::Frame Decode(const FramePtr& frame) {
  absl::StatusOr<wire::Frame> decoded = wire::DecodeFrame(frame->bytes);
  EXPECT_TRUE(decoded.ok()) << decoded.status();
  return decoded.ok() ? *decoded : wire::Frame{};
}

// Drives a builder as a session in real time does: 60 ticks a second, streamed every second one,
// stamped each second.
class Ticker {
 public:
  explicit Ticker(FrameBuilder& builder) : builder_(builder) {}
  bool Step(bool watched = true) {
    TickEvent event;
    event.stamp = {
        .tick = tick_, .server_monotonic_ns = tick_ * kSecond / kTickRateHz, .speed = 1.0};
    event.stream_instant = tick_ % 2 == 0;
    event.stamp_instant = tick_ % kTickRateHz == 0;
    probes_ = {.tick = tick_, .height_m = std::vector<float>(8, static_cast<float>(tick_))};
    if (event.stamp_instant) event.probes = &probes_;
    ++tick_;
    return builder_.OnTick(event, watched);
  }
  Tick last() const { return tick_ - 1; }

 private:
  FrameBuilder& builder_;
  wire::ProbeHeights probes_;
  Tick tick_ = 0;
};

TEST(FrameBuilder, StampViewersAreToldOnceASecond) {
  FrameBuilder builder(Audience::kStamps);
  builder.OnWelcome(SampleWelcome());
  Ticker ticker(builder);
  int frames = 0;
  std::size_t bytes = 0;
  for (int n = 0; n < 10 * kTickRateHz; ++n) {
    if (!ticker.Step()) continue;
    ++frames;
    bytes += builder.newest()->bytes.size();
    const wire::Frame frame = Decode(builder.newest());
    EXPECT_EQ(frame.sequence, frames);
    EXPECT_EQ(frame.stamp->tick, ticker.last());
    ASSERT_TRUE(frame.probes.has_value());
    EXPECT_EQ(frame.probes->tick, ticker.last());
    EXPECT_FALSE(frame.keyframe);
    EXPECT_FALSE(frame.welcome.has_value());
  }
  EXPECT_EQ(frames, 10);
  // The issue allows 1 KB/s for everything on the wire; gRPC and HTTP/2 add 14 bytes a frame.
  EXPECT_LE(bytes / 10, 200u);
}

TEST(FrameBuilder, EveryFrameViewersAreToldEveryStreamedTick) {
  FrameBuilder builder(Audience::kEveryFrame);
  builder.OnWelcome(SampleWelcome());
  Ticker ticker(builder);
  for (int n = 0; n < 2 * kTickRateHz; ++n) EXPECT_EQ(ticker.Step(), n % 2 == 0) << n;
  EXPECT_EQ(builder.newest_sequence(), kTickRateHz);
}

// One body.
std::shared_ptr<world::WorldView> SmallWorld(Tick tick) {
  auto world = std::make_shared<world::WorldView>();
  world->tick = tick;
  world->interaction = std::make_shared<const sea::InteractionSnapshot>();
  world->past = std::make_shared<const sea::InteractionPast>();
  world->bodies.resize(1);
  world->bodies[0].state.id = 1;
  auto info = std::make_shared<wire::BodyInfo>();
  info->id = 1;
  info->mass_kg = 1.0;
  world->bodies[0].info = info;
  return world;
}

TickEvent EventOf(std::shared_ptr<const world::WorldView> world) {
  TickEvent event;
  event.stamp = {.tick = world->tick,
                 .server_monotonic_ns = world->tick * kSecond / kTickRateHz,
                 .speed = 1.0};
  event.stream_instant = world->tick % 2 == 0;
  event.world = std::move(world);
  return event;
}

// Tied between two frames and gone after a while: each told in one frame, and to newcomers between.
TEST(FrameBuilder, RopesAreToldWhenTheyChange) {
  FrameBuilder builder(Audience::kEveryFrame);
  builder.OnWelcome(SampleWelcome());
  const auto ropes = std::make_shared<const std::vector<wire::TiedRope>>(
      std::vector<wire::TiedRope>{{2, {{1, {}}, {0, {9, 0, 0}}}}});
  std::vector<int> told;  // by frame; -1: nothing said
  for (Tick tick = 1; tick <= 20; ++tick) {
    const auto world = SmallWorld(tick);
    if (tick >= 5 && tick < 13) world->ropes = ropes;
    if (!builder.OnTick(EventOf(world), true)) continue;
    const wire::RopeList list = Decode(builder.newest()).world->ropes;
    told.push_back(list == nullptr ? -1 : static_cast<int>(list->size()));
    const wire::RopeList joiners = Decode(builder.Keyframe()).world->ropes;
    if (tick >= 5 && tick < 13) {
      ASSERT_NE(joiners, nullptr) << tick;
      EXPECT_EQ(*joiners, *ropes);
    } else {
      EXPECT_EQ(joiners, nullptr) << tick;
    }
  }
  EXPECT_EQ(told, (std::vector<int>{-1, -1, 1, -1, -1, -1, 0, -1, -1, -1}));
}

// Frames come with every second tick; what is thrown up in the others is told too, once.
TEST(FrameBuilder, SprayOfEachTickIsToldOnce) {
  FrameBuilder builder(Audience::kEveryFrame);
  builder.OnWelcome(SampleWelcome());
  const auto step = [&](Tick tick, std::size_t events, bool watched) {
    const auto world = SmallWorld(tick);
    world->spray.assign(events, {{1, 2, 3}, {0, 0, 4}, static_cast<double>(tick)});
    const bool told = builder.OnTick(EventOf(world), watched);
    return told ? Decode(builder.newest()).world->spray : std::vector<wire::Spray>{};
  };
  step(1, 5, false);  // nobody saw it, nobody will
  EXPECT_TRUE(step(2, 0, true).empty());
  step(3, 2, true);
  const auto both = step(4, 1, true);
  ASSERT_EQ(both.size(), 3u);
  EXPECT_EQ(both[0].mass_kg, 3.0);
  EXPECT_EQ(both[2].mass_kg, 4.0);
  step(5, 0, true);
  EXPECT_TRUE(step(6, 0, true).empty());
  step(7, 200, true);
  EXPECT_EQ(step(8, 200, true).size(), 256u);
}

TEST(FrameBuilder, KeyframeIsTheWholeStateUnderTheNewestSequence) {
  FrameBuilder builder(Audience::kStamps);
  EXPECT_EQ(builder.newest_sequence(), -1);
  builder.OnWelcome(SampleWelcome());
  EXPECT_EQ(builder.newest_sequence(), -1) << "a welcome alone does not say what time it is";
  Ticker ticker(builder);
  for (int n = 0; n < 90; ++n) ticker.Step();
  const wire::Frame frame = Decode(builder.Keyframe());
  EXPECT_TRUE(frame.keyframe);
  EXPECT_EQ(frame.sequence, 2);
  EXPECT_EQ(frame.stamp->tick, 89);
  EXPECT_EQ(frame.probes->tick, 60);
  ASSERT_TRUE(frame.welcome.has_value());
  EXPECT_EQ(frame.welcome->recipe, SampleWelcome()->recipe);
  EXPECT_EQ(frame.welcome->component_hash, SampleWelcome()->component_hash);
  EXPECT_EQ(frame.welcome->session.tick, 89);
  // Everybody who asks within the tick shares the bytes.
  const FramePtr first = builder.Keyframe();
  EXPECT_EQ(first, builder.Keyframe());
  ticker.Step();
  EXPECT_NE(first, builder.Keyframe());
}

TEST(FrameBuilder, WithoutViewersNothingIsEncodedAndNewcomersStillGetTheNewest) {
  FrameBuilder builder(Audience::kEveryFrame);
  builder.OnWelcome(SampleWelcome());
  Ticker ticker(builder);
  for (int n = 0; n < 60; ++n) EXPECT_FALSE(ticker.Step(/*watched=*/false));
  EXPECT_EQ(builder.newest(), nullptr);
  EXPECT_EQ(Decode(builder.Keyframe()).stamp->tick, 59);
}

TEST(FrameBuilder, NewWeatherReachesEverybodyAtOnceAsAKeyframe) {
  FrameBuilder builder(Audience::kStamps);
  builder.OnWelcome(SampleWelcome());
  Ticker ticker(builder);
  for (int n = 0; n < 30; ++n) ticker.Step();
  auto changed = std::make_shared<wire::Welcome>(*SampleWelcome());
  changed->component_hash = 77;
  builder.OnWelcome(changed);
  EXPECT_EQ(builder.newest_sequence(), 2);
  const wire::Frame frame = Decode(builder.newest());
  EXPECT_TRUE(frame.keyframe);
  EXPECT_EQ(frame.sequence, 2);
  EXPECT_EQ(frame.welcome->component_hash, 77u);
}

// Lock-step with one-tick requests a millisecond apart: every one is a stamp instant.
TEST(FrameBuilder, ABurstOfStepsIsThinnedAndItsLastTickIsTold) {
  FrameBuilder builder(Audience::kStamps);
  builder.OnWelcome(SampleWelcome());
  int frames = 0;
  std::int64_t now_ns = 0;
  for (Tick tick = 0; tick < 1000; ++tick) {
    TickEvent event;
    now_ns = tick * 1'000'000;
    event.stamp = {
        .tick = tick, .server_monotonic_ns = now_ns, .speed = 0.0, .pace = Pace::kLockStep};
    event.stamp_instant = true;
    if (builder.OnTick(event, true)) ++frames;
  }
  EXPECT_EQ(frames, 10);
  EXPECT_FALSE(builder.Flush(now_ns));
  EXPECT_TRUE(builder.Flush(now_ns + kStampSpacingNs));
  EXPECT_EQ(Decode(builder.newest()).stamp->tick, 999);
  EXPECT_FALSE(builder.Flush(now_ns + 2 * kStampSpacingNs)) << "told once";
}

TEST(FrameBuilder, AChangeOfPaceIsNotHeldBack) {
  FrameBuilder builder(Audience::kStamps);
  builder.OnWelcome(SampleWelcome());
  TickEvent event;
  event.stamp_instant = true;
  event.stamp = {.tick = 1, .server_monotonic_ns = 0, .speed = 1.0};
  EXPECT_TRUE(builder.OnTick(event, true));
  event.stamp = {.tick = 2, .server_monotonic_ns = 1000, .speed = 0.0, .pace = Pace::kHeld};
  EXPECT_TRUE(builder.OnTick(event, true));
  EXPECT_EQ(Decode(builder.newest()).stamp->pace, Pace::kHeld);
}

TEST(FrameBuilder, FarewellIsInTheFrameAndInTheKeyframe) {
  FrameBuilder builder(Audience::kStamps);
  builder.OnWelcome(SampleWelcome());
  Ticker ticker(builder);
  ticker.Step();
  builder.OnClosed("deleted");
  EXPECT_EQ(Decode(builder.newest()).farewell, "deleted");
  EXPECT_EQ(Decode(builder.Keyframe()).farewell, "deleted");
  EXPECT_EQ(Decode(builder.Keyframe()).sequence, builder.newest_sequence());
}

TEST(Broadcast, WakesForWatchedAudiencesOnly) {
  int wakes = 0;
  Broadcast broadcast([&] { ++wakes; });
  broadcast.OnWelcomeChanged(SampleWelcome());
  wakes = 0;
  TickEvent event;
  event.stamp = {.tick = 2, .server_monotonic_ns = kSecond};
  event.stream_instant = true;
  broadcast.OnTick(event);
  EXPECT_EQ(wakes, 0);
  broadcast.AddViewer(Audience::kEveryFrame);
  event.stamp = {.tick = 4, .server_monotonic_ns = 2 * kSecond};
  broadcast.OnTick(event);
  EXPECT_EQ(wakes, 1);
  EXPECT_EQ(broadcast.newest(Audience::kEveryFrame, false).sequence, 1);
  EXPECT_EQ(broadcast.newest(Audience::kStamps, false).sequence, 0);
}

}  // namespace
}  // namespace onesea::server
