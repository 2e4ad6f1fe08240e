#include "client/app/drive_script.h"

#include <string>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace onesea::client {
namespace {

constexpr double kSecondsMax = 3600.0;

bool* KeyNamed(absl::string_view name, SkipperInput& keys) {
  if (name == "up") return &keys.helm.ahead;
  if (name == "down") return &keys.helm.astern;
  if (name == "left") return &keys.helm.port;
  if (name == "right") return &keys.helm.starboard;
  if (name == "b") return &keys.spawn;
  if (name == "space") return &keys.crate;
  if (name == "x") return &keys.explode;
  if (name == "delete") return &keys.remove;
  return nullptr;
}

}  // namespace

absl::StatusOr<DriveScript> DriveScript::Parse(std::string_view text) {
  DriveScript script;
  const absl::string_view whole(text.data(), text.size());
  for (const absl::string_view part : absl::StrSplit(whole, ',', absl::SkipWhitespace())) {
    const std::pair<absl::string_view, absl::string_view> sides =
        absl::StrSplit(part, absl::MaxSplits('=', 1));
    const double last = script.entries_.empty() ? 0.0 : script.entries_.back().second;
    Entry entry;
    if (!absl::SimpleAtod(sides.first, &entry.second) || part.find('=') == part.npos ||
        !(entry.second >= last && entry.second <= kSecondsMax)) {
      return absl::InvalidArgumentError(absl::StrCat(
          "--drive: '", part, "': write SECOND=KEYS with seconds that ascend within [0, ",
          kSecondsMax, "], as 0=b,1=up,4=up+left,9="));
    }
    for (const absl::string_view name : absl::StrSplit(sides.second, '+', absl::SkipWhitespace())) {
      bool* const key = KeyNamed(absl::StripAsciiWhitespace(name), entry.keys);
      if (key == nullptr) {
        return absl::InvalidArgumentError(
            absl::StrCat("--drive: no key '", name, "' in '", part,
                         "'; there are up, down, left, right, b, space, x, delete"));
      }
      *key = true;
    }
    script.entries_.push_back(entry);
  }
  return script;
}

SkipperInput DriveScript::At(double second) {
  SkipperInput keys;
  for (; next_ < entries_.size() && entries_[next_].second <= second; ++next_) {
    const SkipperInput& down = entries_[next_].keys;
    keys.spawn = keys.spawn || down.spawn;
    keys.crate = keys.crate || down.crate;
    keys.explode = keys.explode || down.explode;
    keys.remove = keys.remove || down.remove;
  }
  if (next_ > 0) keys.helm = entries_[next_ - 1].keys.helm;
  return keys;
}

}  // namespace onesea::client
