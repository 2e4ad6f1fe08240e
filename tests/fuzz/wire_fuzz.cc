// libFuzzer target for what a client decodes: build with clang and ONESEA_FUZZ=ON, then
//   wire_fuzz -max_len=65536 CORPUS
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/wire_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  onesea::fuzz::DecodeAndCheck({reinterpret_cast<const char*>(data), size});
  return 0;
}
