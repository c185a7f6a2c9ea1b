// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/primitive_stage.h"

namespace halfspace {

namespace {

// Returns the vertices of an unclipped triangle in submission order. Setup has reordered them to be counter-clockwise from the smallest
// depth, and has stored the position of the provoking vertex.
std::array<uint32_t, 3> submitted_order(const Triangle& t, const DrawState& state) {
  const uint32_t provoking = state.provoking == ProvokingVertex::first ? 0 : 2;
  const bool kept_winding = t.is(kFrontFacing) == (state.front == Winding::counter_clockwise);
  std::array<uint32_t, 3> vertex;
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t steps = kept_winding ? i + 3 - provoking : provoking + 3 - i;
    vertex[i] = t.vertex[(t.provoking() + steps) % 3];
  }
  return vertex;
}

class DrawRangePrimitives {
 public:
  DrawRangePrimitives(const PassContext& context, const Chunk& chunk, const DrawRange& range)
      : chunk_(chunk), draw_(context.draws[range.draw]), shaded_(context.shaded[range.draw]) {}

  // Returns the varyings of the submitted vertices of triangle i.
  std::array<const float*, 3> rows(uint32_t i) {
    const Triangle& t = chunk_.triangles[i];
    const bool is_piece = t.is(kClipped | kLine);
    const std::array<uint32_t, 3> vertex = is_piece ? source(i) : submitted_order(t, draw_.state);
    std::array<const float*, 3> r;
    for (std::size_t k = 0; k < 3; ++k) {
      r[k] = shaded_.varyings.get() + std::size_t{vertex[k]} * static_cast<std::size_t>(shaded_.varying_count);
    }
    return r;
  }

 private:
  std::array<uint32_t, 3> source(uint32_t i) {
    const auto after = std::upper_bound(chunk_.clip_sources.begin(), chunk_.clip_sources.end(), i,
                                        [](uint32_t triangle, const ClipSource& s) { return triangle < s.triangle; });
    return (after - 1)->vertex;
  }

  const Chunk& chunk_;
  const Draw& draw_;
  const ShadedVertices& shaded_;
};

}  // namespace

void run_primitive_stage(const PassContext& context, Chunk& chunk) {
  std::vector<std::array<const float*, 3>> rows;
  for (std::size_t s = 0; s < chunk.ranges.size(); ++s) {
    DrawRange& range = chunk.ranges[s];
    const Draw& draw = context.draws[range.draw];
    const auto end = s + 1 < chunk.ranges.size() ? chunk.ranges[s + 1].first_triangle : static_cast<uint32_t>(chunk.triangles.size());
    if (draw.kernels.primitive == nullptr || range.first_triangle == end) continue;
    rows.clear();
    DrawRangePrimitives range_rows(context, chunk, range);
    for (uint32_t i = range.first_triangle; i < end; ++i) rows.push_back(range_rows.rows(i));
    range.first_primitive = static_cast<uint32_t>(chunk.primitives.size());
    chunk.primitives.resize(chunk.primitives.size() + rows.size() * static_cast<std::size_t>(draw.kernels.primitive_count));
    draw.kernels.primitive(draw.shader.get(),
                           {rows.data(), static_cast<int>(rows.size()), chunk.primitives.data() + range.first_primitive});
  }
}

}  // namespace halfspace
