#include "common/ingest/file_bytes.h"

#include <zlib.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

#include "absl/strings/str_cat.h"
#include "common/base/limits.h"
#include "common/ingest/text_lines.h"

namespace onesea::ingest {
namespace {

constexpr std::size_t kBytesMax = static_cast<std::size_t>(kReadFileBytesMax);

std::string TooLarge(absl::string_view what) {
  return absl::StrCat(what, " is larger than ", kReadFileBytesMax, " bytes, the limit");
}

struct EndInflate {
  void operator()(z_stream* stream) const {
    inflateEnd(stream);
    delete stream;
  }
};
using Inflater = std::unique_ptr<z_stream, EndInflate>;

Inflater NewInflater(absl::string_view bytes) {
  auto stream = std::make_unique<z_stream>();
  *stream = {};
  // zlib never writes through next_in; its type only lacks the const.
  stream->next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream->avail_in = static_cast<uInt>(bytes.size());
  constexpr int kGzipWindowBits = 15 + 16;
  if (inflateInit2(stream.get(), kGzipWindowBits) != Z_OK) return nullptr;
  return Inflater(stream.release());
}

}  // namespace

absl::StatusOr<std::string> ReadFileBytes(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    return absl::NotFoundError(absl::StrCat(path, ": no such file"));
  }
  // A directory, a pipe or a device may never end.
  if (!std::filesystem::is_regular_file(status)) {
    return FileError(path, 0, "file", "is not a regular file");
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return absl::UnavailableError(absl::StrCat(path, ": ", error.message()));
  if (size > kBytesMax) return FileError(path, 0, "file", TooLarge("it"));
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
    return absl::UnavailableError(absl::StrCat(path, ": can't be read"));
  }
  return bytes;
}

bool IsGzip(absl::string_view bytes) { return bytes.substr(0, 2) == "\x1f\x8b"; }

absl::StatusOr<std::string> InflateGzip(absl::string_view name, absl::string_view bytes) {
  if (bytes.size() > kBytesMax) return FileError(name, 0, "gzip", TooLarge("the file"));
  const Inflater stream = NewInflater(bytes);
  if (stream == nullptr) return absl::ResourceExhaustedError("no memory for zlib");
  std::string text;
  std::array<char, 64 * 1024> chunk;
  while (true) {
    stream->next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream->avail_out = static_cast<uInt>(chunk.size());
    const int result = inflate(stream.get(), Z_NO_FLUSH);
    const std::size_t written = chunk.size() - stream->avail_out;
    if (text.size() + written > kBytesMax) {
      return FileError(name, 0, "gzip", TooLarge("the unpacked text"));
    }
    text.append(chunk.data(), written);
    if (result == Z_STREAM_END) {
      const absl::string_view rest(reinterpret_cast<const char*>(stream->next_in),
                                   stream->avail_in);
      // What follows the last member without being one is padding, which gzip itself ignores.
      if (!IsGzip(rest)) return text;
      if (inflateReset(stream.get()) != Z_OK) return FileError(name, 0, "gzip", "is damaged");
    } else if (result != Z_OK) {
      const bool is_cut = result == Z_BUF_ERROR;
      return FileError(name, 0, "gzip", is_cut ? "the file is cut short" : "is damaged");
    }
  }
}

}  // namespace onesea::ingest
