// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/amplify/emit_primitives.h"

#include <algorithm>
#include <span>

#include "halfspace/raster/amplify/emitting_stages.h"
#include "halfspace/raster/amplify/run_geometry.h"
#include "halfspace/raster/amplify/run_tessellation.h"
#include "halfspace/raster/primitives/primitive_assembly.h"
#include "halfspace/raster/primitives/vertex_stage.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kPrimitivesPerTask = 128;  // so that what a task emits is usually smaller than what malloc maps anew
constexpr std::size_t kAssembledPerTask = 4096;
constexpr std::size_t kPatchesPerTask = 16;  // a patch can be divided into 8192 triangles

ClipVertices shade_all_vertices(const Draw& draw, VertexKernel kernel, int varying_count, const Workers& workers) {
  ClipVertices vertices;
  allocate_clip_vertices(draw, varying_count, vertices);
  const std::size_t tasks = (draw.vertex_count + kVerticesPerTask - 1) / kVerticesPerTask;
  workers.for_each(static_cast<int>(tasks), [&](int task) {
    const std::size_t begin = static_cast<std::size_t>(task) * kVerticesPerTask;
    shade_clip_vertices(draw, kernel, begin, std::min(begin + kVerticesPerTask, draw.vertex_count), vertices);
  });
  return vertices;
}

// Vertices, numbers and instances of some primitives.
struct PrimitiveList {
  CacheLineVector<uint32_t> slots;
  CacheLineVector<int32_t> primitives, instances;

  PrimitiveRows rows(const VertexRows& vertices) const {
    return {vertices, slots.data(), primitives.data(), instances.data(), static_cast<int>(primitives.size())};
  }
};

// Returns primitives [begin, end) of a draw, counted over all instances, with `corners` vertices each. next: returns the indices of the
// next primitive.
template <class Next>
PrimitiveList primitives_of(const Draw& draw, std::size_t corners, std::size_t begin, std::size_t end, const Next& next) {
  const uint32_t first_vertex = draw.indices->first_vertex(), slots = draw.indices->end_vertex() - first_vertex;
  PrimitiveList out;
  for (std::size_t p = begin; p < end;) {
    const std::size_t instance = p / draw.primitive_count, first = p % draw.primitive_count;
    const std::size_t count = std::min(end - p, draw.primitive_count - first);
    const uint32_t slot_base = first_vertex - static_cast<uint32_t>(instance) * slots;
    Assembly assembly(draw, static_cast<uint32_t>(first));
    for (std::size_t i = 0; i < count; ++i) {
      const auto indices = next(assembly);
      for (std::size_t v = 0; v < corners; ++v) out.slots.push_back(indices[v] - slot_base);
      out.primitives.push_back(static_cast<int32_t>(first + i));
      out.instances.push_back(static_cast<int32_t>(instance));
    }
    p += count;
  }
  return out;
}

// There must be a vertex.
VertexRows rows_of(const ClipVertices& vertices, int varying_count) {
  return {&vertices.positions.get()->x, 4, vertices.varyings.get(), static_cast<std::size_t>(varying_count)};
}

EmittedPrimitives no_primitives(std::size_t row, Topology topology) {
  EmittedPrimitives none;
  none.row = row;
  none.topology = topology;
  return none;
}

std::size_t primitives_in(const Draw& draw) { return std::size_t{draw.primitive_count} * draw.state.instances; }

EmittedPrimitives tessellate_patches(const Draw& draw, const ClipVertices& vertices, const Workers& workers) {
  const EmittingStages& stages = *draw.kernels.emitting;
  const TessellationStage& stage = *stages.tessellation;
  return emit_in_parts(workers, primitives_in(draw), kPatchesPerTask, static_cast<std::size_t>(stage.row), topology_of(stage.options),
                       [&](std::size_t begin, std::size_t end) {
                         const PrimitiveList patches = primitives_of(draw, static_cast<std::size_t>(stage.patch_vertices), begin, end,
                                                                     [](Assembly& a) { return a.next_patch(); });
                         return run_tessellation(stage, draw.shader.get(), patches.rows(rows_of(vertices, stages.varying_count)));
                       });
}

EmittedPrimitives emit_from_primitives(const Draw& draw, const ClipVertices& vertices, const Workers& workers) {
  const EmittingStages& stages = *draw.kernels.emitting;
  const GeometryStage& stage = *stages.geometry;
  const auto corners = static_cast<std::size_t>(vertices_of(stage.layout.input));
  const bool first_provokes = draw.state.provoking == ProvokingVertex::first;
  return emit_in_parts(workers, primitives_in(draw), kPrimitivesPerTask, static_cast<std::size_t>(stage.row),
                       topology_of(stage.layout.output), [&](std::size_t begin, std::size_t end) {
                         const PrimitiveList list =
                             primitives_of(draw, corners, begin, end, [](Assembly& a) { return a.next_with_adjacency(); });
                         return run_geometry(stage, draw.shader.get(), list.rows(rows_of(vertices, stages.varying_count)), first_provokes);
                       });
}

