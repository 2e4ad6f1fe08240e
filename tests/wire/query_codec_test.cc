#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/limits.h"
#include "common/wire/proto_query.h"

namespace onesea::wire {
namespace {

using ::testing::HasSubstr;

QueryRequest SomeRequest() {
  QueryRequest request;
  request.session = "storm";
  request.id = -5;
  request.points_m = {{1.0 / 3.0, -2.0}, {3e6, 4.0}};
  request.time_s = 0.1;
  request.detail = sea::QueryDetail::kVelocity;
  request.depth_m = {1.0, 2.5};
  return request;
}

TEST(QueryCodec, RequestRoundTripIsExact) {
  v1::QueryPointsRequest proto;
  ToProto(SomeRequest(), &proto);
  const absl::StatusOr<QueryRequest> again = FromProto(proto);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ(again->session, "storm");
  EXPECT_EQ(again->id, -5);
  EXPECT_EQ(again->points_m, SomeRequest().points_m);
  EXPECT_EQ(again->time_s, 0.1);
  EXPECT_FALSE(again->tick.has_value());
  EXPECT_EQ(again->detail, sea::QueryDetail::kVelocity);
  EXPECT_EQ(again->depth_m, SomeRequest().depth_m);
}

TEST(QueryCodec, AnswerRoundTripIsExact) {
  QueryAnswer answer;
  answer.id = 9;
  answer.time_s = 1.0 / 7.0;
  answer.layers = 1;
  answer.height_m = {0.1f, -0.3f};
  answer.height_error_bound_m = 0.01;
  answer.normal = {0, 0, 1, 0, 0, 1};
  answer.folded_indices = {1};
  answer.dry_indices = {0};
  v1::QueryPointsResponse proto;
  ToProto(answer, &proto);
  const absl::StatusOr<QueryAnswer> again = FromProto(proto);
  ASSERT_TRUE(again.ok()) << again.status();
  EXPECT_EQ(again->height_m, answer.height_m);
  EXPECT_EQ(again->normal, answer.normal);
  EXPECT_EQ(again->folded_indices, answer.folded_indices);
  EXPECT_EQ(again->dry_indices, answer.dry_indices);
  EXPECT_EQ(again->time_s, answer.time_s);
  EXPECT_TRUE(again->status.ok());
}

TEST(QueryCodec, AnErrorTravelsWithItsId) {
  QueryAnswer answer;
  answer.id = 3;
  answer.status = absl::NotFoundError("session: 'x' is not here");
  v1::QueryPointsResponse proto;
  ToProto(answer, &proto);
  const absl::StatusOr<QueryAnswer> again = FromProto(proto);
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->id, 3);
  EXPECT_EQ(again->status, answer.status);
}

TEST(QueryCodec, RefusesSizesThatDoNotMatch) {
  v1::QueryPointsRequest proto;
  EXPECT_THAT(std::string(FromProto(proto).status().message()), HasSubstr("x_m: 0 elements"));
  proto.add_x_m(1.0);
  EXPECT_THAT(std::string(FromProto(proto).status().message()), HasSubstr("y_m: 0 elements"));
  proto.add_y_m(1.0);
  EXPECT_TRUE(FromProto(proto).ok());
  proto.add_depth_m(1.0);
  proto.add_depth_m(1.0);
  EXPECT_THAT(std::string(FromProto(proto).status().message()), HasSubstr("depth_m: 2 elements"));
  proto.clear_depth_m();
  proto.set_detail(static_cast<v1::QueryPointsRequest::Detail>(9));
  EXPECT_THAT(std::string(FromProto(proto).status().message()), HasSubstr("detail: 9"));
}

TEST(QueryCodec, RefusesAMillionPoints) {
  v1::QueryPointsRequest proto;
  proto.mutable_x_m()->Resize(1'000'000, 0.0);
  proto.mutable_y_m()->Resize(1'000'000, 0.0);
  EXPECT_THAT(std::string(FromProto(proto).status().message()),
              HasSubstr("x_m: 1000000 elements, the limit is 100000"));
}

TEST(QueryCodec, RefusesAnAnswerWhoseArraysLie) {
  v1::QueryPointsResponse proto;
  proto.add_height_m(1.0f);
  EXPECT_TRUE(FromProto(proto).ok());
  proto.add_normal(1.0f);
  EXPECT_FALSE(FromProto(proto).ok());
  proto.clear_normal();
  proto.add_folded_indices(1);
  EXPECT_FALSE(FromProto(proto).ok());
}

// An array may be consistent with the heights and yet not with what was asked.
TEST(QueryCodec, AnAnswerOfOtherSizesThanAskedIsRefused) {
  QueryRequest request;
  request.points_m = {{0.0, 0.0}, {1.0, 2.0}};
  request.detail = sea::QueryDetail::kNormal;
  request.depth_m = {1.0, 2.0};
  QueryAnswer whole;
  whole.height_m.resize(2);
  whole.normal.resize(6);
  whole.depth_velocity_m_per_s.resize(6);
  whole.dynamic_pressure_pa.resize(2);
  EXPECT_TRUE(CheckAnswers(request, whole).ok()) << CheckAnswers(request, whole);
  const struct {
    const char* field;
    void (*spoil)(QueryAnswer&);
  } cases[] = {
      {"height_m", [](QueryAnswer& a) { a.height_m.clear(); }},
      {"normal", [](QueryAnswer& a) { a.normal.clear(); }},
      {"velocity_m_per_s", [](QueryAnswer& a) { a.velocity_m_per_s.resize(6); }},
      {"depth_velocity_m_per_s", [](QueryAnswer& a) { a.depth_velocity_m_per_s.pop_back(); }},
      {"dynamic_pressure_pa", [](QueryAnswer& a) { a.dynamic_pressure_pa.resize(1); }},
  };
  for (const auto& bad : cases) {
    QueryAnswer answer = whole;
    bad.spoil(answer);
    const absl::Status status = CheckAnswers(request, answer);
    EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss) << bad.field;
    EXPECT_NE(status.message().find(bad.field), absl::string_view::npos) << status;
  }
}

}  // namespace
}  // namespace onesea::wire
