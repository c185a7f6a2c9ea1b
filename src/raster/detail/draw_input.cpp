// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/detail/draw_input.h"

namespace halfspace::HS_LANES::detail {

static_assert(kMaxStreamComponents == kMaxComponents);

std::size_t count_of(const DrawState& state, std::size_t size) {
  HS_CHECK_OP(state.first, <=, size, "DrawState: `first` is too large; expected at most the number of vertices or indices");
  const std::size_t rest = size - state.first;
  const std::size_t count = state.count.value_or(rest);
  HS_CHECK_OP(count, <=, rest, "DrawState: `count` is too large; expected at most the number of vertices or indices from `first` on");
  return count;
}

VertexStreams keep_streams(const VertexView& view, uint32_t base_instance, std::pmr::memory_resource& memory) {
  const auto count = static_cast<std::size_t>(view.stream_count);
  auto* const kept = static_cast<VertexStream*>(memory.allocate(count * sizeof(VertexStream), alignof(VertexStream)));
  std::uninitialized_copy_n(view.streams.begin(), count, kept);
  for (std::size_t i = 0; base_instance != 0 && i < count; ++i) {
    if (kept[i].divisor == 0) continue;
    const std::size_t rows = std::min<std::size_t>(base_instance, kept[i].count);
    kept[i].data += rows * static_cast<std::size_t>(kept[i].stride);
    kept[i].count -= rows;
  }
  return {{kept, count}, view.has_instance_streams, view.needs_conversion};
}

void check_instances(const VertexView& view, const DrawState& state) {
  if (!view.has_instance_streams || state.instances == 0) return;
  for (const VertexStream& s : view.used_streams()) {
    if (s.divisor == 0) continue;
    HS_CHECK_OP(std::size_t{state.base_instance} + (state.instances - 1) / s.divisor, <, s.count,
                "Pass::draw: there are more instances than rows of a per-instance stream; expected a row for each, from base_instance on");
  }
}

void check_vertices(const VertexView& view, const Indices& indices, const DrawState& state) {
  if (indices.used_count() == 0) return;
  HS_CHECK_OP(int64_t{indices.first_vertex()} + state.base_vertex, >=, 0,
              "Pass::draw: an index plus base_vertex is negative; expected vertices of the streams");
  HS_CHECK_OP(int64_t{indices.end_vertex()} + state.base_vertex, <=, static_cast<int64_t>(view.vertex_count),
              "Pass::draw: an index plus base_vertex is too large; expected less than the number of vertices");
}

}  // namespace halfspace::HS_LANES::detail
