#include <ostream>
#include <random>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/substitute.h"
#include "client/app/cli_server.h"
#include "client/app/cli_world.h"
#include "client/app/json_writer.h"
#include "common/base/check.h"

namespace onesea::app {

wire::CommandHeader HeaderFor(const SessionInfo& session, const Arguments& arguments) {
  std::random_device random;
  return {.session = session.name,
          .request_id = absl::StrFormat("cli-%08x%08x", random(), random()),
          .tick = std::nullopt,
          .lease = arguments.Get("lease").value_or("")};
}

absl::StatusOr<std::uint32_t> ParseId(absl::string_view what, absl::string_view text) {
  ONESEA_ASSIGN_OR_RETURN(const std::int64_t id, InUsage(ParseInteger(what, text, 1, 0xffffffff)));
  return static_cast<std::uint32_t>(id);
}

absl::StatusOr<std::uint32_t> BodyOperand(const Arguments& arguments) {
  return ParseId("BODY", arguments.operands()[0]);
}

absl::StatusOr<double> NumberOr(const Arguments& arguments, absl::string_view option,
                                double otherwise, double min, double max) {
  const std::optional<std::string> text = arguments.Get(option);
  if (!text) return otherwise;
  return InUsage(ParseNumber(absl::StrCat("--", option), *text, min, max));
}

absl::StatusOr<Vec2d> PlaceOption(const Arguments& arguments) {
  const std::optional<std::string> text = arguments.Get("at");
  if (!text) return UsageError("--at X,Y is needed, metres east and north");
  return InUsage(ParsePlace("--at", *text));
}

absl::StatusOr<std::uint32_t> IdOption(const Arguments& arguments, absl::string_view option) {
  const std::optional<std::string> text = arguments.Get(option);
  if (!text) return 0;
  return ParseId(absl::StrCat("--", option), *text);
}

absl::Status DoCommand(const CliContext& context, const Arguments& arguments,
                       const wire::WorldCommand& command, absl::string_view what) {
  ONESEA_ASSIGN_OR_RETURN(const ChosenSession chosen, ChooseSession(context));
  ONESEA_ASSIGN_OR_RETURN(const client::CommandAnswer answer,
                          chosen.server->Command(HeaderFor(chosen.info, arguments), command));
  PrintDone(context, chosen.info, answer, absl::Substitute(what, answer.id));
  return absl::OkStatus();
}

void PrintDone(const CliContext& context, const SessionInfo& session,
               const client::CommandAnswer& answer, absl::string_view what) {
  if (context.json) {
    JsonWriter json;
    json.BeginObject().Key("session").Value(session.name).Key("tick").Value(answer.tick);
    json.Key("id").Value(static_cast<std::int64_t>(answer.id)).Key("lease").Value(answer.lease);
    context.out << json.EndObject().text() << '\n';
    return;
  }
  context.out << session.name << ": " << what << " from tick " << answer.tick << '\n';
}

}  // namespace onesea::app
