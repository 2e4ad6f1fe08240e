#include "client/app/cli_command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>
#include <sstream>

namespace onesea::app {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

absl::Status Echo(const CliContext& context, const Arguments& arguments) {
  context.out << context.server << '|' << context.session << '|' << context.json << '|'
              << arguments.operands()[0] << '|' << arguments.Get("loud").value_or("-");
  return absl::OkStatus();
}

absl::Status Refuse(const CliContext& context, const Arguments&) {
  if (context.session == "gone") return absl::UnavailableError("no server");
  if (context.session == "usage") return UsageError("bad word");
  return absl::NotFoundError("first line\nsecond line");
}

const std::vector<CliCommand> kCommands = {{.name = "echo",
                                            .operands = "WORD",
                                            .operand_count = 1,
                                            .summary = "says it again",
                                            .details = "",
                                            .options = {{"loud", "HOW", "how loud"}},
                                            .examples = {"onesea echo hello"},
                                            .run = Echo},
                                           {.name = "refuse",
                                            .operands = "",
                                            .summary = "fails",
                                            .details = "",
                                            .options = {},
                                            .examples = {},
                                            .run = Refuse}};

struct Outcome {
  int code;
  std::string out, err;
};

Outcome RunWords(const std::vector<std::string>& words) {
  std::ostringstream out, err;
  const int code = RunCli(kCommands, words, "default:1", out, err);
  return {code, out.str(), err.str()};
}

TEST(RunCli, CommonOptionsMayStandBeforeOrAfterTheCommand) {
  EXPECT_EQ(RunWords({"echo", "hi"}).out, "default:1||0|hi|-");
  EXPECT_EQ(RunWords({"--server", "h:2", "--json", "echo", "hi"}).out, "h:2||1|hi|-");
  EXPECT_EQ(RunWords({"echo", "--session=s", "hi", "--loud", "very", "--server=h:2"}).out,
            "h:2|s|0|hi|very");
  // A session called like a command is still the value of --session.
  EXPECT_EQ(RunWords({"--session", "echo", "echo", "hi"}).out, "default:1|echo|0|hi|-");
}

TEST(RunCli, WrongWordsAreOneLineAndExitTwo) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"ehco"},
                                             {"echo"},
                                             {"echo", "a", "b"},
                                             {"echo", "--quiet", "a"},
                                             {"--nonsense"},
                                             {"echo", "a", "--loud"},
                                             {"refuse", "--session", "usage"},
                                             {"--loud", "x"}}) {
    const Outcome outcome = RunWords(words);
    EXPECT_EQ(outcome.code, kExitUsage);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  }
  EXPECT_THAT(RunWords({"ehco"}).err, HasSubstr("unknown command 'ehco'; known: echo, refuse"));
  EXPECT_THAT(RunWords({"echo"}).err, HasSubstr("echo takes WORD, not 0 words"));
}

TEST(RunCli, NothingAtAllShowsTheHelpAsAnError) {
  EXPECT_EQ(RunWords({}).code, kExitUsage);
  EXPECT_THAT(RunWords({}).err, HasSubstr("usage: onesea"));
}

TEST(RunCli, HelpListsCommandsOptionsExamplesAndExitCodes) {
  const Outcome program = RunWords({"--help"});
  EXPECT_EQ(program.code, kExitDone);
  EXPECT_THAT(program.out, HasSubstr("says it again"));
  EXPECT_THAT(program.out, HasSubstr("Exit codes: 0 done, 1"));
  const Outcome command = RunWords({"echo", "--help"});
  EXPECT_EQ(command.code, kExitDone);
  EXPECT_THAT(command.out, HasSubstr("--loud HOW"));
  EXPECT_THAT(command.out, HasSubstr("--server HOST:PORT"));
  EXPECT_THAT(command.out, HasSubstr("onesea echo hello"));
}

TEST(RunCli, ErrorsAreOneLineWithTheirExitCode) {
  const Outcome refused = RunWords({"refuse"});
  EXPECT_EQ(refused.code, kExitRefused);
  EXPECT_EQ(refused.err, "onesea: first line second line\n");
  const Outcome alone = RunWords({"refuse", "--session", "gone"});
  EXPECT_EQ(alone.code, kExitNoServer);
  EXPECT_THAT(alone.err, HasSubstr("no server answers at default:1; start one with onesea-server"));
}

}  // namespace
}  // namespace onesea::app
