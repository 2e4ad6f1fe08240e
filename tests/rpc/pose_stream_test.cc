// Bodies that their owners integrate: a few lines of an integrator against the server's water.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "common/sea/constants.h"
#include "tests/rpc/rpc_fixture.h"

namespace onesea::server {
namespace {

using ::testing::HasSubstr;
using PoseStream =
    grpc::ClientReaderWriter<v1::StreamBodyPosesRequest, v1::StreamBodyPosesResponse>;

constexpr double kStepS = 1.0 / 60.0;

v1::Vector3 Vector(double x, double y, double z) {
  v1::Vector3 vector;
  vector.set_x(x);
  vector.set_y(y);
  vector.set_z(z);
  return vector;
}

class PoseStreamTest : public RpcFixture {
 protected:
  PoseStreamTest() {
    SessionSpec calm = SmallSession("calm");
    calm.pace = Pace::kHeld;
    calm.recipe.timeline[0].sea = SmallSea(1e-5);
    calm.recipe.timeline[0].sea.wind_speed_m_per_s = 0.0;
    ONESEA_CHECK(registry.Create(calm).ok());
    stream = stub->StreamBodyPoses(&context);
  }
  ~PoseStreamTest() override { context.TryCancel(); }

  v1::Command Header() {
    v1::Command command;
    command.set_session("calm");
    command.set_request_id("r" + std::to_string(++requests));
    return command;
  }

  // A box of 2 x 2 x 1 m.
  v1::SpawnBodyResponse Spawn(v1::BodyDescription::Control control, double mass_kg, double x) {
    v1::SpawnBodyRequest request;
    *request.mutable_command() = Header();
    request.mutable_body()->set_control(control);
    request.mutable_body()->set_mass_kg(mass_kg);
    *request.mutable_body()->mutable_shape()->mutable_box()->mutable_size_m() = Vector(2, 2, 1);
    request.mutable_start()->mutable_position_m()->set_x(x);
    v1::SpawnBodyResponse response;
    const grpc::Status status = Call(&Stub::SpawnBody, request, &response);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return response;
  }

  static v1::StreamBodyPosesRequest At(const v1::SpawnBodyResponse& body, double x, double z) {
    v1::StreamBodyPosesRequest request;
    request.set_session("calm");
    auto* pose = request.add_poses();
    pose->set_body_id(body.body_id());
    pose->set_lease(body.lease());
    *pose->mutable_state()->mutable_position_m() = Vector(x, 0, z);
    return request;
  }

  v1::StreamBodyPosesResponse Ask(v1::StreamBodyPosesRequest request) {
    request.set_id(++requests);
    EXPECT_TRUE(stream->Write(request));
    v1::StreamBodyPosesResponse response;
    EXPECT_TRUE(stream->Read(&response));
    EXPECT_EQ(response.id(), request.id());
    return response;
  }

  void Step() {
    v1::StepSessionRequest request;
    request.set_session("calm");
    request.set_ticks(1);
    v1::StepSessionResponse response;
    const grpc::Status status = Call(&Stub::StepSession, request, &response);
    ASSERT_TRUE(status.ok()) << status.error_message();
  }

  v1::Vector3 PlaceOf(const v1::SpawnBodyResponse& body) {
    v1::ListBodiesRequest request;
    request.set_session("calm");
    v1::ListBodiesResponse list;
    EXPECT_TRUE(Call(&Stub::ListBodies, request, &list).ok());
    for (const auto& listed : list.bodies()) {
      if (listed.info().id() == body.body_id()) return listed.state().position_m();
    }
    ADD_FAILURE() << "no body " << body.body_id();
    return {};
  }

  // Largest height of the calm session's water along a line to the east.
  double HighestAlong(double from_x, double to_x, double y) {
    v1::QueryPointsRequest request;
    request.set_session("calm");
    for (double x = from_x; x <= to_x; x += 0.5) {
      request.add_x_m(x);
      request.add_y_m(y);
    }
    v1::QueryPointsResponse answer;
    EXPECT_TRUE(Call(&Stub::QueryPoints, request, &answer).ok());
    double highest = 0.0;
    for (const float height : answer.height_m()) highest = std::max<double>(highest, height);
    return highest;
  }

