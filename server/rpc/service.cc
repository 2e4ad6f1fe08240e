#include "server/rpc/service.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <utility>

#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/wire/bounds.h"
#include "common/wire/proto_query.h"
#include "common/wire/proto_sea.h"
#include "common/wire/proto_session.h"
#include "server/rpc/answer.h"
#include "server/rpc/status_map.h"
#include "server/rpc/step_session.h"
#include "server/rpc/stream_queries.h"

namespace onesea::server {
namespace {

// Runs `work` on `worker` and answers with its status.
grpc::ServerUnaryReactor* AnswerLater(grpc::CallbackServerContext* context, Worker& worker,
                                      std::function<absl::Status()> work) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  const absl::Status posted =
      worker.Post([reactor, work = std::move(work)] { reactor->Finish(ToGrpc(work())); });
  if (!posted.ok()) reactor->Finish(ToGrpc(posted));
  return reactor;
}

absl::Status Create(const v1::CreateSessionRequest& request, Registry& registry,
                    v1::CreateSessionResponse* response) {
  ONESEA_ASSIGN_OR_RETURN(SessionSpec spec, wire::FromProto(request.spec()));
  ONESEA_ASSIGN_OR_RETURN(const std::shared_ptr<SessionLoop> session,
                          registry.Create(std::move(spec)));
  wire::ToProto(session->Info(), response->mutable_session());
  spdlog::info("session {}: created over the network", session->name());
  return absl::OkStatus();
}

absl::Status Change(const v1::ChangeWeatherRequest& request, Registry& registry,
                    v1::ChangeWeatherResponse* response) {
  ONESEA_ASSIGN_OR_RETURN(const std::shared_ptr<SessionLoop> session,
                          registry.Find(request.session()));
  ONESEA_RETURN_IF_ERROR(wire::CheckReal("", "over_s", request.over_s(), 0.0, kWeatherSpanMaxS));
  WeatherRequest weather;
  ONESEA_ASSIGN_OR_RETURN(weather.sea, wire::FromProto(request.sea(), "sea."));
  weather.span_ticks = std::llround(request.over_s() * session->tick_rate_hz());
  if (request.has_start_tick()) weather.start_tick = request.start_tick();
  ONESEA_ASSIGN_OR_RETURN(const WeatherSpan span, session->ChangeWeather(weather));
  response->set_start_tick(span.start_tick);
  response->set_end_tick(span.end_tick);
  spdlog::info("session {}: weather turns to '{}' from tick {} to {}", session->name(),
               weather.sea.name, span.start_tick, span.end_tick);
  return absl::OkStatus();
}

}  // namespace

grpc::ServerUnaryReactor* OneSeaService::ListSessions(grpc::CallbackServerContext* context,
                                                      const v1::ListSessionsRequest* /*request*/,
                                                      v1::ListSessionsResponse* response) {
  for (const std::shared_ptr<SessionLoop>& session : registry_.List()) {
    wire::ToProto(session->Info(), response->add_sessions());
  }
  return Answer(context, absl::OkStatus());
}

grpc::ServerUnaryReactor* OneSeaService::CreateSession(grpc::CallbackServerContext* context,
                                                       const v1::CreateSessionRequest* request,
                                                       v1::CreateSessionResponse* response) {
  return AnswerLater(context, builder_,
                     [=, this] { return Create(*request, registry_, response); });
}

grpc::ServerUnaryReactor* OneSeaService::DeleteSession(grpc::CallbackServerContext* context,
                                                       const v1::DeleteSessionRequest* request,
                                                       v1::DeleteSessionResponse* /*response*/) {
  const absl::Status status = registry_.Delete(request->session(), "the session was deleted");
  if (status.ok()) spdlog::info("session {}: deleted over the network", request->session());
  desk_.Prune();
  return Answer(context, status);
}

