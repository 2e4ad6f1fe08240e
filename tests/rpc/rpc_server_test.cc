// The server as a whole, over loopback: health, reflection, keepalive, shutdown.
#include "server/rpc/rpc_server.h"

#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>

#include <thread>

#include "absl/strings/str_cat.h"
#include "tests/rpc/rpc_fixture.h"

namespace onesea::server {
namespace {

using ::testing::HasSubstr;

class Loopback : public RpcFixture {
 protected:
  Loopback() : RpcFixture("127.0.0.1:0") {}

  std::shared_ptr<grpc::Channel> Connect(const grpc::ChannelArguments& arguments = {}) {
    return grpc::CreateCustomChannel(absl::StrCat("127.0.0.1:", server->port()),
                                     grpc::InsecureChannelCredentials(), arguments);
  }
};

grpc::ByteBuffer Bytes(const std::string& text) {
  const grpc::Slice slice(text);
  return grpc::ByteBuffer(&slice, 1);
}

std::string Text(const grpc::ByteBuffer& bytes) {
  std::vector<grpc::Slice> slices;
  std::string text;
  EXPECT_TRUE(bytes.Dump(&slices).ok());
  for (const grpc::Slice& slice : slices) {
    text.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  }
  return text;
}

// One request, one answer of a bidirectional or unary method by its name, in bytes.
std::string CallByName(const std::shared_ptr<grpc::Channel>& channel, const std::string& method,
                       const std::string& request) {
  grpc::GenericStub generic(channel);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
  grpc::CompletionQueue queue;
  const auto call = generic.PrepareCall(&context, method, &queue);
  const auto wait = [&] {
    void* tag = nullptr;
    bool ok = false;
    queue.Next(&tag, &ok);
    return ok;
  };
  call->StartCall(nullptr);
  EXPECT_TRUE(wait());
  call->WriteLast(Bytes(request), grpc::WriteOptions(), nullptr);
  EXPECT_TRUE(wait());
  grpc::ByteBuffer answer;
  call->Read(&answer, nullptr);
  EXPECT_TRUE(wait());
  grpc::Status status;
  call->Finish(&status, nullptr);
  wait();
  EXPECT_TRUE(status.ok()) << status.error_message();
  return Text(answer);
}

TEST_F(Loopback, AnswersOverASocket) {
  const auto remote = v1::OneSea::NewStub(Connect());
  grpc::ClientContext context;
  v1::ListSessionsResponse response;
  ASSERT_TRUE(remote->ListSessions(&context, v1::ListSessionsRequest(), &response).ok());
  EXPECT_EQ(response.sessions_size(), 2);
}

TEST_F(Loopback, ClockIsTheMachines) {
  const auto remote = v1::OneSea::NewStub(Connect());
  std::int64_t last_ns = SystemClock().MonotonicNs();
  for (int n = 0; n < 10; ++n) {
    grpc::ClientContext context;
    v1::SyncClockResponse response;
    ASSERT_TRUE(remote->SyncClock(&context, v1::SyncClockRequest(), &response).ok());
    EXPECT_GE(response.server_monotonic_ns(), last_ns);
    last_ns = response.server_monotonic_ns();
  }
  EXPECT_LE(last_ns, SystemClock().MonotonicNs());
}

// grpc.health.v1.Health/Check {service: "onesea.v1.OneSea"} -> {status: SERVING (1)}.
TEST_F(Loopback, SpeaksTheStandardHealthProtocol) {
  EXPECT_EQ(CallByName(Connect(), "/grpc.health.v1.Health/Check",
                       std::string("\x0a\x10") + "onesea.v1.OneSea"),
            std::string("\x08\x01"));
  EXPECT_EQ(CallByName(Connect(), "/grpc.health.v1.Health/Check", ""), std::string("\x08\x01"));
}

// ServerReflectionRequest {list_services: ""}: field 7.
TEST_F(Loopback, SpeaksReflection) {
  const std::string answer =
      CallByName(Connect(), "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo",
                 std::string("\x3a\x00", 2));
  EXPECT_THAT(answer, HasSubstr("onesea.v1.OneSea"));
  EXPECT_THAT(answer, HasSubstr("grpc.health.v1.Health"));
}

// A default gRPC server ends such a client's calls after a few pings ("too_many_pings").
TEST_F(Loopback, ToleratesAClientThatPingsOnASilentStream) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 600);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  const auto remote = v1::OneSea::NewStub(Connect(arguments));
  grpc::ClientContext context;
  const auto stream = remote->StreamQueries(&context);
  v1::QueryPointsResponse response;
  ASSERT_TRUE(stream->Write(QueryAt("small", 1)));
  ASSERT_TRUE(stream->Read(&response));
  std::this_thread::sleep_for(std::chrono::milliseconds(3500));
  ASSERT_TRUE(stream->Write(QueryAt("small", 1)));
  ASSERT_TRUE(stream->Read(&response));
  stream->WritesDone();
  EXPECT_TRUE(stream->Finish().ok());
}

TEST_F(Loopback, AnAddressInUseIsAnError) {
  Registry other;
  const auto second =
      RpcServer::Start({.listen_address = absl::StrCat("127.0.0.1:", server->port())}, other);
  EXPECT_EQ(second.status().code(), absl::StatusCode::kUnavailable);
}

TEST_F(Loopback, ShutdownEndsOpenStreams) {
  const auto remote = v1::OneSea::NewStub(Connect());
  grpc::ClientContext context;
  const auto stream = remote->StreamQueries(&context);
  v1::QueryPointsResponse response;
  ASSERT_TRUE(stream->Write(QueryAt("small", 1)));
  ASSERT_TRUE(stream->Read(&response));
  server->Shutdown(0.05);
  EXPECT_FALSE(stream->Read(&response));
  EXPECT_FALSE(stream->Finish().ok());
  EXPECT_TRUE(registry.List().empty());
}

TEST_F(Loopback, WatchersAreServedBesideTheRest) {
  const auto remote = v1::OneSea::NewStub(Connect());
  grpc::ClientContext context;
  v1::WatchStampsRequest request;
  request.set_session("small");
  const auto stream = remote->WatchStamps(&context, request);
  v1::WatchResponse response;
  ASSERT_TRUE(stream->Read(&response));
  EXPECT_EQ(response.welcome().component_hash(), Find("small")->View().components->hash);
  context.TryCancel();
  stream->Finish();
}

}  // namespace
}  // namespace onesea::server
