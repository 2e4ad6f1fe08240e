#include "client/net/remote_server.h"

#include <grpcpp/channel.h>

#include <utility>

#include "client/net/remote_server_impl.h"
#include "common/base/check.h"
#include "common/wire/proto_query.h"
#include "common/wire/proto_sea.h"
#include "common/wire/proto_session.h"

namespace onesea::client {
namespace {

// A single call has no use for an answer that carries an error or has the wrong sizes.
absl::StatusOr<wire::QueryAnswer> AnswerTo(const wire::QueryRequest& request,
                                           const v1::QueryPointsResponse& response) {
  ONESEA_ASSIGN_OR_RETURN(wire::QueryAnswer answer, wire::FromProto(response));
  ONESEA_RETURN_IF_ERROR(answer.status);
  ONESEA_RETURN_IF_ERROR(wire::CheckAnswers(request, answer));
  return answer;
}

}  // namespace

RemoteServer::RemoteServer(const ChannelFactory& connect, std::int64_t timeout_ns)
    : impl_(std::make_unique<Impl>(Impl{v1::OneSea::NewStub(connect()), timeout_ns})) {}
RemoteServer::~RemoteServer() = default;

absl::StatusOr<std::vector<SessionInfo>> RemoteServer::ListSessions() {
  v1::ListSessionsResponse response;
  ONESEA_RETURN_IF_ERROR(
      impl_->Call(&v1::OneSea::Stub::ListSessions, v1::ListSessionsRequest(), &response));
  std::vector<SessionInfo> sessions;
  for (const v1::SessionInfo& proto : response.sessions()) {
    ONESEA_ASSIGN_OR_RETURN(SessionInfo info, wire::FromProto(proto));
    sessions.push_back(std::move(info));
  }
  return sessions;
}

absl::StatusOr<SessionInfo> RemoteServer::CreateSession(const SessionSpec& spec) {
  v1::CreateSessionRequest request;
  wire::ToProto(spec, request.mutable_spec());
  v1::CreateSessionResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::CreateSession, request, &response));
  return wire::FromProto(response.session());
}

absl::Status RemoteServer::DeleteSession(const std::string& session) {
  v1::DeleteSessionRequest request;
  request.set_session(session);
  v1::DeleteSessionResponse response;
  return impl_->Call(&v1::OneSea::Stub::DeleteSession, request, &response);
}

absl::StatusOr<wire::QueryAnswer> RemoteServer::QueryPoints(const wire::QueryRequest& request) {
  v1::QueryPointsRequest proto;
  wire::ToProto(request, &proto);
  v1::QueryPointsResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::QueryPoints, proto, &response));
  return AnswerTo(request, response);
}

absl::StatusOr<WeatherSpan> RemoteServer::ChangeWeather(const std::string& session,
                                                        const WeatherChange& change) {
  v1::ChangeWeatherRequest request;
  request.set_session(session);
  wire::ToProto(change.sea, request.mutable_sea());
  request.set_over_s(change.over_s);
  if (change.start_tick.has_value()) request.set_start_tick(*change.start_tick);
  v1::ChangeWeatherResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::ChangeWeather, request, &response));
  return WeatherSpan{response.start_tick(), response.end_tick()};
}

absl::StatusOr<Tick> RemoteServer::Hold(const std::string& session) {
  v1::HoldSessionRequest request;
  request.set_session(session);
  v1::HoldSessionResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::HoldSession, request, &response));
  return response.tick();
}

absl::StatusOr<Tick> RemoteServer::Resume(const std::string& session) {
  v1::ResumeSessionRequest request;
  request.set_session(session);
  v1::ResumeSessionResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::ResumeSession, request, &response));
  return response.tick();
}

absl::StatusOr<double> RemoteServer::SetSpeed(const std::string& session, double speed) {
  v1::SetSpeedRequest request;
  request.set_session(session);
  request.set_speed(speed);
  v1::SetSpeedResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::SetSpeed, request, &response));
  return response.speed();
}

absl::StatusOr<StepAnswer> RemoteServer::Step(const std::string& session,
                                              const StepOptions& options) {
  v1::StepSessionRequest request;
  request.set_session(session);
  request.set_ticks(options.ticks);
  request.set_participant(options.participant);
  if (options.query.has_value()) wire::ToProto(*options.query, request.mutable_query());
  v1::StepSessionResponse response;
  ONESEA_RETURN_IF_ERROR(
      impl_->Call(&v1::OneSea::Stub::StepSession, request, &response, options.timeout_ns));
  StepAnswer answer{.tick = response.tick(), .state_hash = response.state_hash(), .query = {}};
  if (options.query.has_value() && response.has_query()) {
    answer.query = wire::OrError(AnswerTo(*options.query, response.query()), options.query->id);
  }
  return answer;
}

absl::StatusOr<StateHashes> RemoteServer::GetStateHash(const std::string& session) {
  v1::GetStateHashRequest request;
  request.set_session(session);
  v1::GetStateHashResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::GetStateHash, request, &response));
  return StateHashes{response.tick(), response.state_hash(), response.component_hash()};
}

absl::StatusOr<std::int64_t> RemoteServer::ServerMonotonicNs() {
  v1::SyncClockResponse response;
  ONESEA_RETURN_IF_ERROR(
      impl_->Call(&v1::OneSea::Stub::SyncClock, v1::SyncClockRequest(), &response));
  return response.server_monotonic_ns();
}

struct QueryStream::Impl {
  std::shared_ptr<v1::OneSea::Stub> stub;
  grpc::ClientContext context;
  v1::QueryPointsRequest request;
  v1::QueryPointsResponse response;
  std::unique_ptr<grpc::ClientReaderWriter<v1::QueryPointsRequest, v1::QueryPointsResponse>> stream;
};

QueryStream::QueryStream(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

QueryStream::~QueryStream() {
  impl_->context.TryCancel();
  impl_->stream->Finish();
}

absl::Status QueryStream::Send(const wire::QueryRequest& request) {
  impl_->request.Clear();
  wire::ToProto(request, &impl_->request);
  if (impl_->stream->Write(impl_->request)) return absl::OkStatus();
  return absl::UnavailableError("the query stream is over");
}

absl::StatusOr<wire::QueryAnswer> QueryStream::Receive() {
  if (!impl_->stream->Read(&impl_->response)) {
    return absl::UnavailableError("the server ended the query stream");
  }
  return wire::FromProto(impl_->response);
}

std::unique_ptr<QueryStream> RemoteServer::StreamQueries() {
  auto impl = std::make_unique<QueryStream::Impl>();
  impl->stub = impl_->stub;
  impl->stream = impl_->stub->StreamQueries(&impl->context);
  return std::make_unique<QueryStream>(std::move(impl));
}

}  // namespace onesea::client
