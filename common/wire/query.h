#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "common/base/sim_time.h"
#include "common/base/vec.h"
#include "common/sea/point_query.h"

/// Point queries in the domain's own words (proto onesea.v1.QueryPointsRequest and -Response).
namespace onesea::wire {

struct QueryRequest {
  std::string session;
  std::int64_t id = 0;          ///< echoed in the answer
  std::vector<Vec2d> points_m;  ///< (n), 1..kQueryPointsMax
  std::optional<Tick> tick;     ///< at most one of `tick` and `time_s`; neither: now
  std::optional<double> time_s;
  sea::QueryDetail detail = sea::QueryDetail::kHeight;
  std::vector<double> depth_m;  ///< empty, or (n) below the mean water level
};

/// Arrays have the request's size, or none when not asked for.
struct QueryAnswer {
  std::int64_t id = 0;
  double time_s = 0.0;          ///< sea time that the answer holds for
  std::uint32_t layers = 0;     ///< bit set of sea::kLayer...
  std::vector<float> height_m;  ///< (n)
  double height_error_bound_m = 0.0;
  std::vector<float> normal;            ///< (n x 3)
  std::vector<float> velocity_m_per_s;  ///< (n x 3)
  std::vector<std::int32_t> folded_indices;
  std::vector<std::int32_t> dry_indices;  ///< on land, or above the surface: zeros in the two below
  std::vector<float> depth_velocity_m_per_s;  ///< (n x 3)
  std::vector<float> dynamic_pressure_pa;     ///< (n)
  absl::Status status;                        ///< streams and steps: why there is no answer
};

/// `answer`, or one that carries its error in `status`, for request `id`.
QueryAnswer OrError(absl::StatusOr<QueryAnswer> answer, std::int64_t id);

}  // namespace onesea::wire
