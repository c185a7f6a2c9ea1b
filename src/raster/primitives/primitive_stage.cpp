// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/primitive_stage.h"

#include <bit>

#include "halfspace/raster/primitives/primitive_assembly.h"

namespace halfspace::HS_LANES {

namespace {

// Calls f(primitive, slots of its vertices) for the triangles [range.first_triangle, end).
template <class F>
void for_each_triangle(const PassContext& context, const Chunk& chunk, const DrawRange& range, uint32_t end, const F& f) {
  const ShadedVertices& shaded = context.shaded[range.draw];
  const uint32_t slot_base = shaded.first - range.instance * shaded.count;
  Assembly assembly(context.draws[range.draw], range.first);
  std::array<uint32_t, 3> vertex{};
  uint32_t next = range.first;
  HS_CHECK(range.first_triangle == end || chunk.primitive_numbers.size() >= end,
           "primitive stage: setup did not record the primitive numbers; expected a TileRunner that inspects primitives");
  for (uint32_t i = range.first_triangle; i < end; ++i) {
    const uint32_t primitive = chunk.primitive_numbers[i];
    for (; next <= primitive; ++next) {
      vertex = assembly.next();
      for (uint32_t& v : vertex) v -= slot_base;
    }
    f(primitive, vertex);
  }
}

// Writes the ids of the triangles [range.first_triangle, end).
void write_ids(const PassContext& context, const Chunk& chunk, const DrawRange& range, uint32_t end, float* row) {
  const Draw& draw = context.draws[range.draw];
  const DrawState& state = draw.state;
  const bool has_second = !draws_points(state), has_third = has_second && !is_lines(state.topology);
  for_each_triangle(context, chunk, range, end, [&](uint32_t primitive, const std::array<uint32_t, 3>& vertex) {
    const PrimitiveNumber number = submitted_primitive(draw, range.instance, primitive);
    row[kIdPrimitive] = std::bit_cast<float>(number.primitive);
    row[kIdInstance] = std::bit_cast<float>(number.instance);
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
    range.first_primitive = static_cast<uint32_t>(chunk.primitives.size());
    chunk.primitives.resize(chunk.primitives.size() +
                            std::size_t{end - range.first_triangle} * static_cast<std::size_t>(draw.kernels.primitive_count));
    if (draw.kernels.uses_id) {
      write_ids(context, chunk, range, end, chunk.primitives.data() + range.first_primitive);
      continue;
    }
    rows.clear();
    const ShadedVertices& shaded = context.shaded[range.draw];
    const auto row_of = [&](uint32_t slot) {
      return shaded.varyings.get() + std::size_t{slot} * static_cast<std::size_t>(shaded.varying_count);
    };
    for_each_triangle(context, chunk, range, end, [&](uint32_t, const std::array<uint32_t, 3>& vertex) {
      rows.push_back({row_of(vertex[0]), row_of(vertex[1]), row_of(vertex[2])});
    });
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
