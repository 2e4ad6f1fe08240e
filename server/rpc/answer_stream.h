#pragma once

#include <grpcpp/support/server_callback.h>

#include <cstddef>
#include <deque>
#include <utility>

#include "absl/base/thread_annotations.h"
#include "absl/synchronization/mutex.h"

/// A bidirectional call in which every request gets one answer, in whatever order.
namespace onesea::server {

/// 1. A request is read and goes to Take(), which gives its answer at once or lets another thread
///    Give() it later.
/// 2. Answers queue up and are written one at a time.
/// 3. With kInFlightMax answers owed the next request is not read: the client feels the
///    back-pressure of HTTP/2.
/// 4. When the client has closed its half and all is answered, or when the call is cancelled and
///    everything that was taken is given back, the call is finished. Deletes itself when gRPC is
///    done.
template <typename Request, typename Response>
class AnswerStream : public grpc::ServerBidiReactor<Request, Response> {
 public:
  static constexpr std::size_t kInFlightMax = 16;

  AnswerStream() { this->StartRead(&request_); }

  void OnReadDone(bool ok) override {
    if (ok) {
      {
        absl::MutexLock lock(&mutex_);
        ++owed_;
      }
      Take(request_);
    }
    bool over = false;
    {
      absl::MutexLock lock(&mutex_);
      reading_ = false;
      if (!ok) no_more_requests_ = true;
      over = GoOn();
    }
    if (over) this->Finish(grpc::Status::OK);
  }

  void OnWriteDone(bool ok) override {
    bool over = false;
    {
      absl::MutexLock lock(&mutex_);
      writing_ = false;
      answers_.pop_front();
      if (!ok) {
        broken_ = true;
        answers_.clear();
      }
      over = GoOn();
    }
    if (over) this->Finish(grpc::Status::OK);
  }

  void OnCancel() override {
    bool over = false;
    {
      absl::MutexLock lock(&mutex_);
      broken_ = true;
      while (answers_.size() > (writing_ ? 1 : 0)) answers_.pop_back();
      over = GoOn();
    }
    if (over) this->Finish(grpc::Status::OK);
  }

  void OnDone() override { delete this; }

 protected:
  /// One Give() must follow, from inside or from any thread. One call at a time; `request` is valid
  /// during it.
  virtual void Take(const Request& request) = 0;

  /// The reactor may be gone when it returns, unless it was called from inside Take().
  void Give(Response response) {
    bool over = false;
    {
      absl::MutexLock lock(&mutex_);
      --owed_;
      if (!broken_) answers_.push_back(std::move(response));
      over = GoOn();
    }
    if (over) this->Finish(grpc::Status::OK);
  }

 private:
  // Starts what can be started. True: the call is over, and the caller is to Finish() it after
  // giving the lock back. False: another thread may, and delete the reactor; no member may be
  // touched or called any more.
  [[nodiscard]] bool GoOn() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    if (finished_) return false;
    if (!writing_ && !answers_.empty()) {
      writing_ = true;
      this->StartWrite(&answers_.front());
    }
    if (!reading_ && !no_more_requests_ && !broken_ && answers_.size() + owed_ < kInFlightMax) {
      reading_ = true;
      this->StartRead(&request_);
    }
    const bool idle = !writing_ && !reading_ && owed_ == 0 && answers_.empty();
    finished_ = idle && (no_more_requests_ || broken_);
    return finished_;
  }

  Request request_;  // owned by gRPC while reading_
  absl::Mutex mutex_;
  std::deque<Response> answers_ ABSL_GUARDED_BY(mutex_);  // front: being written
  std::size_t owed_ ABSL_GUARDED_BY(mutex_) = 0;          // taken and not given back
  bool reading_ ABSL_GUARDED_BY(mutex_) = true;  // a read is under way or its request in hand
  bool writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool no_more_requests_ ABSL_GUARDED_BY(mutex_) = false;
  bool broken_ ABSL_GUARDED_BY(mutex_) = false;
  bool finished_ ABSL_GUARDED_BY(mutex_) = false;
};

}  // namespace onesea::server
