// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace halfspace {

/// 64-bit FNV-1a over numbers. Each number is hashed in one step, whether it is a byte or a word.
class Hash {
 public:
  void add(uint64_t number) { value_ = (value_ ^ number) * 0x100000001b3u; }
  /// Adds all channels of an image with integer texels.
  template <class Image>
  void add_codes(const Image& image) {
    for (const auto& t : image.texels()) {
      for (int c = 0; c < 4; ++c) add(t[c]);
    }
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0xcbf29ce484222325u;
};

}  // namespace halfspace
