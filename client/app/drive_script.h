#pragma once

#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "client/app/skipper.h"

namespace onesea::client {

/// Keys by time, for a viewer without a keyboard.
class DriveScript {
 public:
  /// "0=b,1=up,4=up+left,9=": from second 0 B is held, from 1 on the arrow up, from 9 on nothing.
  /// Keys: up, down, left, right, b, space, x, delete; the last four act once, when their entry
  /// begins. Seconds in [0, 3600] ascend. InvalidArgument naming the entry.
  static absl::StatusOr<DriveScript> Parse(std::string_view text);

  /// The keys at `second` since the start. Keys that act once count if their entry began after the
  /// last call; seconds ascend.
  SkipperInput At(double second);
  bool empty() const { return entries_.empty(); }

 private:
  struct Entry {
    double second = 0.0;
    SkipperInput keys;
  };
  std::vector<Entry> entries_;
  std::size_t next_ = 0;  // the first that hasn't begun
};

}  // namespace onesea::client
