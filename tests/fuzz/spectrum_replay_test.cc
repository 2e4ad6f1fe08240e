// Cut and mutated files without a fuzzer: the same inputs in every run. A crash, a hang, unbounded
// memory or a record that breaks its promises fails.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "common/ingest/file_bytes.h"
#include "common/ingest/ndbc_files.h"
#include "common/ingest/spectrum_file.h"
#include "tests/fuzz/spectrum_input.h"

namespace onesea::fuzz {
namespace {

using ingest::NamedBytes;

std::string Bytes(const std::string& path) {
  const auto bytes = ingest::ReadFileBytes(path);
  EXPECT_TRUE(bytes.ok()) << bytes.status();
  return bytes.value_or("");
}

std::string Unpacked(const std::string& path) {
  std::string bytes = Bytes(path);
  return ingest::IsGzip(bytes) ? ingest::InflateGzip(path, bytes).value() : bytes;
}

std::vector<NamedBytes> NdbcFiles(const std::string& density, std::size_t bytes_max) {
  std::vector<NamedBytes> files;
  for (const ingest::NdbcQuantity quantity : ingest::kNdbcQuantities) {
    const std::string path = ingest::NdbcSibling(density, quantity);
    files.push_back({path, Unpacked(path).substr(0, bytes_max)});
  }
  return files;
}

const char kStorm[] = "deploy/sessions/41010/41010w2019part.txt.gz";
const std::string kSpectra = "tests/data/spectra/";

// Enough of every format to hold some records.
std::vector<std::vector<NamedBytes>> Corpus() {
  std::vector<std::vector<NamedBytes>> corpus = {NdbcFiles(kStorm, 1500),
                                                 NdbcFiles(kSpectra + "41010.data_spec", 3000)};
  for (const char* name : {"44004w2000.txt", "ww3station.spec", "swanfile.spec", "f31har01.bnd"}) {
    corpus.push_back({{kSpectra + name, Bytes(kSpectra + name)}});
  }
  // 240 places down to 3, so that mutations reach the blocks.
  std::string hot = Bytes(kSpectra + "swanhot.spec");
  hot.replace(hot.find("   240"), 6, "     3");
  const std::size_t fourth = hot.find("  165.000000  -45");
  hot.erase(fourth, hot.find("AFREQ") - fourth);
  corpus.push_back({{"hot.spec", hot.substr(0, 4000)}});
  return corpus;
}

TEST(SpectrumReplay, EveryCutOfEveryFileIsSurvived) {
  for (const std::vector<NamedBytes>& whole : Corpus()) {
    for (std::size_t f = 0; f < whole.size(); ++f) {
      const std::size_t size = whole[f].bytes.size();
      const std::size_t stride = size <= 4000 ? 1 : size / 1000;
      for (std::size_t cut = 0; cut < size; cut += stride) {
        std::vector<NamedBytes> files = whole;
        files[f].bytes.resize(cut);
        ParseAndCheck(files);
      }
    }
  }
}

TEST(SpectrumReplay, EveryCutOfThePackedStormIsRefused) {
  const std::string packed = Bytes(kStorm);
  for (std::size_t cut = 0; cut < packed.size(); cut += 7) {
    const std::vector<NamedBytes> files = {{kStorm, packed.substr(0, cut)}};
    EXPECT_FALSE(ingest::ParseSpectrum(files).ok()) << cut;
  }
}

// Pieces that break parsers, put over, into or in place of the text.
const char* const kPieces[] = {
    "999",     "-1",         "nan",         "inf",  "1e308", "1e-320",
    "0.1-999", "(",          ")",           "'",    "\n",    "\r\n",
    "\t",      "#YY",        "FACTOR",      "ZERO", "0",     "99999999999999999999",
    "NODATA",  "QUANT",      "NDIR",        "$",    "\xff",  "LOCATIONS",
    "TIME",    "2147483647", "-2147483648", "360"};

std::string Mutate(std::string text, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % (n + 1)); };
  const std::size_t edits = 1 + below(3);
  for (std::size_t i = 0; i < edits; ++i) {
    const std::size_t at = below(text.size()), length = std::min(below(12), text.size() - at);
    const std::string piece = kPieces[random() % std::size(kPieces)];
    switch (random() % 5) {
      case 0:
        text.replace(at, length, piece);
        break;
      case 1:
        text.insert(at, piece);
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << (random() % 8)));
        break;
      default:
        text.insert(below(text.size()), text.substr(at, 40 * length));
    }
  }
  return text;
}

TEST(SpectrumReplay, TwentyThousandMutationsAreSurvived) {
  std::mt19937_64 random(20190210);
  const std::vector<std::vector<NamedBytes>> corpus = Corpus();
  constexpr int kMutations = 20'000;
  for (int i = 0; i < kMutations; ++i) {
    std::vector<NamedBytes> files = corpus[random() % corpus.size()];
    std::string& bytes = files[random() % files.size()].bytes;
    bytes = Mutate(std::move(bytes), random);
    ParseAndCheck(files);
  }
}

TEST(SpectrumReplay, SplitUndoesJoin) {
  const std::vector<NamedBytes> files = {{"41010w2019.txt", "a\nb"}, {"x", ""}, {"y", "c\n"}};
  const std::vector<NamedBytes> again = SplitFiles(JoinFiles(files));
  ASSERT_EQ(again.size(), files.size());
  for (std::size_t i = 0; i < files.size(); ++i) {
    EXPECT_EQ(again[i].name, files[i].name);
    EXPECT_EQ(again[i].bytes, files[i].bytes);
  }
  EXPECT_EQ(SplitFiles("").size(), 1U);
}

// A file of blocks without numbers must not become more memory than it is bytes.
TEST(SpectrumReplay, EmptyBlocksGiveNoRecords) {
  std::string text = Bytes(kSpectra + "swanfile.spec");
  text.resize(text.find("2016"));
  for (int block = 0; block < 300'000; ++block) text += "20161011.000000\nZERO\n";
  const auto records = ingest::ParseSpectrum(std::vector<NamedBytes>{{"zero.spec", text}});
  EXPECT_NE(records.status().message().find("no record with waves"), absl::string_view::npos);
}

}  // namespace
}  // namespace onesea::fuzz
