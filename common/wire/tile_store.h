#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "common/wire/tile_codec.h"

namespace onesea::wire {

/// One region as a receiver has it. Arrays are row-major, layout.cells.cells() each.
struct RegionField {
  RegionLayout layout;
  std::vector<float> height_m;
  std::vector<float> foam;  ///< share of the surface, [0, 1]
};

/// The receiving end of TileEncoder. Not thread-safe.
class TileStore {
 public:
  /// Takes over an update; a keyframe replaces everything. InvalidArgument for bytes that no
  /// encoder writes, FailedPrecondition for an update that needs one that is missing; from then on
  /// fields() is stale and every update is refused but a keyframe. Allocates when a region appears.
  absl::Status Apply(const TileUpdate& update, bool keyframe);

  /// Has it a keyframe and everything since?
  bool current() const { return current_; }
  /// In the order of the layout; vanished regions are gone.
  std::span<const RegionField> fields() const { return fields_; }

 private:
  absl::Status ApplyAll(const TileUpdate& update, bool keyframe);
  absl::Status SetLayout(std::span<const RegionLayout> layout);
  void MoveRegion(std::size_t region, const RegionLayout& layout);
  absl::Status ApplyBlob(std::string_view blob);
  absl::Status CheckHeader(const TileBlobHeader& header, const TileGrid& grid) const;
  void ApplyPlanes(const TileBlobHeader& header, TileGroup& group);
  void Show(const TileGrid& grid, const TileGroup& group, int tile, RegionField& field) const;

  std::vector<TileGrid> grids_;
  std::vector<RegionField> fields_;  // same order
  bool current_ = false;
  Unpacker unpacker_;
  std::array<std::uint8_t, kPlaneBytesMax> planes_;
};

}  // namespace onesea::wire
