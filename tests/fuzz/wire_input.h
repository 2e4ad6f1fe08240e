#pragma once

#include <string_view>

/// What a client decodes, from bytes that nobody vouches for.
namespace onesea::fuzz {

/// The first byte chooses: 0 a blob of tiles, for a viewer that holds the first frames of a sea; 1
/// states of bodies; 2 a whole frame; 'T' a terrain. Aborts where what is accepted breaks its
/// promises.
void DecodeAndCheck(std::string_view input);

}  // namespace onesea::fuzz
