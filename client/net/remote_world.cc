// RemoteServer's calls on the world of a session.

#include <utility>

#include "client/net/remote_server_impl.h"
#include "common/base/check.h"
#include "common/wire/proto_body.h"
#include "common/wire/proto_world.h"

namespace onesea::client {
namespace {

template <typename Request, typename Response>
using Method = grpc::Status (v1::OneSea::Stub::*)(grpc::ClientContext*, const Request&, Response*);

Method<v1::SpawnBodyRequest, v1::SpawnBodyResponse> MethodOf(const wire::SpawnBody&) {
  return &v1::OneSea::Stub::SpawnBody;
}
Method<v1::RemoveBodyRequest, v1::RemoveBodyResponse> MethodOf(const wire::RemoveBody&) {
  return &v1::OneSea::Stub::RemoveBody;
}
Method<v1::DriveBodyRequest, v1::DriveBodyResponse> MethodOf(const wire::DriveBody&) {
  return &v1::OneSea::Stub::DriveBody;
}
Method<v1::ApplyImpulseRequest, v1::ApplyImpulseResponse> MethodOf(const wire::ApplyImpulse&) {
  return &v1::OneSea::Stub::ApplyImpulse;
}
Method<v1::ExplodeRequest, v1::ExplodeResponse> MethodOf(const wire::Explode&) {
  return &v1::OneSea::Stub::Explode;
}
Method<v1::SetObstacleRequest, v1::SetObstacleResponse> MethodOf(const wire::SetObstacle&) {
  return &v1::OneSea::Stub::SetObstacle;
}
Method<v1::RemoveObstacleRequest, v1::RemoveObstacleResponse> MethodOf(
    const wire::RemoveObstacle&) {
  return &v1::OneSea::Stub::RemoveObstacle;
}
Method<v1::AddRegionRequest, v1::AddRegionResponse> MethodOf(const wire::AddRegion&) {
  return &v1::OneSea::Stub::AddRegion;
}
Method<v1::RemoveRegionRequest, v1::RemoveRegionResponse> MethodOf(const wire::RemoveRegion&) {
  return &v1::OneSea::Stub::RemoveRegion;
}
Method<v1::AddRopeRequest, v1::AddRopeResponse> MethodOf(const wire::AddRope&) {
  return &v1::OneSea::Stub::AddRope;
}
Method<v1::RemoveRopeRequest, v1::RemoveRopeResponse> MethodOf(const wire::RemoveRope&) {
  return &v1::OneSea::Stub::RemoveRope;
}
Method<v1::TakeLeaseRequest, v1::TakeLeaseResponse> MethodOf(const wire::TakeLease&) {
  return &v1::OneSea::Stub::TakeLease;
}
Method<v1::ReleaseLeaseRequest, v1::ReleaseLeaseResponse> MethodOf(const wire::ReleaseLease&) {
  return &v1::OneSea::Stub::ReleaseLease;
}

template <typename Response>
absl::StatusOr<CommandAnswer> AnswerOf(const Response& response) {
  CommandAnswer answer;
  answer.tick = response.tick();
  if constexpr (requires { response.body_id(); }) answer.id = response.body_id();
  if constexpr (requires { response.obstacle_id(); }) answer.id = response.obstacle_id();
  if constexpr (requires { response.region_id(); }) answer.id = response.region_id();
  if constexpr (requires { response.rope_id(); }) answer.id = response.rope_id();
  if constexpr (requires { response.lease(); }) answer.lease = response.lease();
  if constexpr (requires { response.body(); }) {
    if (!response.has_body()) return answer;
    ONESEA_ASSIGN_OR_RETURN(answer.body, wire::FromProto(response.body(), ""));
    answer.body->preset.clear();  // filled in: shape and mass must be there
    ONESEA_RETURN_IF_ERROR(wire::ValidateBodyDescription("body.", *answer.body));
  }
  return answer;
}

}  // namespace

absl::StatusOr<CommandAnswer> RemoteServer::Command(const wire::CommandHeader& header,
                                                    const wire::WorldCommand& command) {
  const auto call = [&]<typename Request, typename Response>(
                        const auto& one,
                        Method<Request, Response> method) -> absl::StatusOr<CommandAnswer> {
    Request request;
    wire::ToProto(header, request.mutable_command());
    wire::ToProto(one, &request);
    Response response;
    ONESEA_RETURN_IF_ERROR(impl_->Call(method, request, &response));
    return AnswerOf(response);
  };
  return std::visit([&](const auto& one) { return call(one, MethodOf(one)); }, command);
}

absl::StatusOr<std::string> RemoteServer::GetMesh(const std::string& session, std::uint64_t hash) {
  v1::GetMeshRequest request;
  request.set_session(session);
  request.set_hash(hash);
  v1::GetMeshResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::GetMesh, request, &response));
  return std::move(*response.mutable_file());
}

