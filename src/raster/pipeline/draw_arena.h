// SPDX-License-Identifier: Apache-2.0
//
// Memory for what the draws of a pass keep: copies of their shaders, vertex streams and states. It is freed all at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <memory_resource>
#include <new>
#include <type_traits>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Allocates from blocks that are kept for the next pass. Not thread-safe.
class DrawArena final : public std::pmr::memory_resource {
 public:
  /// Frees everything that was allocated, and keeps the blocks.
  void reset() { block_ = used_ = 0; }
  /// Returns the size of all blocks.
  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const Block& b : blocks_) sum += b.size;
    return sum;
  }

 private:
  static constexpr std::size_t kBlockBytes = 64 << 10;

  struct Block {
    std::unique_ptr<std::byte[]> data;
    std::size_t size;
  };

  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    for (; block_ < blocks_.size(); ++block_, used_ = 0) {
      void* at = blocks_[block_].data.get() + used_;
      std::size_t space = blocks_[block_].size - used_;
      if (std::align(alignment, bytes, at, space) == nullptr) continue;
      used_ = blocks_[block_].size - space + bytes;
      return at;
    }
    const std::size_t size = std::max(kBlockBytes, bytes + alignment);
    blocks_.push_back({std::make_unique_for_overwrite<std::byte[]>(size), size});
    return do_allocate(bytes, alignment);
  }
  void do_deallocate(void*, std::size_t, std::size_t) override {}
  bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override { return this == &other; }

  std::vector<Block> blocks_;
  std::size_t block_ = 0;  // the block from which memory is taken
  std::size_t used_ = 0;   // bytes of this block
};

/// Returns a copy of a value that lasts as long as the memory.
template <class T>
const T& keep(const T& value, std::pmr::memory_resource& memory) {
  static_assert(std::is_trivially_destructible_v<T>);
  return *::new (memory.allocate(sizeof(T), alignof(T))) T(value);
}

}  // namespace halfspace::HS_LANES