// The same for the primitives of divided patches.
EmittedPrimitives emit_from_patches(const Draw& draw, const EmittedPrimitives& divided, const Workers& workers) {
  const EmittingStages& stages = *draw.kernels.emitting;
  const GeometryStage& stage = *stages.geometry;
  if (divided.rows.empty()) return no_primitives(static_cast<std::size_t>(stage.row), topology_of(stage.layout.output));
  const auto varyings = static_cast<std::size_t>(stages.tessellation->varying_count);
  const VertexRows vertices{divided.rows.data(), divided.row, divided.rows.data() + divided.row - varyings, divided.row};
  const std::size_t corners = divided.vertices_per_primitive();
  const bool first_provokes = draw.state.provoking == ProvokingVertex::first;
  return emit_in_parts(workers, divided.primitive_count(), kPrimitivesPerTask, static_cast<std::size_t>(stage.row),
                       topology_of(stage.layout.output), [&](std::size_t begin, std::size_t end) {
                         return run_geometry(stage, draw.shader.get(),
                                             {vertices, divided.indices.data() + begin * corners, divided.numbers.data() + begin,
                                              divided.instances.data() + begin, static_cast<int>(end - begin)},
                                             first_provokes);
                       });
}

// Returns the kind of primitives that remains if strips, loops, fans and adjacent vertices are resolved.
Topology list_topology(Topology t) {
  if (t == Topology::points) return t;
  return is_lines(t) ? Topology::lines : Topology::triangles;
}

// Returns a row for each slot, with the position before the other values. Rows that no index refers to are uninitialized.
CacheLineVector<float> rows_by_slot(const Draw& draw, VertexKernel kernel, std::size_t values, const Workers& workers) {
  const ClipVertices vertices = shade_all_vertices(draw, kernel, static_cast<int>(values), workers);
  const std::size_t per_instance = draw.indices->used_count(), row = 4 + values;
  const std::span<const uint32_t> used = draw.indices->used();
  CacheLineVector<float> rows(std::size_t{vertices.count} * draw.state.instances * row);
  workers.for_each(static_cast<int>((draw.vertex_count + kVerticesPerTask - 1) / kVerticesPerTask), [&](int task) {
    const std::size_t begin = static_cast<std::size_t>(task) * kVerticesPerTask;
    for (std::size_t i = begin; i < std::min(begin + kVerticesPerTask, draw.vertex_count); ++i) {
      const std::size_t place = i % per_instance;
      const std::size_t slot = i / per_instance * vertices.count + (used.empty() ? place : used[place] - vertices.first);
      float* const to = rows.data() + slot * row;
      std::copy_n(&vertices.positions[slot].x, 4, to);
      std::copy_n(vertices.varyings.get() + slot * values, values, to + 4);
    }
  });
  return rows;
}

}  // namespace

EmittedPrimitives emit_primitives(const Draw& draw, const Workers& workers, PassStatistics& statistics) {
  const EmittingStages& stages = *draw.kernels.emitting;
  const ClipVertices vertices = shade_all_vertices(draw, stages.vertex, stages.varying_count, workers);
  const auto count_geometry = [&](std::size_t primitives) {
    statistics.geometry_invocations += primitives * static_cast<std::size_t>(stages.geometry->layout.invocations);
  };
  if (stages.tessellation == nullptr) {
    count_geometry(primitives_in(draw));
    return emit_from_primitives(draw, vertices, workers);
  }
  EmittedPrimitives divided = tessellate_patches(draw, vertices, workers);
  statistics.patches_in += primitives_in(draw);
  statistics.vertices_evaluated += divided.vertex_count();
  if (stages.geometry == nullptr) return divided;
  count_geometry(divided.primitive_count());
  return emit_from_patches(draw, divided, workers);
}

EmittedPrimitives assemble_primitives(const Draw& draw, VertexKernel kernel, int values, const Workers& workers) {
  const std::size_t row = 4 + static_cast<std::size_t>(values);
  const Topology topology = list_topology(draw.state.topology);
  EmittedPrimitives all =
      emit_in_parts(workers, primitives_in(draw), kAssembledPerTask, row, topology, [&](std::size_t begin, std::size_t end) {
        EmittedPrimitives out = no_primitives(row, topology);
        PrimitiveList list = primitives_of(draw, out.vertices_per_primitive(), begin, end, [](Assembly& a) { return a.next(); });
        out.indices = std::move(list.slots);
        out.numbers = std::move(list.primitives);
        out.instances = std::move(list.instances);
        return out;
      });
  all.rows = rows_by_slot(draw, kernel, static_cast<std::size_t>(values), workers);
  return all;
}

std::array<VertexStream, 3> streams_of(const EmittedPrimitives& primitives, const ShaderKernels& kernels) {
  const auto varyings = static_cast<std::size_t>(kernels.varying_count);
  const auto stream_at = [&](std::size_t value, std::size_t components) {
    return VertexStream{.data = reinterpret_cast<const std::byte*>(primitives.rows.data() + value),
                        .stride = static_cast<int32_t>(primitives.row * sizeof(float)),
                        .components = static_cast<int32_t>(components),
                        .count = primitives.vertex_count()};
  };
  const std::size_t others =
      kernels.gives_point_size ? 1 + static_cast<std::size_t>(kernels.clip_distance_count + kernels.cull_distance_count) : 0;
  return {stream_at(0, 4), stream_at(4, others), stream_at(primitives.row - varyings, varyings)};
}

void check_topology(const ShaderKernels& kernels, const DrawState& state) {
  const EmittingStages* const stages = kernels.emitting;
  const bool draws_patches = stages != nullptr && stages->tessellation != nullptr;
  HS_CHECK(draws_patches == (state.topology == Topology::patches),
           "Pass::draw: patches need a shader with tessellation, and tessellation needs patches; expected both or neither");
  if (stages == nullptr || stages->geometry == nullptr) return;
  HS_CHECK(accepts(stages->geometry->layout.input, draws_patches ? topology_of(stages->tessellation->options) : state.topology),
           "Pass::draw: the geometry function receives other primitives; expected a topology with those of GeometryLayout::input");
}

}  // namespace halfspace::HS_LANES
