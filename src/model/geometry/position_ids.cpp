// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/geometry/position_ids.h"

#include <bit>
#include <limits>

namespace halfspace::HS_LANES {

namespace {

constexpr uint32_t kEmpty = std::numeric_limits<uint32_t>::max();

uint64_t mix(uint64_t x) {
  x *= 0x9e3779b97f4a7c15u;
  return x ^ (x >> 32);
}

uint64_t hash(const glm::vec3& p) {
  const auto bits = [](float x) { return uint64_t{std::bit_cast<uint32_t>(x + 0.0f)}; };  // −0 becomes 0
  return mix(mix(bits(p.x) | bits(p.y) << 32) ^ bits(p.z));
}

}  // namespace

std::vector<uint32_t> position_ids(std::span<const glm::vec3> positions) {
  const std::size_t slots = std::bit_ceil(positions.size() * 2 + 1);  // at most half full
  std::vector<uint32_t> table(slots, kEmpty), ids(positions.size());
  for (uint32_t i = 0; i < ids.size(); ++i) {
    std::size_t slot = hash(positions[i]) & (slots - 1);
    while (table[slot] != kEmpty && positions[table[slot]] != positions[i]) slot = (slot + 1) & (slots - 1);
    if (table[slot] == kEmpty) table[slot] = i;
    ids[i] = table[slot];
  }
  return ids;
}

}  // namespace halfspace::HS_LANES
