#pragma once

#include <cstddef>
#include <cstdint>

#include "common/sea/surface.h"

/// The spline coefficients of a cascade as point queries read them.
///
/// Three planes are rounded to 16 bits, in units of the largest value over 32767 (0.2 mm in a storm
/// of Hs 5 m), and a record holds their values at one column and two neighbouring rows: four words,
/// one a plane and one of nothing, the lower row in the lower half of each. So the 16 coefficients
/// around a point are twice 64 contiguous bytes, and a weighted sum along the columns is one
/// multiplication of pairs.
///
/// Layout: (N + 2) rows of (N + 4) records. Row r and column c hold rows r - 1 and r and column
/// c - 1 of the planes, which go on periodically. The second record of a row starts a cache line.
namespace onesea::sea {

struct QueryRecords {
  const std::uint32_t* words = nullptr;
  float unit = 0.0f;  ///< of the planes' own unit, for one step of a half word
};

inline std::size_t RecordPitchWords(int grid_size) {
  return 4 * (static_cast<std::size_t>(grid_size) + 4);
}
inline constexpr std::size_t kRecordLeadWords = 12;
inline std::size_t RecordWords(int grid_size) {
  return kRecordLeadWords + (static_cast<std::size_t>(grid_size) + 2) * RecordPitchWords(grid_size);
}

/// A half of a word, in units. `row` 0 is the lower one.
inline int RecordHalf(std::uint32_t word, int row) {
  return static_cast<std::int16_t>(row == 0 ? word & 0xffffu : word >> 16);
}

/// Fills `storage`, RecordWords() from a cache line on, and returns the records in it. Allocates
/// nothing.
QueryRecords WriteRecords(const CascadeFields& fields, const Field (&planes)[3],
                          std::uint32_t* storage);

}  // namespace onesea::sea
