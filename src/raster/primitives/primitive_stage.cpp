// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/primitive_stage.h"

#include <bit>

#include "halfspace/raster/primitives/primitive_assembly.h"

namespace halfspace::HS_LANES {

namespace {

// Returns the vertices of an unclipped triangle in submission order. Setup has reordered them to be counter-clockwise, with the smallest
// depth first, and has stored the position of the provoking vertex.
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

  // The primitive that a triangle was created from.
  struct Source {
    std::array<uint32_t, 3> vertex;  // slots of the submitted vertices
    bool is_first;                   // the triangle is its first piece
  };
  Source source(uint32_t i) const {
    const Triangle& t = chunk_.triangles[i];
    if (!t.is(kClipped | kLine)) return {submitted_order(t, draw_.state), true};
    const auto after = std::upper_bound(chunk_.clip_sources.begin(), chunk_.clip_sources.end(), i,
                                        [](uint32_t triangle, const ClipSource& s) { return triangle < s.triangle; });
    return {(after - 1)->vertex, (after - 1)->triangle == i};
  }

  // Returns the varyings of the submitted vertices of triangle i.
  std::array<const float*, 3> rows(uint32_t i) const {
    const std::array<uint32_t, 3> vertex = source(i).vertex;
    std::array<const float*, 3> r;
    for (std::size_t k = 0; k < 3; ++k) {
      r[k] = shaded_.varyings.get() + std::size_t{vertex[k]} * static_cast<std::size_t>(shaded_.varying_count);
    }
    return r;
  }

 private:
  const Chunk& chunk_;
  const Draw& draw_;
  const ShadedVertices& shaded_;
};

// Calls f(primitive, slots of its vertices) for the triangles [range.first_triangle, end). Setup keeps the order of the primitives, but
// drops some and splits others. Whether a primitive is dropped depends only on its vertices and their order. The source of a triangle is
// therefore the next submitted primitive that has the same vertices.
template <class F>
void for_each_triangle(const PassContext& context, const Chunk& chunk, const DrawRange& range, uint32_t end, const F& f) {
  const DrawRangePrimitives primitives(context, chunk, range);
  const ShadedVertices& shaded = context.shaded[range.draw];
  const uint32_t slot_base = shaded.first - range.instance * shaded.count;
  Assembly assembly(context.draws[range.draw], range.first);
  std::array<uint32_t, 3> vertex{};
  uint32_t next = range.first;
  for (uint32_t i = range.first_triangle; i < end; ++i) {
    const auto source = primitives.source(i);
    if (source.is_first) {
      do {
        HS_CHECK(next < range.first + range.count, "primitive stage: a chunk has too many primitives; expected those of its range");
        vertex = assembly.next();
        for (uint32_t& v : vertex) v -= slot_base;
        ++next;
      } while (vertex != source.vertex);
    }
    f(next - 1, vertex);
  }
}

// Writes the ids of the triangles [range.first_triangle, end).
void write_ids(const PassContext& context, const Chunk& chunk, const DrawRange& range, uint32_t end, float* row) {
  const DrawState& state = context.draws[range.draw].state;
  const bool has_second = !draws_points(state), has_third = has_second && !is_lines(state.topology);
  for_each_triangle(context, chunk, range, end, [&](uint32_t primitive, const std::array<uint32_t, 3>& vertex) {
    row[kIdPrimitive] = std::bit_cast<float>(primitive);
    row[kIdInstance] = std::bit_cast<float>(range.instance);
    row[kIdSecond] = std::bit_cast<float>(has_second ? vertex[1] : kNoSlot);
    row[kIdThird] = std::bit_cast<float>(has_third ? vertex[2] : kNoSlot);
    row += kIdRow;
  });
}

}  // namespace

void run_primitive_stage(const PassContext& context, Chunk& chunk) {
  std::vector<std::array<const float*, 3>> rows;
  for (std::size_t s = 0; s < chunk.ranges.size(); ++s) {
    DrawRange& range = chunk.ranges[s];
    const Draw& draw = context.draws[range.draw];
    const uint32_t end = chunk.end_triangle(s);
    if (draw.kernels.primitive_count == 0 || range.first_triangle == end) continue;
    const DrawRangePrimitives range_rows(context, chunk, range);
    range.first_primitive = static_cast<uint32_t>(chunk.primitives.size());
    chunk.primitives.resize(chunk.primitives.size() +
                            std::size_t{end - range.first_triangle} * static_cast<std::size_t>(draw.kernels.primitive_count));
    if (draw.kernels.uses_id) {
      write_ids(context, chunk, range, end, chunk.primitives.data() + range.first_primitive);
      continue;
    }
    rows.clear();
    for (uint32_t i = range.first_triangle; i < end; ++i) rows.push_back(range_rows.rows(i));
    draw.kernels.primitive(draw.shader.get(),
                           {rows.data(), static_cast<int>(rows.size()), chunk.primitives.data() + range.first_primitive});
  }
}

std::vector<SubmittedPrimitive> submitted_primitives(const PassContext& context, const Chunk& chunk) {
  std::vector<SubmittedPrimitive> out;
  out.reserve(chunk.triangles.size());
  for (std::size_t s = 0; s < chunk.ranges.size(); ++s) {
    for_each_triangle(context, chunk, chunk.ranges[s], chunk.end_triangle(s),
                      [&](uint32_t primitive, const std::array<uint32_t, 3>& vertex) {
                        out.push_back({primitive, vertex});
                      });
  }
  return out;
}

}  // namespace halfspace::HS_LANES
