#include "common/ingest/text_lines.h"

#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"

namespace onesea::ingest {
namespace {

constexpr absl::string_view kBlanks = " \t\r\v\f";
constexpr std::size_t kQuotedCharactersMax = 40;
constexpr std::size_t kNumberCharactersMax = 64;

// std::from_chars knows no plus in front.
absl::string_view WithoutPlus(absl::string_view text) {
  const bool is_signed_once = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return is_signed_once ? text.substr(1) : text;
}

// Writes Fortran's real as C's: D becomes e, and a sign that follows a digit gets the e that
// Fortran left out.
std::size_t NormaliseReal(absl::string_view text, char* out) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool after_mantissa =
        i > 0 && ((text[i - 1] >= '0' && text[i - 1] <= '9') || text[i - 1] == '.');
    if ((c == '+' || c == '-') && after_mantissa) out[size++] = 'e';
    const bool is_exponent = c == 'D' || c == 'd' || c == 'E';
    out[size++] = is_exponent ? 'e' : c;
  }
  return size;
}

}  // namespace

absl::Status FileError(absl::string_view name, int line, absl::string_view field,
                       absl::string_view problem) {
  const std::string place = line > 0 ? absl::StrCat(name, ":", line) : std::string(name);
  return absl::InvalidArgumentError(absl::StrCat(place, ": ", field, ": ", problem));
}

absl::Status BadField(absl::string_view name, int line, absl::string_view field,
                      absl::string_view found, absl::string_view wanted) {
  const bool is_long = found.size() > kQuotedCharactersMax;
  return FileError(name, line, field,
                   absl::StrCat("'", absl::CHexEscape(found.substr(0, kQuotedCharactersMax)),
                                is_long ? "...' is not " : "' is not ", wanted));
}

absl::string_view TakeField(absl::string_view& rest) {
  const std::size_t begin = rest.find_first_not_of(kBlanks);
  if (begin == absl::string_view::npos) {
    rest = {};
    return {};
  }
  rest.remove_prefix(begin);
  const absl::string_view field = rest.substr(0, rest.find_first_of(kBlanks));
  rest.remove_prefix(field.size());
  return field;
}

std::optional<double> ParseReal(absl::string_view text) {
  text = WithoutPlus(text);
  if (text.empty() || text.size() > kNumberCharactersMax) return std::nullopt;
  char buffer[2 * kNumberCharactersMax];
  const std::size_t size = NormaliseReal(text, buffer);
  double value = 0.0;
  const auto [end, error] = std::from_chars(buffer, buffer + size, value);
  if (end != buffer + size) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    const bool is_tiny = absl::string_view(buffer, size).find("e-") != absl::string_view::npos;
    return is_tiny ? std::optional<double>(0.0) : std::nullopt;
  }
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<int> ParseInt(absl::string_view text) {
  text = WithoutPlus(text);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool TextLines::Next() {
  if (rest_.empty()) {
    line_ = {};
    return false;
  }
  const std::size_t end = rest_.find('\n');
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(end == absl::string_view::npos ? rest_.size() : end + 1);
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  ++number_;
  return true;
}

bool TextLines::NextNotBlank() {
  while (Next()) {
    if (line_.find_first_not_of(kBlanks) != absl::string_view::npos) return true;
  }
  return false;
}

absl::Status TextLines::Truncated(absl::string_view field) const {
  return Error(field, "the file ends here; it is cut short");
}

}  // namespace onesea::ingest
