#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "absl/base/thread_annotations.h"
#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "client/embed/follower.h"
#include "client/net/session_client.h"
#include "client/net/terrain_fetcher.h"
#include "onesea/onesea.h"

namespace onesea::client {

/// The Sea that Join() hands out: a SessionClient for frames and time, a Follower for the waves, a
/// TerrainFetcher for what lies below them.
class JoinedSea final : public Sea, public SessionListener {
 public:
  JoinedSea(const std::string& address, const std::string& session, const JoinOptions& options);
  ~JoinedSea() override;

  /// Waits for the first correct height.
  absl::Status WaitUntilReady(double timeout_s);

  double Now() const override;
  double HeightAt(double x_m, double y_m) const override;
  double HeightAt(double x_m, double y_m, double time_s) const override;
  absl::Status Sample(std::span<const Place> places, double time_s, Detail detail,
                      std::span<Water> out) const override;
  absl::Status SampleAtDepth(std::span<const Place> places, std::span<const double> depth_m,
                             double time_s, std::span<Underwater> out) const override;
  double HeightErrorBound(double time_s) const override;
  absl::Status status() const override;
  DriftReport drift() const override;
  SessionReport session() const override;

 private:
  void OnFrame(const wire::Frame& frame) override;
  void OnLink(const LinkEvent& event) override;
  void OnNewSea();
  void Tell(const std::string& line) const;
  void Fail(const absl::Status& status);
  // The sea, or null once this process can't show it any more, or while a terrain is missing.
  LocalSea* UsableSea() const;
  absl::Status UsableStatus() const;

  const std::function<void(const std::string&)> on_event_;
  mutable absl::Mutex mutex_;
  absl::Status status_ ABSL_GUARDED_BY(mutex_);
  LinkEvent link_ ABSL_GUARDED_BY(mutex_);
  std::atomic<SessionClient*> drift_sink_{nullptr};  // client_, once it is constructed
  std::unique_ptr<Follower> follower_;
  std::unique_ptr<TerrainFetcher> terrain_;
  std::unique_ptr<SessionClient> client_;
};

}  // namespace onesea::client