absl::StatusOr<BodyList> RemoteServer::ListBodies(const std::string& session) {
  v1::ListBodiesRequest request;
  request.set_session(session);
  v1::ListBodiesResponse response;
  ONESEA_RETURN_IF_ERROR(impl_->Call(&v1::OneSea::Stub::ListBodies, request, &response));
  BodyList list;
  list.tick = response.tick();
  for (const v1::ListBodiesResponse::Body& body : response.bodies()) {
    ListedBody& listed = list.bodies.emplace_back();
    ONESEA_ASSIGN_OR_RETURN(listed.info, wire::FromProto(body.info()));
    listed.state = wire::FromProto(body.state());
    listed.driver = body.driver();
  }
  ONESEA_ASSIGN_OR_RETURN(list.ropes, wire::RopesFromProto("", response.ropes()));
  return list;
}

struct InstrumentStream::Impl {
  std::shared_ptr<v1::OneSea::Stub> stub;
  grpc::ClientContext context;
  v1::StreamInstrumentsResponse response;
  std::unique_ptr<grpc::ClientReader<v1::StreamInstrumentsResponse>> stream;
};

InstrumentStream::InstrumentStream(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

InstrumentStream::~InstrumentStream() {
  if (impl_->stream == nullptr) return;
  impl_->context.TryCancel();
  impl_->stream->Finish();
}

absl::StatusOr<InstrumentReading> InstrumentStream::Receive() {
  if (impl_->stream == nullptr) return absl::UnavailableError("the stream is over");
  if (!impl_->stream->Read(&impl_->response)) {
    const auto stream = std::move(impl_->stream);
    ONESEA_RETURN_IF_ERROR(FromGrpc(stream->Finish()));
    return absl::UnavailableError("the server ended the stream of readings");
  }
  const v1::StreamInstrumentsResponse& response = impl_->response;
  return InstrumentReading{.tick = response.tick(),
                           .values = {response.values().begin(), response.values().end()},
                           .skipped_count = response.skipped_count()};
}

std::unique_ptr<InstrumentStream> RemoteServer::StreamInstruments(
    const wire::InstrumentRequest& request) {
  auto impl = std::make_unique<InstrumentStream::Impl>();
  impl->stub = impl_->stub;
  v1::StreamInstrumentsRequest proto;
  wire::ToProto(request, &proto);
  impl->stream = impl_->stub->StreamInstruments(&impl->context, proto);
  return std::make_unique<InstrumentStream>(std::move(impl));
}

absl::StatusOr<std::vector<ListedPreset>> RemoteServer::ListPresets() {
  v1::ListPresetsResponse response;
  ONESEA_RETURN_IF_ERROR(
      impl_->Call(&v1::OneSea::Stub::ListPresets, v1::ListPresetsRequest(), &response));
  std::vector<ListedPreset> presets;
  for (const auto& preset : response.presets()) {
    presets.push_back({preset.name(), preset.summary()});
  }
  return presets;
}

}  // namespace onesea::client
