#include "server/app/default_session.h"

#include <filesystem>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace onesea::server {

absl::StatusOr<std::string> FindDefaultSession() {
  namespace fs = std::filesystem;
  constexpr char kInSource[] = "deploy/sessions/storm-41010.textproto";
  std::error_code failure;
  const fs::path program = fs::read_symlink("/proc/self/exe", failure).parent_path();
  const std::vector<fs::path> places = {kInSource, program / "../../.." / kInSource,
                                        program / "../share/onesea/sessions/storm-41010.textproto"};
  std::vector<std::string> tried;
  for (const fs::path& place : places) {
    if (fs::exists(place, failure)) return place.lexically_normal().string();
    tried.push_back(place.lexically_normal().string());
  }
  return absl::NotFoundError(absl::StrCat(
      "no --session is given, and the default one is at none of ", absl::StrJoin(tried, ", ")));
}

}  // namespace onesea::server
