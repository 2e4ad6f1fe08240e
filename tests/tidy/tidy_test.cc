// The rules of the house that a program can check: forbidden includes, lengths, banned words, files
// nobody builds.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"

namespace {

namespace fs = std::filesystem;

constexpr int kFileLinesMax = 600;
constexpr int kFunctionLinesMax = 70;
constexpr int kColumnsMax = 100;

struct SourceFile {
  std::string path;  // relative to the root, e.g. "common/sea/recipe.h"
  std::vector<std::string> lines;
};

bool IsSource(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".h" || extension == ".cc";
}

std::vector<SourceFile> ReadTree(const std::vector<std::string>& folders) {
  std::vector<SourceFile> files;
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file() || !IsSource(entry.path())) continue;
      if (absl::StrContains(entry.path().string(), "node_modules")) continue;
      SourceFile file{entry.path().generic_string(), {}};
      std::ifstream stream(entry.path());
      for (std::string line; std::getline(stream, line);) file.lines.push_back(line);
      files.push_back(std::move(file));
    }
  }
  return files;
}

const std::vector<SourceFile>& Product() {
  static const auto& files = *new std::vector<SourceFile>(ReadTree({"common", "server", "client"}));
  return files;
}

const std::vector<SourceFile>& Everything() {
  static const auto& files =
      *new std::vector<SourceFile>(ReadTree({"common", "server", "client", "tests"}));
  return files;
}

