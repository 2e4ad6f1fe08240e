#include "tests/bench/child.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"

namespace onesea::bench {

Child::Child(const std::function<void(int port_pipe, int stop_pipe)>& serve) {
  int port_pipe[2], stop_pipe[2];
  ONESEA_CHECK(pipe(port_pipe) == 0 && pipe(stop_pipe) == 0);
  pid_ = fork();
  ONESEA_CHECK(pid_ >= 0);
  if (pid_ == 0) {
    close(port_pipe[0]);
    close(stop_pipe[1]);
    serve(port_pipe[1], stop_pipe[0]);
    _exit(0);
  }
  close(port_pipe[1]);
  close(stop_pipe[0]);
  port_pipe_ = port_pipe[0];
  stop_pipe_ = stop_pipe[1];
}

Child::~Child() {
  close(stop_pipe_);
  waitpid(pid_, nullptr, 0);
  close(port_pipe_);
}

int Child::port() {
  if (port_ < 0 && read(port_pipe_, &port_, sizeof(port_)) != sizeof(port_)) port_ = 0;
  return port_;
}

double Child::CpuSeconds() const {
  // Fields 14 and 15 of /proc/PID/stat; the name in field 2 may hold spaces, so count from its end.
  std::ifstream file(absl::StrCat("/proc/", pid_, "/stat"));
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::istringstream after_name(text.substr(text.rfind(')') + 1));
  std::string skipped;
  for (int field = 3; field < 14; ++field) after_name >> skipped;
  double user = 0.0, system = 0.0;
  after_name >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace onesea::bench
