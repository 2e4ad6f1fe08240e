// Servers that nobody here may follow: one whose components hash differently, as another release's
// would, and one whose numbers are absurd.

#include <gmock/gmock.h>
#include <grpcpp/security/server_credentials.h>
#include <grpcpp/server_builder.h>
#include <gtest/gtest.h>
#include <onesea/onesea.h>

#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include "absl/strings/str_format.h"
#include "common/base/clock.h"
#include "common/base/limits.h"
#include "onesea/v1/onesea.grpc.pb.h"
#include "tests/model/welcome_for_tests.h"

namespace onesea {
namespace {

using ::testing::HasSubstr;

constexpr std::uint64_t kForeignHash = 0x00c0ffee00c0ffeeULL;

// What an honest server would say first.
wire::Frame FirstFrame() {
  wire::Frame frame;
  frame.keyframe = true;
  frame.sequence = 1;
  frame.stamp.emplace();
  frame.stamp->server_monotonic_ns = SystemClock().MonotonicNs();
  frame.welcome = client::WelcomeFor(client::OneWaveRecipe());
  return frame;
}

wire::Frame FrameOfAnotherRelease() {
  wire::Frame frame = FirstFrame();
  frame.welcome->component_hash = kForeignHash;
  return frame;
}

// Says one frame to whoever watches.
class ForeignServer final : public v1::OneSea::Service {
 public:
  explicit ForeignServer(wire::Frame frame) : frame_(std::move(frame)) {
    grpc::ServerBuilder builder;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port_);
    builder.RegisterService(this);
    server_ = builder.BuildAndStart();
  }
  ~ForeignServer() override { server_->Shutdown(std::chrono::system_clock::now()); }

  std::string address() const { return absl::StrFormat("127.0.0.1:%d", port_); }

 private:
  grpc::Status ListSessions(grpc::ServerContext*, const v1::ListSessionsRequest*,
                            v1::ListSessionsResponse* response) override {
    v1::SessionInfo* info = response->add_sessions();
    info->set_name("test");
    info->set_pace(v1::PACE_REAL_TIME);
    info->set_tick_rate_hz(60);
    info->set_stream_rate_hz(30);
    info->set_speed(1.0);
    info->set_actual_speed(1.0);
    return grpc::Status::OK;
  }
  grpc::Status SyncClock(grpc::ServerContext*, const v1::SyncClockRequest*,
                         v1::SyncClockResponse* response) override {
    response->set_server_monotonic_ns(SystemClock().MonotonicNs());
    return grpc::Status::OK;
  }
  grpc::Status Watch(
      grpc::ServerContext*,
      grpc::ServerReaderWriter<v1::WatchResponse, v1::WatchRequest>* stream) override {
    v1::WatchRequest request;
    if (!stream->Read(&request)) return grpc::Status::OK;
    v1::WatchResponse response;
    response.ParseFromString(wire::EncodeFrame(frame_));
    stream->Write(response);
    while (stream->Read(&request)) {
    }
    return grpc::Status::OK;
  }

  const wire::Frame frame_;
  int port_ = 0;
  std::unique_ptr<grpc::Server> server_;
};

TEST(OtherSea, JoinRefusesNamingBothHashes) {
  const ForeignServer server(FrameOfAnotherRelease());
  const absl::Status status = Join(server.address()).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("00c0ffee00c0ffee"));
  EXPECT_THAT(std::string(status.message()),
              HasSubstr(absl::StrFormat("%016x", FirstFrame().welcome->component_hash)));
}

// The tick is one that a frame may carry at 1000 Hz; at 60 Hz it is no time that 64 bits hold.
TEST(OtherSea, JoinRefusesATickThatIsNoTime) {
  wire::Frame frame = FirstFrame();
  frame.stamp->tick = kTickMax;
  const ForeignServer server(std::move(frame));
  const absl::Status status = Join(server.address()).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("stamp.tick: 3200000000000"));
}

TEST(OtherSea, TheCommandSaysSoAndExitsWithFour) {
  const ForeignServer server(FrameOfAnotherRelease());
  const std::string command =
      absl::StrFormat("%s watch --server %s 2>&1 >/dev/null", ONESEA_COMMAND, server.address());
  FILE* const pipe = popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string errors;
  std::array<char, 1024> text;
  while (fgets(text.data(), text.size(), pipe) != nullptr) errors += text.data();
  const int status = pclose(pipe);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4) << errors;
  EXPECT_THAT(errors, HasSubstr("00c0ffee00c0ffee"));
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
}

}  // namespace
}  // namespace onesea
