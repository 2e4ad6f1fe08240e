#include "common/wire/terrain_codec.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/base/limits.h"
#include "common/base/range_check.h"
#include "common/wire/zstd_pack.h"
#include "onesea/v1/terrain.pb.h"

namespace onesea::wire {
namespace {

constexpr int kPackLevel = 6;  // sent once; a few per cent smaller than level 1
constexpr int kStepsPerM[] = {1, 10, 100, 1000};
constexpr int kBytesPerSample = 4;

// Floats in the order of their values, so that neighbours have close numbers.
std::uint32_t FromFloat(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits >> 31) != 0 ? ~bits : bits | 0x80000000u;
}
float ToFloat(std::uint32_t number) {
  return std::bit_cast<float>((number >> 31) != 0 ? number & 0x7FFFFFFFu : ~number);
}

float FromSteps(std::uint32_t number, int steps_per_m) {
  return static_cast<float>(static_cast<std::int32_t>(number) / static_cast<double>(steps_per_m));
}

// The number of steps, if it gives back the value.
bool ToSteps(float value, int steps_per_m, std::uint32_t& number) {
  number = static_cast<std::uint32_t>(
      static_cast<std::int32_t>(std::lround(double{value} * steps_per_m)));
  return FromSteps(number, steps_per_m) == value;
}

bool AllToSteps(const std::vector<float>& values, int steps_per_m,
                std::vector<std::uint32_t>& numbers) {
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!ToSteps(values[n], steps_per_m, numbers[n])) return false;
  }
  return true;
}

// What the neighbours to the west, south and south-west let expect; beyond the grid they are 0.
std::uint32_t Expected(const std::vector<std::uint32_t>& numbers, int columns, int i, int j) {
  const std::size_t at = static_cast<std::size_t>(j) * columns + i;
  const std::uint32_t west = i > 0 ? numbers[at - 1] : 0;
  const std::uint32_t south = j > 0 ? numbers[at - columns] : 0;
  const std::uint32_t corner = i > 0 && j > 0 ? numbers[at - columns - 1] : 0;
  return west + south - corner;
}

std::uint32_t ZigZag32(std::uint32_t difference) {
  return (difference << 1) ^ (0u - (difference >> 31));
}
std::uint32_t UnZigZag32(std::uint32_t folded) { return (folded >> 1) ^ (0u - (folded & 1u)); }

absl::Status CheckGeometry(const v1::Terrain& message) {
  for (const auto& [name, value] : {std::pair("terrain.columns", message.columns()),
                                    std::pair("terrain.rows", message.rows())}) {
    if (absl::Status s = CheckInRange(name, value, 2, kTerrainSideMax); !s.ok()) return s;
  }
  if (message.steps_per_m() == 0) return absl::OkStatus();
  for (const int steps_per_m : kStepsPerM) {
    if (message.steps_per_m() == steps_per_m) return absl::OkStatus();
  }
  return absl::InvalidArgumentError(
      absl::StrCat("terrain.steps_per_m = ", message.steps_per_m(), " is not 0, 1, 10, 100, 1000"));
}

}  // namespace

std::string EncodeTerrain(const sea::Terrain& terrain) {
  ONESEA_CHECK(sea::ValidateTerrain(terrain).ok()) << sea::ValidateTerrain(terrain).message();
  v1::Terrain message;
  message.set_west_m(terrain.west_m);
  message.set_south_m(terrain.south_m);
  message.set_cell_m(terrain.cell_m);
  message.set_columns(terrain.columns);
  message.set_rows(terrain.rows);
  message.set_hash(sea::TerrainHash(terrain));
  const std::size_t samples = terrain.elevation_m.size();
  std::vector<std::uint32_t> numbers(samples);
  for (const int steps_per_m : kStepsPerM) {
    if (!AllToSteps(terrain.elevation_m, steps_per_m, numbers)) continue;
    message.set_steps_per_m(steps_per_m);
    break;
  }
  if (message.steps_per_m() == 0) {
    for (std::size_t n = 0; n < samples; ++n) numbers[n] = FromFloat(terrain.elevation_m[n]);
  }
  std::vector<std::uint8_t> planes(kBytesPerSample * samples);
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) {
      const std::size_t at = static_cast<std::size_t>(j) * terrain.columns + i;
      const std::uint32_t folded = ZigZag32(numbers[at] - Expected(numbers, terrain.columns, i, j));
      for (int b = 0; b < kBytesPerSample; ++b) {
        planes[b * samples + at] = static_cast<std::uint8_t>(folded >> (8 * b));
      }
    }
  }
  Packer(kPackLevel).Append(planes, *message.mutable_samples());
  return message.SerializeAsString();
}

absl::StatusOr<sea::Terrain> DecodeTerrain(std::string_view bytes) {
  v1::Terrain message;
  if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    return absl::DataLossError("terrain: the bytes are no onesea.v1.Terrain");
  }
  if (absl::Status s = CheckGeometry(message); !s.ok()) return s;
  sea::Terrain terrain = {.west_m = message.west_m(),
                          .south_m = message.south_m(),
                          .cell_m = message.cell_m(),
                          .columns = message.columns(),
                          .rows = message.rows(),
                          .elevation_m = {}};
  const std::size_t samples = static_cast<std::size_t>(terrain.columns) * terrain.rows;
  std::vector<std::uint8_t> planes(kBytesPerSample * samples);
  if (absl::Status s = Unpacker().Fill(message.samples(), planes); !s.ok()) {
    return absl::DataLossError(absl::StrCat("terrain.samples: ", s.message()));
  }
  std::vector<std::uint32_t> numbers(samples);
  terrain.elevation_m.resize(samples);
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) {
      const std::size_t at = static_cast<std::size_t>(j) * terrain.columns + i;
      std::uint32_t folded = 0;
      for (int b = 0; b < kBytesPerSample; ++b) {
        folded |= std::uint32_t{planes[b * samples + at]} << (8 * b);
      }
      numbers[at] = UnZigZag32(folded) + Expected(numbers, terrain.columns, i, j);
      terrain.elevation_m[at] = message.steps_per_m() == 0
                                    ? ToFloat(numbers[at])
                                    : FromSteps(numbers[at], message.steps_per_m());
    }
  }
  if (absl::Status s = sea::ValidateTerrain(terrain); !s.ok()) return s;
  if (sea::TerrainHash(terrain) != message.hash()) {
    return absl::DataLossError("terrain.hash: the samples have another");
  }
  return terrain;
}

}  // namespace onesea::wire
