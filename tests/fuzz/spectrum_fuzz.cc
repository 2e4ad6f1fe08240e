// libFuzzer target for the spectrum readers: build with clang and ONESEA_FUZZ=ON, then
//   spectrum_fuzz -max_len=65536 CORPUS tests/data/spectra
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/spectrum_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const absl::string_view input(reinterpret_cast<const char*>(data), size);
  onesea::fuzz::ParseAndCheck(onesea::fuzz::SplitFiles(input));
  return 0;
}
