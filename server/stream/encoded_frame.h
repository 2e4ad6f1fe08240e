#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace onesea::server {

/// Who a frame is for.
enum class Audience : std::uint8_t {
  kStamps,      ///< the spectral sea alone: a stamp a second
  kEveryFrame,  ///< every streamed tick
};
inline constexpr int kAudiences = 2;

/// A frame as it goes over the wire, the same bytes for every viewer. Immutable.
struct EncodedFrame {
  std::int64_t sequence = 0;
  std::string bytes;  ///< onesea.v1.WatchResponse
};
using FramePtr = std::shared_ptr<const EncodedFrame>;

}  // namespace onesea::server
