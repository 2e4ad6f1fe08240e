// How much a viewer costs, beside the least it could: N light viewers on loopback against a server
// in a process of its own, then as many plain sockets with frames of the same size. With --query
// also the latency of 100-point queries on one stream while the viewers are served.
//
// Server and viewers share the machine's cores. Loopback only; at most 4000 viewers and 60 seconds.
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "absl/flags/flag.h"
#include "absl/flags/parse.h"
#include "absl/flags/usage.h"
#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/clock.h"
#include "server/rpc/rpc_server.h"
#include "server/session/registry.h"
#include "tests/bench/asker.h"
#include "tests/bench/child.h"
#include "tests/bench/crowd.h"
#include "tests/bench/light_viewer.h"
#include "tests/bench/ping_pong.h"
#include "tests/bench/plain_fanout.h"

ABSL_FLAG(int, viewers, 500, "Viewers, [1, 4000]");
ABSL_FLAG(int, seconds, 5, "How long to measure, [1, 60]");
ABSL_FLAG(int, shards, 1, "Threads of the server that send, [1, 64]");
ABSL_FLAG(bool, every_frame, true, "30 frames a second; otherwise a stamp a second");
ABSL_FLAG(bool, query, true, "Also 100-point queries while the viewers are served");

namespace onesea::bench {
namespace {

constexpr int kStreamRateHz = 30;

struct Options {
  int viewers;
  int seconds;
  int shards;
  bool every_frame;
  bool query;
};

Options FromFlags() {
  return {.viewers = std::clamp(absl::GetFlag(FLAGS_viewers), 1, 4000),
          .seconds = std::clamp(absl::GetFlag(FLAGS_seconds), 1, 60),
          .shards = std::clamp(absl::GetFlag(FLAGS_shards), 1, 64),
          .every_frame = absl::GetFlag(FLAGS_every_frame),
          .query = absl::GetFlag(FLAGS_query)};
}

void ServeSea(int shards, int port_pipe, int stop_pipe) {
  SessionSpec spec;
  spec.name = "bench";
  spec.recipe.cascades = sea::DefaultCascades();
  sea::WeatherEntry entry;
  entry.sea.systems = {sea::JonswapSystem{}};
  spec.recipe.timeline = {entry};
  spec.stream_rate_hz = kStreamRateHz;
  spec.probes_m = DefaultProbes();
  server::Registry registry;
  ONESEA_CHECK(registry.Create(spec).ok());
  std::unique_ptr<server::RpcServer> rpc;
  // Ports that the system gives to clients are taken by the viewers.
  for (int port = 21'200; port < 21'300 && rpc == nullptr; ++port) {
    server::RpcServerOptions options;
    options.listen_address = absl::StrCat("127.0.0.1:", port);
    options.watch_shards = shards;
    auto started = server::RpcServer::Start(options, registry);
    if (started.ok()) rpc = *std::move(started);
  }
  const int port = rpc == nullptr ? 0 : rpc->port();
  if (write(port_pipe, &port, sizeof(port)) != sizeof(port) || port == 0) return;
  pollfd stop{stop_pipe, POLLIN, 0};
  poll(&stop, 1, -1);
  rpc->Shutdown(0.5);
}

void Print(const char* name, const CrowdResult& result, double cpu_s, int viewers, double span_s) {
  const double frames = static_cast<double>(std::max<std::int64_t>(1, result.frames));
  std::printf(
      "%-6s viewers %4d  frames/s %8.0f  server %5.1f %% of a core  %6.2f us/frame  "
      "late p50 %6.2f p99 %6.2f p99.9 %6.2f ms  %6.0f bytes/s/viewer  skipped %ld  lost %d\n",
      name, viewers, frames / span_s, 100.0 * cpu_s / span_s, 1e6 * cpu_s / frames,
      result.lateness_ms.p50, result.lateness_ms.p99, result.lateness_ms.p999,
      static_cast<double>(result.bytes) / span_s / viewers, static_cast<long>(result.gaps),
      result.lost);
}

// Watches for the span with queries beside it.
template <typename Viewer>
CrowdResult WatchAndAsk(std::vector<Viewer>& viewers, std::int64_t span_ns, Child& server,
                        Child& ping_pong, const std::string& when) {
  Asker asker(server.port(), ping_pong.port(), "bench");
  const CrowdResult result = Watch(viewers, span_ns);
  PrintAsked(when.c_str(), asker.Stop());
  return result;
}

// Microseconds of server CPU per frame.
double RunSea(Child& server, Child& ping_pong, const Options& options, std::int64_t* frame_bytes) {
  const int port = server.port();
  ONESEA_CHECK(port > 0) << "no free port";
  const auto span_ns = static_cast<std::int64_t>(options.seconds) * 1'000'000'000;
  std::vector<LightViewer> viewers;
  if (options.query) WatchAndAsk(viewers, span_ns, server, ping_pong, "nobody watches");
  viewers.reserve(options.viewers);
  for (int n = 0; n < options.viewers; ++n) {
    viewers.emplace_back();
    ONESEA_CHECK(viewers.back().Open(port, "bench", options.every_frame)) << "viewer " << n;
  }
  Watch(viewers, 1'000'000'000);  // warm
  const double cpu_before_s = server.CpuSeconds();
  const CrowdResult alone = Watch(viewers, span_ns);
  const double cpu_s = server.CpuSeconds() - cpu_before_s;
  Print("onesea", alone, cpu_s, options.viewers, options.seconds);
  for (const LightViewer& viewer : viewers) {
    if (!viewer.trouble().empty()) std::printf("  trouble: %s\n", viewer.trouble().c_str());
  }
  if (options.query) {
    WatchAndAsk(viewers, span_ns, server, ping_pong,
                absl::StrCat("while streaming to ", options.viewers));
  }
  const auto frames = static_cast<double>(std::max<std::int64_t>(1, alone.frames));
  *frame_bytes = static_cast<std::int64_t>(static_cast<double>(alone.bytes) / frames);
  return 1e6 * cpu_s / frames;
}

double RunPlain(Child& server, const Options& options, int frame_bytes) {
  const int port = server.port();
  ONESEA_CHECK(port > 0) << "no free port";
  std::vector<PlainViewer> viewers;
  viewers.reserve(options.viewers);
  for (int n = 0; n < options.viewers; ++n) {
    viewers.emplace_back(frame_bytes);
    ONESEA_CHECK(viewers.back().Open(port)) << "plain viewer " << n;
  }
  Watch(viewers, 1'000'000'000);
  const double cpu_before_s = server.CpuSeconds();
  const auto span_ns = static_cast<std::int64_t>(options.seconds) * 1'000'000'000;
  const CrowdResult result = Watch(viewers, span_ns);
  const double cpu_s = server.CpuSeconds() - cpu_before_s;
  Print("tcp", result, cpu_s, options.viewers, options.seconds);
  return 1e6 * cpu_s / static_cast<double>(std::max<std::int64_t>(1, result.frames));
}

void Run(const Options& options) {
  rlimit files{};
  getrlimit(RLIMIT_NOFILE, &files);
  files.rlim_cur = files.rlim_max;
  setrlimit(RLIMIT_NOFILE, &files);
  // All are forked before the first thread; the idle ones cost nothing.
  constexpr int kPlainFrameBytes = 64;  // about what a stamp takes on the wire, both ways
  Child plain([&](int port_pipe, int stop_pipe) {
    ServePlainFanout(kPlainFrameBytes, options.every_frame ? kStreamRateHz : 1, port_pipe,
                     stop_pipe);
  });
  Child sea([&](int port_pipe, int stop_pipe) { ServeSea(options.shards, port_pipe, stop_pipe); });
  Child ping_pong(ServePingPong);
  std::int64_t frame_bytes = 0;
  const double sea_us = RunSea(sea, ping_pong, options, &frame_bytes);
  const double plain_us = RunPlain(plain, options, kPlainFrameBytes);
  std::printf(
      "ratio  onesea / plain sockets: %.2f in server CPU per frame (%ld and %d bytes a frame)\n",
      plain_us > 0.0 ? sea_us / plain_us : 0.0, static_cast<long>(frame_bytes), kPlainFrameBytes);
}

}  // namespace
}  // namespace onesea::bench

int main(int argc, char** argv) {
  absl::SetProgramUsageMessage(
      "What a viewer costs, beside plain sockets in the same run. Loopback only.");
  absl::ParseCommandLine(argc, argv);
  onesea::bench::Run(onesea::bench::FromFlags());
  return 0;
}
