#pragma once

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "client/model/local_world.h"

namespace onesea::client {

/// Where every body was drawn, as a table for people and tests:
///   time_s,id,name,x_m,y_m,z_m,heading_deg,speed_m_per_s,own
/// with headings clockwise from north; `own` is 1 for the boat driven from here.
class PoseLog {
 public:
  /// Overwrites. Unavailable: the file can't be written.
  static absl::StatusOr<std::unique_ptr<PoseLog>> Open(const std::string& path);

  /// One line a body; of the own one as it is drawn.
  void Write(const WorldView& world, SimTime time, const std::optional<wire::BodyState>& own);
  /// Unavailable if something could not be written.
  absl::Status Close();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  PoseLog(std::string path, std::FILE* file) : path_(std::move(path)), file_(file) {}

  std::string path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
};

}  // namespace onesea::client
