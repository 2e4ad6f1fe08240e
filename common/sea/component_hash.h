#pragma once

#include <cstdint>

#include "common/sea/components.h"

namespace onesea::sea {

/// The hash that travels with a recipe: over every number from which a surface is synthesised, in
/// the order of components.h. Names and Components::hash itself are left out. Cost: about 1 ms.
std::uint64_t HashOf(const Components& components);

}  // namespace onesea::sea
