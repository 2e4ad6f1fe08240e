#include "tests/e2e/tcp_relay.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "common/base/check.h"
#include "common/base/clock.h"
#include "tests/shared/loopback.h"

namespace onesea::e2e {

TcpRelay::TcpRelay(int server_port, std::int64_t delay_ns)
    : server_port_(server_port), delay_ns_(delay_ns) {
  listener_ = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = Loopback(0);
  socklen_t size = sizeof(address);
  ONESEA_CHECK(bind(listener_, reinterpret_cast<sockaddr*>(&address), size) == 0);
  ONESEA_CHECK(listen(listener_, 16) == 0);
  getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] { Run(); });
}

TcpRelay::~TcpRelay() {
  stop_ = true;
  thread_.join();
  for (const Pair& pair : pairs_) {
    close(pair.client);
    close(pair.server);
  }
  close(listener_);
}

void TcpRelay::Accept() {
  const int client = accept(listener_, nullptr, nullptr);
  if (client < 0) return;
  const int server = socket(AF_INET, SOCK_STREAM, 0);
  const sockaddr_in address = Loopback(server_port_);
  if (cut_ || connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    close(client);
    close(server);
    return;
  }
  SetNoDelay(client);
  SetNoDelay(server);
  pairs_.push_back({client, server});
}

bool TcpRelay::Carry(int from, int to, std::atomic<std::int64_t>& count, Pair& pair) {
  std::array<char, 65536> buffer;
  const ssize_t size = recv(from, buffer.data(), buffer.size(), 0);
  if (size <= 0) return false;
  count += size;
  pair.under_way.push_back({to, SystemClock().MonotonicNs() + delay_ns_,
                            std::string(buffer.data(), static_cast<std::size_t>(size))});
  return true;
}

bool TcpRelay::Deliver(Pair& pair) {
  const std::int64_t now_ns = SystemClock().MonotonicNs();
  for (; !pair.under_way.empty() && pair.under_way.front().due_ns <= now_ns;
       pair.under_way.pop_front()) {
    const auto& [to, due_ns, bytes] = pair.under_way.front();
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t n = send(to, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (n <= 0) return false;
      sent += static_cast<std::size_t>(n);
    }
  }
  return true;
}

void TcpRelay::Run() {
  while (!stop_) {
    std::vector<pollfd> fds = {{listener_, POLLIN, 0}};
    for (const Pair& pair : pairs_) {
      fds.push_back({pair.client, POLLIN, 0});
      fds.push_back({pair.server, POLLIN, 0});
    }
    poll(fds.data(), fds.size(), delay_ns_ > 0 ? 1 : 10);
    std::vector<Pair> alive;
    for (std::size_t n = 0; n < pairs_.size(); ++n) {
      Pair& pair = pairs_[n];
      bool ok = !cut_;
      if (ok && fds[1 + 2 * n].revents != 0) ok = Carry(pair.client, pair.server, to_server_, pair);
      if (ok && fds[2 + 2 * n].revents != 0) ok = Carry(pair.server, pair.client, to_client_, pair);
      ok = ok && Deliver(pair);
      if (ok) {
        alive.push_back(std::move(pair));
      } else {
        close(pair.client);
        close(pair.server);
      }
    }
    pairs_ = std::move(alive);
    if (fds[0].revents != 0) Accept();
  }
}

}  // namespace onesea::e2e
