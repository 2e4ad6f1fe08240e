#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <thread>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"

/// A thread for work that would hold a gRPC thread too long: building components, points at depth.
namespace onesea::server {

class Worker {
 public:
  static constexpr std::size_t kQueueMax = 64;

  Worker();
  /// Finishes what is queued.
  ~Worker();

  /// ResourceExhausted when kQueueMax jobs wait already; then `job` is not run.
  absl::Status Post(std::function<void()> job);

 private:
  void Run();

  absl::Mutex mutex_;
  std::deque<std::function<void()>> jobs_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

}  // namespace onesea::server
