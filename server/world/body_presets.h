#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "common/wire/body_description.h"

/// The ready-made bodies that commands and session files know by name: the one list of them. Bodies
/// of sensible figures, of nobody's real make.
namespace onesea::world {

struct BodyPresetEntry {
  absl::string_view name;
  absl::string_view summary;  ///< one line for people
};
std::vector<BodyPresetEntry> BodyPresets();

/// Complete, of that name, with the bytes of its mesh. NotFound naming those that there are.
absl::StatusOr<wire::BodyDescription> BodyPreset(absl::string_view name);

/// The description with its preset filled in (wire::Overlaid), or as it is if it names none.
/// NotFound.
absl::StatusOr<wire::BodyDescription> WithPreset(wire::BodyDescription given);

}  // namespace onesea::world
