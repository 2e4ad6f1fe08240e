#pragma once

#include <string>
#include <vector>

#include "absl/strings/string_view.h"
#include "common/ingest/spectrum_record.h"

/// How one string of bytes stands for the files that ParseSpectrum() takes: they are joined by
/// lines that hold "%% name" alone. So a fuzzer can change all five files of a buoy at once.
namespace onesea::fuzz {

std::vector<ingest::NamedBytes> SplitFiles(absl::string_view input);
std::string JoinFiles(const std::vector<ingest::NamedBytes>& files);

/// Parses, and checks what a caller relies on of every record that comes back: sizes, order and
/// ranges as common/sea/sea_state.h states them. Aborts where that does not hold.
void ParseAndCheck(const std::vector<ingest::NamedBytes>& files);

}  // namespace onesea::fuzz
