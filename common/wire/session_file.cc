#include "common/wire/session_file.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include "absl/strings/str_cat.h"
#include "common/base/check.h"
#include "common/wire/proto_sea.h"
#include "common/wire/proto_session.h"

namespace onesea::wire {
namespace {

// A session file holds names, numbers and at most one spectrum; more is somebody's mistake.
constexpr std::uintmax_t kFileBytesMax = 1024 * 1024;

// Keeps the first error: those after it are mostly its echoes.
class FirstError final : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int line, google::protobuf::io::ColumnNumber column,
                const std::string& message) override {
    if (!text_.empty()) return;
    text_ = line < 0 ? message
                     : absl::StrCat("line ", line + 1, ", column ", column + 1, ": ", message);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

template <typename Proto>
absl::StatusOr<Proto> ParseText(std::string_view text) {
  Proto proto;
  FirstError error;
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&error);
  if (!parser.ParseFromString(std::string(text), &proto)) {
    return absl::InvalidArgumentError(error.text());
  }
  return proto;
}

absl::StatusOr<std::string> ReadWholeFile(const std::string& path) {
  std::error_code failure;
  const std::uintmax_t size = std::filesystem::file_size(path, failure);
  if (failure) return absl::NotFoundError(absl::StrCat(path, ": ", failure.message()));
  if (size > kFileBytesMax) {
    return absl::InvalidArgumentError(
        absl::StrCat(path, ": ", size, " bytes, the limit is ", kFileBytesMax));
  }
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) return absl::NotFoundError(absl::StrCat(path, ": can't be read"));
  return text.str();
}

std::string FolderOf(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

absl::Status InFile(const absl::Status& status, const std::string& path) {
  return absl::Status(status.code(), absl::StrCat(path, ": ", status.message()));
}

}  // namespace

absl::StatusOr<SessionSpec> ParseSessionText(std::string_view text, const std::string& folder) {
  ONESEA_ASSIGN_OR_RETURN(const v1::SessionSpec proto, ParseText<v1::SessionSpec>(text));
  return FromProto(proto, folder);
}

absl::StatusOr<sea::SeaState> ParseSeaText(std::string_view text, const std::string& folder) {
  ONESEA_ASSIGN_OR_RETURN(const v1::SeaState proto, ParseText<v1::SeaState>(text));
  return FromProto(proto, "", folder);
}

absl::StatusOr<SessionSpec> ReadSessionFile(const std::string& path) {
  ONESEA_ASSIGN_OR_RETURN(const std::string text, ReadWholeFile(path));
  absl::StatusOr<SessionSpec> spec = ParseSessionText(text, FolderOf(path));
  if (!spec.ok()) return InFile(spec.status(), path);
  return spec;
}

absl::StatusOr<sea::SeaState> ReadSeaFile(const std::string& path) {
  ONESEA_ASSIGN_OR_RETURN(const std::string text, ReadWholeFile(path));
  absl::StatusOr<sea::SeaState> sea = ParseSeaText(text, FolderOf(path));
  if (!sea.ok()) return InFile(sea.status(), path);
  return sea;
}

}  // namespace onesea::wire
