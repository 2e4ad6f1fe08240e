#include "tests/bench/plain_fanout.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>
#include <vector>

#include "common/base/clock.h"
#include "tests/shared/loopback.h"

namespace onesea::bench {
namespace {

// Of the ports that the system gives to no client, the first that is free.
int ListenBelowClientPorts(int listener) {
  for (int port = 21'000; port < 21'100; ++port) {
    const sockaddr_in address = Loopback(port);
    if (bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 &&
        listen(listener, 4096) == 0)
      return port;
  }
  return 0;
}

}  // namespace

void ServePlainFanout(int frame_bytes, int rate_hz, int port_pipe, int stop_pipe) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
  const int port = ListenBelowClientPorts(listener);
  if (write(port_pipe, &port, sizeof(port)) != sizeof(port) || port == 0) return;
  std::vector<int> viewers;
  std::string frame(static_cast<std::size_t>(frame_bytes), 'x');
  FrameSeen head;
  std::int64_t due_ns = SystemClock().MonotonicNs();
  for (pollfd stop{stop_pipe, POLLIN, 0}; poll(&stop, 1, 0) == 0;) {
    for (int fd; (fd = accept(listener, nullptr, nullptr)) >= 0;) {
      SetNoDelay(fd);
      viewers.push_back(fd);
    }
    due_ns += 1'000'000'000 / rate_hz;
    SystemClock().SleepUntil(due_ns);
    head = {head.sequence + 1, due_ns};
    std::memcpy(frame.data(), &head, sizeof(head));
    for (const int fd : viewers) send(fd, frame.data(), frame.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  }
}

PlainViewer::~PlainViewer() {
  if (fd_ >= 0) close(fd_);
}

PlainViewer::PlainViewer(PlainViewer&& other) noexcept
    : frame_bytes_(other.frame_bytes_), fd_(std::exchange(other.fd_, -1)) {}

bool PlainViewer::Open(int port) {
  fd_ = socket(AF_INET, SOCK_STREAM, 0);
  const sockaddr_in address = Loopback(port);
  if (connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) return false;
  return fcntl(fd_, F_SETFL, fcntl(fd_, F_GETFL) | O_NONBLOCK) == 0;
}

bool PlainViewer::Receive() {
  std::array<char, 65536> buffer;
  const ssize_t size = recv(fd_, buffer.data(), buffer.size(), 0);
  if (size <= 0) return size < 0 && errno == EAGAIN;
  bytes_ += size;
  in_.append(buffer.data(), static_cast<std::size_t>(size));
  return true;
}

bool PlainViewer::Take(FrameSeen* out) {
  const auto size = static_cast<std::size_t>(frame_bytes_);
  if (in_.size() < size) return false;
  std::memcpy(out, in_.data(), sizeof(*out));
  in_.erase(0, size);
  return true;
}

}  // namespace onesea::bench