// Characters, not bytes: a wave has a λ.
int Columns(const std::string& line) {
  return static_cast<int>(std::count_if(line.begin(), line.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

bool StartsWithAny(const std::string& text, const std::vector<std::string>& prefixes) {
  for (const std::string& prefix : prefixes) {
    if (absl::StartsWith(text, prefix)) return true;
  }
  return false;
}

// "Files under `from` never include what matches `what`, except files under `except`."
struct ForbiddenArrow {
  std::vector<std::string> from;
  std::string what;
  std::vector<std::string> except;
  std::string because;
};

const std::vector<ForbiddenArrow>& ForbiddenArrows() {
  static const auto& arrows = *new std::vector<ForbiddenArrow>{
      {{"common/"}, "^(server|client)/", {}, "they meet on the wire only"},
      {{"server/"}, "^client/", {}, "they meet on the wire only"},
      {{"client/"}, "^server/", {}, "they meet on the wire only"},
      {{"common/base/"}, "^common/(sea|ingest|wire)/", {}, "base is the ground floor"},
      {{"common/sea/"},
       "^(common/(ingest|wire)/|grpc|google/|spdlog/|common/base/"
       "clock|thread$|mutex$|chrono$|fstream$|absl/time|"
       "absl/synchronization)",
       {},
       "the mathematics must be testable with paper and pen"},
      {{"common/ingest/"}, "^common/wire/", {}, "readers give domain objects"},
      {{"server/session/"},
       "^(grpc|server/(store|rpc|stream|app)/|chrono$)",
       {},
       "replay needs neither network nor disk"},
      {{"server/world/"},
       "^(grpc|google/|server/(session|stream|query|store|rpc|app)/|common/base/clock|chrono$)",
       {},
       "physics needs neither network nor disk nor clock; a tick is an argument"},
      {{""},
       "^bt|^bullet/|^Bullet",
       {"server/world/contacts.cc"},
       "one file to change per dependency"},
      {{"server/store/"},
       "^server/rpc/",
       {},
       "a restored and a created session take the same path"},
      {{"server/rpc/"},
       "^server/store/",
       {},
       "a restored and a created session take the same path"},
      {{"client/render/"},
       "^(client/net/|common/wire/|grpc)",
       {},
       "a picture test needs no server"},
      {{"client/model/"},
       "^(client/(net|render)/|epoxy/|GL/|grpc)",
       {},
       "a robot needs no display"},
      {{"client/net/"}, "^(client/render/|epoxy/|GL/)", {}, "a robot needs no display"},
      {{"client/embed/onesea/"},
       "^(?!absl/status/status(or)?\\.h$|onesea/bodies\\.h$).*/",
       {},
       "a game sees the standard library and absl::Status, nothing of what is behind"},
      {{""},
       "\\.pb\\.h$",
       {"common/wire/", "server/rpc/", "client/net/", "tests/"},
       "a schema change stops at the codec"},
      {{""},
       "^fftw3\\.h",
       {"common/sea/fft_fftw.cc", "tests/"},
       "one file to change per dependency"},
      {{""}, "^zstd", {"common/wire/zstd_pack.cc"}, "one file to change per dependency"},
      {{""}, "^GLFW/", {"client/app/window.cc"}, "one file to change per dependency"},
      {{""},
       "^grpcpp/",
       {"server/rpc/", "client/net/", "tests/"},
       "one file to change per dependency"},
      {{"common/", "server/", "client/"},
       "^absl/flags/",
       {"server/app/", "client/app/"},
       "configuration enters by one door"},
      {{"common/", "server/", "client/"}, "^tests/", {}, "fakes are not shipped"},
  };
  return arrows;
}

TEST(Tidy, NoForbiddenIncludes) {
  static const std::regex include(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  std::vector<std::string> found;
  for (const SourceFile& file : Everything()) {
    for (const std::string& line : file.lines) {
      std::smatch match;
      if (!std::regex_search(line, match, include)) continue;
      const std::string target = match[1];
      for (const ForbiddenArrow& arrow : ForbiddenArrows()) {
        if (!StartsWithAny(file.path, arrow.from) || StartsWithAny(file.path, arrow.except))
          continue;
        if (std::regex_search(target, std::regex(arrow.what))) {
          found.push_back(absl::StrCat(file.path, " -> ", target, ": ", arrow.because));
        }
      }
    }
  }
  EXPECT_TRUE(found.empty()) << absl::StrJoin(found, "\n");
}

// The wall clock and the environment enter through base/clock and the app folders.
TEST(Tidy, ClockAndEnvironmentEnterByOneDoor) {
  static const std::regex forbidden(
      R"(\b(getenv|system_clock|steady_clock|gettimeofday|clock_gettime)\b)");
  std::vector<std::string> found;
  for (const SourceFile& file : Product()) {
    if (StartsWithAny(file.path, {"common/base/", "server/app/", "client/app/"})) continue;
    for (std::size_t n = 0; n < file.lines.size(); ++n) {
      if (std::regex_search(file.lines[n], forbidden))
        found.push_back(absl::StrCat(file.path, ":", n + 1));
    }
  }
  EXPECT_TRUE(found.empty()) << absl::StrJoin(found, "\n");
}

TEST(Tidy, FilesAndLinesAreShort) {
  std::vector<std::string> found;
  for (const SourceFile& file : Everything()) {
    if (file.lines.size() > kFileLinesMax) {
      found.push_back(
          absl::StrCat(file.path, ": ", file.lines.size(), " lines, at most ", kFileLinesMax));
    }
    for (std::size_t n = 0; n < file.lines.size(); ++n) {
      const int columns = Columns(file.lines[n]);
      if (columns > kColumnsMax && !absl::StrContains(file.lines[n], "http")) {
        found.push_back(absl::StrCat(file.path, ":", n + 1, ": ", columns, " columns"));
      }
    }
  }
  EXPECT_TRUE(found.empty()) << absl::StrJoin(found, "\n");
}

// A function body in these sources opens with a line that begins in column 0 (or 2 inside a class)
// and ends in "{", and closes with "}" in the same column. Namespaces and types are passed over.
TEST(Tidy, FunctionsAreShort) {
  static const std::regex opening(R"(^[A-Za-z_].*\{$)");
  static const std::regex not_function(
      R"(^(namespace|struct|class|enum|union|extern|const|constexpr|static const))");
  std::vector<std::string> found;
  for (const SourceFile& file : Product()) {
    std::size_t start = 0;
    bool inside = false;
    for (std::size_t n = 0; n < file.lines.size(); ++n) {
      const std::string& line = file.lines[n];
      if (!inside && std::regex_search(line, opening) && !std::regex_search(line, not_function)) {
        inside = true;
        start = n;
      } else if (inside && absl::StartsWith(line, "}")) {
        inside = false;
        if (n - start > kFunctionLinesMax) {
          found.push_back(absl::StrCat(file.path, ":", start + 1, ": a function of ", n - start,
                                       " lines, at most ", kFunctionLinesMax));
        }
      }
    }
  }
  EXPECT_TRUE(found.empty()) << absl::StrJoin(found, "\n");
}

TEST(Tidy, HeadersHavePragmaOnce) {
  std::vector<std::string> found;
  for (const SourceFile& file : Everything()) {
    // Highway includes its per-target files once per target, with guards of its own.
    if (!absl::EndsWith(file.path, ".h") || absl::EndsWith(file.path, "-inl.h")) continue;
    bool has = false;
    for (const std::string& line : file.lines) has |= line == "#pragma once";
    if (!has) found.push_back(file.path);
  }
  EXPECT_TRUE(found.empty()) << absl::StrJoin(found, "\n");
}

std::string Slurp(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A source that no CMakeLists.txt names is dead.
TEST(Tidy, EverySourceIsBuilt) {
  std::vector<std::string> found;
  std::map<std::string, std::string> lists;
  for (const SourceFile& file : Everything()) {
    if (!absl::EndsWith(file.path, ".cc")) continue;
    bool named = false;
    for (fs::path folder = fs::path(file.path).parent_path(); !folder.empty();
         folder = folder.parent_path()) {
      const std::string list = (folder / "CMakeLists.txt").generic_string();
      if (!lists.contains(list)) lists[list] = Slurp(list);
      named |= absl::StrContains(lists[list], fs::path(file.path).filename().string());
    }
    if (!named) found.push_back(file.path);
  }
  EXPECT_TRUE(found.empty()) << absl::StrJoin(found, "\n");
}

TEST(Tidy, NoFlagThatChangesArithmetic) {
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(".")) {
    const std::string path = entry.path().generic_string();
    if (absl::StartsWith(path, "./build/") || absl::StartsWith(path, "./.git/")) continue;
    const std::string name = entry.path().filename().string();
    if (name != "CMakeLists.txt" && name != "CMakePresets.json" && !absl::EndsWith(name, ".cmake"))
      continue;
    const std::string text = Slurp(entry.path());
    for (const char* flag :
         {"-ffast-math", "-Ofast", "-funsafe-math", "-ffp-contract=fast", "-march=native"}) {
      if (absl::StrContains(text, flag)) found.push_back(absl::StrCat(path, ": ", flag));
    }
  }
  EXPECT_TRUE(found.empty()) << absl::StrJoin(found, "\n");
}

}  // namespace
