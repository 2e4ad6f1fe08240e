#include "client/embed/follower.h"

#include <utility>

#include "common/base/check.h"

namespace onesea::client {

Follower::Follower(Events events) : events_(std::move(events)), thread_([this] { Run(); }) {}

Follower::~Follower() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
}

void Follower::Offer(const wire::Frame& frame) {
  if (!frame.welcome.has_value() && !frame.probes.has_value()) return;
  absl::MutexLock lock(&mutex_);
  if (frame.welcome.has_value()) {
    welcome_ = *frame.welcome;
    probes_.reset();  // they were of the sea before
  }
  if (frame.probes.has_value()) probes_ = *frame.probes;
}

LocalSea* Follower::sea() const {
  absl::MutexLock lock(&mutex_);
  return sea_.get();
}

absl::Status Follower::WaitForSea(absl::Time deadline) const {
  absl::MutexLock lock(&mutex_);
  const auto decided = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) {
    return sea_ != nullptr || !refusal_.ok();
  };
  if (!mutex_.AwaitWithDeadline(absl::Condition(&decided), deadline)) {
    return absl::DeadlineExceededError("no welcome came in time");
  }
  return refusal_;
}

void Follower::Run() {
  while (true) {
    std::optional<wire::Welcome> welcome;
    std::optional<wire::ProbeHeights> probes;
    {
      absl::MutexLock lock(&mutex_);
      const auto has_work = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) {
        return stopping_ || welcome_.has_value() || probes_.has_value();
      };
      mutex_.Await(absl::Condition(&has_work));
      if (stopping_) return;
      welcome = std::exchange(welcome_, std::nullopt);
      probes = std::exchange(probes_, std::nullopt);
    }
    if (welcome.has_value()) {
      const absl::Status status = Follow(*welcome);
      {
        absl::MutexLock lock(&mutex_);
        refusal_ = status;
      }
      if (!status.ok()) {
        events_.on_refused(status);
        continue;
      }
      events_.on_new_sea();
    }
    LocalSea* const sea = this->sea();
    if (!probes.has_value() || sea == nullptr || sea->missing_terrain() != 0) continue;
    const absl::StatusOr<double> drift_m = sea->CompareProbes(*probes);
    if (drift_m.ok()) {
      events_.on_compared(sea->drift());
    } else {
      events_.on_refused(drift_m.status());
    }
  }
}

absl::Status Follower::Follow(const wire::Welcome& welcome) {
  if (LocalSea* const sea = this->sea()) return sea->Follow(welcome);
  ONESEA_ASSIGN_OR_RETURN(std::unique_ptr<LocalSea> made, LocalSea::Make(welcome));
  absl::MutexLock lock(&mutex_);
  sea_ = std::move(made);
  return absl::OkStatus();
}

}  // namespace onesea::client
