#pragma once

#include <functional>

#include "common/base/clock.h"
#include "server/rpc/methods.h"
#include "server/rpc/query_desk.h"
#include "server/rpc/worker.h"
#include "server/session/registry.h"

/// The methods of onesea.v1.OneSea but for Watch and WatchStamps: each translates, asks the
/// registry, a session or the query desk, and translates back. Nothing here holds a gRPC thread for
/// long; what builds components goes to a worker.
namespace onesea::server {

class OneSeaService final : public OneSeaMethods {
 public:
  OneSeaService(Registry& registry, const Clock& clock, sea::TransformKind transform)
      : registry_(registry), clock_(clock), desk_(registry, clock, transform) {}

  grpc::ServerUnaryReactor* ListSessions(grpc::CallbackServerContext* context,
                                         const v1::ListSessionsRequest* request,
                                         v1::ListSessionsResponse* response) override;
  grpc::ServerUnaryReactor* CreateSession(grpc::CallbackServerContext* context,
                                          const v1::CreateSessionRequest* request,
                                          v1::CreateSessionResponse* response) override;
  grpc::ServerUnaryReactor* DeleteSession(grpc::CallbackServerContext* context,
                                          const v1::DeleteSessionRequest* request,
                                          v1::DeleteSessionResponse* response) override;
  grpc::ServerUnaryReactor* QueryPoints(grpc::CallbackServerContext* context,
                                        const v1::QueryPointsRequest* request,
                                        v1::QueryPointsResponse* response) override;
  grpc::ServerBidiReactor<v1::QueryPointsRequest, v1::QueryPointsResponse>* StreamQueries(
      grpc::CallbackServerContext* context) override;
  grpc::ServerUnaryReactor* ChangeWeather(grpc::CallbackServerContext* context,
                                          const v1::ChangeWeatherRequest* request,
                                          v1::ChangeWeatherResponse* response) override;
  grpc::ServerUnaryReactor* HoldSession(grpc::CallbackServerContext* context,
                                        const v1::HoldSessionRequest* request,
                                        v1::HoldSessionResponse* response) override;
  grpc::ServerUnaryReactor* ResumeSession(grpc::CallbackServerContext* context,
                                          const v1::ResumeSessionRequest* request,
                                          v1::ResumeSessionResponse* response) override;
  grpc::ServerUnaryReactor* SetSpeed(grpc::CallbackServerContext* context,
                                     const v1::SetSpeedRequest* request,
                                     v1::SetSpeedResponse* response) override;
  grpc::ServerUnaryReactor* StepSession(grpc::CallbackServerContext* context,
                                        const v1::StepSessionRequest* request,
                                        v1::StepSessionResponse* response) override;
  grpc::ServerUnaryReactor* SyncClock(grpc::CallbackServerContext* context,
                                      const v1::SyncClockRequest* request,
                                      v1::SyncClockResponse* response) override;
  grpc::ServerUnaryReactor* GetStateHash(grpc::CallbackServerContext* context,
                                         const v1::GetStateHashRequest* request,
                                         v1::GetStateHashResponse* response) override;

  // Of the world: service_world.cc.
  grpc::ServerUnaryReactor* SpawnBody(grpc::CallbackServerContext* context,
                                      const v1::SpawnBodyRequest* request,
                                      v1::SpawnBodyResponse* response) override;
  grpc::ServerUnaryReactor* RemoveBody(grpc::CallbackServerContext* context,
                                       const v1::RemoveBodyRequest* request,
                                       v1::RemoveBodyResponse* response) override;
  grpc::ServerUnaryReactor* DriveBody(grpc::CallbackServerContext* context,
                                      const v1::DriveBodyRequest* request,
                                      v1::DriveBodyResponse* response) override;
  grpc::ServerUnaryReactor* ApplyImpulse(grpc::CallbackServerContext* context,
                                         const v1::ApplyImpulseRequest* request,
                                         v1::ApplyImpulseResponse* response) override;
  grpc::ServerUnaryReactor* Explode(grpc::CallbackServerContext* context,
                                    const v1::ExplodeRequest* request,
                                    v1::ExplodeResponse* response) override;
  grpc::ServerUnaryReactor* SetObstacle(grpc::CallbackServerContext* context,
                                        const v1::SetObstacleRequest* request,
                                        v1::SetObstacleResponse* response) override;
  grpc::ServerUnaryReactor* RemoveObstacle(grpc::CallbackServerContext* context,
                                           const v1::RemoveObstacleRequest* request,
                                           v1::RemoveObstacleResponse* response) override;
  grpc::ServerUnaryReactor* AddRegion(grpc::CallbackServerContext* context,
                                      const v1::AddRegionRequest* request,
                                      v1::AddRegionResponse* response) override;
  grpc::ServerUnaryReactor* RemoveRegion(grpc::CallbackServerContext* context,
                                         const v1::RemoveRegionRequest* request,
                                         v1::RemoveRegionResponse* response) override;
  grpc::ServerUnaryReactor* AddRope(grpc::CallbackServerContext* context,
                                    const v1::AddRopeRequest* request,
                                    v1::AddRopeResponse* response) override;
  grpc::ServerUnaryReactor* RemoveRope(grpc::CallbackServerContext* context,
                                       const v1::RemoveRopeRequest* request,
                                       v1::RemoveRopeResponse* response) override;
  grpc::ServerUnaryReactor* TakeLease(grpc::CallbackServerContext* context,
                                      const v1::TakeLeaseRequest* request,
                                      v1::TakeLeaseResponse* response) override;
  grpc::ServerUnaryReactor* ReleaseLease(grpc::CallbackServerContext* context,
                                         const v1::ReleaseLeaseRequest* request,
                                         v1::ReleaseLeaseResponse* response) override;
  grpc::ServerUnaryReactor* ListBodies(grpc::CallbackServerContext* context,
                                       const v1::ListBodiesRequest* request,
                                       v1::ListBodiesResponse* response) override;
  grpc::ServerUnaryReactor* ListPresets(grpc::CallbackServerContext* context,
                                        const v1::ListPresetsRequest* request,
                                        v1::ListPresetsResponse* response) override;
  grpc::ServerUnaryReactor* GetMesh(grpc::CallbackServerContext* context,
                                    const v1::GetMeshRequest* request,
                                    v1::GetMeshResponse* response) override;
  grpc::ServerWriteReactor<v1::GetTerrainResponse>* GetTerrain(
      grpc::CallbackServerContext* context, const v1::GetTerrainRequest* request) override;
  grpc::ServerBidiReactor<v1::StreamBodyPosesRequest, v1::StreamBodyPosesResponse>* StreamBodyPoses(
      grpc::CallbackServerContext* context) override;
  grpc::ServerWriteReactor<v1::StreamInstrumentsResponse>* StreamInstruments(
      grpc::CallbackServerContext* context, const v1::StreamInstrumentsRequest* request) override;

 private:
  Registry& registry_;
  const Clock& clock_;
  QueryDesk desk_;
  Worker builder_;  // components of new sessions and new weather
  Worker queries_;  // many points
  Worker instruments_;
};

}  // namespace onesea::server
