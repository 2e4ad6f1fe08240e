#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <map>
#include <thread>

#include "common/sea/point_query.h"
#include "tests/rpc/rpc_fixture.h"

namespace onesea::server {
namespace {

using ::testing::HasSubstr;

using QueryMethods = RpcFixture;

TEST_F(QueryMethods, AnswersLikeASnapshotOfTheSameComponents) {
  v1::QueryPointsRequest request = QueryAt("small", 50);
  request.set_id(11);
  request.set_time_s(12.25);
  request.set_detail(v1::QueryPointsRequest::DETAIL_VELOCITY);
  v1::QueryPointsResponse response;
  ASSERT_TRUE(Call(&Stub::QueryPoints, request, &response).ok());
  EXPECT_EQ(response.id(), 11);
  EXPECT_EQ(response.time_s(), 12.25);
  EXPECT_EQ(response.layers(), 1u);
  ASSERT_EQ(response.height_m_size(), 50);
  ASSERT_EQ(response.normal_size(), 150);
  ASSERT_EQ(response.velocity_m_per_s_size(), 150);
  const auto snapshot = sea::SnapshotBuilder(Find("small")->View().components)
                            .At(SimTime::FromSeconds(12.25), sea::QueryDetail::kVelocity);
  std::vector<Vec2d> points;
  for (int n = 0; n < 50; ++n) points.push_back({request.x_m(n), request.y_m(n)});
  std::vector<sea::SurfaceSample> samples(50);
  snapshot->Sample(points, samples);
  for (int n = 0; n < 50; ++n) {
    const sea::SurfaceSample& sample = samples[static_cast<std::size_t>(n)];
    EXPECT_EQ(response.height_m(n), sample.height_m);
    EXPECT_EQ(response.normal(3 * n + 1), sample.normal_y);
    EXPECT_EQ(response.velocity_m_per_s(3 * n + 2), sample.velocity_z_m_per_s);
  }
}

TEST_F(QueryMethods, LargeRequestsAreAnsweredToo) {
  v1::QueryPointsResponse response;
  ASSERT_TRUE(Call(&Stub::QueryPoints, QueryAt("small", 100'000), &response).ok());
  EXPECT_EQ(response.height_m_size(), 100'000);
  v1::QueryPointsRequest deep = QueryAt("small", 500);
  for (int n = 0; n < 500; ++n) deep.add_depth_m(5.0);
  ASSERT_TRUE(Call(&Stub::QueryPoints, deep, &response).ok());
  EXPECT_EQ(response.dynamic_pressure_pa_size(), 500);
  EXPECT_EQ(response.depth_velocity_m_per_s_size(), 1500);
}

TEST_F(QueryMethods, Errors) {
  v1::QueryPointsResponse response;
  EXPECT_EQ(Call(&Stub::QueryPoints, QueryAt("nobody", 1), &response).error_code(),
            grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(Call(&Stub::QueryPoints, QueryAt("small", 0), &response).error_code(),
            grpc::StatusCode::INVALID_ARGUMENT);
  v1::QueryPointsRequest bad = QueryAt("small", 2);
  bad.set_y_m(1, std::nan(""));
  const grpc::Status status = Call(&Stub::QueryPoints, bad, &response);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(status.error_message(), HasSubstr("y_m[1]: nan is outside [-1e+07, 1e+07]"));
}

// 100 001 points are refused by the service, a million by gRPC's message limit before they are
// held.
TEST_F(QueryMethods, AMillionPointsAreRefused) {
  v1::QueryPointsResponse response;
  EXPECT_EQ(Call(&Stub::QueryPoints, QueryAt("small", 100'001), &response).error_code(),
            grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(Call(&Stub::QueryPoints, QueryAt("small", 1'000'000), &response).error_code(),
            grpc::StatusCode::RESOURCE_EXHAUSTED);
}

TEST_F(QueryMethods, StreamAnswersEveryRequestByItsId) {
  grpc::ClientContext context;
  const auto stream = stub->StreamQueries(&context);
  std::thread writer([&] {
    for (int id = 0; id < 200; ++id) {
      v1::QueryPointsRequest request = QueryAt("small", 1 + id % 7);
      request.set_id(id);
      request.set_tick(id % 3);
      if (id % 50 == 17) request.mutable_x_m()->Resize(25'000, 1.0);  // heavy: overtaken
      if (id % 50 == 17) request.mutable_y_m()->Resize(25'000, 1.0);
      ASSERT_TRUE(stream->Write(request));
    }
    stream->WritesDone();
  });
  std::map<std::int64_t, int> sizes;
  v1::QueryPointsResponse response;
  while (stream->Read(&response)) {
    EXPECT_EQ(response.error_code(), 0) << response.error_message();
    EXPECT_TRUE(sizes.emplace(response.id(), response.height_m_size()).second);
  }
  writer.join();
  EXPECT_TRUE(stream->Finish().ok());
  ASSERT_EQ(sizes.size(), 200u);
  for (const auto& [id, size] : sizes) EXPECT_EQ(size, id % 50 == 17 ? 25'000 : 1 + id % 7);
}

TEST_F(QueryMethods, StreamGoesOnAfterABadRequest) {
  grpc::ClientContext context;
  const auto stream = stub->StreamQueries(&context);
  const auto ask = [&](v1::QueryPointsRequest request) {
    EXPECT_TRUE(stream->Write(request));
    v1::QueryPointsResponse response;
    EXPECT_TRUE(stream->Read(&response));
    return response;
  };
  v1::QueryPointsRequest bad = QueryAt("small", 2);
  bad.set_id(1);
  bad.set_x_m(0, 1e9);
  v1::QueryPointsResponse response = ask(bad);
  EXPECT_EQ(response.id(), 1);
  EXPECT_EQ(response.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(response.error_message(), HasSubstr("x_m[0]"));
  v1::QueryPointsRequest unknown = QueryAt("nobody", 1);
  unknown.set_id(2);
  EXPECT_EQ(ask(unknown).error_code(), grpc::StatusCode::NOT_FOUND);
  v1::QueryPointsRequest uneven = QueryAt("small", 1);
  uneven.add_x_m(0.0);
  EXPECT_EQ(ask(uneven).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  response = ask(QueryAt("small", 1));
  EXPECT_EQ(response.error_code(), 0);
  EXPECT_EQ(response.height_m_size(), 1);
  stream->WritesDone();
  EXPECT_FALSE(stream->Read(&response));
  EXPECT_TRUE(stream->Finish().ok());
}

// The client neither reads nor ends: the server must hold only a few answers and let go when it is
// cancelled.
TEST_F(QueryMethods, AStreamThatIsNotReadIsLetGo) {
  for (int round = 0; round < 20; ++round) {
    grpc::ClientContext context;
    const auto stream = stub->StreamQueries(&context);
    v1::QueryPointsRequest request = QueryAt("small", round % 2 == 0 ? 10 : 25'000);
    for (int n = 0; n < 10; ++n) {
      if (!stream->Write(request)) break;
    }
    context.TryCancel();
    EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::CANCELLED);
  }
}

TEST_F(QueryMethods, DeletionWhileQueriedIsNotFoundOrAnAnswer) {
  std::atomic<bool> stop{false};
  std::atomic<int> answered{0}, not_found{0}, other{0};
  std::vector<std::thread> clients;
  for (int n = 0; n < 3; ++n) {
    clients.emplace_back([&] {
      while (!stop) {
        v1::QueryPointsResponse response;
        const grpc::Status status = Call(&Stub::QueryPoints, QueryAt("brief", 100), &response);
        if (status.ok()) {
          ++answered;
        } else if (status.error_code() == grpc::StatusCode::NOT_FOUND) {
          ++not_found;
        } else {
          ++other;
        }
      }
    });
  }
  for (int round = 0; round < 10; ++round) {
    ASSERT_TRUE(registry.Create(SmallSession("brief")).ok());
    const int before = answered;
    while (answered == before) std::this_thread::yield();
    ASSERT_TRUE(registry.Delete("brief", "test").ok());
  }
  stop = true;
  for (std::thread& client : clients) client.join();
  EXPECT_GE(answered, 10);
  EXPECT_EQ(other, 0);
}

}  // namespace
}  // namespace onesea::server
