// Bodies over the network: spawned, driven, listed, seen by queries and by viewers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "client/model/local_world.h"
#include "common/sea/point_query.h"
#include "common/wire/frame.h"
#include "tests/rpc/rpc_fixture.h"

namespace onesea::server {
namespace {

using ::testing::HasSubstr;

class WorldMethodsTest : public RpcFixture {
 protected:
  v1::Command Header(const std::string& id, const std::string& lease = "") {
    v1::Command command;
    command.set_session("small");
    command.set_request_id(id);
    command.set_lease(lease);
    return command;
  }

  v1::SpawnBodyRequest BoatRequest(const std::string& id) {
    v1::SpawnBodyRequest request;
    *request.mutable_command() = Header(id);
    v1::BodyDescription& body = *request.mutable_body();
    body.set_name("boat");
    body.set_owner("Anna");
    body.set_mass_kg(1900);
    v1::Vector3& size = *body.mutable_shape()->mutable_box()->mutable_size_m();
    size.set_x(6);
    size.set_y(2.2);
    size.set_z(1.1);
    v1::Thruster& motor = *body.add_thrusters();
    motor.mutable_position_m()->set_x(-2.9);
    motor.mutable_position_m()->set_z(-0.85);
    motor.set_diameter_m(0.4);
    return request;
  }

  grpc::Status SpawnPreset(const std::string& id, const std::string& preset,
                           v1::SpawnBodyResponse* response) {
    v1::SpawnBodyRequest request;
    *request.mutable_command() = Header(id);
    request.mutable_body()->set_preset(preset);
    request.mutable_body()->set_mass_kg(600);
    return Call(&Stub::SpawnBody, request, response);
  }

  v1::SpawnBodyResponse SpawnBoat(const std::string& id) {
    v1::SpawnBodyResponse response;
    const grpc::Status status = Call(&Stub::SpawnBody, BoatRequest(id), &response);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return response;
  }

  void AddRegion(std::uint32_t follow) {
    v1::AddRegionRequest request;
    *request.mutable_command() = Header("region");
    request.mutable_region()->set_columns(64);
    request.mutable_region()->set_rows(64);
    request.mutable_region()->set_follow_body_id(follow);
    v1::AddRegionResponse response;
    const grpc::Status status = Call(&Stub::AddRegion, request, &response);
    ASSERT_TRUE(status.ok()) << status.error_message();
  }

  grpc::Status Drive(std::uint32_t body, const std::string& lease, const std::string& id) {
    v1::DriveBodyRequest request;
    *request.mutable_command() = Header(id, lease);
    request.set_body_id(body);
    request.add_throttle(1.0);
    v1::DriveBodyResponse response;
    return Call(&Stub::DriveBody, request, &response);
  }

  void Step(int ticks) {
    v1::StepSessionRequest request;
    request.set_session("small");
    request.set_ticks(ticks);
    v1::StepSessionResponse response;
    const grpc::Status status = Call(&Stub::StepSession, request, &response);
    ASSERT_TRUE(status.ok()) << status.error_message();
  }

