#include "client/app/pose_log.h"

#include <cerrno>
#include <cstring>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/model/boat_figures.h"

namespace onesea::client {

absl::StatusOr<std::unique_ptr<PoseLog>> PoseLog::Open(const std::string& path) {
  std::FILE* const file = std::fopen(path.c_str(), "w");
  if (file == nullptr) {
    return absl::UnavailableError(absl::StrCat("can't write ", path, ": ", std::strerror(errno)));
  }
  absl::FPrintF(file, "time_s,id,name,x_m,y_m,z_m,heading_deg,speed_m_per_s,own\n");
  return std::unique_ptr<PoseLog>(new PoseLog(path, file));
}

void PoseLog::Write(const WorldView& world, SimTime time,
                    const std::optional<wire::BodyState>& own) {
  for (const wire::BodyTable::Body& body : world.bodies()) {
    const bool is_own = own && own->id == body.newest.id;
    const wire::BodyState state = is_own ? *own : body.At(time);
    std::string name = body.info->name;  // anybody's words: no comma may split them
    for (char& c : name) {
      if (c == ',' || c == '"' || c == '\n' || c == '\r') c = ' ';
    }
    double heading_deg = 90.0 - HeadingOf(state.turn) * 180.0 / std::numbers::pi;
    if (heading_deg < 0.0) heading_deg += 360.0;
    absl::FPrintF(file_.get(), "%.4f,%d,%s,%.4f,%.4f,%.4f,%.3f,%.4f,%d\n", time.Seconds(), state.id,
                  name, state.position_m.x, state.position_m.y, state.position_m.z, heading_deg,
                  Norm(state.velocity_m_per_s), is_own ? 1 : 0);
  }
}

absl::Status PoseLog::Close() {
  const bool failed = std::ferror(file_.get()) != 0;
  if (std::fclose(file_.release()) == 0 && !failed) return absl::OkStatus();
  return absl::UnavailableError(absl::StrCat("can't write ", path_, ": ", std::strerror(errno)));
}

}  // namespace onesea::client
