#include "tests/e2e/server_process.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "common/base/check.h"
#include "tests/shared/loopback.h"

namespace onesea::e2e {
namespace {

using std::chrono::milliseconds;

// Below the range from which outgoing connections are numbered.
int FreePort() {
  std::random_device random;
  while (true) {
    const int port = 20000 + static_cast<int>(random() % 11000);
    const int probe = socket(AF_INET, SOCK_STREAM, 0);
    const sockaddr_in address = Loopback(port);
    const bool is_free =
        bind(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    close(probe);
    if (is_free) return port;
  }
}

}  // namespace

ServerProcess::ServerProcess(std::string session_file)
    : session_file_(std::move(session_file)), address_("127.0.0.1:" + std::to_string(FreePort())) {
  Start();
}

ServerProcess::~ServerProcess() { Kill(); }

void ServerProcess::Start() {
  ONESEA_CHECK(pid_ < 0) << "already started";
  const std::string listen = "--listen=" + address_;
  const std::string session = "--session=" + session_file_;
  const char* words[] = {ONESEA_SERVER_PROGRAM, listen.c_str(), session.c_str(), nullptr};
  const int error = posix_spawn(&pid_, ONESEA_SERVER_PROGRAM, nullptr, nullptr,
                                const_cast<char* const*>(words), environ);
  ONESEA_CHECK(error == 0) << ONESEA_SERVER_PROGRAM;
  WaitUntilItAnswers();
}

void ServerProcess::Kill() {
  if (pid_ < 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  pid_ = -1;
}

void ServerProcess::WaitUntilItAnswers() {
  for (int attempt = 0; attempt < 600; ++attempt) {
    // A new channel each time: a channel that failed waits longer and longer before it tries again.
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    stub_ = v1::OneSea::NewStub(
        grpc::CreateCustomChannel(address_, grpc::InsecureChannelCredentials(), arguments));
    grpc::ClientContext context;
    v1::ListSessionsResponse response;
    if (stub_->ListSessions(&context, {}, &response).ok() && response.sessions_size() > 0) return;
    ONESEA_CHECK(waitpid(pid_, nullptr, WNOHANG) == 0) << "the server ended by itself";
    std::this_thread::sleep_for(milliseconds(50));
  }
  ONESEA_CHECK(false) << "the server does not answer at " << address_;
}

std::string ServerProcess::SessionName() {
  grpc::ClientContext context;
  v1::ListSessionsResponse response;
  ONESEA_CHECK(stub_->ListSessions(&context, {}, &response).ok());
  ONESEA_CHECK(response.sessions_size() == 1);
  return response.sessions(0).name();
}

v1::QueryPointsResponse ServerProcess::Query(double x_m, double y_m, double time_s) {
  v1::QueryPointsRequest request;
  request.set_session(SessionName());
  request.add_x_m(x_m);
  request.add_y_m(y_m);
  request.set_time_s(time_s);
  v1::QueryPointsResponse response;
  grpc::ClientContext context;
  const grpc::Status status = stub_->QueryPoints(&context, request, &response);
  ONESEA_CHECK(status.ok()) << status.error_message();
  return response;
}

}  // namespace onesea::e2e
