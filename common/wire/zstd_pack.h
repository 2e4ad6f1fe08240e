#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "absl/status/status.h"

/// Zstandard with contexts that are kept, so that packing many small pieces allocates nothing. The
/// only file that knows zstd.h.
namespace onesea::wire {

/// Makes one Zstandard frame of a piece; the frame carries its content size. Not thread-safe.
class Packer {
 public:
  /// `level` of zstd, [1, 19]; 1 is the knee for tiles (2 % more bytes than 3, half the time).
  explicit Packer(int level);
  ~Packer();
  Packer(const Packer&) = delete;
  Packer& operator=(const Packer&) = delete;

  /// The most bytes that `size` bytes can become.
  static std::size_t BytesMax(std::size_t size);
  /// Appends to `out`. Allocates only if `out` has no room for BytesMax(in.size()) more bytes.
  void Append(std::span<const std::uint8_t> in, std::string& out);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// Undoes Packer for bytes that nobody vouches for. Not thread-safe.
class Unpacker {
 public:
  Unpacker();
  ~Unpacker();
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  /// Fills the whole of `out`. InvalidArgument unless `in` is exactly one frame of exactly that
  /// content size; then `out` may hold anything. Allocates nothing.
  absl::Status Fill(std::string_view in, std::span<std::uint8_t> out);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace onesea::wire
