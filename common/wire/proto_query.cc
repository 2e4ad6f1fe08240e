#include "common/wire/proto_query.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"

namespace onesea::wire {
namespace {

template <typename T>
void Assign(const std::vector<T>& from, google::protobuf::RepeatedField<T>* to) {
  to->Assign(from.begin(), from.end());
}

template <typename T>
std::vector<T> ToVector(const google::protobuf::RepeatedField<T>& from) {
  return {from.begin(), from.end()};
}

// Sizes first, so that no allocation follows a lie.
absl::Status CheckSizes(const v1::QueryPointsRequest& proto) {
  const auto points = static_cast<std::size_t>(proto.x_m_size());
  ONESEA_RETURN_IF_ERROR(CheckSize("", "x_m", points, kQueryPointsMax));
  if (points == 0) return absl::InvalidArgumentError("x_m: 0 elements, at least 1 is needed");
  if (proto.y_m_size() != proto.x_m_size()) {
    return absl::InvalidArgumentError(
        absl::StrCat("y_m: ", proto.y_m_size(), " elements, but x_m has ", proto.x_m_size()));
  }
  const auto depths = static_cast<std::size_t>(proto.depth_m_size());
  ONESEA_RETURN_IF_ERROR(CheckSize("", "depth_m", depths, kQueryDepthPointsMax));
  if (depths != 0 && depths != points) {
    return absl::InvalidArgumentError(absl::StrCat("depth_m: ", proto.depth_m_size(),
                                                   " elements, but x_m has ", proto.x_m_size()));
  }
  return absl::OkStatus();
}

absl::Status CheckAnswerSizes(const v1::QueryPointsResponse& proto) {
  const std::int64_t points = proto.height_m_size();
  const auto check = [points](const char* field, std::int64_t size, std::int64_t per_point) {
    if (size == 0 || size == per_point * points) return absl::OkStatus();
    return absl::InvalidArgumentError(absl::StrCat(field, ": ", size, " elements for ", points,
                                                   " points, ", per_point, " a point are due"));
  };
  ONESEA_RETURN_IF_ERROR(check("normal", proto.normal_size(), 3));
  ONESEA_RETURN_IF_ERROR(check("velocity_m_per_s", proto.velocity_m_per_s_size(), 3));
  ONESEA_RETURN_IF_ERROR(check("depth_velocity_m_per_s", proto.depth_velocity_m_per_s_size(), 3));
  ONESEA_RETURN_IF_ERROR(check("dynamic_pressure_pa", proto.dynamic_pressure_pa_size(), 1));
  for (std::int32_t index : proto.folded_indices()) {
    ONESEA_RETURN_IF_ERROR(CheckInteger("", "folded_indices", index, 0, points - 1));
  }
  for (std::int32_t index : proto.dry_indices()) {
    ONESEA_RETURN_IF_ERROR(CheckInteger("", "dry_indices", index, 0, points - 1));
  }
  return absl::OkStatus();
}

}  // namespace

void ToProto(const QueryRequest& request, v1::QueryPointsRequest* out) {
  out->set_session(request.session);
  out->set_id(request.id);
  const int points = static_cast<int>(request.points_m.size());
  out->mutable_x_m()->Reserve(points);
  out->mutable_y_m()->Reserve(points);
  for (Vec2d point : request.points_m) {
    out->mutable_x_m()->AddAlreadyReserved(point.x);
    out->mutable_y_m()->AddAlreadyReserved(point.y);
  }
  if (request.tick) out->set_tick(*request.tick);
  if (request.time_s) out->set_time_s(*request.time_s);
  out->set_detail(static_cast<v1::QueryPointsRequest::Detail>(request.detail));
  Assign(request.depth_m, out->mutable_depth_m());
}

absl::StatusOr<QueryRequest> FromProto(const v1::QueryPointsRequest& proto) {
  ONESEA_RETURN_IF_ERROR(CheckSizes(proto));
  QueryRequest request;
  request.session = proto.session();
  request.id = proto.id();
  const double* x_m = proto.x_m().data();
  const double* y_m = proto.y_m().data();
  request.points_m.reserve(static_cast<std::size_t>(proto.x_m_size()));
  for (int n = 0; n < proto.x_m_size(); ++n) request.points_m.push_back({x_m[n], y_m[n]});
  if (proto.when_case() == v1::QueryPointsRequest::kTick) request.tick = proto.tick();
  if (proto.when_case() == v1::QueryPointsRequest::kTimeS) request.time_s = proto.time_s();
  if (proto.detail() != v1::QueryPointsRequest::DETAIL_UNSPECIFIED) {
    if (!v1::QueryPointsRequest::Detail_IsValid(proto.detail())) {
      return absl::InvalidArgumentError(
          absl::StrCat("detail: ", static_cast<int>(proto.detail()),
                       " is none of DETAIL_HEIGHT (1), DETAIL_NORMAL (2), DETAIL_VELOCITY (3)"));
    }
    request.detail = static_cast<sea::QueryDetail>(proto.detail());
  }
  request.depth_m = ToVector(proto.depth_m());
  return request;
}

void ToProto(const QueryAnswer& answer, v1::QueryPointsResponse* out) {
  out->set_id(answer.id);
  if (!answer.status.ok()) {
    out->set_error_code(static_cast<std::int32_t>(answer.status.code()));
    out->set_error_message(std::string(answer.status.message()));
    return;
  }
  out->set_time_s(answer.time_s);
  out->set_layers(answer.layers);
  Assign(answer.height_m, out->mutable_height_m());
  out->set_height_error_bound_m(answer.height_error_bound_m);
  Assign(answer.normal, out->mutable_normal());
  Assign(answer.velocity_m_per_s, out->mutable_velocity_m_per_s());
  Assign(answer.folded_indices, out->mutable_folded_indices());
  Assign(answer.dry_indices, out->mutable_dry_indices());
  Assign(answer.depth_velocity_m_per_s, out->mutable_depth_velocity_m_per_s());
  Assign(answer.dynamic_pressure_pa, out->mutable_dynamic_pressure_pa());
}

absl::StatusOr<QueryAnswer> FromProto(const v1::QueryPointsResponse& proto) {
  QueryAnswer answer;
  answer.id = proto.id();
  if (proto.error_code() != 0) {
    answer.status = absl::Status(static_cast<absl::StatusCode>(proto.error_code()),
                                 Printable(proto.error_message(), kErrorLengthMax));
    return answer;
  }
  ONESEA_RETURN_IF_ERROR(CheckAnswerSizes(proto));
  answer.time_s = proto.time_s();
  answer.layers = proto.layers();
  answer.height_m = ToVector(proto.height_m());
  answer.height_error_bound_m = proto.height_error_bound_m();
  answer.normal = ToVector(proto.normal());
  answer.velocity_m_per_s = ToVector(proto.velocity_m_per_s());
  answer.folded_indices = ToVector(proto.folded_indices());
  answer.dry_indices = ToVector(proto.dry_indices());
  answer.depth_velocity_m_per_s = ToVector(proto.depth_velocity_m_per_s());
  answer.dynamic_pressure_pa = ToVector(proto.dynamic_pressure_pa());
  return answer;
}

QueryAnswer OrError(absl::StatusOr<QueryAnswer> answer, std::int64_t id) {
  if (answer.ok()) return *std::move(answer);
  QueryAnswer error;
  error.id = id;
  error.status = answer.status();
  return error;
}

absl::Status CheckAnswers(const QueryRequest& request, const QueryAnswer& answer) {
  const std::size_t points = request.points_m.size(), depths = request.depth_m.size();
  const bool with_normal = request.detail >= sea::QueryDetail::kNormal;
  const bool with_velocity = request.detail >= sea::QueryDetail::kVelocity;
  const struct {
    const char* field;
    std::size_t size, due;
  } arrays[] = {
      {"height_m", answer.height_m.size(), points},
      {"normal", answer.normal.size(), with_normal ? 3 * points : 0},
      {"velocity_m_per_s", answer.velocity_m_per_s.size(), with_velocity ? 3 * points : 0},
      {"depth_velocity_m_per_s", answer.depth_velocity_m_per_s.size(), 3 * depths},
      {"dynamic_pressure_pa", answer.dynamic_pressure_pa.size(), depths},
  };
  for (const auto& array : arrays) {
    if (array.size == array.due) continue;
    return absl::DataLossError(absl::StrCat("the server answered ", array.size, " values of ",
                                            array.field, ", ", array.due, " are due"));
  }
  return absl::OkStatus();
}

}  // namespace onesea::wire
