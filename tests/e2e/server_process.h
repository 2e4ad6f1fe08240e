#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

#include "onesea/v1/onesea.grpc.pb.h"

namespace onesea::e2e {

/// The real onesea-server as a child process on a free loopback port, and plain stubs to ask it.
class ServerProcess {
 public:
  /// Starts the program with `session_file` and waits until it answers; CHECK-fails after 30 s.
  explicit ServerProcess(std::string session_file);
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  const std::string& address() const { return address_; }

  /// As a crash would: no farewell to anybody.
  void Kill();
  /// Starts again on the same port, after Kill().
  void Start();

  /// Stubs over a channel of its own, so that nothing of client/net takes part.
  v1::OneSea::Stub& stub() { return *stub_; }
  /// Name of the only session.
  std::string SessionName();
  /// The server's heights at sea time `time_s`. CHECK-fails on errors.
  v1::QueryPointsResponse Query(double x_m, double y_m, double time_s);

 private:
  void WaitUntilItAnswers();

  std::string session_file_;
  std::string address_;
  pid_t pid_ = -1;
  std::unique_ptr<v1::OneSea::Stub> stub_;
};

}  // namespace onesea::e2e
