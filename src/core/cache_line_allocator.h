// SPDX-License-Identifier: Apache-2.0
//
// Memory for images and textures.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

namespace halfspace {

/// bytes of memory, all 0, that start at a cache line, so that whole lines can be written at once. Large memory comes from the
/// system, which clears a page when it is first touched, and so in the thread that writes it; it is put on large pages where there are
/// any: it is had and given back in a fraction of the time, so that a program with gigabytes of picture ends at once. Throws
/// std::bad_alloc.
void* allocate_lines(std::size_t bytes);
/// Gives back what allocate_lines(bytes) gave.
void free_lines(void* memory, std::size_t bytes) noexcept;

/// allocate_lines for containers that only grow: a new value is taken to be 0 already, and is not touched.
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

}  // namespace halfspace
