#include "common/wire/tile_codec.h"

#include <bit>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/wire/byte_reader.h"

namespace onesea::wire {
namespace {

constexpr unsigned kAllTiles = (1U << kGroupTiles) - 1;

std::uint8_t Nibbles(unsigned low, unsigned high) {
  return static_cast<std::uint8_t>(low | (high << kGroupTiles));
}

absl::Status Malformed(std::string_view what) {
  return absl::InvalidArgumentError(
      absl::StrCat("tile blob: ", absl::string_view(what.data(), what.size())));
}

}  // namespace

std::size_t TileBlobHeader::PlaneBytes() const {
  const auto heights_bytes = static_cast<std::size_t>(2 * std::popcount(heights)) * kTileCells;
  return heights_bytes + static_cast<std::size_t>(std::popcount(foams)) * kTileCells;
}

void AppendHeader(const TileBlobHeader& header, std::string& out) {
  AppendVarint(header.region, out);
  AppendSigned(header.i, out);
  AppendSigned(header.j, out);
  out.push_back(static_cast<char>(Nibbles(header.heights, header.foams)));
  out.push_back(static_cast<char>(Nibbles(header.calm_heights, header.calm_foams)));
  if (header.heights == 0) return;
  unsigned predictions = 0;
  for (int tile = 0; tile < kGroupTiles; ++tile) {
    predictions |= static_cast<unsigned>(header.predictions[tile]) << (2 * tile);
  }
  out.push_back(static_cast<char>(predictions));
  for (int tile = 0; tile < kGroupTiles; ++tile) {
    if (header.predictions[tile] != Prediction::kFitted) continue;
    const WaveFit& fit = header.fits[tile];
    for (const std::int8_t part : {fit.a, fit.b, fit.c}) out.push_back(static_cast<char>(part));
  }
}

absl::StatusOr<TileBlobHeader> ReadHeader(std::string_view blob, std::string_view& rest) {
  ByteReader reader(blob);
  TileBlobHeader header;
  const std::uint64_t region = reader.Varint();
  header.i = reader.Signed();
  header.j = reader.Signed();
  const unsigned present = reader.Byte(), calm = reader.Byte();
  header.heights = present & kAllTiles;
  header.foams = static_cast<std::uint8_t>(present >> kGroupTiles);
  header.calm_heights = calm & kAllTiles;
  header.calm_foams = static_cast<std::uint8_t>(calm >> kGroupTiles);
  const unsigned predictions = header.heights != 0 ? reader.Byte() : 0;
  for (int tile = 0; tile < kGroupTiles; ++tile) {
    header.predictions[tile] = static_cast<Prediction>((predictions >> (2 * tile)) & 3);
    if (header.predictions[tile] != Prediction::kFitted) continue;
    WaveFit& fit = header.fits[tile];
    for (std::int8_t* part : {&fit.a, &fit.b, &fit.c}) {
      *part = static_cast<std::int8_t>(reader.Byte());
    }
  }
  if (!reader.ok()) return Malformed("ends within its header");
  if (region == 0 || region > UINT32_MAX) return Malformed("no such region id");
  header.region = static_cast<std::uint32_t>(region);
  if ((present & calm) != 0) return Malformed("a tile is calm and changed at once");
  for (int tile = 0; tile < kGroupTiles; ++tile) {
    const Prediction prediction = header.predictions[tile];
    const bool follows = (header.heights >> tile & 1) != 0;
    if (prediction > Prediction::kSpatial || (prediction != Prediction::kHold && !follows)) {
      return Malformed("no such prediction");
    }
  }
  rest = reader.rest();
  if (header.PlaneBytes() == 0 && !rest.empty()) return Malformed("bytes after the end");
  return header;
}

}  // namespace onesea::wire
