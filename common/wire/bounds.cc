#include "common/wire/bounds.h"

#include <algorithm>
#include <utility>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"

namespace onesea::wire {
namespace {

// Bytes of the character that `text` begins with; 0 if it is none, or a control character.
// Source: RFC 3629, section 4.
std::size_t CharacterBytes(std::string_view text) {
  const auto byte = [&text](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const auto tail = [&](std::size_t n) { return n < text.size() && (byte(n) & 0xc0) == 0x80; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return lead >= 0x20 && lead != 0x7f ? 1 : 0;
  if (!tail(1)) return 0;
  if (lead >= 0xc2 && lead < 0xe0) return 2;
  if (!tail(2)) return 0;
  if (lead == 0xe0) return byte(1) >= 0xa0 ? 3 : 0;  // else a shorter form would do
  if (lead == 0xed) return byte(1) < 0xa0 ? 3 : 0;   // else half of a UTF-16 pair
  if (lead > 0xe0 && lead < 0xf0) return 3;
  if (!tail(3)) return 0;
  if (lead == 0xf0) return byte(1) >= 0x90 ? 4 : 0;
  if (lead == 0xf4) return byte(1) < 0x90 ? 4 : 0;
  return lead > 0xf0 && lead < 0xf4 ? 4 : 0;
}

}  // namespace

absl::Status CheckReal(std::string_view prefix, std::string_view field, double value, double min,
                       double max) {
  if (value >= min && value <= max) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(Text(prefix), Text(field), ": ", value, " is outside [", min, ", ", max, "]"));
}

absl::Status CheckInteger(std::string_view prefix, std::string_view field, std::int64_t value,
                          std::int64_t min, std::int64_t max) {
  if (value >= min && value <= max) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(Text(prefix), Text(field), ": ", value, " is outside [", min, ", ", max, "]"));
}

absl::Status CheckVector(std::string_view prefix, const std::string& field, Vec3d v, double max) {
  for (const auto& [part, value] :
       {std::pair(".x", v.x), std::pair(".y", v.y), std::pair(".z", v.z)}) {
    if (absl::Status s = CheckReal(prefix, field + part, value, -max, max); !s.ok()) return s;
  }
  return absl::OkStatus();
}

absl::Status CheckSize(std::string_view prefix, std::string_view field, std::size_t size,
                       std::size_t max) {
  if (size <= max) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(Text(prefix), Text(field), ": ", size, " elements, the limit is ", max));
}

absl::Status CheckText(std::string_view prefix, std::string_view field, std::string_view text,
                       std::size_t max) {
  if (text.size() > max) {
    return absl::InvalidArgumentError(
        absl::StrCat(Text(prefix), Text(field), ": ", text.size(), " bytes, the limit is ", max));
  }
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = CharacterBytes(text.substr(at));
    if (bytes == 0) {
      return absl::InvalidArgumentError(absl::StrCat(Text(prefix), Text(field), ": '",
                                                     absl::CHexEscape(Text(text)), "', byte ", at,
                                                     " begins no printable character of UTF-8"));
    }
    at += bytes;
  }
  return absl::OkStatus();
}

std::string Printable(std::string_view text, std::size_t max) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = CharacterBytes(text.substr(at));
    const std::string_view character = bytes == 0 ? "?" : text.substr(at, bytes);
    if (out.size() + character.size() > max) break;
    out += character;
    at += std::max<std::size_t>(bytes, 1);
  }
  return out;
}

}  // namespace onesea::wire
