// SessionClient and RemoteServer against a real server, with and without sockets.
#include "client/net/session_client.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "common/sea/components.h"
#include "tests/e2e/harness.h"
#include "tests/e2e/tcp_relay.h"

namespace onesea::e2e {
namespace {

using client::LinkState;
using client::SeaTime;
using client::SessionClient;

// "1 ms-ish": the goal on a quiet machine is far below; a busy one may take this long between two
// readings.
constexpr double kSeaTimeErrorMaxS = 1e-3;

client::SessionClientOptions Options(bool every_frame = false) {
  client::SessionClientOptions options;
  options.session = "a";
  options.every_frame = every_frame;
  options.backoff = {.first_ns = 5'000'000, .longest_ns = 50'000'000};
  return options;
}

// Client and server share this process's clock, so the truth needs no synchronisation: the newest
// stamp and the time. The best of some readings: a preempted thread between two of them is not the
// estimate's fault.
double SeaTimeError(SessionClient& client, const wire::Stamp& stamp, int tick_rate_hz = 60) {
  double best_s = 1e9;
  for (int n = 0; n < 20; ++n) {
    const std::int64_t before_ns = SystemClock().MonotonicNs();
    const SeaTime now = client.Now();
    const std::int64_t after_ns = SystemClock().MonotonicNs();
    const double since_s =
        static_cast<double>((before_ns + after_ns) / 2 - stamp.server_monotonic_ns) * 1e-9;
    const double truth_s = TimeOfTick(stamp.tick, tick_rate_hz).Seconds() + since_s * stamp.speed;
    best_s = std::min(best_s, std::abs(now.exact.Seconds() - truth_s));
  }
  return best_s;
}

class Client : public testing::TestWithParam<Transport> {
 protected:
  TestServer server_{GetParam()};
  Recorder recorder_;
};

INSTANTIATE_TEST_SUITE_P(Transports, Client,
                         testing::Values(Transport::kInProcess, Transport::kLoopback),
                         [](const auto& info) {
                           return info.param == Transport::kInProcess ? "InProcess" : "Loopback";
                         });

TEST_P(Client, JoinsAndKnowsTheTime) {
  server_.Create(SmallSession("a"));
  SessionClient client(server_.Connect(), Options(), recorder_);
  ASSERT_TRUE(recorder_.AwaitFrames(2));
  const wire::Frame welcome = recorder_.frames().front();
  ASSERT_TRUE(welcome.welcome.has_value());
  EXPECT_EQ(welcome.welcome->component_hash,
            (*sea::BuildComponents(SmallSession("a").recipe))->hash);
  ASSERT_TRUE(Eventually([&] { return client.Now().valid; }));
  const SeaTime now = client.Now();
  EXPECT_LE(SeaTimeError(client, *recorder_.frames().back().stamp), kSeaTimeErrorMaxS);
  EXPECT_GT(now.error_bound_s, 0.0);
  EXPECT_EQ(client.stats().state, LinkState::kLive);
  client.Stop();
  EXPECT_EQ(client.stats().state, LinkState::kStopped);
}

TEST_P(Client, EveryFrameWithoutGapsWhenItKeepsUp) {
  server_.Create(SmallSession("a"));
  SessionClient client(server_.Connect(), Options(true), recorder_);
  ASSERT_TRUE(recorder_.AwaitFrames(120));
  // 120 frames are far more than the credit: they came because they were acknowledged.
  EXPECT_LT(client.stats().gaps, 60);
}

TEST_P(Client, ReportsItsDriftToTheServer) {
  server_.Create(SmallSession("a"));
  std::ostringstream log;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(log)));
  {
    SessionClient client(server_.Connect(), Options(true), recorder_);
    client.ReportDrift(0.25);
    ASSERT_TRUE(recorder_.AwaitFrames(20));
  }
  server_.Stop();
  spdlog::set_default_logger(before);
  EXPECT_THAT(log.str(), testing::HasSubstr("viewer \"onesea\" is 0.250 m off"));
}

TEST_P(Client, ComesBackAfterTheServerDidAndKnowsItsTime) {
  server_.Create(SmallSession("a"));
  SessionClient client(server_.Connect(), Options(), recorder_);
  ASSERT_TRUE(recorder_.AwaitFrames(2));
  server_.Stop();
  ASSERT_TRUE(recorder_.AwaitLink(LinkState::kWaiting));
  EXPECT_TRUE(client.Now().valid) << "the sea runs on while the link is lost";
  server_.Start();
  // It may be refused once more: the session is not there yet.
  absl::SleepFor(absl::Milliseconds(100));
  server_.Create(SmallSession("a"));
  ASSERT_TRUE(Eventually([&] { return client.stats().connections == 2; }));
  ASSERT_TRUE(Eventually([&] {
    const wire::Frame frame = recorder_.frames().back();
    return frame.stamp.has_value() && SeaTimeError(client, *frame.stamp) <= kSeaTimeErrorMaxS;
  }));
}

