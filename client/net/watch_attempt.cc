#include "client/net/watch_attempt.h"

#include <grpc/support/time.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/net/grpc_status.h"
#include "common/base/check.h"

namespace onesea::client {
namespace {

// A live server speaks at least once a second.
constexpr std::int64_t kSilenceMaxNs = 5'000'000'000;
constexpr int kAckEvery = 4;
// A new connection's clock takes over after this many exchanges, a few round trips.
constexpr int kFirstExchanges = 6;
constexpr std::int64_t kExchangePeriodNs = 4'000'000'000;
constexpr std::int64_t kExchangeRetryNs = 500'000'000;
constexpr std::int64_t kExchangeTimeoutMs = 2'000;
// A connection whose sea is so far behind the old line shows another life of the session, or one
// that stood still meanwhile: its time begins at once. An epoch in the session's file hides the
// difference from everything else.
constexpr double kOtherLifeS = 0.05;
// Beyond this no clock is honest, and sums of two stay inside 64 bits.
constexpr std::int64_t kMonotonicMaxNs = std::int64_t{1} << 61;

absl::Status CheckMonotonic(const char* field, std::int64_t value_ns) {
  if (value_ns >= 0 && value_ns <= kMonotonicMaxNs) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(field, ": ", value_ns, " ns, not in [0, ", kMonotonicMaxNs, "]"));
}

absl::Status CheckStamp(const wire::Stamp& stamp, int tick_rate_hz) {
  if (!IsTickInRange(stamp.tick, tick_rate_hz)) {
    return absl::InvalidArgumentError(absl::StrCat("stamp.tick: ", stamp.tick,
                                                   " is more than a century from tick 0 at ",
                                                   tick_rate_hz, " Hz"));
  }
  return CheckMonotonic("stamp.server_monotonic_ns", stamp.server_monotonic_ns);
}

std::string_view Text(const grpc::Slice& slice) {
  return {reinterpret_cast<const char*>(slice.begin()), slice.size()};
}

}  // namespace

WatchAttempt::WatchAttempt(SessionClient& client)
    : client_(client), clock_(client.clock_), channel_(client.connect_()) {
  stub_ = v1::OneSea::NewStub(channel_);
}

absl::Status WatchAttempt::Run() {
  grpc::GenericStub stub(channel_);
  stream_ = stub.PrepareCall(&context_, "/onesea.v1.OneSea/Watch", &queue_);
  stream_->StartCall(Tag(Op::kStarted));
  pending_ = 1;
  last_news_ns_ = clock_.MonotonicNs();
  while (pending_ > 0) {
    void* tag = nullptr;
    bool ok = false;
    const gpr_timespec deadline = gpr_time_from_millis(100, GPR_TIMESPAN);
    if (queue_.AsyncNext(&tag, &ok, deadline) == grpc::CompletionQueue::GOT_EVENT) {
      --pending_;
      OnEvent(*static_cast<const Op*>(tag), ok);
    }
    OnTime(clock_.MonotonicNs());
  }
  queue_.Shutdown();
  void* tag = nullptr;
  for (bool ok = false; queue_.Next(&tag, &ok);) {
  }
  return Outcome();
}

absl::Status WatchAttempt::Outcome() const {
  if (!given_.ok()) return given_;
  if (!stream_status_.ok()) return FromGrpc(stream_status_);
  return absl::UnavailableError(farewell_.empty() ? "the server ended the stream"
                                                  : absl::StrCat("the server said: ", farewell_));
}

void WatchAttempt::OnEvent(Op op, bool ok) {
  switch (op) {
    case Op::kStarted:
      if (ok) {
        v1::WatchRequest request;
        request.mutable_open()->set_session(client_.options_.session);
        request.mutable_open()->set_credit(client_.options_.credit);
        request.mutable_open()->set_every_frame(client_.options_.every_frame);
        request.mutable_open()->set_client_name(client_.options_.client_name);
        Send(request);
        StartExchange();
      }
      ++pending_;
      stream_->Read(&received_, Tag(Op::kRead));
      break;
    case Op::kRead:
      OnRead(ok);
      break;
    case Op::kWritten:
      writing_ = false;
      if (ok && ack_owed_) Acknowledge();
      break;
    case Op::kFinished:
      finishing_ = true;
      next_exchange_ns_ = INT64_MAX;
      if (exchange_context_ != nullptr) exchange_context_->TryCancel();
      break;
    case Op::kExchanged:
      OnExchanged(clock_.MonotonicNs());
      break;
  }
}

void WatchAttempt::OnRead(bool ok) {
  ++pending_;
  if (!ok) return stream_->Finish(&stream_status_, Tag(Op::kFinished));
  last_news_ns_ = clock_.MonotonicNs();
  grpc::Slice slice;
  if (!received_.TrySingleSlice(&slice).ok() && !received_.DumpToSingleSlice(&slice).ok()) {
    Give(absl::DataLossError("frame: could not be read"));
  } else {
    {
      absl::MutexLock lock(&client_.mutex_);
      ++client_.stats_.frames;
      client_.stats_.frame_bytes += static_cast<std::int64_t>(slice.size());
    }
    absl::StatusOr<wire::Frame> frame = wire::DecodeFrame(Text(slice));
    const absl::Status status = frame.ok() ? Accept(*frame) : frame.status();
    if (!status.ok()) Give(status);
  }
  stream_->Read(&received_, Tag(Op::kRead));
}

