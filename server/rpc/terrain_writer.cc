#include "server/rpc/terrain_writer.h"

#include <utility>

#include "server/rpc/status_map.h"

namespace onesea::server {

TerrainWriter::TerrainWriter(std::shared_ptr<const wire::EncodedTerrain> terrain)
    : terrain_(std::move(terrain)) {
  WriteNext();
}

TerrainWriter::TerrainWriter(const absl::Status& refusal) { Finish(ToGrpc(refusal)); }

void TerrainWriter::WriteNext() {
  if (offset_ == terrain_->bytes.size()) return Finish(grpc::Status::OK);
  const wire::TerrainPiece piece = wire::PieceAt(*terrain_, offset_);
  piece_.set_total_bytes(piece.total_bytes);
  piece_.set_hash(piece.hash);
  piece_.set_piece(piece.bytes.data(), piece.bytes.size());
  offset_ += piece.bytes.size();
  StartWrite(&piece_);
}

void TerrainWriter::OnWriteDone(bool ok) {
  if (!ok) return Finish(grpc::Status(grpc::StatusCode::CANCELLED, "the receiver went away"));
  WriteNext();
}

}  // namespace onesea::server
