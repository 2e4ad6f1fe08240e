#pragma once

#include <cstdint>
#include <functional>

namespace onesea::bench {

/// A server in a process of its own, so that its CPU time can be told from the load generator's.
/// Start before any thread exists.
class Child {
 public:
  /// `serve(port_pipe, stop_pipe)` runs in the child: it writes its port (an int) and returns when
  /// stop_pipe ends.
  explicit Child(const std::function<void(int port_pipe, int stop_pipe)>& serve);
  /// Ends the child and waits for it.
  ~Child();

  /// Waits for the child to listen; 0 if it never does.
  int port();
  /// User and system time of the child so far.
  double CpuSeconds() const;

 private:
  int pid_ = -1;
  int port_pipe_ = -1;
  int stop_pipe_ = -1;
  int port_ = -1;
};

}  // namespace onesea::bench
