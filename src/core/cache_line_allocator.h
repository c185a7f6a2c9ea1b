// SPDX-License-Identifier: Apache-2.0
//
// Zero-initialized memory for images, textures and other large arrays.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Allocates zeroed memory that starts on a cache line boundary, so that code can write whole lines. Blocks of 1 MiB or more are mapped
/// directly from the system, on huge pages where available. The kernel clears each such page on the thread that first touches it.
/// Allocating and freeing such blocks is much faster, so a program with gigabytes of images exits without delay. Throws std::bad_alloc on
/// failure.
void* allocate_lines(std::size_t bytes);
/// Frees memory returned by allocate_lines. bytes must be the value passed to that call.
void free_lines(void* memory, std::size_t bytes) noexcept;

/// Standard allocator on top of allocate_lines. Value-initialized elements are not written, since fresh memory is already
/// zero. A container must therefore only grow: elements that reuse old storage would keep their previous values.
template <class T>
struct CacheLineAllocator {
  using value_type = T;

  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(allocate_lines(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) { free_lines(p, n * sizeof(T)); }
  template <class U, class... Arguments>
  void construct(U* p, Arguments&&... arguments) {
    static_assert(std::is_trivially_copyable_v<U>);
    if constexpr (sizeof...(Arguments) != 0) ::new (static_cast<void*>(p)) U(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};

/// A vector that does not write new elements when it is resized.
template <class T>
using CacheLineVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace halfspace::HS_LANES
