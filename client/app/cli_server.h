#pragma once

#include <memory>

#include "absl/status/statusor.h"
#include "client/app/cli_command.h"
#include "client/net/remote_server.h"
#include "onesea/onesea.h"

/// How commands find their server and session.
namespace onesea::app {

/// The server's calls; it connects at the first. A usage error if --server isn't HOST:PORT.
absl::StatusOr<std::unique_ptr<client::RemoteServer>> ConnectTo(const CliContext& context);

struct ChosenSession {
  std::unique_ptr<client::RemoteServer> server;
  SessionInfo info;
};

/// The session that --session names, or the server's only one. NotFound with the names that there
/// are; Unavailable.
absl::StatusOr<ChosenSession> ChooseSession(const CliContext& context);

/// Joins as a game would; `world`: with wakes and bodies.
absl::StatusOr<std::unique_ptr<Sea>> JoinSession(const CliContext& context,
                                                 const std::string& session, bool world);

/// Errors of ParseNumber() and its kin, marked as the command line's own.
template <typename T>
absl::StatusOr<T> InUsage(absl::StatusOr<T> result) {
  if (result.ok()) return result;
  return UsageError(result.status().message());
}

}  // namespace onesea::app
