#include "client/app/cli_arguments.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "absl/strings/match.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "absl/strings/strip.h"
#include "common/base/check.h"
#include "common/base/limits.h"

namespace onesea::app {
namespace {

std::string KnownOptions(std::span<const OptionSpec> specs) {
  return absl::StrJoin(specs, ", ", [](std::string* out, const OptionSpec& spec) {
    absl::StrAppend(out, "--", spec.name);
  });
}

absl::Status NotANumber(absl::string_view what, absl::string_view text, double min, double max) {
  return absl::InvalidArgumentError(
      absl::StrFormat("%s is '%s', it must be a number in [%g, %g]", what, text, min, max));
}

}  // namespace

std::optional<std::string> Arguments::Get(absl::string_view option) const {
  const auto found = values_.find(option);
  if (found == values_.end()) return std::nullopt;
  return found->second.back();
}

std::vector<std::string> Arguments::GetAll(absl::string_view option) const {
  const auto found = values_.find(option);
  return found == values_.end() ? std::vector<std::string>() : found->second;
}

absl::StatusOr<Arguments> ParseArguments(std::span<const OptionSpec> specs,
                                         std::span<const std::string> words) {
  Arguments arguments;
  bool only_operands = false;
  for (std::size_t n = 0; n < words.size(); ++n) {
    const std::string& word = words[n];
    if (!only_operands && word == "--") {
      only_operands = true;
      continue;
    }
    const bool is_option = !only_operands && (absl::StartsWith(word, "--") || word == "-h");
    if (!is_option) {
      arguments.operands_.push_back(word);
      continue;
    }
    const absl::string_view bare = word == "-h" ? "help" : absl::string_view(word).substr(2);
    const std::size_t equals = bare.find('=');
    const absl::string_view name = bare.substr(0, equals);
    const auto spec = std::ranges::find(specs, name, &OptionSpec::name);
    if (spec == specs.end()) {
      return absl::InvalidArgumentError(
          absl::StrFormat("unknown option --%s; known: %s", name, KnownOptions(specs)));
    }
    std::string value;
    if (equals != absl::string_view::npos) {
      if (spec->placeholder.empty()) {
        return absl::InvalidArgumentError(absl::StrFormat("option --%s takes no value", name));
      }
      value = std::string(bare.substr(equals + 1));
    } else if (!spec->placeholder.empty()) {
      if (n + 1 == words.size()) {
        return absl::InvalidArgumentError(
            absl::StrFormat("option --%s needs a value: --%s %s", name, name, spec->placeholder));
      }
      value = words[++n];
    }
    arguments.values_[std::string(name)].push_back(std::move(value));
  }
  return arguments;
}

absl::StatusOr<double> ParseNumber(absl::string_view what, absl::string_view text, double min,
                                   double max) {
  double number = 0.0;
  if (!absl::SimpleAtod(text, &number) || !(number >= min && number <= max)) {
    return NotANumber(what, text, min, max);
  }
  return number;
}

absl::StatusOr<std::int64_t> ParseInteger(absl::string_view what, absl::string_view text,
                                          std::int64_t min, std::int64_t max) {
  std::int64_t number = 0;
  if (!absl::SimpleAtoi(text, &number) || number < min || number > max) {
    return absl::InvalidArgumentError(
        absl::StrFormat("%s is '%s', it must be a whole number in [%d, %d]", what, text, min, max));
  }
  return number;
}

absl::StatusOr<Vec2d> ParsePlace(absl::string_view what, absl::string_view text) {
  const std::vector<absl::string_view> parts = absl::StrSplit(text, ',');
  if (parts.size() != 2) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%s is '%s', it must be X,Y: metres east and north of the origin", what, text));
  }
  Vec2d place;
  ONESEA_ASSIGN_OR_RETURN(place.x, ParseNumber(absl::StrCat("X of ", what), parts[0],
                                               -kQueryCoordinateMaxM, kQueryCoordinateMaxM));
  ONESEA_ASSIGN_OR_RETURN(place.y, ParseNumber(absl::StrCat("Y of ", what), parts[1],
                                               -kQueryCoordinateMaxM, kQueryCoordinateMaxM));
  return place;
}

absl::StatusOr<std::vector<double>> ParseNumbers(absl::string_view what, absl::string_view form,
                                                 absl::string_view text, double max) {
  const std::vector<absl::string_view> names = absl::StrSplit(form, ',');
  const std::vector<absl::string_view> parts = absl::StrSplit(text, ',');
  if (parts.size() != names.size()) {
    return absl::InvalidArgumentError(
        absl::StrFormat("%s is '%s', it must be %s", what, text, form));
  }
  std::vector<double> numbers;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    ONESEA_ASSIGN_OR_RETURN(numbers.emplace_back(),
                            ParseNumber(absl::StrCat(names[n], " of ", what), parts[n], -max, max));
  }
  return numbers;
}

absl::StatusOr<double> ParseSpan(absl::string_view what, absl::string_view text, double min_s,
                                 double max_s) {
  struct Unit {
    absl::string_view suffix;
    double seconds;
  };
  // "ms" and "min" before the suffixes that they end in or begin with.
  static constexpr std::array<Unit, 5> kUnits = {
      {{"ms", 1e-3}, {"min", 60.0}, {"s", 1.0}, {"h", 3600.0}, {"", 1.0}}};
  for (const Unit& unit : kUnits) {
    absl::string_view digits = text;
    if (!absl::ConsumeSuffix(&digits, unit.suffix)) continue;
    double number = 0.0;
    if (!absl::SimpleAtod(digits, &number)) break;
    const double seconds = number * unit.seconds;
    if (!(seconds >= min_s && seconds <= max_s)) break;
    return seconds;
  }
  return absl::InvalidArgumentError(
      absl::StrFormat("%s is '%s', it must be a span such as 90s, 1.5min or 2h in [%g s, %g s]",
                      what, text, min_s, max_s));
}

}  // namespace onesea::app
