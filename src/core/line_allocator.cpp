// SPDX-License-Identifier: Apache-2.0
#include "core/line_allocator.h"

#include <sys/mman.h>

#include <new>

namespace halfspace {

namespace {

constexpr std::align_val_t kLine{64};
constexpr std::align_val_t kLargePage{std::size_t{2} << 20};
constexpr std::size_t kLarge = std::size_t{4} << 20;

std::align_val_t alignment_of(std::size_t bytes) { return bytes < kLarge ? kLine : kLargePage; }

}  // namespace

void* allocate_lines(std::size_t bytes) {
  void* memory = ::operator new(bytes, alignment_of(bytes));
  if (bytes >= kLarge) ::madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: where it is refused, pages are small
  return memory;
}

void free_lines(void* memory, std::size_t bytes) noexcept { ::operator delete(memory, alignment_of(bytes)); }

}  // namespace halfspace
