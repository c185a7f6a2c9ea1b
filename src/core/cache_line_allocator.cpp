// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/cache_line_allocator.h"

#include <sys/mman.h>

#include <cstdint>
#include <cstring>
#include <new>

namespace halfspace::HS_LANES {

namespace {

constexpr std::align_val_t kLine{64};
constexpr std::size_t kLargePage = std::size_t{2} << 20;
constexpr std::size_t kLarge = std::size_t{1} << 20;  // smaller blocks would leave more than half of a large page unused

// Maps zeroed memory aligned to a large page. bytes must be a multiple of kLargePage.
void* map_pages(std::size_t bytes) {
  void* mapping = ::mmap(nullptr, bytes + kLargePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapping == MAP_FAILED) throw std::bad_alloc();
  auto* const first = static_cast<std::byte*>(mapping);
  const std::size_t before = (kLargePage - reinterpret_cast<uintptr_t>(first) % kLargePage) % kLargePage;
  if (before != 0) ::munmap(first, before);
  ::munmap(first + before + bytes, kLargePage - before);
  ::madvise(first + before, bytes, MADV_HUGEPAGE);  // only a hint: without huge pages the kernel uses small ones
  return first + before;
}

std::size_t whole_pages(std::size_t bytes) { return (bytes + kLargePage - 1) / kLargePage * kLargePage; }

}  // namespace

void* allocate_lines(std::size_t bytes) {
  if (bytes > SIZE_MAX / 2) throw std::bad_alloc();
  if (bytes >= kLarge) return map_pages(whole_pages(bytes));
  return std::memset(::operator new(bytes, kLine), 0, bytes);
}

void free_lines(void* memory, std::size_t bytes) noexcept {
  if (bytes >= kLarge) {
    ::munmap(memory, whole_pages(bytes));
  } else {
    ::operator delete(memory, kLine);
  }
}

}  // namespace halfspace::HS_LANES