grpc::ServerUnaryReactor* OneSeaService::QueryPoints(grpc::CallbackServerContext* context,
                                                     const v1::QueryPointsRequest* request,
                                                     v1::QueryPointsResponse* response) {
  absl::StatusOr<wire::QueryRequest> query = wire::FromProto(*request);
  if (!query.ok()) return Answer(context, query.status());
  const auto work = [this, response](const wire::QueryRequest& asked) -> absl::Status {
    ONESEA_ASSIGN_OR_RETURN(const wire::QueryAnswer answer, desk_.Answer(asked));
    ToProto(answer, response);
    return absl::OkStatus();
  };
  if (!QueryDesk::IsHeavy(*query)) return Answer(context, work(*query));
  return AnswerLater(context, queries_, [work, asked = *std::move(query)] { return work(asked); });
}

grpc::ServerBidiReactor<v1::QueryPointsRequest, v1::QueryPointsResponse>*
OneSeaService::StreamQueries(grpc::CallbackServerContext* /*context*/) {
  return new StreamQueriesReactor(desk_, queries_);
}

grpc::ServerUnaryReactor* OneSeaService::ChangeWeather(grpc::CallbackServerContext* context,
                                                       const v1::ChangeWeatherRequest* request,
                                                       v1::ChangeWeatherResponse* response) {
  return AnswerLater(context, builder_,
                     [=, this] { return Change(*request, registry_, response); });
}

grpc::ServerUnaryReactor* OneSeaService::HoldSession(grpc::CallbackServerContext* context,
                                                     const v1::HoldSessionRequest* request,
                                                     v1::HoldSessionResponse* response) {
  const auto work = [&]() -> absl::Status {
    ONESEA_ASSIGN_OR_RETURN(const auto session, registry_.Find(request->session()));
    ONESEA_ASSIGN_OR_RETURN(const Tick tick, session->Hold());
    response->set_tick(tick);
    return absl::OkStatus();
  };
  return Answer(context, work());
}

grpc::ServerUnaryReactor* OneSeaService::ResumeSession(grpc::CallbackServerContext* context,
                                                       const v1::ResumeSessionRequest* request,
                                                       v1::ResumeSessionResponse* response) {
  const auto work = [&]() -> absl::Status {
    ONESEA_ASSIGN_OR_RETURN(const auto session, registry_.Find(request->session()));
    ONESEA_ASSIGN_OR_RETURN(const Tick tick, session->Resume());
    response->set_tick(tick);
    return absl::OkStatus();
  };
  return Answer(context, work());
}

grpc::ServerUnaryReactor* OneSeaService::SetSpeed(grpc::CallbackServerContext* context,
                                                  const v1::SetSpeedRequest* request,
                                                  v1::SetSpeedResponse* response) {
  const auto work = [&]() -> absl::Status {
    ONESEA_ASSIGN_OR_RETURN(const auto session, registry_.Find(request->session()));
    ONESEA_RETURN_IF_ERROR(session->SetSpeed(request->speed()));
    response->set_speed(request->speed());
    return absl::OkStatus();
  };
  return Answer(context, work());
}

grpc::ServerUnaryReactor* OneSeaService::StepSession(grpc::CallbackServerContext* /*context*/,
                                                     const v1::StepSessionRequest* request,
                                                     v1::StepSessionResponse* response) {
  auto* reactor = new StepReactor(request, response, desk_, queries_);
  StepReactor::Begin(reactor, registry_);
  return reactor;
}

grpc::ServerUnaryReactor* OneSeaService::SyncClock(grpc::CallbackServerContext* context,
                                                   const v1::SyncClockRequest* /*request*/,
                                                   v1::SyncClockResponse* response) {
  response->set_server_monotonic_ns(clock_.MonotonicNs());
  return Answer(context, absl::OkStatus());
}

grpc::ServerUnaryReactor* OneSeaService::GetStateHash(grpc::CallbackServerContext* context,
                                                      const v1::GetStateHashRequest* request,
                                                      v1::GetStateHashResponse* response) {
  const absl::StatusOr<std::shared_ptr<SessionLoop>> session = registry_.Find(request->session());
  if (!session.ok()) return Answer(context, session.status());
  const StateHashes hashes = (*session)->Hashes();
  response->set_tick(hashes.tick);
  response->set_state_hash(hashes.state_hash);
  response->set_component_hash(hashes.component_hash);
  return Answer(context, absl::OkStatus());
}

}  // namespace onesea::server
