#include "tests/bench/ping_pong.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "common/base/check.h"
#include "tests/shared/loopback.h"

namespace onesea::bench {
namespace {

constexpr int kBytesMax = std::max(kPingBytes, kPongBytes);

bool SendAll(int fd, int bytes) {
  std::array<char, kBytesMax> buffer{};
  return send(fd, buffer.data(), static_cast<std::size_t>(bytes), MSG_NOSIGNAL) == bytes;
}

bool ReceiveAll(int fd, int bytes) {
  std::array<char, kBytesMax> buffer{};
  return recv(fd, buffer.data(), static_cast<std::size_t>(bytes), MSG_WAITALL) == bytes;
}

}  // namespace

void ServePingPong(int port_pipe, int stop_pipe) {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = Loopback(0);
  socklen_t size = sizeof(address);
  auto* const generic = reinterpret_cast<sockaddr*>(&address);
  const bool listens = bind(listener, generic, size) == 0 && listen(listener, 16) == 0 &&
                       getsockname(listener, generic, &size) == 0;
  const int port = listens ? ntohs(address.sin_port) : 0;
  if (write(port_pipe, &port, sizeof(port)) != sizeof(port) || port == 0) return;
  std::array<pollfd, 2> ends{{{listener, POLLIN, 0}, {stop_pipe, POLLIN, 0}}};
  while (poll(ends.data(), ends.size(), -1) > 0 && ends[1].revents == 0) {
    const int fd = accept(listener, nullptr, nullptr);
    SetNoDelay(fd);
    while (ReceiveAll(fd, kPingBytes) && SendAll(fd, kPongBytes)) {
    }
    close(fd);
  }
}

Pinger::Pinger(int port) : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
  const sockaddr_in address = Loopback(port);
  ONESEA_CHECK(connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0);
  SetNoDelay(fd_);
}

Pinger::~Pinger() { close(fd_); }

void Pinger::Ping() const { ONESEA_CHECK(SendAll(fd_, kPingBytes) && ReceiveAll(fd_, kPongBytes)); }

}  // namespace onesea::bench
