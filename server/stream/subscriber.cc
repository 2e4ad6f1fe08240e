#include "server/stream/subscriber.h"

#include "absl/strings/str_cat.h"
#include "common/base/check.h"

namespace onesea::server {

Subscriber::Subscriber(int credit, std::int64_t now_ns) : credit_(credit), state_since_ns_(now_ns) {
  ONESEA_CHECK(credit == kCreditUnlimited || (credit >= kCreditMin && credit <= kCreditMax))
      << "credit " << credit;
}

bool Subscriber::NeedsKeyframe(std::int64_t newest_sequence) const {
  return state_ == State::kReady && newest_sequence > last_sent_ && !Follows(newest_sequence);
}

Subscriber::Send Subscriber::Next(std::int64_t newest_sequence, std::int64_t now_ns) {
  if (state_ != State::kReady || newest_sequence <= last_sent_) return Send::kNothing;
  const bool needs_keyframe = NeedsKeyframe(newest_sequence);
  last_sent_ = newest_sequence;
  if (credit_ != kCreditUnlimited) {
    sent_[(oldest_ + unacknowledged_) % kCreditMax] = newest_sequence;
    ++unacknowledged_;
  }
  state_ = State::kWriting;
  state_since_ns_ = now_ns;
  ++frames_sent_;
  if (!needs_keyframe) return Send::kFrame;
  ++keyframes_sent_;
  return Send::kKeyframe;
}

void Subscriber::OnWritten(std::int64_t now_ns) {
  ONESEA_CHECK(state_ == State::kWriting || state_ == State::kEnded);
  if (state_ == State::kWriting) Settle(now_ns);
}

absl::Status Subscriber::OnAck(std::int64_t sequence, std::int64_t now_ns) {
  if (sequence > last_sent_) {
    return absl::InvalidArgumentError(
        absl::StrCat("ack.sequence: ", sequence, " was never sent; the newest is ", last_sent_));
  }
  while (unacknowledged_ > 0 && sent_[oldest_] <= sequence) {
    oldest_ = (oldest_ + 1) % kCreditMax;
    --unacknowledged_;
  }
  if (state_ == State::kStarved) Settle(now_ns);
  return absl::OkStatus();
}

void Subscriber::Settle(std::int64_t now_ns) {
  const bool starved = credit_ != kCreditUnlimited && unacknowledged_ >= credit_;
  const State next = starved ? State::kStarved : State::kReady;
  if (next == state_)
    return;  // an acknowledgement that gave no credit does not restart the patience
  state_ = next;
  state_since_ns_ = now_ns;
}

std::int64_t Subscriber::StalledNs(std::int64_t now_ns) const {
  const bool waits = state_ == State::kWriting || state_ == State::kStarved;
  return waits ? now_ns - state_since_ns_ : 0;
}

}  // namespace onesea::server
