// Commands on the world and what is told of it.

#include <type_traits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/wire/proto_body.h"
#include "common/wire/proto_world.h"
#include "server/rpc/answer.h"
#include "server/rpc/service.h"
#include "server/rpc/status_map.h"
#include "server/rpc/stream_instruments.h"
#include "server/rpc/stream_poses.h"
#include "server/rpc/terrain_writer.h"
#include "server/world/body_presets.h"

namespace onesea::server {
namespace {

// What of the result this response has a field for.
template <typename Response>
void Fill(const CommandResult& result, Response* out) {
  out->set_tick(result.tick);
  if constexpr (requires { out->set_obstacle_id(result.id); }) out->set_obstacle_id(result.id);
  if constexpr (requires { out->set_region_id(result.id); }) out->set_region_id(result.id);
  if constexpr (requires { out->set_rope_id(result.id); }) out->set_rope_id(result.id);
  if constexpr (requires { out->set_lease(result.lease); }) out->set_lease(result.lease);
  if constexpr (std::is_same_v<Response, v1::SpawnBodyResponse>) {
    out->set_body_id(result.id);
    wire::ToProto(result.body->description, out->mutable_body());
  }
}

// Gives a command to its session and answers when it has acted.
template <typename Request, typename Response>
void Command(Registry& registry, const Request& request, Response* response,
             grpc::ServerUnaryReactor* reactor) {
  const auto give = [&]() -> absl::Status {
    ONESEA_ASSIGN_OR_RETURN(wire::HeadedCommand headed, wire::FromProto(request));
    ONESEA_ASSIGN_OR_RETURN(const std::shared_ptr<SessionLoop> session,
                            registry.Find(headed.header.session));
    session->Command(std::move(headed.header), std::move(headed.command),
                     [reactor, response](const absl::StatusOr<CommandResult>& result) {
                       if (result.ok()) Fill(*result, response);
                       reactor->Finish(ToGrpc(result.status()));
                     });
    return absl::OkStatus();
  };
  if (const absl::Status status = give(); !status.ok()) reactor->Finish(ToGrpc(status));
}

template <typename Request, typename Response>
grpc::ServerUnaryReactor* Command(grpc::CallbackServerContext* context, Registry& registry,
                                  const Request* request, Response* response) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  Command(registry, *request, response, reactor);
  return reactor;
}

}  // namespace

// A hull may take a while to read and check.
grpc::ServerUnaryReactor* OneSeaService::SpawnBody(grpc::CallbackServerContext* context,
                                                   const v1::SpawnBodyRequest* request,
                                                   v1::SpawnBodyResponse* response) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  const absl::Status posted = builder_.Post(
      [this, request, response, reactor] { Command(registry_, *request, response, reactor); });
  if (!posted.ok()) reactor->Finish(ToGrpc(posted));
  return reactor;
}

