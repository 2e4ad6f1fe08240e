#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "common/base/vec.h"

/// Range checks of numbers that came from people or the network. Every error reads
/// "timeline[0].sea.systems[1].hs_m: 99 is outside [0, 40]". NaN is outside of every range.
namespace onesea::wire {

/// Abseil's string_view is its own type in some builds; its StrCat takes no other.
inline absl::string_view Text(std::string_view text) { return {text.data(), text.size()}; }

absl::Status CheckReal(std::string_view prefix, std::string_view field, double value, double min,
                       double max);
absl::Status CheckInteger(std::string_view prefix, std::string_view field, std::int64_t value,
                          std::int64_t min, std::int64_t max);

/// Each part within ±max.
absl::Status CheckVector(std::string_view prefix, const std::string& field, Vec3d v, double max);

/// `size` elements where at most `max` are allowed.
absl::Status CheckSize(std::string_view prefix, std::string_view field, std::size_t size,
                       std::size_t max);

/// At most `max` bytes of UTF-8 without control characters: what a protobuf string can carry and a
/// terminal may show.
absl::Status CheckText(std::string_view prefix, std::string_view field, std::string_view text,
                       std::size_t max);

/// What a terminal may show of a text that nobody checked: at most `max` bytes, cut between two
/// characters, with a question mark for every byte that CheckText() would refuse.
std::string Printable(std::string_view text, std::size_t max);

}  // namespace onesea::wire
