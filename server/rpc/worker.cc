#include "server/rpc/worker.h"

#include <utility>

#include "absl/strings/str_cat.h"

namespace onesea::server {

Worker::Worker() : thread_([this] { Run(); }) {}

Worker::~Worker() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
}

absl::Status Worker::Post(std::function<void()> job) {
  absl::MutexLock lock(&mutex_);
  if (jobs_.size() >= kQueueMax) {
    return absl::ResourceExhaustedError(
        absl::StrCat(kQueueMax, " requests wait for the server already; try again later"));
  }
  jobs_.push_back(std::move(job));
  return absl::OkStatus();
}

void Worker::Run() {
  const auto ready = [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return stopping_ || !jobs_.empty();
  };
  while (true) {
    std::function<void()> job;
    {
      absl::MutexLock lock(&mutex_);
      mutex_.Await(absl::Condition(&ready));
      if (jobs_.empty()) return;
      job = std::move(jobs_.front());
      jobs_.pop_front();
    }
    job();
  }
}

}  // namespace onesea::server
