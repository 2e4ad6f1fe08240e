#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <cstdint>
#include <string>
#include <variant>

#include "absl/status/statusor.h"
#include "server/stream/encoded_frame.h"

/// What viewers send, from bytes that anybody may have made up.
namespace onesea::server {

inline constexpr std::size_t kViewerMessageBytesMax =
    1024;                                                 // an open is below 250, an ack below 20
inline constexpr std::size_t kClientNameLengthMax = 128;  // goes into logs

struct OpenMessage {
  std::string session;
  int credit = 0;
  Audience audience = Audience::kStamps;
  std::string client_name;
};

struct AckMessage {
  std::int64_t sequence = 0;
  float drift_m = -1.0f;  ///< any value, NaN too; only >= 0 means something
};

using ViewerMessage = std::variant<OpenMessage, AckMessage>;

/// onesea.v1.WatchRequest. InvalidArgument naming field, value and limit.
absl::StatusOr<ViewerMessage> ParseViewerMessage(const grpc::ByteBuffer& bytes);

/// onesea.v1.WatchStampsRequest: credit is kCreditUnlimited. InvalidArgument as above.
absl::StatusOr<OpenMessage> ParseStampsMessage(const grpc::ByteBuffer& bytes);

}  // namespace onesea::server
