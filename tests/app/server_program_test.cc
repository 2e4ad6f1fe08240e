// The program as a person meets it: starts, says that it is ready, stops when told, explains what
// is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using ::testing::HasSubstr;

// onesea-server with arguments; standard output and error come together in one pipe.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments) {
    std::array<int, 2> ends;
    EXPECT_EQ(pipe(ends.data()), 0);
    arguments.insert(arguments.begin(), ONESEA_SERVER_PROGRAM);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      dup2(ends[1], STDERR_FILENO);
      close(ends[0]);
      close(ends[1]);
      execv(argv[0], argv.data());
      _exit(127);
    }
    close(ends[1]);
    output_ = fdopen(ends[0], "r");
  }
  ~Program() {
    if (pid_ > 0) Stop(SIGKILL);
    std::fclose(output_);
  }

  // The next line that holds `text`; empty at the end of the output.
  std::string ReadLineWith(const std::string& text) {
    std::array<char, 4096> line;
    while (std::fgets(line.data(), line.size(), output_) != nullptr) {
      if (std::string(line.data()).find(text) != std::string::npos) return line.data();
    }
    return "";
  }
  std::string ReadAll() {
    std::string all;
    std::array<char, 4096> line;
    while (std::fgets(line.data(), line.size(), output_) != nullptr) all += line.data();
    return all;
  }
  // Exit code, or -1 if it was killed.
  int Stop(int signal) {
    kill(pid_, signal);
    return Wait();
  }
  int Wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  pid_t pid_ = 0;
  FILE* output_ = nullptr;
};

TEST(ServerProgram, StartsSaysSoAndStopsWhenTold) {
  for (int signal : {SIGTERM, SIGINT}) {
    Program server({"--listen=127.0.0.1:0", "--session", "deploy/sessions/tank.textproto",
                    "--session=deploy/sessions/calm-swell.textproto"});
    EXPECT_THAT(server.ReadLineWith("listening on"), HasSubstr("2 sessions: tank, calm-swell"));
    EXPECT_EQ(server.Stop(signal), 0);
    EXPECT_THAT(server.ReadAll(), HasSubstr("stopping on SIG"));
  }
}

TEST(ServerProgram, TheDefaultSessionIsTheMeasuredStorm) {
  Program server({"--listen=127.0.0.1:0"});
  EXPECT_THAT(server.ReadLineWith("listening on"), HasSubstr("1 session: storm-41010"));
  EXPECT_EQ(server.Stop(SIGTERM), 0);
  Program printer({"--print_default_session"});
  EXPECT_THAT(printer.ReadAll(), HasSubstr("name: \"storm-41010\""));
  EXPECT_EQ(printer.Wait(), 0);
}

TEST(ServerProgram, ExplainsWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"--session=no/such/file", "no/such/file: "},
      {"--listen=0.0.0.0:0", "--insecure_public"},
      {"--listen=nowhere", "is not HOST:PORT"},
      {"--transform=dft", "--transform=dft: is not own or fftw"},
      {"--log_level=loud", "--log_level=loud: is none of"},
  };
  for (const auto& [argument, message] : cases) {
    Program server({argument});
    EXPECT_THAT(server.ReadAll(), HasSubstr(message));
    EXPECT_EQ(server.Wait(), 1) << argument;
  }
}

}  // namespace
