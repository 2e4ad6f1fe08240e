#pragma once

#include <cstdint>

/// Calls of operator new in this program so far; link allocation_count.cc, which replaces the
/// operator.
std::int64_t AllocationCount();
