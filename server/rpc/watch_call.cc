#include "server/rpc/watch_call.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "server/rpc/status_map.h"
#include "server/rpc/watch_shard.h"

namespace onesea::server {
namespace {

// A viewer acknowledges every fourth frame (WIRE.md).
constexpr int kFramesPerAck = 4;
constexpr std::int64_t kIdleNs = 200'000'000;

}  // namespace

WatchCall::WatchCall(WatchShard& shard, WatchMethods& methods) : shard_(shard), methods_(methods) {
  for (int op = 0; op < kWatchOps; ++op) tags_[op] = {this, static_cast<WatchOp>(op)};
}

void* WatchCall::Begin(WatchOp op) {
  ++pending_;
  return &tags_[static_cast<int>(op)];
}

void WatchCall::OnOp(WatchOp op, bool ok, std::int64_t now_ns) {
  --pending_;
  switch (op) {
    case WatchOp::kAccepted:
      if (!ok) {
        --pending_;  // kGone comes only for calls that began
        state_ = State::kOver;
        break;
      }
      state_ = State::kOpening;
      state_since_ns_ = now_ns;
      OnAccepted(now_ns);
      break;
    case WatchOp::kRead:
      if (state_ != State::kOpening && state_ != State::kWatching) break;
      if (ok) {
        OnRead(now_ns);
      } else {
        Finish(absl::OkStatus(), now_ns);  // the viewer closed its side, or is gone
      }
      break;
    case WatchOp::kWritten:
      OnWritten(ok, now_ns);
      break;
    case WatchOp::kFinished:
      state_ = State::kOver;
      break;
    case WatchOp::kGone:
      if (context_.IsCancelled()) Finish(absl::CancelledError("the viewer left"), now_ns);
      break;
  }
}

void WatchCall::Watch(absl::StatusOr<OpenMessage> open, std::int64_t now_ns) {
  if (!open.ok()) return Finish(open.status(), now_ns);
  absl::StatusOr<Seat> seat = shard_.hub().TakeSeat(open->session, open->audience);
  if (!seat.ok()) return Finish(seat.status(), now_ns);
  seat_ = *std::move(seat);
  viewer_ = *std::move(open);
  subscriber_.emplace(viewer_.credit, now_ns);
  state_ = State::kWatching;
  shard_.Enlist(*this, seat_.broadcast(), seat_.audience());
  Drive(now_ns);
}

void WatchCall::Drive(std::int64_t now_ns) {
  if (state_ != State::kWatching || group->newest.sequence < 0 || writing_) return;
  if (subscriber_->NeedsKeyframe(group->newest.sequence)) group->Refresh(true);
  if (group->newest.closed) {
    // Credit or not: it is the last frame. Who lacks the one before gets it as a keyframe.
    if (!subscriber_->Follows(group->newest.sequence)) group->Refresh(true);
    const bool frame = subscriber_->Follows(group->newest.sequence);
    subscriber_->End();
    state_ = State::kFinishing;
    state_since_ns_ = now_ns;
    StartLastWrite(frame ? group->FrameBytes() : group->KeyframeBytes());
    return;
  }
  switch (subscriber_->Next(group->newest.sequence, now_ns)) {
    case Subscriber::Send::kNothing:
      return;
    case Subscriber::Send::kFrame:
      StartWrite(group->FrameBytes());
      break;
    case Subscriber::Send::kKeyframe:
      StartWrite(group->KeyframeBytes());
      shard_.CountKeyframe();
      break;
  }
  writing_ = true;
  sent_ns_ = now_ns;
  shard_.CountFrame();
  ReadIfDue(false);
}

void WatchCall::OnWritten(bool ok, std::int64_t now_ns) {
  writing_ = false;
  if (owed_status_.has_value()) {
    StartFinish(*owed_status_);
    owed_status_.reset();
    return;
  }
  if (!ok) return Finish(absl::CancelledError("the viewer left"), now_ns);
  subscriber_->OnWritten(now_ns);
  Drive(now_ns);
}

void WatchCall::Finish(const absl::Status& status, std::int64_t now_ns) {
  if (state_ != State::kOpening && state_ != State::kWatching) return;
  state_ = State::kFinishing;
  state_since_ns_ = now_ns;
  if (subscriber_.has_value()) subscriber_->End();
  if (writing_) {
    owed_status_ = ToGrpc(status);
  } else {
    StartFinish(ToGrpc(status));
  }
}

void WatchCall::CheckPatience(std::int64_t now_ns) {
  if (state_ == State::kWatching && now_ns - sent_ns_ >= kIdleNs) ReadIfDue(true);
  if (state_ == State::kOpening && now_ns - state_since_ns_ >= kOpenTimeoutNs) {
    Finish(absl::DeadlineExceededError("open: nothing came for 5 s"), now_ns);
  } else if (state_ == State::kWatching && subscriber_->Stalled(now_ns)) {
    const bool stuck = subscriber_->state() == Subscriber::State::kWriting;
    Finish(absl::DeadlineExceededError(absl::StrCat("ack: nothing came for 5 s with ",
                                                    subscriber_->unacknowledged(),
                                                    " frames unacknowledged")),
           now_ns);
    if (stuck) context_.TryCancel();
  } else if (state_ == State::kFinishing && now_ns - state_since_ns_ >= kStallTimeoutNs) {
    context_.TryCancel();  // not even the status gets through
  }
}

void BidiWatchCall::Request() {
  context_.AsyncNotifyWhenDone(Begin(WatchOp::kGone));
  methods_.RequestWatch(&context_, &stream_, shard_.queue(), shard_.queue(),
                        Begin(WatchOp::kAccepted));
}

void BidiWatchCall::OnAccepted(std::int64_t) { Read(); }

void BidiWatchCall::Read() {
  reading_ = true;
  stream_.Read(&received_, Begin(WatchOp::kRead));
}

void BidiWatchCall::ReadIfDue(bool idle) {
  if (reading_ || state_ != State::kWatching) return;
  // The frame that was sent just now is not what is waited for.
  const int owed = subscriber_->unacknowledged() - 1;
  if (idle || owed >= kFramesPerAck || owed + 1 >= viewer_.credit) Read();
}

void BidiWatchCall::OnRead(std::int64_t now_ns) {
  reading_ = false;
  absl::StatusOr<ViewerMessage> message = ParseViewerMessage(received_);
  if (!message.ok()) return Finish(message.status(), now_ns);
  auto* open = std::get_if<OpenMessage>(&*message);
  if (state_ == State::kOpening) {
    if (open == nullptr) {
      return Finish(absl::InvalidArgumentError("ack: the first message must be open"), now_ns);
    }
    Watch(std::move(*open), now_ns);
  } else if (open != nullptr) {
    return Finish(absl::InvalidArgumentError("open: only the first message may be"), now_ns);
  } else {
    OnAck(std::get<AckMessage>(*message), now_ns);
  }
  ReadIfDue(false);
}

void BidiWatchCall::OnAck(const AckMessage& ack, std::int64_t now_ns) {
  if (absl::Status s = subscriber_->OnAck(ack.sequence, now_ns); !s.ok()) return Finish(s, now_ns);
  if (ack.drift_m > kDriftWarnM && !warned_of_drift_) {  // NaN compares false
    warned_of_drift_ = true;
    spdlog::warn("session {}: viewer \"{}\" is {:.3f} m off at a probe", viewer_.session,
                 absl::CHexEscape(viewer_.client_name), ack.drift_m);
  }
  Drive(now_ns);
}

void BidiWatchCall::StartWrite(const grpc::ByteBuffer& bytes) {
  stream_.Write(bytes, Begin(WatchOp::kWritten));
}
void BidiWatchCall::StartFinish(const grpc::Status& status) {
  stream_.Finish(status, Begin(WatchOp::kFinished));
}
void BidiWatchCall::StartLastWrite(const grpc::ByteBuffer& bytes) {
  stream_.WriteAndFinish(bytes, grpc::WriteOptions(), grpc::Status::OK, Begin(WatchOp::kFinished));
}

void StampsWatchCall::Request() {
  context_.AsyncNotifyWhenDone(Begin(WatchOp::kGone));
  methods_.RequestWatchStamps(&context_, &request_, &stream_, shard_.queue(), shard_.queue(),
                              Begin(WatchOp::kAccepted));
}

void StampsWatchCall::OnAccepted(std::int64_t now_ns) {
  Watch(ParseStampsMessage(request_), now_ns);
}

void StampsWatchCall::StartWrite(const grpc::ByteBuffer& bytes) {
  stream_.Write(bytes, Begin(WatchOp::kWritten));
}
void StampsWatchCall::StartFinish(const grpc::Status& status) {
  stream_.Finish(status, Begin(WatchOp::kFinished));
}
void StampsWatchCall::StartLastWrite(const grpc::ByteBuffer& bytes) {
  stream_.WriteAndFinish(bytes, grpc::WriteOptions(), grpc::Status::OK, Begin(WatchOp::kFinished));
}

}  // namespace onesea::server
