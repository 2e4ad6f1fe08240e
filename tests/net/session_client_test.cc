// SessionClient against a server made for the test, over loopback sockets.

#include "client/net/session_client.h"

#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>
#include <gtest/gtest.h>

#include <mutex>
#include <vector>

#include "absl/strings/str_cat.h"
#include "common/base/clock.h"
#include "onesea/v1/onesea.grpc.pb.h"

namespace onesea::client {
namespace {

// Sends a welcome with a stamp, then a stamp every few milliseconds, and keeps what it is told.
class FakeService final : public v1::OneSea::Service {
 public:
  grpc::Status Watch(
      grpc::ServerContext* context,
      grpc::ServerReaderWriter<v1::WatchResponse, v1::WatchRequest>* stream) override {
    v1::WatchRequest request;
    if (!stream->Read(&request) || request.open().session() != "storm") {
      return {grpc::StatusCode::NOT_FOUND, "session: none has this name"};
    }
    std::thread reader([&] {
      while (stream->Read(&request)) {
        std::lock_guard lock(mutex_);
        acks_.push_back(request.ack());
      }
    });
    for (int n = 1; n <= frames_max_ && !context->IsCancelled(); ++n) {
      v1::WatchResponse response;
      response.set_sequence(n < 6 ? n : n + 2);  // two frames skipped after the fifth
      response.mutable_stamp()->set_tick(60 * n);
      response.mutable_stamp()->set_server_monotonic_ns(SystemClock().MonotonicNs());
      response.mutable_stamp()->set_speed(1.0);
      response.mutable_stamp()->set_pace(v1::PACE_REAL_TIME);
      if (n == 1) FillWelcome(response.mutable_welcome());
      if (!stream->Write(response)) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    context->TryCancel();
    reader.join();
    return grpc::Status::OK;
  }
  grpc::Status SyncClock(grpc::ServerContext*, const v1::SyncClockRequest*,
                         v1::SyncClockResponse* response) override {
    response->set_server_monotonic_ns(SystemClock().MonotonicNs() + kOffsetNs);
    return grpc::Status::OK;
  }
  std::vector<v1::WatchRequest::Ack> acks() {
    std::lock_guard lock(mutex_);
    return acks_;
  }
  void set_frames_max(int count) { frames_max_ = count; }

  static constexpr std::int64_t kOffsetNs = 42'000'000'000;

 private:
  static void FillWelcome(v1::Welcome* welcome) {
    v1::Recipe& recipe = *welcome->mutable_recipe();
    recipe.set_sea_model_version(1);
    recipe.set_seed(1);
    recipe.set_tick_rate_hz(60);
    recipe.set_amplitude(v1::AMPLITUDE_KIND_FIXED);
    recipe.set_choppiness(1);
    v1::Cascade& cascade = *recipe.add_cascades();
    cascade.set_length_m(100);
    cascade.set_wavenumber_max_rad_per_m(1.0);
    cascade.set_query_grid_size(256);
    v1::JonswapSystem& jonswap =
        *recipe.add_timeline()->mutable_sea()->add_systems()->mutable_jonswap();
    jonswap.set_hs_m(2);
    jonswap.set_tp_s(8);
    jonswap.mutable_direction()->set_to_rad(0);
    welcome->mutable_session()->set_name("storm");
    welcome->mutable_session()->set_tick_rate_hz(60);
    welcome->mutable_session()->set_stream_rate_hz(30);
    welcome->mutable_session()->set_pace(v1::PACE_REAL_TIME);
  }

  std::mutex mutex_;
  std::vector<v1::WatchRequest::Ack> acks_;
  std::atomic<int> frames_max_ = 1'000'000;
};

struct FakeServer {
  FakeService service;
  int port = 0;
  std::unique_ptr<grpc::Server> server;

  explicit FakeServer(int wanted_port = 0) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort(absl::StrCat("127.0.0.1:", wanted_port),
                             grpc::InsecureServerCredentials(), &port);
    builder.RegisterService(&service);
    server = builder.BuildAndStart();
  }
  ~FakeServer() {
    if (server) server->Shutdown(gpr_time_0(GPR_TIMESPAN));
  }
  std::string address() const { return absl::StrCat("127.0.0.1:", port); }
};

template <typename Condition>
bool Eventually(Condition condition) {
  for (int n = 0; n < 1000; ++n) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

TEST(SessionClient, FollowsAcknowledgesAndCountsGaps) {
  FakeServer fake;
  ASSERT_NE(fake.server, nullptr);
  std::atomic<int> welcomes = 0;
  SessionClient client(fake.address(), {.session = "storm"},
                       {.on_frame = [&](const wire::Frame& f) {
                         if (f.welcome) ++welcomes;
                       }});
  client.SetDrift(0.25);
  ASSERT_TRUE(Eventually([&] { return fake.service.acks().size() >= 4; }));
  EXPECT_EQ(welcomes, 1);
  EXPECT_EQ(client.Report().frames_skipped, 2);
  const auto acks = fake.service.acks();
  EXPECT_EQ(acks[0].sequence(), 1) << "the welcome at once";
  EXPECT_EQ(acks[1].sequence(), 5) << "then every fourth frame";
  EXPECT_FLOAT_EQ(acks[2].drift_m(), 0.25f);
}

// The fake server's clock is ours plus 42 s and its stamps are not: sea time must be 42 s behind.
TEST(SessionClient, ReadsStampsByTheServersClock) {
  FakeServer fake;
  SessionClient client(fake.address(), {.session = "storm"}, {});
  ASSERT_TRUE(Eventually([&] {
    const auto report = client.Report();
    return report.clock && report.frames_received > 10 && client.SeaTime();
  }));
  const auto clock = *client.Report().clock;
  EXPECT_NEAR(static_cast<double>(clock.offset_ns), static_cast<double>(FakeService::kOffsetNs),
              static_cast<double>(clock.error_ns));
  EXPECT_GE(client.SeaTime()->Seconds(), 42.0);
}

TEST(SessionClient, ComesBackWhenTheServerDoes) {
  auto fake = std::make_unique<FakeServer>();
  const int port = fake->port;
  SessionClient client(fake->address(), {.session = "storm"}, {});
  ASSERT_TRUE(Eventually([&] { return client.SeaTime().has_value(); }));
  fake.reset();
  ASSERT_TRUE(Eventually([&] { return !client.Report().connected; }));
  EXPECT_TRUE(client.SeaTime().has_value()) << "the sea goes on meanwhile";
  FakeServer again(port);
  ASSERT_NE(again.server, nullptr);
  EXPECT_TRUE(Eventually([&] { return client.Report().connection_count == 2; }));
  EXPECT_TRUE(client.Report().final_status.ok());
}

TEST(SessionClient, GivesUpOnASessionThatDoesNotExist) {
  FakeServer fake;
  SessionClient client(fake.address(), {.session = "calm"}, {});
  ASSERT_TRUE(Eventually([&] { return !client.Report().final_status.ok(); }));
  EXPECT_EQ(client.Report().final_status.code(), absl::StatusCode::kNotFound);
}

TEST(SessionClient, EndsWhileNobodyAnswers) {
  SessionClient client("127.0.0.1:1", {.session = "storm"}, {});
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(client.Report().connected);
}

}  // namespace
}  // namespace onesea::client
