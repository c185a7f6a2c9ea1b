// SPDX-License-Identifier: Apache-2.0
//
// Transparent layers of a tile, for draws with DrawState::order_independent: blended fragments are kept, sorted by depth, until all of them
// are known. Input: shaded packets and their depth. Output: the tile's color buffers.
#pragma once

#include <memory>
#include <vector>

#include "halfspace/raster/tile/tile.h"

namespace halfspace {

class TransparentLayers {
 public:
  static constexpr int kMaxLayers = 8;  ///< per sample; the farthest one also contains all that would follow

  /// Removes all layers. nearer_is_greater: of two depths, the greater one is nearer to the eye.
  void clear(bool nearer_is_greater);
  bool empty() const { return used_.empty(); }

  /// Inserts a fragment in front of the layers that are at the same depth or farther away. color has straight alpha. Returns the lanes in which there were
  /// already kMaxLayers layers.
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
    int count;                             // of layers that exist in any lane; in the other lanes they are infinitely far and transparent
  };

  Mask is_nearer(Real a, Real b) const { return nearer_is_greater_ ? a > b : a < b; }
  Stack& stack_of(int packet);

  bool nearer_is_greater_ = true;
  std::vector<uint16_t> used_;  // packets with a stack, in the order of `stacks_`
  std::vector<std::unique_ptr<Stack>> stacks_;
  std::array<int16_t, kPackets> index_{};  // of a packet's stack, plus 1; 0: none
};

}  // namespace halfspace
