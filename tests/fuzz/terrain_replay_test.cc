// Cut and mutated terrain without a fuzzer: the same inputs in every run.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <string>

#include "absl/strings/str_cat.h"
#include "common/ingest/file_bytes.h"
#include "tests/fuzz/terrain_input.h"

namespace onesea::fuzz {
namespace {

std::string Xyz() {
  std::string text;
  for (int n = 0; n < 60; ++n) absl::StrAppend(&text, n % 10 * 25, " ", n / 10 * 25, " ", -n, "\n");
  return text;
}

TEST(TerrainReplay, EveryCutIsSurvived) {
  const std::string asc = ingest::ReadFileBytes("tests/data/terrain/haringvliet.asc").value();
  for (std::size_t cut = 0; cut < asc.size(); cut += 3) ParseTerrainAndCheck(asc.substr(0, cut));
  const std::string xyz = Xyz();
  for (std::size_t cut = 0; cut < xyz.size(); ++cut) ParseTerrainAndCheck(xyz.substr(0, cut));
}

TEST(TerrainReplay, TwentyThousandMutationsAreSurvived) {
  static constexpr const char* kPieces[] = {
      "nan",  "-1", "1e308", "1e-320",   "4096",     "99999",  "ncols", "nrows 2", "\n",
      "\r\n", "#",  "-9999", "cellsize", "\xff",     "dx 1",   "0",     "+-5",     "xllcorner",
      "\t",   ",",  "1e-9",  "1e9",      "\x1f\x8b", "0.1-99", ";"};
  std::mt19937_64 random(20190210);
  const std::string corpus[] = {
      Xyz(),
      "ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n"
      "1 2 3 4\n5 6 7 8\n-9 -8 -9999 -6\n",
      "ncols 3\nnrows 3\nxllcenter 0\nyllcenter 0\ndx 10\ndy 30\n1 2 3 4 5 6 7 8 9\n"};
  for (int i = 0; i < 20'000; ++i) {
    std::string text = corpus[random() % std::size(corpus)];
    for (std::size_t edits = 1 + random() % 3; edits > 0; --edits) {
      const std::size_t at = random() % (text.size() + 1);
      const std::size_t length = std::min<std::size_t>(random() % 6, text.size() - at);
      text.replace(at, length, kPieces[random() % std::size(kPieces)]);
    }
    ParseTerrainAndCheck(text);
  }
}

}  // namespace
}  // namespace onesea::fuzz
