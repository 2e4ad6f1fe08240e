#pragma once

#include <concepts>
#include <cstdint>
#include <string>

#include "absl/strings/string_view.h"

namespace onesea::app {

/// Writes one JSON value, for the --json answers of the command. Keys in the order of the calls,
/// one line.
///
///   JsonWriter json;
///   json.BeginObject().Key("hs_m").Value(4.71);
///   json.Key("points").BeginArray().Value(1).EndArray().EndObject();
///   json.text()  // {"hs_m":4.71,"points":[1]}
///
/// Numbers are the shortest text that reads back as the same double; NaN and infinities, which JSON
/// lacks, are null. 64-bit hashes go in as text, since most readers of JSON hold numbers as
/// doubles.
class JsonWriter {
 public:
  JsonWriter& BeginObject() { return Open('{'); }
  JsonWriter& EndObject() { return Close('}'); }
  JsonWriter& BeginArray() { return Open('['); }
  JsonWriter& EndArray() { return Close(']'); }
  JsonWriter& Key(absl::string_view name);
  JsonWriter& Value(double number);
  JsonWriter& Value(float number);
  JsonWriter& Value(absl::string_view text);
  JsonWriter& Value(const char* text) { return Value(absl::string_view(text)); }
  JsonWriter& Value(bool truth);
  template <std::integral T>
  JsonWriter& Value(T number) {
    return Plain(std::to_string(number));
  }
  JsonWriter& Null() { return Plain("null"); }

  const std::string& text() const { return text_; }

 private:
  JsonWriter& Open(char bracket);
  JsonWriter& Close(char bracket);
  JsonWriter& Plain(absl::string_view text);
  void Separate();
  void AppendQuoted(absl::string_view text);

  std::string text_;
  bool needs_comma_ = false;
};

}  // namespace onesea::app