  v1::ListBodiesResponse List() {
    v1::ListBodiesRequest request;
    request.set_session("small");
    v1::ListBodiesResponse response;
    EXPECT_TRUE(Call(&Stub::ListBodies, request, &response).ok());
    return response;
  }
};

TEST_F(WorldMethodsTest, ADrivenBoatMovesAndItsWakeIsInQueries) {
  const v1::SpawnBodyResponse boat = SpawnBoat("spawn");
  AddRegion(boat.body_id());
  ASSERT_TRUE(Drive(boat.body_id(), boat.lease(), "drive").ok());
  const double before_x = List().bodies(0).state().position_m().x();
  Step(300);
  const v1::ListBodiesResponse list = List();
  ASSERT_EQ(list.bodies_size(), 1);
  EXPECT_EQ(list.bodies(0).driver(), "Anna");
  EXPECT_GT(list.bodies(0).state().position_m().x(), before_x + 2.0);

  v1::QueryPointsResponse answer;
  ASSERT_TRUE(Call(&Stub::QueryPoints, QueryAt("small", 3), &answer).ok());
  EXPECT_EQ(answer.layers(), sea::kLayerSpectral | sea::kLayerInteraction);
  v1::QueryPointsRequest earlier = QueryAt("small", 3);
  earlier.set_tick(10);
  ASSERT_TRUE(Call(&Stub::QueryPoints, earlier, &answer).ok());
  EXPECT_EQ(answer.layers(), sea::kLayerSpectral);  // wakes of so long ago are not held
  earlier.set_tick(270);
  ASSERT_TRUE(Call(&Stub::QueryPoints, earlier, &answer).ok());
  EXPECT_EQ(answer.layers(), sea::kLayerSpectral | sea::kLayerInteraction);
}

TEST_F(WorldMethodsTest, ARetryIsHarmless) {
  const v1::SpawnBodyResponse first = SpawnBoat("same");
  const v1::SpawnBodyResponse again = SpawnBoat("same");
  EXPECT_EQ(first.body_id(), again.body_id());
  EXPECT_EQ(first.lease(), again.lease());
  EXPECT_EQ(List().bodies_size(), 1);
}

TEST_F(WorldMethodsTest, APresetIsNamedAndItsHullIsFetchedByHash) {
  v1::SpawnBodyResponse boat;
  const grpc::Status spawned = SpawnPreset("spawn", "boat", &boat);
  ASSERT_TRUE(spawned.ok()) << spawned.error_message();
  const v1::BodyInfo info = List().bodies(0).info();
  EXPECT_EQ(info.name(), "boat");
  EXPECT_EQ(info.mass_kg(), 600);  // what was given besides
  ASSERT_TRUE(info.shape().has_mesh());
  EXPECT_TRUE(info.shape().mesh().file().empty());
  v1::GetMeshRequest ask;
  ask.set_session("small");
  ask.set_hash(info.shape().mesh().hash());
  v1::GetMeshResponse mesh;
  ASSERT_TRUE(Call(&Stub::GetMesh, ask, &mesh).ok());
  EXPECT_EQ(wire::MeshHash(mesh.file()), ask.hash());
  EXPECT_TRUE(Drive(boat.body_id(), boat.lease(), "drive").ok());  // with the preset's motor
  EXPECT_EQ(boat.body().thrusters_size(), 1);
  EXPECT_EQ(boat.body().mass_kg(), 600);
  EXPECT_EQ(boat.body().shape().mesh().hash(), ask.hash());
  EXPECT_TRUE(boat.body().shape().mesh().file().empty());

  v1::SpawnBodyResponse none;
  const grpc::Status refused = SpawnPreset("other", "submarine", &none);
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::NOT_FOUND);
  v1::ListPresetsResponse list;
  ASSERT_TRUE(Call(&Stub::ListPresets, v1::ListPresetsRequest(), &list).ok());
  EXPECT_GE(list.presets_size(), 5);
  for (const auto& preset : list.presets()) {
    EXPECT_THAT(refused.error_message(), HasSubstr(preset.name()));
    EXPECT_FALSE(preset.summary().empty());
    EXPECT_GT(preset.body().mass_kg(), 0.0);
    EXPECT_TRUE(preset.body().shape().mesh().file().empty());
  }
}

// As a session file or a request to create one may say it.
TEST_F(WorldMethodsTest, ASessionMayBeginWithPresets) {
  v1::CreateSessionRequest create;
  wire::ToProto(SmallSession("harbour"), create.mutable_spec());
  v1::StartBody& start = *create.mutable_spec()->mutable_world()->add_bodies();
  start.mutable_body()->set_preset("crate");
  start.mutable_body()->set_name("tea");
  v1::CreateSessionResponse created;
  const grpc::Status made = Call(&Stub::CreateSession, create, &created);
  ASSERT_TRUE(made.ok()) << made.error_message();
  v1::ListBodiesRequest ask;
  ask.set_session("harbour");
  v1::ListBodiesResponse bodies;
  ASSERT_TRUE(Call(&Stub::ListBodies, ask, &bodies).ok());
  ASSERT_EQ(bodies.bodies_size(), 1);
  EXPECT_EQ(bodies.bodies(0).info().name(), "tea");
  EXPECT_EQ(bodies.bodies(0).info().shape().box().size_m().z(), 0.8);

  create.mutable_spec()->set_name("other");
  create.mutable_spec()->mutable_world()->mutable_bodies(0)->mutable_body()->set_preset("kraken");
  const grpc::Status refused = Call(&Stub::CreateSession, create, &created);
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::NOT_FOUND);
  EXPECT_THAT(refused.error_message(), HasSubstr("kraken"));
}

