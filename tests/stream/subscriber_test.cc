#include "server/stream/subscriber.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace onesea::server {
namespace {

using Send = Subscriber::Send;
using State = Subscriber::State;

constexpr std::int64_t kSecond = 1'000'000'000;

// Sends `sequence` and completes the write at once, as a healthy transport does.
Send SendAndComplete(Subscriber& subscriber, std::int64_t sequence, std::int64_t now_ns = 0) {
  const Send send = subscriber.Next(sequence, now_ns);
  if (send != Send::kNothing) subscriber.OnWritten(now_ns);
  return send;
}

TEST(Subscriber, NewcomerGetsAKeyframeThenFrames) {
  Subscriber subscriber(8, 0);
  EXPECT_TRUE(subscriber.NeedsKeyframe(41));
  EXPECT_EQ(SendAndComplete(subscriber, 41), Send::kKeyframe);
  EXPECT_EQ(SendAndComplete(subscriber, 42), Send::kFrame);
  EXPECT_EQ(SendAndComplete(subscriber, 43), Send::kFrame);
}

TEST(Subscriber, SendsNothingBeforeThereIsAnythingAndNothingTwice) {
  Subscriber subscriber(8, 0);
  EXPECT_EQ(subscriber.Next(-1, 0), Send::kNothing);
  EXPECT_EQ(SendAndComplete(subscriber, 0), Send::kKeyframe);
  EXPECT_EQ(subscriber.Next(0, 0), Send::kNothing);
  EXPECT_EQ(subscriber.state(), State::kReady);
}

TEST(Subscriber, OneWriteInFlightAndTheNewestReplacesWhatWaits) {
  Subscriber subscriber(8, 0);
  EXPECT_EQ(subscriber.Next(1, 0), Send::kKeyframe);
  EXPECT_EQ(subscriber.state(), State::kWriting);
  EXPECT_EQ(subscriber.Next(2, 0), Send::kNothing);
  EXPECT_EQ(subscriber.Next(3, 0), Send::kNothing);
  subscriber.OnWritten(0);
  // 2 was dropped, so 3 alone would not be understood.
  EXPECT_TRUE(subscriber.NeedsKeyframe(3));
  EXPECT_EQ(subscriber.Next(3, 0), Send::kKeyframe);
  subscriber.OnWritten(0);
  EXPECT_EQ(subscriber.Next(4, 0), Send::kFrame);
}

TEST(Subscriber, WithoutAcknowledgementExactlyCreditFramesGoOut) {
  for (int credit : {1, 2, 8, 64}) {
    Subscriber subscriber(credit, 0);
    int sent = 0;
    for (std::int64_t sequence = 1; sequence <= 200; ++sequence) {
      if (SendAndComplete(subscriber, sequence) != Send::kNothing) ++sent;
    }
    EXPECT_EQ(sent, credit);
    EXPECT_EQ(subscriber.state(), State::kStarved);
    EXPECT_EQ(subscriber.unacknowledged(), credit);
  }
}

TEST(Subscriber, AfterAStallTheNextFrameIsAKeyframeOfTheNewest) {
  Subscriber subscriber(4, 0);
  for (std::int64_t sequence = 1; sequence <= 100; ++sequence)
    SendAndComplete(subscriber, sequence);
  ASSERT_TRUE(subscriber.OnAck(4, 0).ok());
  EXPECT_EQ(subscriber.Next(100, 0), Send::kKeyframe);
  EXPECT_EQ(subscriber.keyframes_sent(), 2);
  EXPECT_EQ(subscriber.unacknowledged(), 1);
}

TEST(Subscriber, AnAcknowledgementCoversEverythingBeforeIt) {
  Subscriber subscriber(8, 0);
  for (std::int64_t sequence = 1; sequence <= 8; ++sequence) SendAndComplete(subscriber, sequence);
  ASSERT_TRUE(subscriber.OnAck(4, 0).ok());
  EXPECT_EQ(subscriber.unacknowledged(), 4);
  ASSERT_TRUE(subscriber.OnAck(2, 0).ok());  // late and old: no harm
  ASSERT_TRUE(subscriber.OnAck(-7, 0).ok());
  EXPECT_EQ(subscriber.unacknowledged(), 4);
  ASSERT_TRUE(subscriber.OnAck(8, 0).ok());
  EXPECT_EQ(subscriber.unacknowledged(), 0);
}

TEST(Subscriber, RefusesToHaveReadWhatWasNeverSent) {
  Subscriber subscriber(8, 0);
  SendAndComplete(subscriber, 5);
  const absl::Status status = subscriber.OnAck(6, 0);
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(status.message()), testing::HasSubstr("ack.sequence: 6"));
  EXPECT_FALSE(subscriber.OnAck(INT64_MAX, 0).ok());
}

