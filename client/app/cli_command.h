#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "client/app/cli_arguments.h"

/// The frame of the `onesea` command: a table of commands, their help, and what becomes of errors.
namespace onesea::app {

/// What every command may read and where it writes.
struct CliContext {
  std::string server;   ///< HOST:PORT
  std::string session;  ///< empty: the server's only one
  bool json = false;
  std::ostream& out;
};

struct CliCommand {
  absl::string_view name;
  absl::string_view operands;       ///< as the usage line shows them: "FILE"
  int operand_count = 0;            ///< exactly so many
  absl::string_view summary;        ///< one line
  absl::string_view details;        ///< paragraphs for --help; may be empty
  std::vector<OptionSpec> options;  ///< beside the common ones
  std::vector<absl::string_view> examples;
  absl::Status (*run)(const CliContext& context, const Arguments& arguments) = nullptr;
};

/// Exit codes, printed by `onesea --help`.
inline constexpr int kExitDone = 0;
inline constexpr int kExitRefused = 1;   ///< the server or a file said no
inline constexpr int kExitUsage = 2;     ///< the command line is wrong
inline constexpr int kExitNoServer = 3;  ///< nobody answers
inline constexpr int kExitOtherSea = 4;  ///< this program's components are not the server's

/// Runs one command line (without the program's name). Answers go to `out`; an error is one line on
/// `err`. `server_default`: where to look for a server when --server is not given.
int RunCli(std::span<const CliCommand> commands, std::span<const std::string> words,
           absl::string_view server_default, std::ostream& out, std::ostream& err);

/// Errors of files, kept apart from Unavailable, which means here that no server answers.
absl::Status FileError(const absl::Status& status);

/// Marks an error as the command line's own (exit code kExitUsage); the others come from the server
/// or from files.
absl::Status UsageError(absl::string_view message);

}  // namespace onesea::app
