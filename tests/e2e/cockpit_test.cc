// Two viewers at one server, by the path that keys take, without a picture.
#include "client/app/cockpit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "client/app/pose_log.h"
#include "tests/e2e/harness.h"

namespace onesea::e2e {
namespace {

using client::Cockpit;
using client::SkipperInput;
using ::testing::HasSubstr;

constexpr std::int64_t kPictureNs = 16'666'667;

class Viewer {
 public:
  explicit Viewer(const TestServer& server) {
    auto source = client::JoinServer(absl::StrCat("127.0.0.1:", server.port()), "a");
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

TEST_F(CockpitTest, BothSeeTheBoatThatOneDrives) {
  Viewer driver(server_), watcher(server_);
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
  Viewer one(server_), two(server_);
  Launch(one);
  ASSERT_TRUE(Eventually([&] { return two.body_count() == 1; }));
  Launch(two);  // at the same camera
  EXPECT_NE(one.cockpit().own()->id, two.cockpit().own()->id);
  EXPECT_GT(Norm(one.cockpit().own()->position_m - two.cockpit().own()->position_m), 5.0);
}

TEST_F(CockpitTest, CratesExplosionsAndLeaving) {
  Viewer viewer(server_);
  Launch(viewer);
  const auto region_is_there = [&] {
    const auto sessions = server_.Remote()->ListBodies("a");
    return sessions.ok() && sessions->bodies.size() == 1;
  };
  ASSERT_TRUE(LookUntil(viewer, {}, region_is_there));
  viewer.Look({.crate = true});
  ASSERT_TRUE(LookUntil(viewer, {}, [&] { return viewer.body_count() == 2; }));
  viewer.Look({.explode = true});
  viewer.Look({.spawn = true});
  EXPECT_THAT(viewer.cockpit().report().line, HasSubstr("you have a boat"));
  viewer.Look({.remove = true});
  ASSERT_TRUE(LookUntil(viewer, {}, [&] { return !viewer.cockpit().own().has_value(); }));
  EXPECT_FALSE(viewer.cockpit().following());
  ASSERT_TRUE(LookUntil(viewer, {}, [&] { return viewer.body_count() == 1; }));  // the crate
  Launch(viewer);                                                                // another
}

TEST_F(CockpitTest, WhoLeavesStopsTheMotorAndLetsGo) {
  Viewer viewer(server_);
  Launch(viewer);
  ASSERT_TRUE(LookUntil(viewer, {.helm = {.ahead = true}},
                        [&] { return viewer.cockpit().report().throttle == 1.0; }));
  EXPECT_EQ(server_.Remote()->ListBodies("a")->bodies[0].driver, "a viewer");
  viewer.Leave();
  EXPECT_EQ(server_.Remote()->ListBodies("a")->bodies[0].driver, "");
}

// The server goes down under way and comes back without the boat.
TEST_F(CockpitTest, ALostServerIsToldAndALostBoatToo) {
  Viewer viewer(server_);
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
