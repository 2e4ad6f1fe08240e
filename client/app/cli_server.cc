#include "client/app/cli_server.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "common/base/check.h"

namespace onesea::app {

absl::StatusOr<std::unique_ptr<client::RemoteServer>> ConnectTo(const CliContext& context) {
  const absl::Status valid = client::ValidateAddress(context.server);
  if (!valid.ok()) return UsageError(absl::StrCat("--server: ", valid.message()));
  return std::make_unique<client::RemoteServer>(client::ConnectTo(context.server));
}

absl::StatusOr<ChosenSession> ChooseSession(const CliContext& context) {
  ChosenSession chosen;
  ONESEA_ASSIGN_OR_RETURN(chosen.server, ConnectTo(context));
  ONESEA_ASSIGN_OR_RETURN(const std::vector<SessionInfo> sessions, chosen.server->ListSessions());
  const std::string names = absl::StrJoin(
      sessions, ", ",
      [](std::string* out, const SessionInfo& info) { absl::StrAppend(out, info.name); });
  if (sessions.empty()) {
    return absl::NotFoundError(absl::StrFormat(
        "the server at %s has no session; create one with: onesea create FILE", context.server));
  }
  if (context.session.empty() && sessions.size() > 1) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "there are %d sessions (%s): choose one with --session NAME", sessions.size(), names));
  }
  const auto found = context.session.empty()
                         ? sessions.begin()
                         : std::ranges::find(sessions, context.session, &SessionInfo::name);
  if (found == sessions.end()) {
    return absl::NotFoundError(
        absl::StrFormat("no session '%s'; there are: %s", context.session, names));
  }
  chosen.info = *found;
  return chosen;
}

absl::StatusOr<std::unique_ptr<Sea>> JoinSession(const CliContext& context,
                                                 const std::string& session, bool world) {
  JoinOptions options;
  options.world = world;
  options.session = session;
  options.client_name = "onesea";
  return Join(context.server, options);
}

}  // namespace onesea::app
