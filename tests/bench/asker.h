#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace onesea::bench {

/// Latencies in microseconds.
struct Asked {
  std::vector<double> query_us;
  std::vector<double> ping_us;
};

/// Asks as a simulator does: kQueryPoints heights on one stream a few hundred times a second, the
/// next when the last is answered. Half-way between two queries a ping-pong of as many bytes over a
/// bare socket: what the machine, its scheduler and the load leave to anybody.
class Asker {
 public:
  static constexpr int kQueryPoints = 100;
  static constexpr std::int64_t kPeriodNs = 4'000'000;

  /// Begins, on a thread of its own.
  Asker(int sea_port, int ping_port, std::string session);
  /// Ends it.
  Asked Stop();

 private:
  void Run(int sea_port, int ping_port, const std::string& session);

  std::atomic<bool> stop_{false};
  Asked asked_;
  std::thread thread_;
};

/// One line, with the ratio of the tails.
void PrintAsked(const char* when, Asked asked);

}  // namespace onesea::bench
