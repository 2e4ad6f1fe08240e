// The Watch methods as seen by viewers that behave in every possible way, with and without sockets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "onesea/v1/frame.pb.h"
#include "server/stream/subscriber.h"
#include "tests/e2e/harness.h"
#include "tests/e2e/raw_watch.h"

namespace onesea::e2e {
namespace {

using testing::HasSubstr;

class Watch : public testing::TestWithParam<Transport> {
 protected:
  std::unique_ptr<RawWatch> Open(const std::string& session, int credit, bool every_frame) {
    auto watch = std::make_unique<RawWatch>(server_.Connect()());
    watch->SendOpen(session, credit, every_frame);
    return watch;
  }
  // The status that a stream gets whose only message is `bytes`.
  grpc::Status StatusAfter(const std::string& bytes) {
    RawWatch watch(server_.Connect()());
    watch.Send(bytes);
    return watch.Status();
  }

  AdvancingClock clock_;
  TestServer server_{GetParam(), clock_};
};

INSTANTIATE_TEST_SUITE_P(Transports, Watch,
                         testing::Values(Transport::kInProcess, Transport::kLoopback),
                         [](const auto& info) {
                           return info.param == Transport::kInProcess ? "InProcess" : "Loopback";
                         });

TEST_P(Watch, FirstFrameIsTheWholeStateThenEveryStreamedTick) {
  server_.Create(SmallSession("a"));
  auto watch = Open("a", 64, true);
  std::optional<wire::Frame> last = watch->Read();
  ASSERT_TRUE(last.has_value());
  EXPECT_TRUE(last->keyframe);
  ASSERT_TRUE(last->welcome.has_value());
  EXPECT_EQ(last->welcome->recipe, SmallSession("a").recipe);
  EXPECT_EQ(last->welcome->session.name, "a");
  ASSERT_TRUE(last->stamp.has_value());
  int probes = 0, gaps = 0;
  for (int n = 0; n < 150; ++n) {
    const std::optional<wire::Frame> frame = watch->Read();
    ASSERT_TRUE(frame.has_value());
    EXPECT_GT(frame->sequence, last->sequence);
    EXPECT_GT(frame->stamp->tick, last->stamp->tick);
    EXPECT_EQ(frame->keyframe, frame->sequence != last->sequence + 1) << "a keyframe follows a gap";
    if (frame->sequence != last->sequence + 1) ++gaps;
    if (frame->probes.has_value()) ++probes;
    if (n % 4 == 0) watch->SendAck(frame->sequence, 0.001f);
    last = frame;
  }
  EXPECT_GE(probes, 1) << "2.5 s hold at least one second's probes";
  EXPECT_LT(gaps, 75) << "a viewer that keeps up is not skipped all the time";
}

TEST_P(Watch, SlowViewerGetsItsCreditAndThenTheNewestAsAKeyframe) {
  auto session = server_.Create(SmallSession("a"));
  auto watch = Open("a", 4, true);
  const std::optional<wire::Frame> first = watch->Read();
  ASSERT_TRUE(first.has_value());
  absl::SleepFor(absl::Seconds(1));  // reads and acknowledges nothing for 60 frames
  std::int64_t last = first->sequence;
  for (int n = 0; n < 3; ++n) {
    const std::optional<wire::Frame> stale = watch->Read();
    ASSERT_TRUE(stale.has_value());
    last = stale->sequence;
  }
  EXPECT_FALSE(watch->ReadWithin(300).has_value()) << "only credit - 1 stale frames";
  const Tick now = session->View().tick;
  watch->SendAck(last);
  const std::optional<wire::Frame> fresh = watch->Read();
  ASSERT_TRUE(fresh.has_value());
  EXPECT_TRUE(fresh->keyframe);
  EXPECT_TRUE(fresh->welcome.has_value());
  EXPECT_GE(fresh->stamp->tick, now - 1);
}

TEST_P(Watch, AViewerThatTakesNothingIsDroppedAfterTheStatedTime) {
  auto session = server_.Create(SmallSession("a"));
  auto watch = Open("a", 2, true);
  ASSERT_TRUE(watch->Read().has_value());
  ASSERT_TRUE(watch->Read().has_value());
  EXPECT_EQ(session->Info().viewer_count, 1);
  absl::SleepFor(absl::Milliseconds(300));
  EXPECT_EQ(session->Info().viewer_count, 1);
  clock_.Advance(server::kStallTimeoutNs);
  const grpc::Status status = watch->Status();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_THAT(status.error_message(), HasSubstr("ack: nothing came for 5 s"));
  EXPECT_TRUE(Eventually([&] { return session->Info().viewer_count == 0; }));
}

TEST_P(Watch, AViewerThatNeverOpensIsDroppedToo) {
  RawWatch watch(server_.Connect()());
  EXPECT_FALSE(watch.ReadWithin(300).has_value());
  clock_.Advance(5'000'000'000);
  const grpc::Status status = watch.Status();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DEADLINE_EXCEEDED);
  EXPECT_THAT(status.error_message(), HasSubstr("open"));
}

TEST_P(Watch, ViewersOfStampsAloneGetOneASecond) {
  server_.Create(SmallSession("a"));
  auto watch = Open("a", 8, false);
  ASSERT_TRUE(watch->Read().has_value());
  std::int64_t bytes = 0;
  std::vector<std::int64_t> at_ns;
  for (int n = 0; n < 4; ++n) {
    const std::optional<wire::Frame> frame = watch->Read();
    ASSERT_TRUE(frame.has_value());
    at_ns.push_back(frame->stamp->server_monotonic_ns);
    bytes += static_cast<std::int64_t>(wire::EncodeFrame(*frame).size());
    watch->SendAck(frame->sequence);
  }
  EXPECT_NEAR(static_cast<double>(at_ns[3] - at_ns[1]), 2e9, 0.2e9);
  EXPECT_LE(bytes / 4, 400);
}

TEST_P(Watch, StampsForSimpleClients) {
  server_.Create(SmallSession("a"));
  v1::WatchStampsRequest request;
  request.set_session("a");
  RawWatch watch(server_.Connect()(), "WatchStamps");
  watch.Send(request.SerializeAsString());
  watch.CloseOurSide();
  const std::optional<wire::Frame> first = watch.Read();
  ASSERT_TRUE(first.has_value());
  EXPECT_TRUE(first->welcome.has_value());
  // More than a credit of 8 would allow, and nothing is acknowledged.
  ASSERT_TRUE(server_.Remote()->SetSpeed("a", 1.5).ok());
  for (int n = 0; n < 9; ++n) {
    ASSERT_TRUE(server_.Remote()->SetSpeed("a", 1.0 + 0.1 * n).ok());
    ASSERT_TRUE(watch.Read().has_value()) << n;
  }
  ASSERT_TRUE(server_.registry().Delete("a", "enough").ok());
  std::optional<wire::Frame> frame;
  do {
    frame = watch.Read();
  } while (frame.has_value() && !frame->farewell.has_value());
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(*frame->farewell, "enough");
  EXPECT_TRUE(watch.Status().ok());

  RawWatch unknown(server_.Connect()(), "WatchStamps");
  unknown.Send(request.SerializeAsString());
  unknown.CloseOurSide();
  EXPECT_EQ(unknown.Status().error_code(), grpc::StatusCode::NOT_FOUND);
}

TEST_P(Watch, DeletingASessionSaysFarewellToItsViewersOnly) {
  server_.Create(SmallSession("a"));
  server_.Create(SmallSession("b"));
  auto in_a = Open("a", 8, true);
  auto starved = Open("a", 1, true);
  auto in_b = Open("b", 8, false);
  ASSERT_TRUE(in_a->Read().has_value());
  ASSERT_TRUE(in_b->Read().has_value());
  absl::SleepFor(absl::Milliseconds(200));
  ASSERT_TRUE(server_.registry().Delete("a", "moved away").ok());
  for (RawWatch* watch : {in_a.get(), starved.get()}) {
    std::optional<wire::Frame> last, frame;
    while ((frame = watch->Read()).has_value()) last = frame;
    ASSERT_TRUE(last.has_value());
    EXPECT_EQ(last->farewell, "moved away");
    EXPECT_TRUE(watch->Status().ok());
  }
  EXPECT_TRUE(in_b->Read().has_value());
  EXPECT_EQ(StatusAfter([] {
              v1::WatchRequest request;
              request.mutable_open()->set_session("a");
              return request.SerializeAsString();
            }())
                .error_code(),
            grpc::StatusCode::NOT_FOUND);
}

TEST_P(Watch, TheServersEndSaysFarewell) {
  server_.Create(SmallSession("a"));
  auto watch = Open("a", 8, false);
  ASSERT_TRUE(watch->Read().has_value());
  std::thread stopper([&] { server_.Stop(); });
  std::optional<wire::Frame> last, frame;
  while ((frame = watch->Read()).has_value()) last = frame;
  stopper.join();
  ASSERT_TRUE(last.has_value());
  EXPECT_TRUE(last->farewell.has_value());
}

// Calls are cut off in every state; each still has operations on a queue that is about to end.
TEST_P(Watch, StopsWithoutGraceUnderViewersOfEveryKind) {
  for (int run = 0; run < 10; ++run) {
    server_.Create(SmallSession("a"));
    std::vector<std::unique_ptr<RawWatch>> watches;
    for (int n = 0; n < 12; ++n) {
      if (n % 4 == 3) {
        watches.push_back(std::make_unique<RawWatch>(server_.Connect()()));  // never opens
      } else {
        watches.push_back(Open("a", 1 + n, n % 2 == 0));
      }
    }
    if (run % 2 == 0) watches[0]->Read();
    server_.Stop(0.0);
    for (const auto& watch : watches) watch->Status();
    watches.clear();
    server_.Start();
  }
}

TEST_P(Watch, HostileFirstMessagesNameTheField) {
  server_.Create(SmallSession("a"));
  const auto open = [](const std::string& session, int credit, const std::string& name = "") {
    v1::WatchRequest request;
    request.mutable_open()->set_session(session);
    request.mutable_open()->set_credit(credit);
    request.mutable_open()->set_client_name(name);
    return request.SerializeAsString();
  };
  v1::WatchRequest ack;
  ack.mutable_ack()->set_sequence(1);
  const struct {
    std::string bytes;
    const char* names;
  } cases[] = {
      {"", "message: neither open nor ack"},
      {"\xff\xff\xff\xff garbage", "message: 12 bytes"},
      {std::string("\x0a\x7f"), "message: 2 bytes"},  // an open cut short
      {std::string(100'000, 'x'), "message: 100000 bytes, at most 1024"},
      {ack.SerializeAsString(), "ack: the first message must be open"},
      {open("a", 65), "open.credit: 65, not in [1, 64]"},
      {open("a", -1), "open.credit: -1"},
      {open(std::string(65, 'a'), 8), "open.session: 65 characters, at most 64"},
      {open("a", 8, std::string(200, 'n')), "open.client_name: 200 characters"},
  };
  for (const auto& [bytes, names] : cases) {
    const grpc::Status status = StatusAfter(bytes);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << names;
    EXPECT_THAT(status.error_message(), HasSubstr(names));
  }
  EXPECT_EQ(StatusAfter(open("nobody", 8)).error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(StatusAfter(open("", 8)).error_code(), grpc::StatusCode::NOT_FOUND);
  // The server is well after all this.
  EXPECT_TRUE(Open("a", 8, false)->Read().has_value());
}

TEST_P(Watch, HostileLaterMessagesEndTheStreamToo) {
  server_.Create(SmallSession("a"));
  v1::WatchRequest never_sent;
  never_sent.mutable_ack()->set_sequence(INT64_MAX);
  v1::WatchRequest second_open;
  second_open.mutable_open()->set_session("a");
  const struct {
    std::string bytes;
    const char* names;
  } cases[] = {
      {never_sent.SerializeAsString(), "ack.sequence"},
      {second_open.SerializeAsString(), "open: only the first"},
      {"\xff\xff", "message: 2 bytes"},
  };
  for (const auto& [bytes, names] : cases) {
    auto watch = Open("a", 64, true);
    ASSERT_TRUE(watch->Read().has_value());
    watch->Send(bytes);
    const grpc::Status status = watch->Status();
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << names;
    EXPECT_THAT(status.error_message(), HasSubstr(names));
  }
}

TEST_P(Watch, FiftyViewersComeAndGo) {
  auto session = server_.Create(SmallSession("a"));
  std::atomic<int> joined{0};
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 5; ++thread) {
    threads.emplace_back([&, thread] {
      for (int n = 0; n < 10; ++n) {
        auto watch = Open("a", 1 + n, n % 2 == 0);
        if (watch->Read().has_value()) ++joined;
        if (n % 3 == 0) watch->CloseOurSide();
        if (n % 4 == thread % 4) absl::SleepFor(absl::Milliseconds(20));
      }  // left without a word
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(joined, 50);
  EXPECT_TRUE(Eventually([&] { return session->Info().viewer_count == 0; }));
}

TEST_P(Watch, DeletesWhileViewersComeAndGo) {
  std::atomic<bool> stop{false};
  std::vector<std::thread> threads;
  for (int thread = 0; thread < 4; ++thread) {
    threads.emplace_back([&] {
      while (!stop) {
        auto watch = Open("a", 8, true);
        watch->Read();
      }
    });
  }
  for (int n = 0; n < 20; ++n) {
    server_.Create(SmallSession("a"));
    absl::SleepFor(absl::Milliseconds(10));
    EXPECT_TRUE(server_.registry().Delete("a", "again").ok());
  }
  stop = true;
  for (std::thread& thread : threads) thread.join();
}

TEST_P(Watch, AHeldSessionIsJoinedAtItsTick) {
  SessionSpec spec = SmallSession("a");
  spec.pace = Pace::kHeld;
  server_.Create(spec);
  auto watch = Open("a", 8, false);
  const std::optional<wire::Frame> frame = watch->Read();
  ASSERT_TRUE(frame.has_value());
  ASSERT_TRUE(frame->stamp.has_value());
  EXPECT_EQ(frame->stamp->speed, 0.0);
  EXPECT_EQ(frame->stamp->pace, Pace::kHeld);
}

}  // namespace
}  // namespace onesea::e2e
