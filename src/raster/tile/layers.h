// SPDX-License-Identifier: Apache-2.0
//
// Transparent layers of a tile, for draws with DrawState::order_independent. Fragments are kept, sorted by depth, and blended once all of
// them are known. Input: shaded packets and their depth. Output: the tile's color buffers.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "halfspace/raster/tile/tile.h"

namespace halfspace::HS_LANES {

class TransparentLayers {
 public:
  static constexpr int kMaxLayers = 8;  ///< per sample; layers that are farther are merged into the farthest one

  /// Removes all layers. nearer_is_greater: greater depths are nearer to the eye.
  void clear(bool nearer_is_greater);
  bool empty() const { return used_.empty(); }

  /// Inserts a fragment in front of the layers that are at the same depth or farther away. color has straight alpha. Returns the lanes that
  /// already had kMaxLayers layers, where the two farthest layers were merged.
  Mask add(int packet, Mask mask, Real depth, const PacketColor& color);

  /// Blends the layers over the colors of the tile, from the farthest to the nearest, and removes them.
  void write(ColorBuffer& buffer);

 private:
  struct Layer {
    Real depth;
    PacketColor color;  // premultiplied by alpha
  };
  struct Stack {
    std::array<Layer, kMaxLayers> layers;  // nearest first
    int count;                             // layers that exist in at least one lane; in other lanes they are infinitely far and transparent
  };

  // Depth of layers that do not exist.
  Real farthest_depth() const {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    return Real(nearer_is_greater_ ? -kInfinity : kInfinity);
  }
  Mask is_nearer(Real a, Real b) const { return nearer_is_greater_ ? a > b : a < b; }
  Stack& stack_of(int packet);

  bool nearer_is_greater_ = true;
  std::vector<uint16_t> used_;  // packets with a stack, in the order of `stacks_`
  std::vector<std::unique_ptr<Stack>> stacks_;
  std::array<int16_t, kPackets> index_{};  // for each packet, the index of its stack plus 1, or 0 if it has none
};

}  // namespace halfspace::HS_LANES