grpc::ServerUnaryReactor* OneSeaService::RemoveBody(grpc::CallbackServerContext* context,
                                                    const v1::RemoveBodyRequest* request,
                                                    v1::RemoveBodyResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::DriveBody(grpc::CallbackServerContext* context,
                                                   const v1::DriveBodyRequest* request,
                                                   v1::DriveBodyResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::ApplyImpulse(grpc::CallbackServerContext* context,
                                                      const v1::ApplyImpulseRequest* request,
                                                      v1::ApplyImpulseResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::Explode(grpc::CallbackServerContext* context,
                                                 const v1::ExplodeRequest* request,
                                                 v1::ExplodeResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::RemoveObstacle(grpc::CallbackServerContext* context,
                                                        const v1::RemoveObstacleRequest* request,
                                                        v1::RemoveObstacleResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::RemoveRegion(grpc::CallbackServerContext* context,
                                                      const v1::RemoveRegionRequest* request,
                                                      v1::RemoveRegionResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::ReleaseLease(grpc::CallbackServerContext* context,
                                                      const v1::ReleaseLeaseRequest* request,
                                                      v1::ReleaseLeaseResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::SetObstacle(grpc::CallbackServerContext* context,
                                                     const v1::SetObstacleRequest* request,
                                                     v1::SetObstacleResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::AddRegion(grpc::CallbackServerContext* context,
                                                   const v1::AddRegionRequest* request,
                                                   v1::AddRegionResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::AddRope(grpc::CallbackServerContext* context,
                                                 const v1::AddRopeRequest* request,
                                                 v1::AddRopeResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::RemoveRope(grpc::CallbackServerContext* context,
                                                    const v1::RemoveRopeRequest* request,
                                                    v1::RemoveRopeResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::TakeLease(grpc::CallbackServerContext* context,
                                                   const v1::TakeLeaseRequest* request,
                                                   v1::TakeLeaseResponse* response) {
  return Command(context, registry_, request, response);
}

grpc::ServerUnaryReactor* OneSeaService::ListBodies(grpc::CallbackServerContext* context,
                                                    const v1::ListBodiesRequest* request,
                                                    v1::ListBodiesResponse* response) {
  const absl::StatusOr<std::shared_ptr<SessionLoop>> session = registry_.Find(request->session());
  if (!session.ok()) return Answer(context, session.status());
  const SessionView view = (*session)->View();
  response->set_tick(view.tick);
  for (const wire::BodyView& body : view.world->bodies) {
    v1::ListBodiesResponse::Body* out = response->add_bodies();
    wire::ToProto(*body.info, out->mutable_info());
    const wire::BodyState& state = body.state;
    wire::ToProto(wire::Kinematics{state.position_m, state.turn, state.velocity_m_per_s,
                                   state.spin_rad_per_s},
                  out->mutable_state());
    out->set_driver((*session)->HolderOf(state.id));
  }
  if (view.world->ropes != nullptr) {
    for (const wire::TiedRope& rope : *view.world->ropes)
      wire::ToProto(rope, response->add_ropes());
  }
  return Answer(context, absl::OkStatus());
}

grpc::ServerUnaryReactor* OneSeaService::ListPresets(grpc::CallbackServerContext* context,
                                                     const v1::ListPresetsRequest* /*request*/,
                                                     v1::ListPresetsResponse* response) {
  for (const world::BodyPresetEntry& entry : world::BodyPresets()) {
    const absl::StatusOr<wire::BodyDescription> body = world::BodyPreset(entry.name);
    ONESEA_CHECK(body.ok()) << body.status().ToString();
    v1::ListPresetsResponse::Preset* out = response->add_presets();
    out->set_name(entry.name.data(), entry.name.size());
    out->set_summary(entry.summary.data(), entry.summary.size());
    wire::ToProto(*body, out->mutable_body());
    if (body->shape->kind == wire::ShapeKind::kMesh) {
      out->mutable_body()->mutable_shape()->mutable_mesh()->clear_file();
    }
  }
  return Answer(context, absl::OkStatus());
}

grpc::ServerUnaryReactor* OneSeaService::GetMesh(grpc::CallbackServerContext* context,
                                                 const v1::GetMeshRequest* request,
                                                 v1::GetMeshResponse* response) {
  const absl::StatusOr<std::shared_ptr<SessionLoop>> session = registry_.Find(request->session());
  if (!session.ok()) return Answer(context, session.status());
  const std::shared_ptr<const std::string> mesh = (*session)->FindMesh(request->hash());
  if (mesh == nullptr) {
    return Answer(context, absl::NotFoundError("hash: no body of the session has this mesh"));
  }
  response->set_file(*mesh);
  return Answer(context, absl::OkStatus());
}

grpc::ServerWriteReactor<v1::GetTerrainResponse>* OneSeaService::GetTerrain(
    grpc::CallbackServerContext* /*context*/, const v1::GetTerrainRequest* request) {
  const absl::StatusOr<std::shared_ptr<SessionLoop>> session = registry_.Find(request->session());
  if (!session.ok()) return new TerrainWriter(session.status());
  if ((*session)->terrain() == nullptr) {
    return new TerrainWriter(
        absl::NotFoundError(absl::StrCat("session: '", (*session)->name(), "' has no terrain")));
  }
  return new TerrainWriter((*session)->terrain());
}

grpc::ServerBidiReactor<v1::StreamBodyPosesRequest, v1::StreamBodyPosesResponse>*
OneSeaService::StreamBodyPoses(grpc::CallbackServerContext* /*context*/) {
  return new StreamPosesReactor(registry_);
}

grpc::ServerWriteReactor<v1::StreamInstrumentsResponse>* OneSeaService::StreamInstruments(
    grpc::CallbackServerContext* /*context*/, const v1::StreamInstrumentsRequest* request) {
  auto* reactor = new StreamInstrumentsReactor(registry_, desk_, instruments_);
  StreamInstrumentsReactor::Begin(reactor, *request);
  return reactor;
}

}  // namespace onesea::server
