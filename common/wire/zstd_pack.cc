#include "common/wire/zstd_pack.h"

#include <zstd.h>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"

namespace onesea::wire {

struct Packer::Context {
  ZSTD_CCtx* zstd = ZSTD_createCCtx();
  ~Context() { ZSTD_freeCCtx(zstd); }
};

Packer::Packer(int level) : context_(std::make_unique<Context>()) {
  ONESEA_CHECK(context_->zstd != nullptr) << "no memory for a zstd context";
  const std::size_t result = ZSTD_CCtx_setParameter(context_->zstd, ZSTD_c_compressionLevel, level);
  ONESEA_CHECK(!ZSTD_isError(result)) << "level " << level;
}

Packer::~Packer() = default;

std::size_t Packer::BytesMax(std::size_t size) { return ZSTD_compressBound(size); }

void Packer::Append(std::span<const std::uint8_t> in, std::string& out) {
  const std::size_t begin = out.size();
  out.resize(begin + BytesMax(in.size()));
  const std::size_t written =
      ZSTD_compress2(context_->zstd, out.data() + begin, out.size() - begin, in.data(), in.size());
  ONESEA_CHECK(!ZSTD_isError(written)) << ZSTD_getErrorName(written);
  out.resize(begin + written);
}

struct Unpacker::Context {
  ZSTD_DCtx* zstd = ZSTD_createDCtx();
  ~Context() { ZSTD_freeDCtx(zstd); }
};

Unpacker::Unpacker() : context_(std::make_unique<Context>()) {
  ONESEA_CHECK(context_->zstd != nullptr) << "no memory for a zstd context";
}

Unpacker::~Unpacker() = default;

absl::Status Unpacker::Fill(std::string_view in, std::span<std::uint8_t> out) {
  // What the frame says of itself comes first: a bomb is refused before it is unpacked.
  const unsigned long long said = ZSTD_getFrameContentSize(in.data(), in.size());
  if (said != out.size()) {
    return absl::InvalidArgumentError(
        said == ZSTD_CONTENTSIZE_UNKNOWN || said == ZSTD_CONTENTSIZE_ERROR
            ? absl::StrCat("packed bytes: no content size, ", out.size(), " is due")
            : absl::StrCat("packed bytes: content size ", said, ", ", out.size(), " is due"));
  }
  if (ZSTD_findFrameCompressedSize(in.data(), in.size()) != in.size()) {
    return absl::InvalidArgumentError("packed bytes: not exactly one zstd frame");
  }
  const std::size_t filled =
      ZSTD_decompressDCtx(context_->zstd, out.data(), out.size(), in.data(), in.size());
  if (ZSTD_isError(filled)) {
    return absl::InvalidArgumentError(absl::StrCat("packed bytes: ", ZSTD_getErrorName(filled)));
  }
  if (filled != out.size()) {
    return absl::InvalidArgumentError(
        absl::StrCat("packed bytes: gave ", filled, " bytes, ", out.size(), " are due"));
  }
  return absl::OkStatus();
}

}  // namespace onesea::wire