TEST_P(Client, FollowsHoldStepResumeAndSpeed) {
  server_.Create(SmallSession("a"));
  SessionClient client(server_.Connect(), Options(), recorder_);
  ASSERT_TRUE(recorder_.AwaitFrames(1));
  const std::unique_ptr<client::RemoteServer> remote = server_.Remote();

  const absl::StatusOr<Tick> held = remote->Hold("a");
  ASSERT_TRUE(held.ok()) << held.status();
  EXPECT_TRUE(Eventually([&] { return client.Now().render == TimeOfTick(*held, 60); }));

  client::StepOptions step;
  step.ticks = 5;
  const absl::StatusOr<client::StepAnswer> stepped = remote->Step("a", step);
  ASSERT_TRUE(stepped.ok()) << stepped.status();
  EXPECT_EQ(stepped->tick, *held + 5);
  EXPECT_TRUE(Eventually([&] { return client.Now().render == TimeOfTick(stepped->tick, 60); }));

  ASSERT_TRUE(remote->Resume("a").ok());
  ASSERT_TRUE(Eventually([&] { return client.Now().speed == 1.0; }));
  ASSERT_TRUE(remote->SetSpeed("a", 3.0).ok());
  ASSERT_TRUE(Eventually([&] { return client.Now().speed == 3.0; }));
  EXPECT_TRUE(Eventually([&] {
    const wire::Stamp stamp = *recorder_.frames().back().stamp;
    return stamp.speed == 3.0 && SeaTimeError(client, stamp) <= 3 * kSeaTimeErrorMaxS;
  }));
}

TEST_P(Client, NewWeatherArrivesAsANewWelcome) {
  server_.Create(SmallSession("a"));
  SessionClient client(server_.Connect(), Options(), recorder_);
  ASSERT_TRUE(recorder_.AwaitFrames(1));
  client::WeatherChange change;
  sea::JonswapSystem storm;
  storm.hs_m = 5.0;
  change.sea.systems = {storm};
  change.over_s = 10.0;
  const absl::StatusOr<client::WeatherSpan> span = server_.Remote()->ChangeWeather("a", change);
  ASSERT_TRUE(span.ok()) << span.status();
  EXPECT_EQ(span->end_tick - span->start_tick, 600);
  ASSERT_TRUE(recorder_.AwaitFrame([](const wire::Frame& frame) {
    return frame.welcome.has_value() && frame.welcome->recipe.timeline.size() == 2;
  }));
  for (const wire::Frame& frame : recorder_.frames()) {
    if (!frame.welcome.has_value()) continue;
    EXPECT_EQ(frame.welcome->component_hash, (*sea::BuildComponents(frame.welcome->recipe))->hash);
  }
}

TEST_P(Client, UnknownSessionFailsAtOnceAndALostOneIsWaitedFor) {
  SessionClient stranger(server_.Connect(), Options(), recorder_);
  ASSERT_TRUE(recorder_.AwaitLink(LinkState::kFailed));
  EXPECT_EQ(recorder_.links().back().status.code(), absl::StatusCode::kNotFound);

  Recorder second;
  server_.Create(SmallSession("a"));
  SessionClient client(server_.Connect(), Options(), second);
  ASSERT_TRUE(second.AwaitFrames(1));
  ASSERT_TRUE(server_.Remote()->DeleteSession("a").ok());
  ASSERT_TRUE(second.AwaitFrame([](const auto& frame) { return frame.farewell.has_value(); }));
  server_.Create(SmallSession("a"));
  EXPECT_TRUE(Eventually([&] { return client.stats().connections == 2; }));
}

TEST_P(Client, NobodyThereIsTriedAgainAndStopEndsIt) {
  server_.Stop();
  SessionClient client(server_.Connect(), Options(), recorder_);
  ASSERT_TRUE(Eventually([&] {
    int waits = 0;
    for (const auto& link : recorder_.links()) waits += link.state == LinkState::kWaiting;
    return waits >= 3;
  }));
  client.Stop();
  const std::size_t links = recorder_.links().size();
  absl::SleepFor(absl::Milliseconds(100));
  EXPECT_EQ(recorder_.links().size(), links) << "nothing is said after Stop()";
}

