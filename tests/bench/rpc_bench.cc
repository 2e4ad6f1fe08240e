// What a query costs over loopback, against what can't be avoided, measured in the same run by
// turns so that the machine's noise hits all alike. Medians; asserts nothing.
//
//   one point      against an empty call (SyncClock)                                       goal <=
// 1.2
//   10,000 points  against an echo of the same bytes + 1.1 x the bare evaluation           goal <=
// 1.0
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "absl/flags/parse.h"
#include "absl/flags/usage.h"
#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/clock.h"
#include "common/sea/point_query.h"
#include "common/wire/session_file.h"
#include "onesea/v1/onesea.grpc.pb.h"
#include "server/rpc/rpc_server.h"
#include "server/session/registry.h"

namespace onesea {
namespace {

constexpr int kPoints = 10'000;

// Parses the same request and sends as many bytes back, without a sea.
class EchoService final : public v1::OneSea::CallbackService {
  grpc::ServerUnaryReactor* QueryPoints(grpc::CallbackServerContext* context,
                                        const v1::QueryPointsRequest* request,
                                        v1::QueryPointsResponse* response) override {
    response->mutable_height_m()->Resize(request->x_m_size(), 1.0f);
    response->set_time_s(1.0);
    response->set_layers(1);
    response->set_height_error_bound_m(0.01);
    grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
    reactor->Finish(grpc::Status::OK);
    return reactor;
  }
};

v1::QueryPointsRequest Request(const std::string& session, int points) {
  v1::QueryPointsRequest request;
  request.set_session(session);
  std::uint64_t random = 1;
  const auto next_m = [&random] {
    random = random * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(random >> 40) * (4000.0 / (1 << 24)) - 2000.0;
  };
  for (int n = 0; n < points; ++n) {
    request.add_x_m(next_m());
    request.add_y_m(next_m());
  }
  return request;
}

struct Measured {
  const char* name;
  std::function<void()> call;
  std::vector<double> us;

  double At(double quantile) {
    std::sort(us.begin(), us.end());
    return us[static_cast<std::size_t>(quantile * static_cast<double>(us.size() - 1))];
  }
};

// Every one in turn, `rounds` times; the first tenth warms up.
void Measure(std::vector<Measured*> all, int rounds) {
  for (int round = -rounds / 10; round < rounds; ++round) {
    for (Measured* one : all) {
      const std::int64_t begin_ns = SystemClock().MonotonicNs();
      one->call();
      const std::int64_t end_ns = SystemClock().MonotonicNs();
      if (round >= 0) one->us.push_back(static_cast<double>(end_ns - begin_ns) * 1e-3);
    }
  }
  for (Measured* one : all) {
    std::printf("%-34s p50 %8.1f us   p99 %8.1f us\n", one->name, one->At(0.5), one->At(0.99));
  }
}

std::unique_ptr<v1::OneSea::Stub> Connect(int port) {
  return v1::OneSea::NewStub(
      grpc::CreateChannel(absl::StrCat("127.0.0.1:", port), grpc::InsecureChannelCredentials()));
}

std::function<void()> QueryCall(v1::OneSea::Stub& stub, v1::QueryPointsRequest request) {
  return [&stub, request = std::move(request)] {
    grpc::ClientContext context;
    v1::QueryPointsResponse response;
    const grpc::Status status = stub.QueryPoints(&context, request, &response);
    ONESEA_CHECK(status.ok() && response.height_m_size() == request.x_m_size());
  };
}

// What the server does for the points alone: a snapshot that is there already.
std::function<void()> BareEvaluation(const server::SessionLoop& session,
                                     const v1::QueryPointsRequest& request) {
  const server::SessionView view = session.View();
  const auto snapshot =
      sea::SnapshotBuilder(view.components)
          .At(TimeOfTick(view.tick, session.tick_rate_hz()), sea::QueryDetail::kHeight);
  std::vector<Vec2d> points;
  for (int n = 0; n < request.x_m_size(); ++n) points.push_back({request.x_m(n), request.y_m(n)});
  return [snapshot, points, samples = std::vector<sea::SurfaceSample>(points.size())]() mutable {
    snapshot->Sample(points, samples);
  };
}

int Main() {
  server::Registry registry;
  SessionSpec spec =
      std::move(wire::ReadSessionFile("deploy/sessions/storm-41010.textproto")).value();
  const auto session = std::move(registry.Create(std::move(spec))).value();
  const auto server =
      std::move(server::RpcServer::Start({.listen_address = "127.0.0.1:0"}, registry)).value();
  EchoService echo_service;
  int echo_port = 0;
  const auto echo_server =
      grpc::ServerBuilder()
          .AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &echo_port)
          .RegisterService(&echo_service)
          .BuildAndStart();
  const auto stub = Connect(server->port());
  const auto echo_stub = Connect(echo_port);

  Measured empty{"empty call (SyncClock)",
                 [&] {
                   grpc::ClientContext context;
                   v1::SyncClockResponse response;
                   ONESEA_CHECK(stub->SyncClock(&context, {}, &response).ok());
                 },
                 {}};
  Measured one{"query of 1 point", QueryCall(*stub, Request(session->name(), 1)), {}};
  Measure({&empty, &one}, 5000);
  std::printf("1 point / empty call = %.2f (goal 1.2)\n\n", one.At(0.5) / empty.At(0.5));

  // Held: otherwise some of the queries also pay for the synthesis of a new tick.
  ONESEA_CHECK(session->Hold().ok());
  const v1::QueryPointsRequest many = Request(session->name(), kPoints);
  Measured echo{"echo of the bytes of 10,000 points", QueryCall(*echo_stub, many), {}};
  Measured bare{"bare evaluation of 10,000 points", BareEvaluation(*session, many), {}};
  Measured query{"query of 10,000 points", QueryCall(*stub, many), {}};
  Measure({&echo, &bare, &query}, 1500);
  std::printf("10,000 points / (echo + 1.1 x bare) = %.2f (goal 1.0)\n",
              query.At(0.5) / (echo.At(0.5) + 1.1 * bare.At(0.5)));
  server->Shutdown(0.1);
  return 0;
}

}  // namespace
}  // namespace onesea

int main(int argc, char** argv) {
  absl::SetProgramUsageMessage(
      "What an RPC query costs beside an empty call and an echo. No options.");
  absl::ParseCommandLine(argc, argv);
  return onesea::Main();
}
