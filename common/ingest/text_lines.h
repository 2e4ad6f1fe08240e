#pragma once

#include <optional>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"

/// Text of untrusted files, line by line, with errors that say where the bad field stands.
namespace onesea::ingest {

/// InvalidArgument "name:line: field: problem". Line 0: the whole file.
absl::Status FileError(absl::string_view name, int line, absl::string_view field,
                       absl::string_view problem);

/// Same, with the offending text quoted: bytes that are not printable escaped, long text cut.
absl::Status BadField(absl::string_view name, int line, absl::string_view field,
                      absl::string_view found, absl::string_view wanted);

/// Takes the next field, separated by blanks or tabs, off the front of `rest`; empty at the end.
absl::string_view TakeField(absl::string_view& rest);

/// Finite numbers only, the whole of `text`. Reals also in Fortran's forms 1.5D+03 and 0.123-104
/// (the exponent letter is dropped when three digits follow); what is too small for a double is 0.
std::optional<double> ParseReal(absl::string_view text);
std::optional<int> ParseInt(absl::string_view text);

/// Walks through a text. Lines end with \n or \r\n; the last one needs no end.
class TextLines {
 public:
  TextLines(absl::string_view name, absl::string_view text) : name_(name), rest_(text) {}

  /// Moves to the next line; false at the end of the text.
  bool Next();
  /// Moves to the next line that has more than blanks.
  bool NextNotBlank();

  absl::string_view line() const { return line_; }
  int number() const { return number_; }
  absl::string_view name() const { return name_; }

  absl::Status Error(absl::string_view field, absl::string_view problem) const {
    return FileError(name_, number_, field, problem);
  }
  absl::Status Bad(absl::string_view field, absl::string_view found,
                   absl::string_view wanted) const {
    return BadField(name_, number_, field, found, wanted);
  }
  /// For a text that ends where `field` was due.
  absl::Status Truncated(absl::string_view field) const;

 private:
  absl::string_view name_;
  absl::string_view rest_;
  absl::string_view line_;
  int number_ = 0;
};

}  // namespace onesea::ingest