TEST_P(Client, RemoteServerCallsEveryMethod) {
  const std::unique_ptr<client::RemoteServer> remote = server_.Remote();
  const absl::StatusOr<SessionInfo> created = remote->CreateSession(SmallSession("made"));
  ASSERT_TRUE(created.ok()) << created.status();
  EXPECT_EQ(created->name, "made");
  EXPECT_EQ(remote->CreateSession(SmallSession("made")).status().code(),
            absl::StatusCode::kAlreadyExists);
  const auto sessions = remote->ListSessions();
  ASSERT_TRUE(sessions.ok());
  ASSERT_EQ(sessions->size(), 1u);

  wire::QueryRequest query;
  query.session = "made";
  query.points_m = {{1.0, 2.0}, {3.0, 4.0}};
  query.tick = 60;
  const absl::StatusOr<wire::QueryAnswer> answer = remote->QueryPoints(query);
  ASSERT_TRUE(answer.ok()) << answer.status();
  ASSERT_EQ(answer->height_m.size(), 2u);
  EXPECT_DOUBLE_EQ(answer->time_s, 1.0);

  const std::unique_ptr<client::QueryStream> stream = remote->StreamQueries();
  for (std::int64_t id = 1; id <= 4; ++id) {
    query.id = id;
    ASSERT_TRUE(stream->Send(query).ok());
  }
  std::vector<std::int64_t> ids;
  for (int n = 0; n < 4; ++n) {
    const absl::StatusOr<wire::QueryAnswer> streamed = stream->Receive();
    ASSERT_TRUE(streamed.ok()) << streamed.status();
    EXPECT_EQ(streamed->height_m, answer->height_m);
    ids.push_back(streamed->id);
  }
  EXPECT_THAT(ids, testing::UnorderedElementsAre(1, 2, 3, 4));

  const auto hashes = remote->GetStateHash("made");
  ASSERT_TRUE(hashes.ok());
  EXPECT_EQ(hashes->component_hash, created->component_hash);
  EXPECT_GT(*remote->ServerMonotonicNs(), 0);
  EXPECT_TRUE(remote->DeleteSession("made").ok());
  EXPECT_EQ(remote->Hold("made").status().code(), absl::StatusCode::kNotFound);
}

// The wire breaks while the session runs on: the picture must not notice.
TEST(ClientOverSockets, ABrokenWireShowsNoJump) {
  TestServer server(Transport::kLoopback);
  server.Create(SmallSession("a"));
  TcpRelay relay(server.port());
  Recorder recorder;
  SessionClient client(client::ConnectTo(absl::StrCat("127.0.0.1:", relay.port())), Options(true),
                       recorder);
  ASSERT_TRUE(recorder.AwaitFrames(30));
  double jump_max_s = 0.0;
  SimTime last_render = client.Now().render;
  const auto look = [&](absl::Duration span) {
    for (const absl::Time end = absl::Now() + span; absl::Now() < end;) {
      const std::int64_t before_ns = SystemClock().MonotonicNs();
      const SeaTime now = client.Now();
      EXPECT_GE(now.render, last_render) << "sea time went back";
      last_render = now.render;
      absl::SleepFor(absl::Milliseconds(1));
      const SeaTime later = client.Now();
      last_render = later.render;
      const double passed_s = static_cast<double>(SystemClock().MonotonicNs() - before_ns) * 1e-9;
      // Sea time that was skipped: more than the real time that passed.
      jump_max_s = std::max(jump_max_s, (later.render - now.render).Seconds() - passed_s);
    }
  };
  look(absl::Milliseconds(200));
  relay.Cut();
  ASSERT_TRUE(recorder.AwaitLink(LinkState::kWaiting));
  look(absl::Milliseconds(300));
  relay.Mend();
  look(absl::Milliseconds(500));
  ASSERT_TRUE(Eventually([&] { return client.stats().connections >= 2; }));
  look(absl::Milliseconds(1000));
  EXPECT_LE(jump_max_s, kSeaTimeErrorMaxS);
  EXPECT_LE(SeaTimeError(client, *recorder.frames().back().stamp), kSeaTimeErrorMaxS);
}

// Everything on the wire: HTTP/2, stamps with probes, acknowledgements, clock exchanges.
TEST(ClientOverSockets, TheSpectralSeaCostsLessThanAKilobyteASecond) {
  TestServer server(Transport::kLoopback);
  server.Create(SmallSession("a"));
  TcpRelay relay(server.port());
  Recorder recorder;
  SessionClient client(client::ConnectTo(absl::StrCat("127.0.0.1:", relay.port())), Options(),
                       recorder);
  ASSERT_TRUE(recorder.AwaitFrames(2));
  const std::int64_t before = relay.to_client_bytes() + relay.to_server_bytes();
  const std::size_t frames = recorder.frames().size();
  absl::SleepFor(absl::Seconds(8));  // two acknowledgements and two exchanges of clocks
  const std::int64_t bytes = relay.to_client_bytes() + relay.to_server_bytes() - before;
  EXPECT_GE(recorder.frames().size() - frames, 7u);
  EXPECT_LE(recorder.frames().size() - frames, 9u);
  RecordProperty("bytes_per_s", static_cast<int>(bytes / 8));
  EXPECT_LE(bytes / 8, 1000) << "bytes a second in both directions";
}

}  // namespace
}  // namespace onesea::e2e
