#include "common/wire/sea_shorthand.h"

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/wire/bounds.h"
#include "common/wire/direction.h"

namespace onesea::wire {

absl::Status SystemFromFile(const v1::SpectrumFile& file, std::string_view prefix,
                            const std::string& folder, sea::WaveSystem& /*out*/) {
  if (folder.empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat(Text(prefix), "path: '", file.path(),
                     "': spectrum files are read beside a session file only, not over the network; "
                     "send the spectrum itself (buoy or grid)"));
  }
  return absl::UnimplementedError(absl::StrCat(Text(prefix), "path: no reader yet"));
}

absl::Status ExpandShorthand(const v1::SeaState& proto, std::string_view prefix,
                             sea::SeaState& sea) {
  if (!proto.has_beaufort() && !proto.has_wmo_sea_state()) return absl::OkStatus();
  if (!sea.systems.empty() || (proto.has_beaufort() && proto.has_wmo_sea_state())) {
    return absl::InvalidArgumentError(absl::StrCat(
        Text(prefix), "beaufort: give one of systems, beaufort and wmo_sea_state, not several"));
  }
  return absl::UnimplementedError(absl::StrCat(Text(prefix), "beaufort: no table yet"));
}

}  // namespace onesea::wire
