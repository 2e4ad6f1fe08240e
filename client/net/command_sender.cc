#include "client/net/command_sender.h"

#include <pthread.h>

#include <algorithm>
#include <memory>
#include <random>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "common/base/clock.h"

namespace onesea::client {
namespace {

constexpr std::int64_t kCallTimeoutNs = 3'000'000'000;
constexpr char kReplaced[] = "a newer order took its place";

std::string RandomId() {
  std::random_device random;
  return absl::StrFormat("view-%08x%08x", random(), random());
}

bool MayGetThroughLater(const absl::Status& status) {
  return absl::IsUnavailable(status) || absl::IsDeadlineExceeded(status);
}

}  // namespace

CommandSender::CommandSender(std::string session, Call call)
    : session_(std::move(session)), call_(std::move(call)), id_(RandomId()) {
  for (int n = 0; n < kUnderWayMax; ++n) {
    threads_.emplace_back([this] {
      pthread_setname_np(pthread_self(), "sea-command");
      Run();
    });
  }
}

CommandSender::~CommandSender() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  for (std::thread& thread : threads_) thread.join();
}

std::int64_t CommandSender::Send(wire::WorldCommand command, std::string lease) {
  absl::MutexLock lock(&mutex_);
  Waiting next;
  next.number = ++last_number_;
  next.header = {.session = session_,
                 .request_id = absl::StrCat(id_, "-", next.number),
                 .tick = std::nullopt,
                 .lease = std::move(lease)};
  next.command = std::move(command);
  next.since_ns = SystemClock().MonotonicNs();
  if (const auto* drive = std::get_if<wire::DriveBody>(&next.command)) {
    const auto is_older = [&](const Waiting& other) {
      const auto* old = std::get_if<wire::DriveBody>(&other.command);
      return old != nullptr && old->body_id == drive->body_id;
    };
    for (const Waiting& other : waiting_) {
      if (is_older(other)) {
        outcomes_.push_back({other.number, absl::CancelledError(kReplaced)});
      }
    }
    std::erase_if(waiting_, is_older);
    newest_order_[drive->body_id] = next.number;
  }
  if (waiting_.size() >= kWaitingMax) {
    outcomes_.push_back({next.number, absl::ResourceExhaustedError(absl::StrCat(
                                          kWaitingMax, " commands wait for the server"))});
  } else {
    waiting_.push_back(std::move(next));
  }
  return last_number_;
}

std::vector<CommandSender::Outcome> CommandSender::Take() {
  absl::MutexLock lock(&mutex_);
  return std::exchange(outcomes_, {});
}

std::string CommandSender::trouble() const {
  absl::MutexLock lock(&mutex_);
  return trouble_;
}

bool CommandSender::AwaitAll(std::int64_t timeout_ns) {
  absl::MutexLock lock(&mutex_);
  return mutex_.AwaitWithTimeout(absl::Condition(this, &CommandSender::IsIdle),
                                 absl::Nanoseconds(timeout_ns));
}

bool CommandSender::HasWork() const { return stopping_ || !waiting_.empty(); }

void CommandSender::Run() {
  absl::MutexLock lock(&mutex_);
  for (;;) {
    mutex_.Await(absl::Condition(this, &CommandSender::HasWork));
    if (stopping_) return;
    const std::int64_t now_ns = SystemClock().MonotonicNs();
    const auto due = std::find_if(waiting_.begin(), waiting_.end(),
                                  [&](const Waiting& w) { return w.not_before_ns <= now_ns; });
    if (due == waiting_.end()) {  // all of them pause
      mutex_.AwaitWithTimeout(absl::Condition(&stopping_), absl::Nanoseconds(kPauseNs / 10));
      continue;
    }
    Waiting next = std::move(*due);
    waiting_.erase(due);
    ++under_way_;
    mutex_.Unlock();
    absl::StatusOr<CommandAnswer> answer = call_(next.header, next.command);
    mutex_.Lock();
    --under_way_;
    Finish(std::move(next), std::move(answer));
  }
}

void CommandSender::Finish(Waiting command, absl::StatusOr<CommandAnswer> answer) {
  if (!MayGetThroughLater(answer.status())) {
    trouble_.clear();
    outcomes_.push_back({command.number, std::move(answer)});
    return;
  }
  trouble_ = absl::StrCat("no answer from the server: ", answer.status().message());
  const std::int64_t now_ns = SystemClock().MonotonicNs();
  if (now_ns - command.since_ns >= kPatienceNs) {
    outcomes_.push_back({command.number, std::move(answer)});
    return;
  }
  // An order that comes late must not undo a newer one.
  const auto* drive = std::get_if<wire::DriveBody>(&command.command);
  if (drive != nullptr && newest_order_[drive->body_id] != command.number) {
    outcomes_.push_back({command.number, absl::CancelledError(kReplaced)});
    return;
  }
  command.not_before_ns = now_ns + kPauseNs;
  waiting_.push_front(std::move(command));
}

CommandSender::Call CommandsTo(ChannelFactory connect) {
  struct Connection {
    absl::Mutex mutex;
    std::shared_ptr<RemoteServer> server ABSL_GUARDED_BY(mutex);
  };
  return [connect = std::move(connect), connection = std::make_shared<Connection>()](
             const wire::CommandHeader& header, const wire::WorldCommand& command) {
    std::shared_ptr<RemoteServer> server;
    {
      absl::MutexLock lock(&connection->mutex);
      if (connection->server == nullptr) {
        connection->server = std::make_shared<RemoteServer>(connect, kCallTimeoutNs);
      }
      server = connection->server;
    }
    absl::StatusOr<CommandAnswer> answer = server->Command(header, command);
    if (absl::IsUnavailable(answer.status())) {
      absl::MutexLock lock(&connection->mutex);
      if (connection->server == server) connection->server = nullptr;
    }
    return answer;
  };
}

}  // namespace onesea::client
