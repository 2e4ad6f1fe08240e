#pragma once

namespace onesea::bench {

/// Bytes of a 100-point query on a stream and of its answer, about.
inline constexpr int kPingBytes = 1640;
inline constexpr int kPongBytes = 440;

/// Answers kPingBytes with kPongBytes on every connection, one after the other, until `stop_pipe`
/// ends: a blocking thread and a socket, the least that a request over loopback can cost.
void ServePingPong(int port_pipe, int stop_pipe);

/// The other end of it.
class Pinger {
 public:
  /// 127.0.0.1:`port`; a failure is a failed check.
  explicit Pinger(int port);
  ~Pinger();
  Pinger(const Pinger&) = delete;
  Pinger& operator=(const Pinger&) = delete;

  /// Once there and back.
  void Ping() const;

 private:
  int fd_;
};

}  // namespace onesea::bench
