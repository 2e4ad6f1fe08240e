#pragma once

#include <cstdint>

#include "absl/status/statusor.h"
#include "client/app/cli_arguments.h"
#include "client/app/cli_command.h"
#include "client/net/remote_server.h"

/// What the commands on a session's world share.
namespace onesea::app {

/// With a request id of its own, and the lease that --lease shows.
wire::CommandHeader HeaderFor(const SessionInfo& session, const Arguments& arguments);

/// Of a body, a rope, a wall, a region. A usage error naming `what` if it is none.
absl::StatusOr<std::uint32_t> ParseId(absl::string_view what, absl::string_view text);
/// The first operand, an id. A usage error if it is none.
absl::StatusOr<std::uint32_t> BodyOperand(const Arguments& arguments);
/// Of `--option N`. A usage error if it is no number or outside [min, max].
absl::StatusOr<double> NumberOr(const Arguments& arguments, absl::string_view option,
                                double otherwise, double min, double max);
/// Of `--at X,Y`. A usage error if it is missing.
absl::StatusOr<Vec2d> PlaceOption(const Arguments& arguments);

/// Of `--option ID`; 0 where it isn't given. A usage error if it is none.
absl::StatusOr<std::uint32_t> IdOption(const Arguments& arguments, absl::string_view option);

/// Gives the command to the chosen session and prints what is done; `$0` in `what` is the answer's
/// id.
absl::Status DoCommand(const CliContext& context, const Arguments& arguments,
                       const wire::WorldCommand& command, absl::string_view what);

void PrintDone(const CliContext& context, const SessionInfo& session,
               const client::CommandAnswer& answer, absl::string_view what);

}  // namespace onesea::app
