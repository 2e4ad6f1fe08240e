#pragma once

#include <bit>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace onesea {

/// FNV-1a, 64 bits, over little-endian bytes of values: the same on every machine. Not
/// cryptographic.
///
/// Doubles enter as their IEEE-754 bits with -0 read as +0, so equal numbers hash equally.
/// Source: Fowler, Noll, Vo; offset basis 0xcbf29ce484222325, prime 0x100000001b3.
class Hash64 {
 public:
  void AddByte(std::uint8_t byte) { state_ = (state_ ^ byte) * 0x100000001b3ULL; }

  template <typename T>
  requires std::is_integral_v<T>
  void Add(T value) {
    auto bits = static_cast<std::make_unsigned_t<T>>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      AddByte(static_cast<std::uint8_t>(bits >> (8 * i)));
    }
  }
  void Add(double value) { Add(std::bit_cast<std::uint64_t>(value + 0.0)); }
  void Add(float value) { Add(std::bit_cast<std::uint32_t>(value + 0.0f)); }
  void Add(std::string_view text) {
    Add(static_cast<std::uint64_t>(text.size()));
    for (char c : text) AddByte(static_cast<std::uint8_t>(c));
  }

  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace onesea
