#include "tests/e2e/harness.h"

#include <gmock/gmock.h>
#include <grpcpp/create_channel.h>
#include <grpcpp/security/credentials.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"

namespace onesea::e2e {

SessionSpec SmallSession(const std::string& name) {
  SessionSpec spec;
  spec.name = name;
  spec.recipe.cascades = {{.length_m = 1000.0,
                           .rotation_rad = 0.1,
                           .wavenumber_min_rad_per_m = 0.02,
                           .wavenumber_max_rad_per_m = 0.05,
                           .query_grid_size = 64}};
  sea::WeatherEntry entry;
  entry.sea.systems = {sea::JonswapSystem{}};
  spec.recipe.timeline = {entry};
  spec.stream_rate_hz = 60;
  spec.probes_m = DefaultProbes();
  return spec;
}

void TestServer::Start() {
  auto registry = std::make_unique<server::Registry>(clock_);
  server::RpcServerOptions options;
  options.listen_address =
      transport_ == Transport::kInProcess ? "" : absl::StrCat("127.0.0.1:", port_);
  options.watch_shards = 2;
  absl::StatusOr<std::unique_ptr<server::RpcServer>> rpc =
      server::RpcServer::Start(options, *registry, clock_);
  ASSERT_TRUE(rpc.ok()) << rpc.status();
  absl::MutexLock lock(&mutex_);
  registry_ = std::move(registry);
  rpc_ = *std::move(rpc);
  port_ = rpc_->port();
}

void TestServer::Stop(double grace_s) {
  std::unique_ptr<server::Registry> registry;
  std::unique_ptr<server::RpcServer> rpc;
  {
    // Out of reach first: a channel into a server that is going down is a bug of the caller's.
    absl::MutexLock lock(&mutex_);
    registry = std::move(registry_);
    rpc = std::move(rpc_);
  }
  if (rpc != nullptr) rpc->Shutdown(grace_s);
}

std::shared_ptr<server::SessionLoop> TestServer::Create(SessionSpec spec) {
  absl::StatusOr<std::shared_ptr<server::SessionLoop>> loop = registry_->Create(std::move(spec));
  EXPECT_TRUE(loop.ok()) << loop.status();
  return loop.ok() ? *loop : nullptr;
}

client::ChannelFactory TestServer::Connect() {
  return [this]() -> std::shared_ptr<grpc::Channel> {
    absl::MutexLock lock(&mutex_);
    if (rpc_ != nullptr && transport_ == Transport::kInProcess) return rpc_->InProcessChannel();
    // Port 1 refuses: nobody listens there.
    const int port = transport_ == Transport::kInProcess ? 1 : port_;
    return client::ConnectTo(absl::StrCat("127.0.0.1:", port))();
  };
}

bool Recorder::AwaitFrame(const std::function<bool(const wire::Frame&)>& wanted) const {
  return Eventually([&] {
    absl::MutexLock lock(&mutex_);
    return std::any_of(frames_.begin(), frames_.end(), wanted);
  });
}

bool Recorder::AwaitFrames(std::size_t count) const {
  return Eventually([&] {
    absl::MutexLock lock(&mutex_);
    return frames_.size() >= count;
  });
}

bool Recorder::AwaitLink(client::LinkState state) const {
  return Eventually([&] {
    absl::MutexLock lock(&mutex_);
    return std::any_of(links_.begin(), links_.end(),
                       [&](const client::LinkEvent& link) { return link.state == state; });
  });
}

bool Eventually(const std::function<bool()>& condition) {
  const absl::Time deadline = absl::Now() + kPatience;
  while (!condition()) {
    if (absl::Now() > deadline) return false;
    absl::SleepFor(absl::Milliseconds(2));
  }
  return true;
}

}  // namespace onesea::e2e
