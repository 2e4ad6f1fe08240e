// onesea-server: reads its flags, creates the sessions, serves them until it is told to stop.
#include <pthread.h>
#include <signal.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "absl/flags/flag.h"
#include "absl/flags/parse.h"
#include "absl/flags/usage.h"
#include "absl/flags/usage_config.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/strip.h"
#include "common/base/check.h"
#include "common/base/fp_env.h"
#include "common/base/limits.h"
#include "common/sea/fft_fftw.h"
#include "common/wire/session_file.h"
#include "server/app/default_session.h"
#include "server/app/listen_address.h"
#include "server/rpc/rpc_server.h"
#include "server/session/registry.h"

ABSL_FLAG(std::vector<std::string>, session, {},
          "Session file (text form of onesea.v1.SessionSpec); may be given several times. Default: "
          "the storm that buoy 41010 measured. 'none': begin without a session");
ABSL_FLAG(std::string, listen, "127.0.0.1:7310", "HOST:PORT to serve on; port 0: any free one");
ABSL_FLAG(bool, insecure_public, false,
          "Allow --listen addresses that other machines can reach. Nothing is encrypted and nobody "
          "is asked who they are");
ABSL_FLAG(std::string, transform, "own",
          "Fourier transform of probes and queries: own (same bits on every machine) or fftw");
ABSL_FLAG(
    std::string, fftw_wisdom, "",
    "File with FFTW's stored plans, for --transform=fftw; its hash goes into the session's record");
ABSL_FLAG(std::string, measure_fftw_wisdom, "",
          "Measure FFTW's best plans on this machine, write them to this file and exit");
ABSL_FLAG(std::string, log_level, "info", "trace, debug, info, warn, error or off");
ABSL_FLAG(int, watch_threads, 0,
          "Threads that send frames to viewers; 0: one less than the machine's cores");
ABSL_FLAG(bool, print_default_session, false, "Print the default session file and exit");