TEST(Subscriber, AcknowledgedWhileWritingCountsWhenTheWriteCompletes) {
  Subscriber subscriber(1, 0);
  EXPECT_EQ(subscriber.Next(1, 0), Send::kKeyframe);
  // The viewer can be faster than our own completion.
  ASSERT_TRUE(subscriber.OnAck(1, 0).ok());
  EXPECT_EQ(subscriber.state(), State::kWriting);
  subscriber.OnWritten(0);
  EXPECT_EQ(subscriber.state(), State::kReady);
}

TEST(Subscriber, StallsAfterTheStatedTimeWithoutCredit) {
  Subscriber subscriber(2, 0);
  SendAndComplete(subscriber, 1, 0);
  EXPECT_FALSE(subscriber.Stalled(100 * kSecond));  // ready: nobody waits for it
  SendAndComplete(subscriber, 2, kSecond);
  EXPECT_FALSE(subscriber.Stalled(kSecond + kStallTimeoutNs - 1));
  EXPECT_TRUE(subscriber.Stalled(kSecond + kStallTimeoutNs));
  // An old acknowledgement gives no credit and no patience; a new one does.
  ASSERT_TRUE(subscriber.OnAck(0, 3 * kSecond).ok());
  EXPECT_TRUE(subscriber.Stalled(kSecond + kStallTimeoutNs));
  ASSERT_TRUE(subscriber.OnAck(1, 3 * kSecond).ok());
  EXPECT_FALSE(subscriber.Stalled(100 * kSecond));
}

TEST(Subscriber, StallsWhenTheTransportTakesNothing) {
  Subscriber subscriber(8, 0);
  EXPECT_EQ(subscriber.Next(1, kSecond), Send::kKeyframe);
  EXPECT_FALSE(subscriber.Stalled(kSecond + kStallTimeoutNs - 1));
  EXPECT_TRUE(subscriber.Stalled(kSecond + kStallTimeoutNs));
  subscriber.OnWritten(2 * kSecond);
  EXPECT_FALSE(subscriber.Stalled(100 * kSecond));
}

TEST(Subscriber, UnlimitedCreditNeverStarves) {
  Subscriber subscriber(kCreditUnlimited, 0);
  for (std::int64_t sequence = 1; sequence <= 1000; ++sequence) {
    EXPECT_NE(SendAndComplete(subscriber, sequence), Send::kNothing);
  }
}

TEST(Subscriber, NothingIsSentAfterTheEnd) {
  Subscriber subscriber(8, 0);
  EXPECT_EQ(subscriber.Next(1, 0), Send::kKeyframe);
  subscriber.End();
  subscriber.OnWritten(0);
  EXPECT_EQ(subscriber.Next(2, 0), Send::kNothing);
  EXPECT_FALSE(subscriber.Stalled(100 * kSecond));
}

// Random order of events against the rule itself: a plain list of what was sent, and the four
// promises of the header.
TEST(Subscriber, RandomEventsKeepThePromises) {
  std::mt19937_64 random(7);
  for (int run = 0; run < 200; ++run) {
    const int credit = 1 + static_cast<int>(random() % kCreditMax);
    Subscriber subscriber(credit, 0);
    std::vector<std::int64_t> sent;
    std::int64_t newest = 0, acked = 0;
    bool in_flight = false;
    for (int step = 0; step < 500; ++step) {
      switch (random() % 4) {
        case 0:
          ++newest;
          break;
        case 1:
          if (in_flight) subscriber.OnWritten(0);
          in_flight = false;
          break;
        case 2:
          if (!sent.empty()) {
            acked = std::max(acked, sent[random() % sent.size()]);
            ASSERT_TRUE(subscriber.OnAck(acked, 0).ok());
          }
          break;
        case 3: {
          const auto open =
              std::count_if(sent.begin(), sent.end(), [&](auto s) { return s > acked; });
          const bool may = !in_flight && open < credit && (sent.empty() || newest > sent.back());
          const bool follows = !sent.empty() && newest == sent.back() + 1;
          const Send send = subscriber.Next(newest, 0);
          ASSERT_EQ(send, !may ? Send::kNothing : follows ? Send::kFrame : Send::kKeyframe);
          if (may) sent.push_back(newest);
          in_flight = in_flight || may;
        }
      }
      ASSERT_LE(subscriber.unacknowledged(), credit);
    }
  }
}

}  // namespace
}  // namespace onesea::server
