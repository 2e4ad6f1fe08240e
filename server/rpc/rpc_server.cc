#include "server/rpc/rpc_server.h"

#include <grpc/support/log.h>
#include <grpc/support/time.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "absl/strings/str_cat.h"
#include "server/rpc/service.h"
#include "server/rpc/watch_server.h"
#include "server/session/registry.h"

namespace onesea::server {
namespace {

// The largest request: 100 000 points with depth, 2.4 MB.
constexpr int kRequestBytesMax = 4 << 20;

// A dead peer is noticed within 15 s even on a silent stream; a client may ping twice a second.
void SetKeepalive(grpc::ServerBuilder& builder) {
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 10'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 5'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 500);
  // Two servers on one port would share its clients at random.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
}

// gRPC's own log lines go where ours go; what is no error of its is for its developers.
void ForwardLog(gpr_log_func_args* args) {
  const bool error = args->severity == GPR_LOG_SEVERITY_ERROR;
  spdlog::log(error ? spdlog::level::warn : spdlog::level::debug, "grpc: {}", args->message);
}

}  // namespace

struct RpcServer::Impl {
  Impl(Registry& registry, const Clock& clock, sea::TransformKind transform)
      : registry(registry), hub(registry), service(registry, clock, transform) {}
  ~Impl() { Shutdown(0.0); }
  void Shutdown(double grace_s);

  Registry& registry;
  Hub hub;
  OneSeaService service;
  std::unique_ptr<WatchServer> watch;
  std::unique_ptr<grpc::Server> server;
  int port = 0;
};

void RpcServer::Impl::Shutdown(double grace_s) {
  if (server == nullptr) return;
  server->GetHealthCheckService()->SetServingStatus(false);
  registry.CloseAll("the server stops");
  watch->AwaitFarewells(grace_s);
  server->Shutdown(gpr_time_from_micros(static_cast<std::int64_t>(grace_s * 1e6), GPR_TIMESPAN));
  watch->Stop();
  server = nullptr;
}

absl::StatusOr<std::unique_ptr<RpcServer>> RpcServer::Start(const RpcServerOptions& options,
                                                            Registry& registry,
                                                            const Clock& clock) {
  gpr_set_log_function(ForwardLog);
  auto impl = std::make_unique<Impl>(registry, clock, options.transform);
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  grpc::ServerBuilder builder;
  SetKeepalive(builder);
  builder.SetMaxReceiveMessageSize(kRequestBytesMax);
  if (!options.listen_address.empty()) {
    builder.AddListeningPort(options.listen_address, grpc::InsecureServerCredentials(),
                             &impl->port);
  }
  builder.RegisterService(&impl->service);
  impl->watch = std::make_unique<WatchServer>(impl->hub, impl->service, builder,
                                              WatchOptions{.shards = options.watch_shards}, clock);
  impl->server = builder.BuildAndStart();
  if (impl->server == nullptr || (!options.listen_address.empty() && impl->port == 0)) {
    return absl::UnavailableError(absl::StrCat("can't listen on ", options.listen_address,
                                               ": is another server running there?"));
  }
  impl->server->GetHealthCheckService()->SetServingStatus("onesea.v1.OneSea", true);
  impl->watch->Start();
  return std::unique_ptr<RpcServer>(new RpcServer(std::move(impl)));
}

RpcServer::RpcServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

RpcServer::~RpcServer() { Shutdown(); }

int RpcServer::port() const { return impl_->port; }

std::shared_ptr<grpc::Channel> RpcServer::InProcessChannel() {
  return impl_->server->InProcessChannel(grpc::ChannelArguments());
}

void RpcServer::Shutdown(double grace_s) { impl_->Shutdown(grace_s); }

}  // namespace onesea::server
