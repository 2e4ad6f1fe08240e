#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/base/thread_annotations.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "common/base/clock.h"
#include "server/session/session_loop.h"

/// The sessions of this server, by name. Thread-safe.
namespace onesea::server {

class Registry {
 public:
  explicit Registry(const Clock& clock = SystemClock(),
                    sea::TransformKind transform = sea::TransformKind::kOwn);
  /// Closes every session.
  ~Registry();

  /// Builds the components on the caller's thread (tens of milliseconds a wave system) and starts
  /// the session. InvalidArgument; AlreadyExists; ResourceExhausted at kSessionsMax.
  absl::StatusOr<std::shared_ptr<SessionLoop>> Create(SessionSpec spec);

  /// NotFound. Closes the session: viewers get `reason`, whoever holds it gets errors from then on.
  absl::Status Delete(std::string_view name, std::string_view reason);

  /// NotFound, with the names that there are.
  absl::StatusOr<std::shared_ptr<SessionLoop>> Find(std::string_view name) const;

  /// By name, ascending.
  std::vector<std::shared_ptr<SessionLoop>> List() const;

  /// Closes every session.
  void CloseAll(std::string_view reason);

 private:
  absl::Status Reserve(const std::string& name);

  const Clock& clock_;
  const sea::TransformKind transform_;
  mutable absl::Mutex mutex_;
  // A null value is a name whose session is still being built.
  std::map<std::string, std::shared_ptr<SessionLoop>, std::less<>> sessions_
      ABSL_GUARDED_BY(mutex_);
};

}  // namespace onesea::server
