#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "client/app/cli_command.h"
#include "client/net/remote_server.h"
#include "common/wire/world_command.h"

/// What the commands on a session's world share.
namespace onesea::app {

/// With a request id of its own and --lease.
wire::CommandHeader HeaderFor(const SessionInfo& session, const Arguments& arguments);

/// The option's number, or `otherwise` where it isn't given.
absl::StatusOr<double> NumberOr(const Arguments& arguments, absl::string_view option,
                                double otherwise, double min, double max);

/// "SESSION: WHAT from tick N", or JSON with the id and the lease that the command gave.
void PrintDone(const CliContext& context, const SessionInfo& session,
               const client::CommandAnswer& answer, absl::string_view what);

}  // namespace onesea::app
