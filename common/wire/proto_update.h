#pragma once

#include "absl/status/statusor.h"
#include "common/wire/world_update.h"
#include "onesea/v1/world.pb.h"

/// Domain <-> proto of WorldUpdate. Only common/wire, server/rpc and client/net include this.
namespace onesea::wire {

void ToProto(const WorldUpdate& update, v1::WorldUpdate* out);

/// Checks sizes, ids, numbers; the packed parts (tiles, states) are checked by TileStore and
/// BodyTable, which know what came before.
absl::StatusOr<WorldUpdate> FromProto(const v1::WorldUpdate& proto);

}  // namespace onesea::wire
