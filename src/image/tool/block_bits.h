// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Reads the bits of a block of 8 or 16 bytes, from the lowest bit of the first byte to the highest bit of the last one.
class BlockBits {
 public:
  BlockBits(const std::byte* block, std::size_t bytes) { std::memcpy(words_, block, bytes); }

  /// Returns the next `count` bits, at most 32. Past the end of the block, they are 0.
  uint32_t take(int count) {
    uint64_t bits = at_ < 128 ? words_[at_ / 64] >> at_ % 64 : 0;
    if (at_ < 64 && at_ + count > 64) bits |= words_[1] << (64 - at_);
    at_ += count;
    return static_cast<uint32_t>(bits & ((uint64_t{1} << count) - 1));
  }

 private:
  uint64_t words_[2] = {};
  int at_ = 0;
};

}  // namespace halfspace::HS_LANES
