#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <string>
#include <thread>
#include <vector>

namespace onesea::e2e {

/// Carries bytes between loopback clients and a loopback server, counts them, can cut the wire, and
/// can be long.
class TcpRelay {
 public:
  /// `delay_ns` each way.
  explicit TcpRelay(int server_port, std::int64_t delay_ns = 0);
  ~TcpRelay();

  int port() const { return port_; }
  /// Breaks every connection at once; new ones are refused until Mend().
  void Cut() { cut_ = true; }
  void Mend() { cut_ = false; }
  std::int64_t to_client_bytes() const { return to_client_; }
  std::int64_t to_server_bytes() const { return to_server_; }

 private:
  struct UnderWay {
    int to = -1;
    std::int64_t due_ns = 0;
    std::string bytes;
  };
  struct Pair {
    int client = -1;
    int server = -1;
    std::deque<UnderWay> under_way = {};  // in order of due_ns
  };
  void Run();
  void Accept();
  // False when the pair is over.
  bool Carry(int from, int to, std::atomic<std::int64_t>& count, Pair& pair);
  bool Deliver(Pair& pair);

  const int server_port_;
  const std::int64_t delay_ns_;
  int listener_ = -1;
  int port_ = 0;
  std::vector<Pair> pairs_;
  std::atomic<bool> cut_{false}, stop_{false};
  std::atomic<std::int64_t> to_client_{0}, to_server_{0};
  std::thread thread_;
};

}  // namespace onesea::e2e
