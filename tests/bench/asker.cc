#include "tests/bench/asker.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <random>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/net/remote_server.h"
#include "common/base/check.h"
#include "common/base/clock.h"
#include "tests/bench/crowd.h"
#include "tests/bench/ping_pong.h"

namespace onesea::bench {
namespace {

wire::QueryRequest RandomPoints(const std::string& session) {
  wire::QueryRequest request;
  request.session = session;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(-1000.0, 1000.0);
  for (int n = 0; n < Asker::kQueryPoints; ++n) {
    request.points_m.push_back({place(random), place(random)});
  }
  return request;
}

template <typename Call>
void Time(std::vector<double>& latencies_us, const Call& call) {
  const std::int64_t before_ns = SystemClock().MonotonicNs();
  call();
  latencies_us.push_back(static_cast<double>(SystemClock().MonotonicNs() - before_ns) * 1e-3);
}

}  // namespace

Asker::Asker(int sea_port, int ping_port, std::string session)
    : thread_([=, this, session = std::move(session)] { Run(sea_port, ping_port, session); }) {}

void Asker::Run(int sea_port, int ping_port, const std::string& session) {
  client::RemoteServer remote(client::ConnectTo(absl::StrCat("127.0.0.1:", sea_port)));
  const std::unique_ptr<client::QueryStream> stream = remote.StreamQueries();
  const Pinger pinger(ping_port);
  wire::QueryRequest request = RandomPoints(session);
  std::int64_t due_ns = SystemClock().MonotonicNs();
  while (!stop_) {
    ++request.id;
    Time(asked_.query_us, [&] {
      ONESEA_CHECK(stream->Send(request).ok());
      const absl::StatusOr<wire::QueryAnswer> answer = stream->Receive();
      ONESEA_CHECK(answer.ok() && answer->status.ok() && answer->id == request.id);
    });
    SystemClock().SleepUntil(due_ns + kPeriodNs / 2);
    Time(asked_.ping_us, [&] { pinger.Ping(); });
    // A late one does not bring the next ones nearer together.
    due_ns = std::max(due_ns + kPeriodNs, SystemClock().MonotonicNs());
    SystemClock().SleepUntil(due_ns);
  }
}

Asked Asker::Stop() {
  stop_ = true;
  thread_.join();
  return std::move(asked_);
}

void PrintAsked(const char* when, Asked asked) {
  const std::size_t count = asked.query_us.size();
  const Spread query = SpreadOf(std::move(asked.query_us));
  const Spread ping = SpreadOf(std::move(asked.ping_us));
  std::printf(
      "query  %d points, %s: p50 %.0f p99 %.0f p99.9 %.0f us over %zu answers; "
      "ping-pong: p50 %.0f p99 %.0f p99.9 %.0f us; p99 / p99 = %.2f\n",
      Asker::kQueryPoints, when, query.p50, query.p99, query.p999, count, ping.p50, ping.p99,
      ping.p999, query.p99 / ping.p99);
}

}  // namespace onesea::bench
