#include "tests/fuzz/terrain_input.h"

#include "common/base/check.h"
#include "common/ingest/terrain_file.h"

namespace onesea::fuzz {

void ParseTerrainAndCheck(absl::string_view text) {
  for (const bool degrees : {false, true}) {
    const auto terrain = ingest::ParseTerrain("t", text, {.degrees = degrees});
    if (!terrain.ok()) {
      ONESEA_CHECK(!terrain.status().message().empty());
      continue;
    }
    ONESEA_CHECK(sea::ValidateTerrain(*terrain).ok());
  }
}

}  // namespace onesea::fuzz
