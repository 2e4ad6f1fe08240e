// Two viewers at one server, by the path that keys take, without a picture.
#include "client/app/cockpit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "tests/e2e/harness.h"
#include "tests/e2e/tcp_relay.h"

namespace onesea::e2e {
namespace {

using client::Cockpit;
using client::SkipperInput;
using ::testing::HasSubstr;

constexpr std::int64_t kPictureNs = 16'666'667;

class Viewer {
 public:
  explicit Viewer(int port) {
    auto source = client::JoinServer(absl::StrCat("127.0.0.1:", port), "a");
    EXPECT_TRUE(source.ok()) << source.status();
    source_ = std::move(*source);
    cockpit_ = std::make_unique<Cockpit>(*source_, *client::CameraControl::FromPreset("deck", 0.0));
  }
  // A picture.
  void Look(const SkipperInput& keys) {
    now_ = source_->Now();
    cockpit_->Update(keys, {}, now_, 1e-9 * kPictureNs);
  }
  const wire::BodyTable::Body* Streamed(std::uint32_t id) {
    world_ = source_->world();
    return world_->FindBody(id);
  }
  std::size_t body_count() const { return source_->world()->bodies().size(); }
  // -1e9: no region of the interaction layer is there.
  double HighestWakeM() const {
    double highest_m = -1e9;
    for (const auto& field : source_->world()->interaction().fields) {
      for (float height_m : field->height_m) highest_m = std::max<double>(highest_m, height_m);
    }
    return highest_m;
  }
  Cockpit& cockpit() { return *cockpit_; }
  SimTime now() const { return now_; }
  void Leave() { cockpit_.reset(); }

 private:
  std::unique_ptr<client::SeaSource> source_;
  std::unique_ptr<Cockpit> cockpit_;
  std::shared_ptr<const client::WorldView> world_;
  SimTime now_;
};

class CockpitTest : public testing::Test {
 protected:
  CockpitTest() { server_.Create(SmallSession("a")); }

  // Pictures of both until it holds; false: not in time.
  bool LookUntil(Viewer& driver, const SkipperInput& keys, const std::function<bool()>& condition) {
    for (int n = 0; n < 60 * 20; ++n) {
      driver.Look(keys);
      if (condition()) return true;
      SystemClock().SleepUntil(SystemClock().MonotonicNs() + kPictureNs);
    }
    return false;
  }
  void Launch(Viewer& viewer) {
    viewer.Look({.spawn = true});
    ASSERT_TRUE(LookUntil(viewer, {}, [&] { return viewer.cockpit().own().has_value(); }))
        << viewer.cockpit().report().line;
  }

  TestServer server_{Transport::kLoopback};
};

// The driver is 50 ms away from the server, each way; the watcher is next to it, and sees the boat
// a frame old, from both sides of the moment.
TEST_F(CockpitTest, BothSeeTheBoatThatOneDrivesFromAfar) {
  TcpRelay relay(server_.port(), 50'000'000);
  Viewer driver(relay.port()), watcher(server_.port());
  Launch(driver);
  const std::uint32_t id = driver.cockpit().own()->id;
  EXPECT_TRUE(driver.cockpit().following());
  double worst_m = 0.0, fastest_m_per_s = 0.0;
  int compared = 0;
  const std::int64_t end_ns = SystemClock().MonotonicNs() + 6'000'000'000;
  LookUntil(driver, {.helm = {.ahead = true}}, [&] {
    watcher.Look({});
    const wire::BodyTable::Body* seen = watcher.Streamed(id);
    if (seen != nullptr) {
      // Both at the driver's moment.
      const wire::BodyState own = *driver.cockpit().own(), other = seen->At(driver.now());
      worst_m = std::max(worst_m, Norm(own.position_m - other.position_m));
      fastest_m_per_s = std::max(fastest_m_per_s, Norm(own.velocity_m_per_s));
      ++compared;
    }
    return SystemClock().MonotonicNs() > end_ns;
  });
  std::printf("%d comparisons, at most %.3f m apart, up to %.1f m/s\n", compared, worst_m,
              fastest_m_per_s);
  EXPECT_GT(compared, 20);
  EXPECT_GT(fastest_m_per_s, 2.0);
  EXPECT_LT(worst_m, 0.5);
  EXPECT_EQ(driver.cockpit().report().throttle, 1.0);
}

TEST_F(CockpitTest, TwoDriversGetABoatEachApartFromOneAnother) {
  Viewer one(server_.port()), two(server_.port());
  Launch(one);
  ASSERT_TRUE(Eventually([&] { return two.body_count() == 1; }));
  Launch(two);  // at the same camera
  EXPECT_NE(one.cockpit().own()->id, two.cockpit().own()->id);
  EXPECT_GT(Norm(one.cockpit().own()->position_m - two.cockpit().own()->position_m), 5.0);
}

TEST_F(CockpitTest, CratesExplosionsAndLeaving) {
  Viewer viewer(server_.port());
  Launch(viewer);
  ASSERT_TRUE(LookUntil(viewer, {}, [&] { return viewer.HighestWakeM() > -1.0; }));
  viewer.Look({.crate = true});
  ASSERT_TRUE(LookUntil(viewer, {}, [&] { return viewer.body_count() == 2; }));
  EXPECT_LT(viewer.HighestWakeM(), 0.5);
  viewer.Look({.explode = true});
  ASSERT_TRUE(LookUntil(viewer, {}, [&] { return viewer.HighestWakeM() > 0.5; }))
      << viewer.cockpit().report().line;
  viewer.Look({.spawn = true});
  EXPECT_THAT(viewer.cockpit().report().line, HasSubstr("you have a boat"));
  viewer.Look({.remove = true});
  ASSERT_TRUE(LookUntil(viewer, {}, [&] { return !viewer.cockpit().own().has_value(); }));
  EXPECT_FALSE(viewer.cockpit().following());
  ASSERT_TRUE(LookUntil(viewer, {}, [&] { return viewer.body_count() == 1; }));  // the crate
  Launch(viewer);                                                                // another
}

TEST_F(CockpitTest, WhoLeavesStopsTheMotorAndLetsGo) {
  Viewer viewer(server_.port());
  Launch(viewer);
  ASSERT_TRUE(LookUntil(viewer, {.helm = {.ahead = true}},
                        [&] { return viewer.cockpit().report().throttle == 1.0; }));
  EXPECT_EQ(server_.Remote()->ListBodies("a")->bodies[0].driver, "a viewer");
  viewer.Leave();
  EXPECT_EQ(server_.Remote()->ListBodies("a")->bodies[0].driver, "");
}

// The server goes down under way and comes back without the boat.
TEST_F(CockpitTest, ALostServerIsToldAndALostBoatToo) {
  Viewer viewer(server_.port());
  Launch(viewer);
  server_.Stop();
  ASSERT_TRUE(LookUntil(viewer, {.helm = {.ahead = true}}, [&] {
    return viewer.cockpit().report().line.find("no answer") != std::string::npos;
  }));
  EXPECT_TRUE(viewer.cockpit().own().has_value());  // still shown, and the helm still answers
  server_.Start();
  server_.Create(SmallSession("a"));
  ASSERT_TRUE(LookUntil(viewer, {}, [&] { return !viewer.cockpit().report().aboard; }));
  EXPECT_FALSE(viewer.cockpit().own().has_value());
  Launch(viewer);
}

}  // namespace
}  // namespace onesea::e2e