  int requests = 0;
  grpc::ClientContext context;
  std::unique_ptr<PoseStream> stream;
};

// Our own integrator: the force of the water and the weight, on the mass with the added one. It
// comes to rest where Archimedes says: draft = m / (rho A).
TEST_F(PoseStreamTest, ABoxFloatsAtItsDraftInLockStep) {
  constexpr double kMassKg = 1500.0;
  const v1::SpawnBodyResponse box =
      Spawn(v1::BodyDescription::CONTROL_BY_OWNER, kMassKg, /*x=*/0.0);
  double z_m = 0.6, speed_m_per_s = 0.0;  // dropped from above its rest
  for (std::int64_t tick = 0; tick < 900; ++tick) {
    v1::StreamBodyPosesRequest request = At(box, 0.0, z_m);
    *request.mutable_poses(0)->mutable_state()->mutable_velocity_m_per_s() =
        Vector(0, 0, speed_m_per_s);
    const v1::StreamBodyPosesResponse answer = Ask(request);
    ASSERT_EQ(answer.error_code(), 0) << answer.error_message();
    ASSERT_EQ(answer.tick(), tick);
    ASSERT_EQ(answer.wrenches_size(), 1);
    ASSERT_EQ(answer.wrenches(0).added_mass_size(), 36);
    const double inertia_kg = kMassKg + answer.wrenches(0).added_mass(14);
    const double force_n = answer.wrenches(0).force_n().z() - kMassKg * sea::kGravity;
    speed_m_per_s += kStepS * force_n / inertia_kg;
    z_m += kStepS * speed_m_per_s;
    Step();
  }
  const double draft_m = kMassKg / (sea::kWaterDensityKgPerM3 * 4.0);
  EXPECT_NEAR(0.5 - z_m, draft_m, 0.01 * draft_m);
  EXPECT_NEAR(speed_m_per_s, 0.0, 1e-3);
  EXPECT_NEAR(PlaceOf(box).z(), z_m, 1e-3);  // and others see it there
}

TEST_F(PoseStreamTest, ATowedBoxMakesAWakeAndPushesWhatItMeets) {
  v1::AddRegionRequest region;
  *region.mutable_command() = Header();
  region.mutable_region()->set_columns(128);
  region.mutable_region()->set_rows(128);
  v1::AddRegionResponse added;
  ASSERT_TRUE(Call(&Stub::AddRegion, region, &added).ok());
  const v1::SpawnBodyResponse box = Spawn(v1::BodyDescription::CONTROL_BY_OWNER, 1500.0, -18.0);
  const v1::SpawnBodyResponse met = Spawn(v1::BodyDescription::CONTROL_INTEGRATED, 800.0, 0.0);
  Step();
  EXPECT_LT(HighestAlong(-15.0, 10.0, 3.0), 1e-3);
  constexpr double kSpeedMPerS = 3.0;
  double x_m = -18.0;
  for (int n = 0; n < 500; ++n, x_m += kStepS * kSpeedMPerS) {
    v1::StreamBodyPosesRequest request = At(box, x_m, 0.13);
    *request.mutable_poses(0)->mutable_state()->mutable_velocity_m_per_s() =
        Vector(kSpeedMPerS, 0, 0);
    const v1::StreamBodyPosesResponse answer = Ask(request);
    ASSERT_EQ(answer.error_code(), 0) << answer.error_message();
    EXPECT_TRUE(n < 100 || answer.wrenches(0).force_n().x() < 0.0) << n;  // it resists
    Step();
  }
  EXPECT_GT(HighestAlong(-15.0, 10.0, 3.0), 0.01);
  EXPECT_GT(PlaceOf(met).x(), x_m + 1.5);  // shoved along: it was at 0, the box is at 7 now
}

TEST_F(PoseStreamTest, ABadRequestIsAnsweredAndTheStreamGoesOn) {
  const v1::SpawnBodyResponse box = Spawn(v1::BodyDescription::CONTROL_BY_OWNER, 1500.0, 0.0);
  const v1::SpawnBodyResponse ours = Spawn(v1::BodyDescription::CONTROL_INTEGRATED, 800.0, 9.0);
  const auto refused = [&](v1::StreamBodyPosesRequest request, grpc::StatusCode code,
                           const char* words) {
    const v1::StreamBodyPosesResponse answer = Ask(std::move(request));
    EXPECT_EQ(answer.error_code(), code) << words;
    EXPECT_THAT(answer.error_message(), HasSubstr(words));
    EXPECT_EQ(answer.wrenches_size(), 0);
  };
  v1::StreamBodyPosesRequest elsewhere = At(box, 0, 0);
  elsewhere.set_session("nobody");
  refused(elsewhere, grpc::StatusCode::NOT_FOUND, "nobody");

  const v1::StreamBodyPosesRequest good = At(box, 1.0, 0.1);
  v1::StreamBodyPosesRequest bad = good;
  bad.mutable_poses(0)->mutable_state()->mutable_position_m()->set_y(std::nan(""));
  refused(bad, grpc::StatusCode::INVALID_ARGUMENT, "poses[0].state.position_m.y: nan");
  bad = good;
  bad.mutable_poses(0)->mutable_state()->mutable_turn()->set_w(0.3);
  refused(bad, grpc::StatusCode::INVALID_ARGUMENT, "turn (its length): 0.3");
  bad = good;
  bad.mutable_poses(0)->mutable_state()->mutable_turn()->set_x(std::nan(""));
  refused(bad, grpc::StatusCode::INVALID_ARGUMENT, "turn (its length): nan");
  bad = good;
  bad.mutable_poses(0)->mutable_state()->mutable_velocity_m_per_s()->set_x(1e9);
  refused(bad, grpc::StatusCode::INVALID_ARGUMENT, "velocity_m_per_s.x");
  bad = good;
  bad.mutable_poses(0)->set_body_id(77);
  refused(bad, grpc::StatusCode::NOT_FOUND, "77");
  bad = good;
  bad.mutable_poses(0)->set_lease("guessed");
  refused(bad, grpc::StatusCode::PERMISSION_DENIED, "is held by");
  refused(At(ours, 9.0, 0.0), grpc::StatusCode::FAILED_PRECONDITION, "CONTROL_BY_OWNER");
  bad = good;
  bad.set_session("small");
  refused(bad, grpc::StatusCode::INVALID_ARGUMENT, "of 'calm'");

  // One bad pose among good ones: none is taken.
  v1::StreamBodyPosesRequest mixed = At(box, 5.0, 0.1);
  *mixed.add_poses() = At(ours, 0, 0).poses(0);
  refused(mixed, grpc::StatusCode::FAILED_PRECONDITION, "poses[1]");
  Step();
  EXPECT_NEAR(PlaceOf(box).x(), 0.0, 1e-9);

  EXPECT_EQ(Ask(good).error_code(), 0);
  v1::StreamBodyPosesRequest again = At(box, 2.0, 0.1);  // the lease was shown before
  again.mutable_poses(0)->clear_lease();
  again.clear_session();
  EXPECT_EQ(Ask(again).error_code(), 0);
  Step();
  EXPECT_NEAR(PlaceOf(box).x(), 2.0, 1e-9);
  EXPECT_TRUE(stream->WritesDone());
  EXPECT_TRUE(stream->Finish().ok());
}

// Answers keep their ids, and an end of the session is an answer too.
TEST_F(PoseStreamTest, ManyAtOnceUntilTheSessionEnds) {
  const v1::SpawnBodyResponse box = Spawn(v1::BodyDescription::CONTROL_BY_OWNER, 1500.0, 0.0);
  v1::StreamBodyPosesRequest request = At(box, 0.0, 0.1);
  for (int n = 0; n < 12; ++n) {
    request.set_id(n);
    ASSERT_TRUE(stream->Write(request));
  }
  v1::StreamBodyPosesResponse answer;
  for (int n = 0; n < 12; ++n) {
    ASSERT_TRUE(stream->Read(&answer));
    EXPECT_EQ(answer.id(), n);
    EXPECT_EQ(answer.error_code(), 0) << answer.error_message();
  }
  ASSERT_TRUE(registry.Delete("calm", "test").ok());
  EXPECT_EQ(Ask(request).error_code(), grpc::StatusCode::NOT_FOUND);
}

}  // namespace
}  // namespace onesea::server
