#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/sea/query_records.cc"
#include "hwy/foreach_target.h"
//
#include <cstring>

#include "common/base/limits.h"
#include "common/sea/query_records.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace onesea::sea {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using DU = hn::RebindToUnsigned<D>;
using V = hn::Vec<D>;

float LargestTarget(const float* values, std::size_t count) {
  const D d;
  V a = hn::Zero(d), b = a;  // a maximum does not depend on its order
  for (std::size_t n = 0; n < count; n += 2 * hn::Lanes(d)) {
    a = hn::Max(a, hn::Abs(hn::Load(d, values + n)));
    b = hn::Max(b, hn::Abs(hn::Load(d, values + n + hn::Lanes(d))));
  }
  return hn::GetLane(hn::MaxOfLanes(d, hn::Max(a, b)));
}

// A row of a plane in whole units; a floor, since nearest-integer conversions differ in ties.
HWY_INLINE void Round(const float* from, V units, std::size_t size, std::uint32_t* to) {
  const D d;
  const hn::RebindToSigned<D> di;
  for (std::size_t u = 0; u < size; u += hn::Lanes(d)) {
    const V scaled = hn::Add(hn::Mul(hn::Load(d, from + u), units), hn::Set(d, 0.5f));
    hn::Store(hn::BitCast(DU(), hn::ConvertTo(di, hn::Floor(scaled))), DU(), to + u);
  }
}

struct alignas(64) RoundedRow {
  std::uint32_t planes[3][kGridSizeMax];
};

void WriteTarget(const float* x, const float* y, const float* z, float units_per_value,
                 std::size_t size, std::uint32_t* words) {
  const DU d;
  const V units = hn::Set(D(), units_per_value);
  const std::size_t pitch = 4 * (size + 4);
  RoundedRow rows[2];
  const auto round = [&](std::size_t v, RoundedRow& to) HWY_ATTR {
    Round(x + v * size, units, size, to.planes[0]);
    Round(y + v * size, units, size, to.planes[1]);
    Round(z + v * size, units, size, to.planes[2]);
  };
  round(size - 1, rows[1]);
  for (std::size_t r = 0; r < size; ++r) {
    const RoundedRow &lower = rows[(r + 1) % 2], &upper = rows[r % 2];
    round(r, rows[r % 2]);
    std::uint32_t* row = words + r * pitch;
    const auto pairs = [&](int plane, std::size_t u) HWY_ATTR {
      const auto low = hn::And(hn::Load(d, lower.planes[plane] + u), hn::Set(d, 0xffffu));
      return hn::Or(low, hn::ShiftLeft<16>(hn::Load(d, upper.planes[plane] + u)));
    };
    for (std::size_t u = 0; u < size; u += hn::Lanes(d)) {
      hn::StoreInterleaved4(pairs(0, u), pairs(1, u), pairs(2, u), hn::Zero(d), d,
                            row + 4 * (u + 1));
    }
    std::memcpy(row, row + 4 * size, 4 * sizeof *row);
    std::memcpy(row + 4 * (size + 1), row + 4, 3 * 4 * sizeof *row);
  }
  std::memcpy(words + size * pitch, words, 2 * pitch * sizeof *words);
}

}  // namespace HWY_NAMESPACE
}  // namespace onesea::sea
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>

namespace onesea::sea {

HWY_EXPORT(LargestTarget);
HWY_EXPORT(WriteTarget);

QueryRecords WriteRecords(const CascadeFields& fields, const Field (&planes)[3],
                          std::uint32_t* storage) {
  constexpr float kUnits = 32767.0f;
  float largest = 0.0f;
  for (const Field plane : planes) {
    const auto values = fields.Plane(plane);
    largest = std::max(largest, HWY_DYNAMIC_DISPATCH(LargestTarget)(values.data(), values.size()));
  }
  std::uint32_t* words = storage + kRecordLeadWords;
  const float units_per_value = largest > 0.0f ? kUnits / largest : 0.0f;
  HWY_DYNAMIC_DISPATCH(WriteTarget)
  (fields.Plane(planes[0]).data(), fields.Plane(planes[1]).data(), fields.Plane(planes[2]).data(),
   units_per_value, static_cast<std::size_t>(fields.grid_size()), words);
  return {words, largest / kUnits};
}

}  // namespace onesea::sea
#endif  // HWY_ONCE
