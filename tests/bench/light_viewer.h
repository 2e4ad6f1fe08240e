#pragma once

#include <cstdint>
#include <string>

#include "onesea/v1/frame.pb.h"

namespace onesea::bench {

/// What a crowd of viewers saw, for one frame each.
struct FrameSeen {
  std::int64_t sequence = 0;
  std::int64_t due_ns = 0;  ///< when the tick was due, machine's monotonic clock
};

/// A viewer with just enough HTTP/2 to watch one session: one socket, one stream, no library, so
/// that thousands of them leave the machine to the server. Reads are driven from outside (epoll).
/// Understands what gRPC servers send; does not decode header blocks (it needs none), and gives up
/// on anything unexpected.
class LightViewer {
 public:
  LightViewer() = default;
  ~LightViewer();
  LightViewer(LightViewer&& other) noexcept;

  /// Connects to 127.0.0.1:`port` and opens Watch. False if that fails.
  bool Open(int port, const std::string& session, bool every_frame);
  int fd() const { return fd_; }

  /// Takes what the socket has. Calls `seen` for each frame, acknowledges every fourth. False when
  /// the stream is over.
  template <typename Seen>
  bool OnReadable(Seen seen) {
    if (!Receive()) return false;
    FrameSeen frame;
    while (NextMessage(&frame)) seen(frame);
    return !broken_;
  }

  std::int64_t bytes() const { return bytes_; }
  const std::string& trouble() const { return trouble_; }

 private:
  bool Receive();
  // Works through HTTP/2 frames until a whole gRPC message is there.
  bool NextMessage(FrameSeen* out);
  bool TakeMessage(FrameSeen* out);
  void OnHttpFrame(std::uint8_t type, std::uint8_t flags, const char* payload, std::size_t size);
  void GiveBackWindow(std::size_t size);
  void SendMessage(const v1::WatchRequest& request);
  void SendAll(const std::string& bytes);
  void Fail(const std::string& why);

  int fd_ = -1;
  std::string in_;  // bytes of HTTP/2, not yet whole frames
  std::size_t in_at_ = 0;
  std::string messages_;  // payload of DATA, not yet whole messages
  std::size_t window_owed_ = 0;
  int unacknowledged_ = 0;
  std::int64_t bytes_ = 0;
  bool broken_ = false;
  std::string trouble_;
  v1::WatchResponse response_;
};

}  // namespace onesea::bench