TEST_F(WorldMethodsTest, OnlyTheLeaseDrives) {
  const v1::SpawnBodyResponse boat = SpawnBoat("spawn");
  const grpc::Status other = Drive(boat.body_id(), "", "other");
  EXPECT_EQ(other.error_code(), grpc::StatusCode::PERMISSION_DENIED);
  EXPECT_THAT(other.error_message(), HasSubstr("'Anna'"));
  EXPECT_TRUE(Drive(boat.body_id(), boat.lease(), "own").ok());
}

TEST_F(WorldMethodsTest, ARopeNeedsTheLeasesOfItsBodies) {
  const v1::SpawnBodyResponse boat = SpawnBoat("spawn");
  v1::AddRopeRequest request;
  *request.mutable_command() = Header("tie");
  request.mutable_rope()->mutable_from()->set_body_id(boat.body_id());
  request.mutable_rope()->mutable_to()->mutable_point_m()->set_x(20);
  request.mutable_rope()->set_length_m(15);
  v1::AddRopeResponse rope;
  EXPECT_EQ(Call(&Stub::AddRope, request, &rope).error_code(), grpc::StatusCode::PERMISSION_DENIED);
  *request.mutable_command() = Header("tie it", boat.lease());
  const grpc::Status tied = Call(&Stub::AddRope, request, &rope);
  ASSERT_TRUE(tied.ok()) << tied.error_message();
  v1::RemoveRopeRequest untie;
  v1::RemoveRopeResponse gone;
  *untie.mutable_command() = Header("untie");
  untie.set_rope_id(rope.rope_id());
  EXPECT_EQ(Call(&Stub::RemoveRope, untie, &gone).error_code(),
            grpc::StatusCode::PERMISSION_DENIED);
  *untie.mutable_command() = Header("untie it", boat.lease());
  EXPECT_TRUE(Call(&Stub::RemoveRope, untie, &gone).ok());
}

TEST_F(WorldMethodsTest, NonsenseIsRefusedByName) {
  EXPECT_EQ(Drive(77, "", "a").error_code(), grpc::StatusCode::NOT_FOUND);
  v1::SpawnBodyRequest heavy = BoatRequest("b");
  heavy.mutable_body()->set_mass_kg(std::nan(""));
  v1::SpawnBodyResponse response;
  const grpc::Status refused = Call(&Stub::SpawnBody, heavy, &response);
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(refused.error_message(), HasSubstr("mass_kg"));
  v1::SpawnBodyRequest nameless = BoatRequest("");
  EXPECT_THAT(Call(&Stub::SpawnBody, nameless, &response).error_message(), HasSubstr("request_id"));
  EXPECT_EQ(List().bodies_size(), 0);
}

// Frames as a viewer gets them, against what the server lists.
TEST_F(WorldMethodsTest, AViewerSeesTheBody) {
  const v1::SpawnBodyResponse boat = SpawnBoat("spawn");
  AddRegion(boat.body_id());
  Step(60);
  grpc::ClientContext context;
  const auto stream = stub->Watch(&context);
  v1::WatchRequest open;
  open.mutable_open()->set_session("small");
  open.mutable_open()->set_every_frame(true);
  ASSERT_TRUE(stream->Write(open));
  client::LocalWorld world;
  v1::WatchResponse response;
  while (world.view()->bodies().empty() && stream->Read(&response)) {
    const auto frame = wire::DecodeFrame(response.SerializeAsString());
    ASSERT_TRUE(frame.ok()) << frame.status();
    ASSERT_TRUE(world.Apply(*frame, 60).ok());
  }
  context.TryCancel();
  ASSERT_EQ(world.view()->bodies().size(), 1u);
  EXPECT_EQ(world.view()->bodies()[0].info->name, "boat");
  EXPECT_EQ(world.view()->interaction().fields.size(), 1u);
  const wire::BodyState state = world.view()->bodies()[0].At(world.view()->time());
  EXPECT_NEAR(state.position_m.z, List().bodies(0).state().position_m().z(), 0.01);
}

}  // namespace
}  // namespace onesea::server
