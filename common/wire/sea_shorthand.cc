#include "common/wire/sea_shorthand.h"

#include <filesystem>
#include <vector>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/ingest/spectrum_file.h"
#include "common/sea/sea_codes.h"
#include "common/wire/bounds.h"
#include "common/wire/direction.h"

namespace onesea::wire {

absl::Status SystemFromFile(const v1::SpectrumFile& file, std::string_view prefix,
                            const std::string& folder, sea::WaveSystem& out) {
  if (folder.empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat(Text(prefix), "path: '", file.path(),
                     "': spectrum files are read beside a session file only, not over the network; "
                     "send the spectrum itself (buoy or grid)"));
  }
  const std::string path = (std::filesystem::path(folder) / file.path()).string();
  ONESEA_ASSIGN_OR_RETURN(const std::vector<ingest::SpectrumRecord> records,
                          ingest::ReadSpectrumFile(path));
  ONESEA_ASSIGN_OR_RETURN(const ingest::SpectrumRecord* record,
                          ingest::FindRecord(records, file.time()));
  out = record->system;
  return absl::OkStatus();
}

absl::StatusOr<std::optional<sea::SeaState>> SeaFromShorthand(const v1::SeaState& proto,
                                                              std::string_view prefix) {
  if (!proto.has_beaufort() && !proto.has_wmo_sea_state()) return std::nullopt;
  if (proto.systems_size() > 0 || (proto.has_beaufort() && proto.has_wmo_sea_state())) {
    return absl::InvalidArgumentError(absl::StrCat(
        Text(prefix), "beaufort: give one of systems, beaufort and wmo_sea_state, not several"));
  }
  ONESEA_ASSIGN_OR_RETURN(const double to_rad, DirectionFromProto(proto.wind(), prefix, "wind"));
  if (proto.has_beaufort()) {
    ONESEA_RETURN_IF_ERROR(CheckInteger(prefix, "beaufort", proto.beaufort(), 0, 12));
    ONESEA_ASSIGN_OR_RETURN(sea::SeaState sea, sea::SeaOfBeaufort(proto.beaufort(), to_rad));
    return sea;
  }
  ONESEA_RETURN_IF_ERROR(CheckInteger(prefix, "wmo_sea_state", proto.wmo_sea_state(), 0, 9));
  ONESEA_ASSIGN_OR_RETURN(sea::SeaState sea, sea::SeaOfWmoCode(proto.wmo_sea_state(), to_rad));
  return sea;
}

}  // namespace onesea::wire
