// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/tile/layers.h"

#include <utility>

#include "halfspace/raster/tile/blend.h"

namespace halfspace::HS_LANES {

namespace {

// Exchanges a and b in the lanes of the mask.
void exchange(Mask mask, Real& a, Real& b) {
  const Real old = a;
  a = select(mask, b, a);
  b = select(mask, old, b);
}

// Blends `front` over `back`; both are premultiplied by alpha.
PacketColor over(const PacketColor& front, const PacketColor& back) {
  PacketColor out;
  for (std::size_t k = 0; k < 4; ++k) out[k] = fma(Real(1.0f) - front[3], back[k], front[k]);
  return out;
}

}  // namespace

void TransparentLayers::clear(bool nearer_is_greater) {
  for (const uint16_t packet : used_) index_[packet] = 0;
  used_.clear();
  nearer_is_greater_ = nearer_is_greater;
}

TransparentLayers::Stack& TransparentLayers::stack_of(int packet) {
  int16_t& index = index_[static_cast<std::size_t>(packet)];
  if (index == 0) {
    used_.push_back(static_cast<uint16_t>(packet));
    index = static_cast<int16_t>(used_.size());
    if (stacks_.size() < used_.size()) stacks_.push_back(std::make_unique<Stack>());
    stacks_[used_.size() - 1]->count = 0;
  }
  return *stacks_[static_cast<std::size_t>(index - 1)];
}

Mask TransparentLayers::add(int packet, Mask mask, Real depth, const PacketColor& color) {
  if (none(mask)) return mask;
  const Real farthest = farthest_depth();
  const Real alpha = select(mask, clamp(color[3], Real(0.0f), Real(1.0f)), Real(0.0f));
  Layer added{select(mask, depth, farthest), {color[0] * alpha, color[1] * alpha, color[2] * alpha, alpha}};
  for (std::size_t k = 0; k < 3; ++k) added.color[k] = select(mask, added.color[k], Real(0.0f));
  Stack& stack = stack_of(packet);
  for (int i = 0; i < stack.count; ++i) {
    Layer& layer = stack.layers[static_cast<std::size_t>(i)];
    const Mask behind = !is_nearer(layer.depth, added.depth) && !(added.depth == farthest);
    if (none(behind)) continue;
    exchange(behind, layer.depth, added.depth);
    for (std::size_t k = 0; k < 4; ++k) exchange(behind, layer.color[k], added.color[k]);
  }
  const Mask left = !(added.depth == farthest);
  if (none(left)) return left;
  if (stack.count < kMaxLayers) {
    stack.layers[static_cast<std::size_t>(stack.count++)] = added;
    return Mask(false);
  }
  Layer& last = stack.layers.back();
  last.color = over(last.color, added.color);  // in the other lanes, `added` is transparent
  return left;
}

void TransparentLayers::write(ColorBuffer& buffer) {
  for (std::size_t i = 0; i < used_.size(); ++i) {
    const Stack& stack = *stacks_[i];
    PacketColor color = read_color(buffer, used_[i]);
    for (int k = stack.count - 1; k >= 0; --k) color = over(stack.layers[static_cast<std::size_t>(k)].color, color);
    write_color(buffer, used_[i], !(stack.layers[0].depth == farthest_depth()), color, color, {});  // other pixels keep their bits
    index_[used_[i]] = 0;
  }
  used_.clear();
}

}  // namespace halfspace::HS_LANES
