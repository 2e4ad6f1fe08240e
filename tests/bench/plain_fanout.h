#pragma once

#include <cstdint>
#include <string>

#include "tests/bench/light_viewer.h"

/// The least that a fan-out can cost: the same number of bytes to the same number of sockets, no
/// protocol.
namespace onesea::bench {

/// Serves every connection one frame of `frame_bytes` at `rate_hz` until `stop_pipe` ends.
void ServePlainFanout(int frame_bytes, int rate_hz, int port_pipe, int stop_pipe);

/// Reads such frames.
class PlainViewer {
 public:
  explicit PlainViewer(int frame_bytes) : frame_bytes_(frame_bytes) {}
  ~PlainViewer();
  PlainViewer(PlainViewer&& other) noexcept;

  bool Open(int port);
  int fd() const { return fd_; }
  std::int64_t bytes() const { return bytes_; }

  template <typename Seen>
  bool OnReadable(Seen seen) {
    if (!Receive()) return false;
    FrameSeen frame;
    while (Take(&frame)) seen(frame);
    return true;
  }

 private:
  bool Receive();
  bool Take(FrameSeen* out);

  int frame_bytes_;
  int fd_ = -1;
  std::int64_t bytes_ = 0;
  std::string in_;
};

}  // namespace onesea::bench
