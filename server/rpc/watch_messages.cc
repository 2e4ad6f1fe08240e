#include "server/rpc/watch_messages.h"

#include <string>

#include "absl/strings/str_cat.h"
#include "common/base/limits.h"
#include "onesea/v1/frame.pb.h"
#include "server/stream/subscriber.h"

namespace onesea::server {
namespace {

absl::Status Parse(const grpc::ByteBuffer& bytes, google::protobuf::MessageLite& out) {
  if (bytes.Length() > kViewerMessageBytesMax) {
    return absl::InvalidArgumentError(
        absl::StrCat("message: ", bytes.Length(), " bytes, at most ", kViewerMessageBytesMax));
  }
  grpc::Slice slice;
  if (!bytes.TrySingleSlice(&slice).ok() && !bytes.DumpToSingleSlice(&slice).ok()) {
    return absl::InvalidArgumentError("message: could not be read (compressed?)");
  }
  if (!out.ParseFromArray(slice.begin(), static_cast<int>(slice.size()))) {
    return absl::InvalidArgumentError(
        absl::StrCat("message: ", slice.size(), " bytes that are not a ", out.GetTypeName()));
  }
  return absl::OkStatus();
}

absl::Status CheckLength(const char* field, const std::string& value, std::size_t length_max) {
  if (value.size() <= length_max) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(field, ": ", value.size(), " characters, at most ", length_max));
}

absl::StatusOr<ViewerMessage> FromProto(const v1::WatchRequest::Open& open) {
  if (absl::Status s = CheckLength("open.session", open.session(), kSessionNameLengthMax); !s.ok())
    return s;
  if (absl::Status s = CheckLength("open.client_name", open.client_name(), kClientNameLengthMax);
      !s.ok())
    return s;
  const int credit = open.credit() == 0 ? kCreditDefault : open.credit();
  if (credit < kCreditMin || credit > kCreditMax) {
    return absl::InvalidArgumentError(
        absl::StrCat("open.credit: ", credit, ", not in [", kCreditMin, ", ", kCreditMax, "]"));
  }
  return OpenMessage{.session = open.session(),
                     .credit = credit,
                     .audience = open.every_frame() ? Audience::kEveryFrame : Audience::kStamps,
                     .client_name = open.client_name()};
}

}  // namespace

absl::StatusOr<ViewerMessage> ParseViewerMessage(const grpc::ByteBuffer& bytes) {
  v1::WatchRequest request;
  if (absl::Status s = Parse(bytes, request); !s.ok()) return s;
  switch (request.message_case()) {
    case v1::WatchRequest::kOpen:
      return FromProto(request.open());
    case v1::WatchRequest::kAck:
      return AckMessage{request.ack().sequence(), request.ack().drift_m()};
    case v1::WatchRequest::MESSAGE_NOT_SET:
      break;
  }
  return absl::InvalidArgumentError("message: neither open nor ack");
}

absl::StatusOr<OpenMessage> ParseStampsMessage(const grpc::ByteBuffer& bytes) {
  v1::WatchStampsRequest request;
  if (absl::Status s = Parse(bytes, request); !s.ok()) return s;
  if (absl::Status s = CheckLength("session", request.session(), kSessionNameLengthMax); !s.ok())
    return s;
  OpenMessage open;
  open.session = request.session();
  open.credit = kCreditUnlimited;
  return open;
}

}  // namespace onesea::server
