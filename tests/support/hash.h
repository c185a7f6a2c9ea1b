// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "halfspace/core/image.h"

namespace halfspace {

/// FNV-1a, 64 bits, over numbers: each is one step, whether it is a byte or a word.
class Hash {
 public:
  void add(uint64_t number) { value_ = (value_ ^ number) * 0x100000001b3u; }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0xcbf29ce484222325u;
};

inline void add_codes(Hash& hash, const Image<glm::u8vec4>& image) {
  for (const glm::u8vec4& t : image.texels()) {
    for (int c = 0; c < 4; ++c) hash.add(t[c]);
  }
}

inline uint64_t hash_of(const Image<glm::u8vec4>& image) {
  Hash hash;
  add_codes(hash, image);
  return hash.value();
}

}  // namespace halfspace
