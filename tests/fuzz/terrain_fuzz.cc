// libFuzzer target for the terrain readers: build with clang and ONESEA_FUZZ=ON, then
//   terrain_fuzz -max_len=16384 CORPUS tests/data/terrain
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/terrain_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  onesea::fuzz::ParseTerrainAndCheck({reinterpret_cast<const char*>(data), size});
  return 0;
}
