#pragma once

#include <grpcpp/support/server_callback.h>

#include <memory>

#include "absl/status/status.h"
#include "common/wire/terrain_pieces.h"
#include "onesea/v1/terrain.pb.h"

namespace onesea::server {

/// Sends a terrain piece by piece, each when the one before is on its way. Owns itself.
class TerrainWriter final : public grpc::ServerWriteReactor<v1::GetTerrainResponse> {
 public:
  explicit TerrainWriter(std::shared_ptr<const wire::EncodedTerrain> terrain);
  /// Ends the call at once.
  explicit TerrainWriter(const absl::Status& refusal);

 private:
  void OnWriteDone(bool ok) override;
  void OnDone() override { delete this; }
  void WriteNext();

  std::shared_ptr<const wire::EncodedTerrain> terrain_;
  std::size_t offset_ = 0;
  v1::GetTerrainResponse piece_;
};

}  // namespace onesea::server
