// SPDX-License-Identifier: Apache-2.0
//
// Memory for images and textures.
#pragma once

#include <cstddef>

namespace halfspace {

/// bytes of memory that start at a cache line, so that whole lines can be written at once. Large memory is put on large
/// pages where the system has them: it is had and given back in a fraction of the time, so that a program with gigabytes
/// of picture ends at once. Throws std::bad_alloc.
void* allocate_lines(std::size_t bytes);
/// Gives back what allocate_lines(bytes) gave.
void free_lines(void* memory, std::size_t bytes) noexcept;

/// allocate_lines for containers.
template <class T>
struct LineAllocator {
  using value_type = T;

  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(allocate_lines(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) { free_lines(p, n * sizeof(T)); }
  friend bool operator==(const LineAllocator&, const LineAllocator&) { return true; }
};

}  // namespace halfspace
