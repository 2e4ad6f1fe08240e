#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "client/embed/joined_sea.h"
#include "client/net/remote_server.h"
#include "common/base/check.h"
#include "onesea/onesea.h"

namespace onesea {
namespace {

constexpr double kTimeoutMaxS = 3600.0;

absl::StatusOr<std::string> OnlySession(const std::string& address, double timeout_s) {
  client::RemoteServer server(client::ConnectTo(address), std::llround(timeout_s * 1e9));
  ONESEA_ASSIGN_OR_RETURN(const std::vector<SessionInfo> sessions, server.ListSessions());
  if (sessions.size() == 1) return sessions[0].name;
  if (sessions.empty()) return absl::NotFoundError("the server has no session");
  return absl::InvalidArgumentError(
      absl::StrCat("the server has several sessions, name one in JoinOptions::session: ",
                   absl::StrJoin(sessions, ", ", [](std::string* out, const SessionInfo& info) {
                     absl::StrAppend(out, info.name);
                   })));
}

}  // namespace

absl::StatusOr<std::unique_ptr<Sea>> Join(const std::string& address, const JoinOptions& options) {
  if (!(options.timeout_s > 0.0 && options.timeout_s <= kTimeoutMaxS)) {
    return absl::InvalidArgumentError(
        absl::StrFormat("timeout_s is %g, it must be in (0, %g]", options.timeout_s, kTimeoutMaxS));
  }
  ONESEA_RETURN_IF_ERROR(client::ValidateAddress(address));
  std::string session = options.session;
  if (session.empty()) {
    ONESEA_ASSIGN_OR_RETURN(session, OnlySession(address, options.timeout_s));
  }
  auto sea = std::make_unique<client::JoinedSea>(address, session, options);
  ONESEA_RETURN_IF_ERROR(sea->WaitUntilReady(options.timeout_s));
  return sea;
}

}  // namespace onesea
