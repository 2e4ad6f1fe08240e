#include "client/app/cli_command.h"

#include <algorithm>
#include <ostream>

#include "absl/strings/cord.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "client/model/other_sea.h"

namespace onesea::app {
namespace {

constexpr absl::string_view kUsageMark = "onesea.app/usage";

const std::vector<OptionSpec>& CommonOptions() {
  static const auto& options = *new std::vector<OptionSpec>{
      {"server", "HOST:PORT", "where the server listens"},
      {"session", "NAME", "which session; default: the server's only one"},
      {"json", "", "answer in JSON, one object a line, for programs"},
      {"help", "", "show this"},
  };
  return options;
}

void PrintOptions(std::span<const OptionSpec> options, std::ostream& out) {
  for (const OptionSpec& option : options) {
    std::string usage = absl::StrCat("--", option.name);
    if (!option.placeholder.empty()) absl::StrAppend(&usage, " ", option.placeholder);
    out << absl::StreamFormat("  %-20s  %s\n", usage, option.help);
  }
}

void PrintProgramHelp(std::span<const CliCommand> commands, absl::string_view server_default,
                      std::ostream& out) {
  out << "onesea: asks and steers a server of one sea\n\n"
         "usage: onesea [--server HOST:PORT] [--session NAME] [--json] COMMAND ...\n\ncommands:\n";
  for (const CliCommand& command : commands) {
    out << absl::StreamFormat("  %-10s  %s\n", command.name, command.summary);
  }
  out << "\nonesea COMMAND --help shows a command's options and examples.\n\noptions:\n";
  PrintOptions(CommonOptions(), out);
  out << "\nWithout --server: " << server_default
      << " (the environment's ONESEA_SERVER, or 127.0.0.1:7310).\n"
         "Exit codes: 0 done, 1 the server or a file refused, 2 the command line is wrong,\n"
         "3 no server answers, 4 this program would compute another sea than the server.\n";
}

void PrintCommandHelp(const CliCommand& command, std::ostream& out) {
  out << "onesea " << command.name << ": " << command.summary << "\n\nusage: onesea "
      << command.name;
  if (!command.operands.empty()) out << ' ' << command.operands;
  out << " [options]\n";
  if (!command.details.empty()) out << '\n' << command.details << '\n';
  out << "\noptions:\n";
  PrintOptions(command.options, out);
  PrintOptions(CommonOptions(), out);
  out << "\nexamples:\n";
  for (const absl::string_view example : command.examples) out << "  " << example << '\n';
}

// Common options may stand before the command; its place is the first word that is neither an
// option nor the value of one.
std::size_t FindCommand(std::span<const std::string> words) {
  std::size_t n = 0;
  while (n < words.size() && absl::StartsWith(words[n], "-")) {
    const bool takes_next = std::ranges::any_of(CommonOptions(), [&](const OptionSpec& option) {
      return !option.placeholder.empty() && words[n] == absl::StrCat("--", option.name);
    });
    n += takes_next ? 2 : 1;
  }
  return n;
}

int ExitCodeOf(const absl::Status& status) {
  if (status.ok()) return kExitDone;
  if (status.GetPayload(kUsageMark).has_value()) return kExitUsage;
  if (absl::IsUnavailable(status)) return kExitNoServer;
  if (client::IsOtherSea(status)) return kExitOtherSea;
  return kExitRefused;
}

int Fail(const absl::Status& status, std::ostream& err) {
  err << "onesea: " << absl::StrReplaceAll(status.message(), {{"\n", " "}}) << '\n';
  return ExitCodeOf(status);
}

absl::StatusOr<Arguments> ParseFor(const CliCommand* command, std::span<const std::string> words) {
  std::vector<OptionSpec> options = CommonOptions();
  if (command != nullptr) {
    options.insert(options.end(), command->options.begin(), command->options.end());
  }
  absl::StatusOr<Arguments> arguments = ParseArguments(options, words);
  if (!arguments.ok()) return UsageError(arguments.status().message());
  return arguments;
}

absl::Status RunCommand(const CliCommand& command, const Arguments& arguments,
                        absl::string_view server_default, std::ostream& out) {
  if (arguments.Has("help")) {
    PrintCommandHelp(command, out);
    return absl::OkStatus();
  }
  const int operand_count = static_cast<int>(arguments.operands().size());
  if (operand_count != command.operand_count) {
    return UsageError(absl::StrFormat(
        "%s takes %s, not %d words; see onesea %s --help", command.name,
        command.operands.empty() ? "no operand" : command.operands, operand_count, command.name));
  }
  const CliContext context{.server = arguments.Get("server").value_or(std::string(server_default)),
                           .session = arguments.Get("session").value_or(""),
                           .json = arguments.Has("json"),
                           .out = out};
  absl::Status status = command.run(context, arguments);
  if (!absl::IsUnavailable(status)) return status;
  return absl::UnavailableError(absl::StrFormat(
      "no server answers at %s; start one with onesea-server, or name another with --server (%s)",
      context.server, status.message()));
}

}  // namespace

absl::Status UsageError(absl::string_view message) {
  absl::Status status = absl::InvalidArgumentError(message);
  status.SetPayload(kUsageMark, absl::Cord());
  return status;
}

absl::Status FileError(const absl::Status& status) {
  return absl::IsUnavailable(status) ? absl::UnknownError(status.message()) : status;
}

int RunCli(std::span<const CliCommand> commands, std::span<const std::string> words,
           absl::string_view server_default, std::ostream& out, std::ostream& err) {
  const std::size_t place = FindCommand(words);
  if (place >= words.size()) {
    const absl::StatusOr<Arguments> arguments = ParseFor(nullptr, words);
    if (!arguments.ok()) return Fail(arguments.status(), err);
    PrintProgramHelp(commands, server_default, arguments->Has("help") ? out : err);
    return arguments->Has("help") ? kExitDone : kExitUsage;
  }
  const auto command = std::ranges::find(commands, words[place], &CliCommand::name);
  if (command == commands.end()) {
    const std::string known = absl::StrJoin(
        commands, ", ",
        [](std::string* text, const CliCommand& known) { absl::StrAppend(text, known.name); });
    return Fail(UsageError(absl::StrCat("unknown command '", words[place], "'; known: ", known,
                                        "; see onesea --help")),
                err);
  }
  std::vector<std::string> rest(words.begin(), words.begin() + place);
  rest.insert(rest.end(), words.begin() + place + 1, words.end());
  const absl::StatusOr<Arguments> arguments = ParseFor(&*command, rest);
  if (!arguments.ok()) return Fail(arguments.status(), err);
  const absl::Status status = RunCommand(*command, *arguments, server_default, out);
  return status.ok() ? kExitDone : Fail(status, err);
}

}  // namespace onesea::app