namespace onesea::server {
namespace {

// Abseil's flags keep the last value only: brings repeated --session together into one list.
std::vector<char*> JoinSessions(int argc, char** argv, std::string& joined) {
  std::vector<char*> rest;
  std::vector<std::string> files;
  for (int n = 0; n < argc; ++n) {
    absl::string_view argument = argv[n];
    if (n > 0 && (argument == "--session" || argument == "-session") && n + 1 < argc) {
      files.push_back(argv[++n]);
    } else if (n > 0 && (absl::ConsumePrefix(&argument, "--session=") ||
                         absl::ConsumePrefix(&argument, "-session="))) {
      files.emplace_back(argument);
    } else {
      rest.push_back(argv[n]);
    }
  }
  if (!files.empty()) {
    joined = absl::StrCat("--session=", absl::StrJoin(files, ","));
    rest.insert(rest.begin() + 1, joined.data());
  }
  return rest;
}

void ParseFlags(int argc, char** argv) {
  absl::SetProgramUsageMessage(
      "Owns seas and serves them to viewers and programs.\n\n"
      "  onesea-server                                  the measured storm on 127.0.0.1:7310\n"
      "  onesea-server --session=FILE --session=FILE2   other seas; deploy/sessions has some");
  absl::FlagsUsageConfig config;
  const auto is_ours = [](absl::string_view file) {
    return absl::EndsWith(file, "server/app/main.cc");
  };
  config.contains_help_flags = is_ours;
  config.contains_helpshort_flags = is_ours;
  absl::SetFlagsUsageConfig(config);
  std::string joined;
  std::vector<char*> arguments = JoinSessions(argc, argv, joined);
  absl::ParseCommandLine(static_cast<int>(arguments.size()), arguments.data());
}

absl::StatusOr<sea::TransformKind> TransformFlag() {
  const std::string name = absl::GetFlag(FLAGS_transform);
  if (name == "own") return sea::TransformKind::kOwn;
  if (name == "fftw") {
    if (sea::TransformAvailable(sea::TransformKind::kFftw)) return sea::TransformKind::kFftw;
    return absl::InvalidArgumentError("--transform=fftw: this program was built without FFTW");
  }
  return absl::InvalidArgumentError(absl::StrCat("--transform=", name, ": is not own or fftw"));
}

absl::Status MeasureFftwWisdom(const std::string& path) {
  if (!sea::TransformAvailable(sea::TransformKind::kFftw)) {
    return absl::InvalidArgumentError("--measure_fftw_wisdom: this program was built without FFTW");
  }
  std::cerr << "measuring FFTW's plans up to " << kGridSizeMax << " x " << kGridSizeMax
            << ": about a minute ..." << std::endl;
  std::ofstream file(path);
  file << sea::FftwTransform::MeasureWisdom(kGridSizeMax);
  file.close();
  if (!file) return absl::PermissionDeniedError(path + ": can't be written");
  return absl::OkStatus();
}

absl::Status UseFftwWisdom(const std::string& path) {
  std::ifstream file(path);
  if (!file) return absl::NotFoundError(absl::StrCat("--fftw_wisdom=", path, ": can't be read"));
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const absl::Status status = sea::FftwTransform::UseWisdom(text);
  return absl::Status(status.code(), status.ok() ? "" : absl::StrCat(path, ": ", status.message()));
}

absl::Status SetLogLevel(const std::string& name) {
  const spdlog::level::level_enum level = spdlog::level::from_str(name);
  if (level == spdlog::level::off && name != "off") {  // what from_str makes of unknown names
    return absl::InvalidArgumentError(
        absl::StrCat("--log_level=", name, ": is none of trace, debug, info, warn, error, off"));
  }
  spdlog::set_level(level);
  return absl::OkStatus();
}

absl::Status PrintDefaultSession() {
  ONESEA_ASSIGN_OR_RETURN(const std::string path, FindDefaultSession());
  std::ifstream file(path);
  std::cout << "# " << path << "\n" << file.rdbuf();
  return absl::OkStatus();
}

absl::StatusOr<std::string> CreateSessions(Registry& registry) {
  std::vector<std::string> files = absl::GetFlag(FLAGS_session);
  if (files.empty()) {
    ONESEA_ASSIGN_OR_RETURN(files.emplace_back(), FindDefaultSession());
  }
  if (files.size() == 1 && files[0] == "none") return "0 sessions";
  std::vector<std::string> names;
  for (const std::string& file : files) {
    ONESEA_ASSIGN_OR_RETURN(SessionSpec spec, wire::ReadSessionFile(file));
    absl::StatusOr<std::shared_ptr<SessionLoop>> session = registry.Create(std::move(spec));
    if (!session.ok()) {
      return absl::Status(session.status().code(),
                          absl::StrCat(file, ": ", session.status().message()));
    }
    const SessionInfo info = (*session)->Info();
    spdlog::info("session {}: '{}', Hs {:.2f} m, {} Hz, components {:016x}", info.name,
                 info.sea_name, info.hs_m, info.tick_rate_hz, info.component_hash);
    names.push_back(info.name);
  }
  return absl::StrCat(names.size(),
                      names.size() == 1 ? " session: " : " sessions: ", absl::StrJoin(names, ", "));
}

// The port in place of a 0 in the address.
std::string BoundAddress(const std::string& listen, int port) {
  if (absl::StartsWith(listen, "unix:")) return listen;
  return absl::StrCat(listen.substr(0, listen.rfind(':')), ":", port);
}

absl::Status Serve(const sigset_t& stop_signals) {
  ONESEA_ASSIGN_OR_RETURN(const sea::TransformKind transform, TransformFlag());
  const std::string listen = absl::GetFlag(FLAGS_listen);
  ONESEA_RETURN_IF_ERROR(CheckListenAddress(listen, absl::GetFlag(FLAGS_insecure_public)));
  if (const absl::Status fp = CheckFpEnvironment(); !fp.ok()) {
    spdlog::warn("other machines may compute another sea: {}", std::string(fp.message()));
  }
  if (const std::string wisdom = absl::GetFlag(FLAGS_fftw_wisdom); !wisdom.empty()) {
    ONESEA_RETURN_IF_ERROR(UseFftwWisdom(wisdom));
  }
  Registry registry(SystemClock(), transform);
  ONESEA_ASSIGN_OR_RETURN(const std::string sessions, CreateSessions(registry));
  ONESEA_ASSIGN_OR_RETURN(const std::unique_ptr<RpcServer> server,
                          RpcServer::Start({.listen_address = listen,
                                            .transform = transform,
                                            .watch_shards = absl::GetFlag(FLAGS_watch_threads)},
                                           registry, SystemClock()));
  std::printf("onesea-server: listening on %s, %s\n", BoundAddress(listen, server->port()).c_str(),
              sessions.c_str());
  std::fflush(stdout);

  int signal = 0;
  sigwait(&stop_signals, &signal);
  spdlog::info("stopping on {}", signal == SIGINT ? "SIGINT" : "SIGTERM");
  server->Shutdown();
  return absl::OkStatus();
}

absl::Status Run(const sigset_t& stop_signals) {
  if (absl::GetFlag(FLAGS_print_default_session)) return PrintDefaultSession();
  const std::string wisdom_path = absl::GetFlag(FLAGS_measure_fftw_wisdom);
  return wisdom_path.empty() ? Serve(stop_signals) : MeasureFftwWisdom(wisdom_path);
}

int Main(int argc, char** argv) {
  ParseFlags(argc, argv);
  spdlog::set_default_logger(spdlog::stderr_color_mt("onesea-server"));
  spdlog::set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
  if (const absl::Status status = SetLogLevel(absl::GetFlag(FLAGS_log_level)); !status.ok()) {
    std::fprintf(stderr, "onesea-server: %s\n", std::string(status.message()).c_str());
    return 1;
  }

  // Before any thread is made, so that all inherit it and only sigwait sees these.
  sigset_t stop_signals;
  sigemptyset(&stop_signals);
  sigaddset(&stop_signals, SIGINT);
  sigaddset(&stop_signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &stop_signals, nullptr);

  const absl::Status status = Run(stop_signals);
  if (status.ok()) return 0;
  std::fprintf(stderr, "onesea-server: %s\n", std::string(status.message()).c_str());
  return 1;
}

}  // namespace
}  // namespace onesea::server

int main(int argc, char** argv) { return onesea::server::Main(argc, argv); }