absl::Status WatchAttempt::Accept(const wire::Frame& frame) {
  if (!given_.ok()) return absl::OkStatus();  // on our way out
  if (!live_ && !frame.welcome.has_value() && !frame.farewell.has_value()) {
    return absl::FailedPreconditionError("welcome: missing in the first frame");
  }
  if (frame.sequence <= last_sequence_) {
    return absl::DataLossError(
        absl::StrCat("sequence: ", frame.sequence, " after ", last_sequence_));
  }
  const bool gap = last_sequence_ >= 0 && frame.sequence != last_sequence_ + 1;
  last_sequence_ = frame.sequence;
  if (frame.welcome.has_value()) {
    tick_rate_hz_ = frame.welcome->recipe.tick_rate_hz;
    stamp_.reset();  // its tick was of the rate before
  }
  if (frame.stamp.has_value()) {
    ONESEA_RETURN_IF_ERROR(CheckStamp(*frame.stamp, tick_rate_hz_));
    stamp_ = frame.stamp;
  }
  if (frame.farewell.has_value()) farewell_ = *frame.farewell;
  const bool first = !live_ && frame.welcome.has_value();
  live_ = live_ || first;
  {
    absl::MutexLock lock(&client_.mutex_);
    if (gap) ++client_.stats_.gaps;
    if (first) ++client_.stats_.connections;
  }
  UseClock(last_news_ns_);
  if (first) client_.Tell({.state = LinkState::kLive, .status = {}, .retry_in_ns = 0});
  client_.listener_.OnFrame(frame);
  if (++unacknowledged_ >= std::min(kAckEvery, client_.options_.credit)) Acknowledge();
  return absl::OkStatus();
}

void WatchAttempt::Acknowledge() {
  ack_owed_ = writing_;
  if (writing_) return;
  unacknowledged_ = 0;
  v1::WatchRequest request;
  request.mutable_ack()->set_sequence(last_sequence_);
  request.mutable_ack()->set_drift_m(client_.drift_m_);
  Send(request);
}

void WatchAttempt::Send(const v1::WatchRequest& request) {
  const grpc::Slice slice(request.SerializeAsString());
  writing_ = true;
  ++pending_;
  stream_->Write(grpc::ByteBuffer(&slice, 1), Tag(Op::kWritten));
}

void WatchAttempt::Give(const absl::Status& status) {
  if (!given_.ok()) return;
  given_ = status;
  context_.TryCancel();
}

void WatchAttempt::OnTime(std::int64_t now_ns) {
  if (finishing_) return;
  if (now_ns - last_news_ns_ >= kSilenceMaxNs) {
    Give(absl::UnavailableError("nothing came from the server for 5 s"));
  }
  if (now_ns >= next_exchange_ns_) StartExchange();
}

void WatchAttempt::StartExchange() {
  next_exchange_ns_ = INT64_MAX;
  exchange_context_ = std::make_unique<grpc::ClientContext>();
  exchange_context_->set_deadline(gpr_time_from_millis(kExchangeTimeoutMs, GPR_TIMESPAN));
  ++pending_;
  exchange_sent_ns_ = clock_.MonotonicNs();
  exchange_ = stub_->AsyncSyncClock(exchange_context_.get(), v1::SyncClockRequest(), &queue_);
  exchange_->Finish(&exchange_response_, &exchange_status_, Tag(Op::kExchanged));
}

void WatchAttempt::OnExchanged(std::int64_t now_ns) {
  exchange_context_.reset();
  if (finishing_) return;
  const std::int64_t server_ns = exchange_response_.server_monotonic_ns();
  const bool good = exchange_status_.ok() && CheckMonotonic("", server_ns).ok();
  if (good) sync_.Add({exchange_sent_ns_, server_ns, now_ns});
  const bool more = sync_.count() < kFirstExchanges;
  next_exchange_ns_ = now_ns + (!good ? kExchangeRetryNs : more ? 0 : kExchangePeriodNs);
  if (good) UseClock(now_ns);
}

void WatchAttempt::UseClock(std::int64_t now_ns) {
  if (!stamp_.has_value() || !sync_.synchronised()) return;
  absl::MutexLock lock(&client_.mutex_);
  if (!clock_in_use_ && client_.sea_clock_.valid()) {
    SeaClock line;
    line.OnStamp(*stamp_, tick_rate_hz_, sync_.offset_ns());
    const SimTime behind = client_.sea_clock_.Exact(now_ns) - line.Exact(now_ns);
    if (behind.Seconds() > kOtherLifeS) client_.sea_clock_ = SeaClock();
  }
  // At the first join any clock is better than none; after that the old one serves until the new
  // one is as good.
  clock_in_use_ = clock_in_use_ || !client_.sea_clock_.valid() || sync_.count() >= kFirstExchanges;
  if (!clock_in_use_) return;
  client_.sea_clock_.OnStamp(*stamp_, tick_rate_hz_, sync_.offset_ns());
  client_.bound_ns_ = sync_.ErrorBoundNs(now_ns);
  client_.bound_at_ns_ = now_ns;
  client_.stats_.round_trip_ns = sync_.round_trip_ns();
}

}  // namespace onesea::client
