#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "client/embed/fleet.h"
#include "client/embed/joined_session.h"
#include "common/base/limits.h"
#include "onesea/onesea.h"

namespace onesea::client {

/// Both refuse NaN.
inline bool IsPlace(double x_m, double y_m) {
  return std::abs(x_m) <= kQueryCoordinateMaxM && std::abs(y_m) <= kQueryCoordinateMaxM;
}
inline bool IsTime(double time_s) { return std::abs(time_s) <= kQueryTimeMaxS; }

/// The Sea that Join() hands out: a session followed, checked questions about it, and the bodies
/// that this process commands.
class JoinedSea final : public Sea {
 public:
  JoinedSea(const std::string& address, const std::string& session, const JoinOptions& options);

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
  std::vector<Body> Bodies() const override;
  std::vector<Body> Bodies(double time_s) const override;
  std::optional<Body> FindBody(std::uint32_t id) const override;
  absl::StatusOr<std::unique_ptr<OwnBody>> Spawn(const SpawnOptions& options) override;
  absl::StatusOr<std::unique_ptr<OwnBody>> Take(std::uint32_t id) override;
  absl::Status status() const override;
  DriftReport drift() const override;
  SessionReport session() const override;

 private:
  // The sea, or null once this process can't show it any more, or while a terrain is missing.
  LocalSea* UsableSea() const;
  absl::Status UsableStatus() const;
  double WakesAt(Vec2d place, SimTime time) const;
  std::vector<Body> BodiesAt(SimTime time) const;
  absl::Status Validate(const wire::WorldCommand& command) const;

  const std::string session_name_, owner_;
  JoinedSession session_;
  Fleet fleet_;  // last: it asks the session
};

}  // namespace onesea::client
