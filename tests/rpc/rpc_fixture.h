#pragma once

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "common/base/check.h"
#include "common/wire/proto_session.h"
#include "onesea/v1/onesea.grpc.pb.h"
#include "server/rpc/rpc_server.h"
#include "server/session/registry.h"
#include "tests/shared/small_sea.h"

namespace onesea::server {

/// A server with one held session "small" and one lock-step session "lock", and a stub without
/// sockets.
class RpcFixture : public ::testing::Test {
 protected:
  explicit RpcFixture(const std::string& listen_address = "") {
    SessionSpec small = SmallSession("small");
    small.pace = Pace::kHeld;
    ONESEA_CHECK(registry.Create(small).ok());
    SessionSpec lock = SmallSession("lock");
    lock.pace = Pace::kLockStep;
    lock.lock_step_participants = 2;
    lock.lock_step_deadline_s = 30.0;
    ONESEA_CHECK(registry.Create(lock).ok());
    server = std::move(RpcServer::Start({.listen_address = listen_address}, registry)).value();
    stub = v1::OneSea::NewStub(server->InProcessChannel());
  }

  /// Calls a unary method: Call(&Stub::HoldSession, request, &response).
  template <typename Method, typename Request, typename Response>
  grpc::Status Call(Method method, const Request& request, Response* response) {
    grpc::ClientContext context;
    return ((*stub).*method)(&context, request, response);
  }

  std::shared_ptr<SessionLoop> Find(const std::string& name) { return *registry.Find(name); }

  using Stub = v1::OneSea::Stub;
  Registry registry;
  std::unique_ptr<RpcServer> server;
  std::unique_ptr<v1::OneSea::Stub> stub;
};

inline v1::QueryPointsRequest QueryAt(const std::string& session, int points) {
  v1::QueryPointsRequest request;
  request.set_session(session);
  for (int n = 0; n < points; ++n) {
    request.add_x_m(3.7 * n);
    request.add_y_m(-1.9 * n);
  }
  return request;
}

}  // namespace onesea::server
