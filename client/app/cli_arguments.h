#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "common/base/vec.h"

/// Words of a command line -> options and operands. Subcommands are why this is not a flags
/// library: each has its own options, and an option may be given several times.
namespace onesea::app {

struct OptionSpec {
  absl::string_view name;         ///< without the dashes
  absl::string_view placeholder;  ///< of its value, "X,Y"; empty: a switch without value
  absl::string_view help;
};

class Arguments {
 public:
  bool Has(absl::string_view option) const { return values_.contains(option); }
  /// The last one given.
  std::optional<std::string> Get(absl::string_view option) const;
  /// All given, in order.
  std::vector<std::string> GetAll(absl::string_view option) const;
  const std::vector<std::string>& operands() const { return operands_; }

 private:
  friend absl::StatusOr<Arguments> ParseArguments(std::span<const OptionSpec> specs,
                                                  std::span<const std::string> words);
  std::map<std::string, std::vector<std::string>, std::less<>> values_;
  std::vector<std::string> operands_;
};

/// `--name value`, `--name=value`, `--switch`, `-h` for --help; after `--` everything is an
/// operand. A value may begin with a dash (--at -3,4). InvalidArgument in one line naming the word.
absl::StatusOr<Arguments> ParseArguments(std::span<const OptionSpec> specs,
                                         std::span<const std::string> words);

/// The numbers of people. `what` names the word in errors ("--time"); NaN and infinities are
/// refused.
absl::StatusOr<double> ParseNumber(absl::string_view what, absl::string_view text, double min,
                                   double max);
absl::StatusOr<std::int64_t> ParseInteger(absl::string_view what, absl::string_view text,
                                          std::int64_t min, std::int64_t max);
/// "X,Y" in metres, each within kQueryCoordinateMaxM.
absl::StatusOr<Vec2d> ParsePlace(absl::string_view what, absl::string_view text);
/// As many numbers as `form` ("X,Y,Z") has names, each within `max` either way.
absl::StatusOr<std::vector<double>> ParseNumbers(absl::string_view what, absl::string_view form,
                                                 absl::string_view text, double max);
/// "90", "90s", "1.5min", "2h", "500ms" -> seconds.
absl::StatusOr<double> ParseSpan(absl::string_view what, absl::string_view text, double min_s,
                                 double max_s);

}  // namespace onesea::app
