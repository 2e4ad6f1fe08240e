#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// The few shapes that packed bytes are made of: bytes, little-endian words, and variable-length
/// integers as Protocol Buffers writes them (seven bits a byte, low ones first; signed ones
/// zig-zagged: 0, -1, 1, -2, ...).
namespace onesea::wire {

constexpr std::uint64_t ZigZag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
constexpr std::int64_t UnZigZag(std::uint64_t value) {
  return static_cast<std::int64_t>((value >> 1) ^ (~(value & 1) + 1));
}

inline void AppendVarint(std::uint64_t value, std::string& out) {
  while (value >= 0x80) {
    out.push_back(static_cast<char>(value | 0x80));
    value >>= 7;
  }
  out.push_back(static_cast<char>(value));
}
inline void AppendSigned(std::int64_t value, std::string& out) { AppendVarint(ZigZag(value), out); }

/// Reads bytes that nobody vouches for. After the first value that isn't there whole, ok() is false
/// and everything reads as 0.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  bool ok() const { return ok_; }
  std::string_view rest() const { return rest_; }

  std::uint8_t Byte() {
    if (rest_.empty()) return Fail();
    const auto byte = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }
  /// At most ten bytes, as in Protocol Buffers; bits beyond the 64th are refused.
  std::uint64_t Varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 70; shift += 7) {
      const std::uint8_t byte = Byte();
      if (!ok_) return 0;
      if (shift == 63 && byte > 1) return Fail();
      value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
      if (byte < 0x80) return value;
    }
    return Fail();
  }
  std::int64_t Signed() { return UnZigZag(Varint()); }
  /// `bytes` of a little-endian word, at most 8.
  std::uint64_t Word(int bytes) {
    std::uint64_t value = 0;
    for (int n = 0; n < bytes; ++n) value |= static_cast<std::uint64_t>(Byte()) << (8 * n);
    return ok_ ? value : 0;
  }

 private:
  std::uint8_t Fail() {
    ok_ = false;
    rest_ = {};
    return 0;
  }

  std::string_view rest_;
  bool ok_ = true;
};

}  // namespace onesea::wire
