#pragma once

#include <memory>

namespace onesea {

/// Has everybody else let go of it? Then whatever they read was before whatever we write: the count
/// itself is read without order, but the copy goes through its increments and decrements, which
/// acquire what the last reader's released. Pre: nobody can get it from a weak pointer.
template <typename T>
bool IsOnlyOwner(const std::shared_ptr<T>& held) {
  if (held.use_count() != 1) return false;
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): the copy is what orders
  const std::shared_ptr<T> in_order = held;
  return true;
}

}  // namespace onesea
