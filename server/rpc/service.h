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

 private:
  Registry& registry_;
  const Clock& clock_;
  QueryDesk desk_;
  Worker builder_;  // components of new sessions and new weather
  Worker queries_;  // many points
};

}  // namespace onesea::server
