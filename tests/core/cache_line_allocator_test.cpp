// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/cache_line_allocator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <string>
#include <vector>

namespace halfspace {
namespace {

// Returns whether huge pages were requested for the mapping that contains address (flag "hg" in /proc/self/smaps).
bool asked_for_large_pages(const void* address) {
  std::ifstream maps("/proc/self/smaps");
  bool inside = false;
  for (std::string line; std::getline(maps, line);) {
    uintptr_t first = 0, last = 0;
    char dash = 0;
    std::istringstream range(line);
    if (range >> std::hex >> first >> dash >> last && dash == '-') {
      inside = first <= reinterpret_cast<uintptr_t>(address) && reinterpret_cast<uintptr_t>(address) < last;
    } else if (inside && line.starts_with("VmFlags:")) {
      return line.find(" hg") != std::string::npos;
    }
  }
  return false;
}

TEST(CacheLineAllocator, AlignsToCacheLines) {
  for (const std::size_t bytes :
       {std::size_t{1}, std::size_t{1000}, (std::size_t{4} << 20) - 1, std::size_t{4} << 20, std::size_t{9} << 20}) {
    void* memory = allocate_lines(bytes);
    EXPECT_EQ(reinterpret_cast<uintptr_t>(memory) % 64, 0u) << bytes;
    static_cast<char*>(memory)[bytes - 1] = 1;
    free_lines(memory, bytes);
  }
}

TEST(CacheLineAllocator, ReturnsZeroedMemory) {
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{1000}, (std::size_t{4} << 20) - 1, std::size_t{9} << 20}) {
    for (int round = 0; round < 3; ++round) {  // freed memory may be reused
      auto* memory = static_cast<unsigned char*>(allocate_lines(bytes));
      EXPECT_EQ(std::count(memory, memory + bytes, 0), static_cast<std::ptrdiff_t>(bytes)) << bytes;
      std::fill(memory, memory + bytes, static_cast<unsigned char>(255));
      free_lines(memory, bytes);
    }
  }
}

TEST(CacheLineAllocator, ThrowsBadAllocForExcessiveSizes) {
  EXPECT_THROW(allocate_lines(SIZE_MAX / 2), std::bad_alloc);
  EXPECT_THROW(allocate_lines(SIZE_MAX - 1), std::bad_alloc);
}

TEST(CacheLineAllocator, KeepsExplicitlyGivenValues) {
  std::vector<int, CacheLineAllocator<int>> numbers(1000);
  EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 0), 1000);
  numbers.push_back(7);
  numbers.resize(3000, 9);
  EXPECT_EQ(numbers[1000], 7);
  EXPECT_EQ(std::count(numbers.begin() + 1001, numbers.end(), 9), 1999);
  numbers.resize(6000);
  EXPECT_EQ(std::count(numbers.begin() + 3000, numbers.end(), 0), 3000);
}

TEST(CacheLineAllocator, RequestsHugePagesForLargeBlocks) {
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage")) GTEST_SKIP() << "transparent huge pages are not available";
  constexpr std::size_t kBytes = std::size_t{64} << 20;
  void* memory = allocate_lines(kBytes);
  EXPECT_EQ(reinterpret_cast<uintptr_t>(memory) % (std::size_t{2} << 20), 0u);
  EXPECT_TRUE(asked_for_large_pages(memory));
  free_lines(memory, kBytes);
}

}  // namespace
}  // namespace halfspace
