#include "client/model/other_sea.h"

#include "absl/strings/cord.h"

namespace onesea::client {
namespace {

constexpr char kMark[] = "onesea.client/other-sea";

}  // namespace

absl::Status OtherSeaError(absl::string_view message) {
  absl::Status status = absl::FailedPreconditionError(message);
  status.SetPayload(kMark, absl::Cord());
  return status;
}

bool IsOtherSea(const absl::Status& status) { return status.GetPayload(kMark).has_value(); }

}  // namespace onesea::client
