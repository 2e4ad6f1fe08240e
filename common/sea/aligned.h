#pragma once

#include <algorithm>
#include <cstddef>

#include "common/base/check.h"
#include "hwy/aligned_allocator.h"

namespace onesea::sea {

/// Arrays that start on a cache line, for SIMD.
template <typename T>
using AlignedArray = hwy::AlignedFreeUniquePtr<T[]>;
using FloatArray = AlignedArray<float>;

template <typename T>
AlignedArray<T> AllocateZeros(std::size_t count) {
  AlignedArray<T> array = hwy::AllocateAligned<T>(count);
  ONESEA_CHECK(array != nullptr) << "out of memory: " << count << " elements";
  std::fill_n(array.get(), count, T{});
  return array;
}

}  // namespace onesea::sea
