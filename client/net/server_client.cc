#include "client/net/server_client.h"

#include <grpc/support/time.h>
#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include <utility>

#include "common/base/check.h"
#include "common/wire/proto_query.h"
#include "common/wire/proto_sea.h"
#include "common/wire/proto_session.h"
#include "onesea/v1/onesea.grpc.pb.h"

namespace onesea::client {
namespace {

constexpr double kStepTimeoutS = 3700.0;  // above the longest barrier deadline

}  // namespace

struct ServerClient::Impl {
  std::unique_ptr<v1::OneSea::Stub> stub;
  std::string address;
  double timeout_s;

  // One unary call: `method` is a member of the stub.
  template <typename Request, typename Response>
  absl::Status Call(grpc::Status (v1::OneSea::Stub::*method)(grpc::ClientContext*, const Request&,
                                                             Response*),
                    const Request& request, Response* response, double timeout) {
    grpc::ClientContext context;
    context.set_deadline(
        gpr_time_add(gpr_now(GPR_CLOCK_MONOTONIC),
                     gpr_time_from_millis(static_cast<std::int64_t>(1e3 * timeout), GPR_TIMESPAN)));
    return ToAbsl((stub.get()->*method)(&context, request, response), address);
  }
  template <typename Request, typename Response>
  absl::Status Call(grpc::Status (v1::OneSea::Stub::*method)(grpc::ClientContext*, const Request&,
                                                             Response*),
                    const Request& request, Response* response) {
    return Call(method, request, response, timeout_s);
  }
};

ServerClient::ServerClient(const std::string& address, double timeout_s)
    : ServerClient(MakeChannel(address), address, timeout_s) {}

ServerClient::ServerClient(std::shared_ptr<grpc::Channel> channel, std::string address,
                           double timeout_s)
    : address_(std::move(address)),
      impl_(new Impl{v1::OneSea::NewStub(std::move(channel)), address_, timeout_s}) {}

ServerClient::~ServerClient() = default;

absl::StatusOr<std::vector<SessionInfo>> ServerClient::ListSessions() {
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

absl::StatusOr<SessionInfo> ServerClient::CreateSession(const SessionSpec& spec) {
  v1::CreateSessionRequest request;
  wire::ToProto(spec, request.mutable_spec());
  v1::CreateSessionResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::CreateSession, request, &response));
  return wire::FromProto(response.session());
}

absl::Status ServerClient::DeleteSession(const std::string& session) {
  v1::DeleteSessionRequest request;
  request.set_session(session);
  v1::DeleteSessionResponse response;
  return impl_->Call(&v1::OneSea::Stub::DeleteSession, request, &response);
}

absl::StatusOr<wire::QueryAnswer> ServerClient::QueryPoints(const wire::QueryRequest& request) {
  v1::QueryPointsRequest proto;
  wire::ToProto(request, &proto);
  v1::QueryPointsResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::QueryPoints, proto, &response));
  return wire::FromProto(response);
}

absl::StatusOr<WeatherChange> ServerClient::ChangeWeather(const std::string& session,
                                                          const sea::SeaState& sea, double over_s) {
  v1::ChangeWeatherRequest request;
  request.set_session(session);
  wire::ToProto(sea, request.mutable_sea());
  request.set_over_s(over_s);
  v1::ChangeWeatherResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::ChangeWeather, request, &response));
  return WeatherChange{response.start_tick(), response.end_tick()};
}

absl::StatusOr<Tick> ServerClient::HoldSession(const std::string& session) {
  v1::HoldSessionRequest request;
  request.set_session(session);
  v1::HoldSessionResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::HoldSession, request, &response));
  return response.tick();
}

absl::StatusOr<Tick> ServerClient::ResumeSession(const std::string& session) {
  v1::ResumeSessionRequest request;
  request.set_session(session);
  v1::ResumeSessionResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::ResumeSession, request, &response));
  return response.tick();
}

absl::StatusOr<double> ServerClient::SetSpeed(const std::string& session, double speed) {
  v1::SetSpeedRequest request;
  request.set_session(session);
  request.set_speed(speed);
  v1::SetSpeedResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::SetSpeed, request, &response));
  return response.speed();
}

absl::StatusOr<StepAnswer> ServerClient::StepSession(const std::string& session, std::int64_t ticks,
                                                     const std::string& participant) {
  v1::StepSessionRequest request;
  request.set_session(session);
  request.set_ticks(ticks);
  request.set_participant(participant);
  v1::StepSessionResponse response;
  ONESEA_RETURN_IF_ERROR(
      impl_->Call(&v1::OneSea::Stub::StepSession, request, &response, kStepTimeoutS));
  return StepAnswer{response.tick(), response.state_hash()};
}

absl::StatusOr<StateHash> ServerClient::GetStateHash(const std::string& session) {
  v1::GetStateHashRequest request;
  request.set_session(session);
  v1::GetStateHashResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::GetStateHash, request, &response));
  return StateHash{response.tick(), response.state_hash(), response.component_hash()};
}

struct QueryStream::Impl {
  std::unique_ptr<v1::OneSea::Stub> stub;
  std::string address;
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReaderWriter<v1::QueryPointsRequest, v1::QueryPointsResponse>> stream;

  absl::Status Broken() const {
    return absl::UnavailableError("the query stream to " + address + " ended; open a new one");
  }
};

QueryStream::QueryStream(std::shared_ptr<grpc::Channel> channel, std::string address)
    : impl_(new Impl{.stub = v1::OneSea::NewStub(std::move(channel)),
                     .address = std::move(address),
                     .context = {},
                     .stream = nullptr}) {
  impl_->stream = impl_->stub->StreamQueries(&impl_->context);
}

QueryStream::~QueryStream() {
  impl_->context.TryCancel();
  impl_->stream->Finish();
}

absl::Status QueryStream::Send(const wire::QueryRequest& request) {
  v1::QueryPointsRequest proto;
  wire::ToProto(request, &proto);
  return impl_->stream->Write(proto) ? absl::OkStatus() : impl_->Broken();
}

absl::StatusOr<wire::QueryAnswer> QueryStream::Receive() {
  v1::QueryPointsResponse response;
  if (!impl_->stream->Read(&response)) return impl_->Broken();
  return wire::FromProto(response);
}

}  // namespace onesea::client
