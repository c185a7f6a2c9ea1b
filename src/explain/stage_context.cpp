// SPDX-License-Identifier: Apache-2.0
#include "halfspace/explain/stage_context.h"

#include <algorithm>

#include "halfspace/explain/stage_kernels.h"
#include "halfspace/raster/primitives/bin.h"
#include "halfspace/raster/primitives/primitive_assembly.h"
#include "halfspace/raster/primitives/setup.h"
#include "halfspace/raster/primitives/vertex_stage.h"
#include "halfspace/core/float_mode.h"

namespace halfspace {

namespace {

PassContext context_of(const PreparedScene& scene) {
  PassContext c;
  c.width = scene.view.width_px;
  c.height = scene.view.height_px;
  c.samples = scene.samples;
  c.samples_at = sample_span(scene.samples);
  c.tile_size = largest_tile(scene.samples);
  c.tiles_x = (c.width + c.tile_size - 1) / c.tile_size;
  c.tiles_y = (c.height + c.tile_size - 1) / c.tile_size;
  c.depth_format = DepthFormat::d32f;
  return c;
}

// Sets what the pass sets in a draw before its vertex stage.
void place_draw(const PassContext& context, Draw& d) {
  const Rect whole{0, 0, context.width, context.height};
  const Rect viewport = d.state.viewport.value_or(whole);
  Rect bounds = intersect(whole, viewport);
  if (d.state.scissor) bounds = intersect(bounds, *d.state.scissor);
  d.viewport = make_viewport(viewport, d.state.depth);
  d.bounds = {bounds.x, bounds.y, bounds.x + bounds.width, bounds.y + bounds.height};
  d.depth_low = std::min(d.state.depth.range_near, d.state.depth.range_far);
  d.depth_high = std::max(d.state.depth.range_near, d.state.depth.range_far);
}

void add_draws(const PreparedScene& scene, PassContext& c) {
  for (const PreparedDraw& from : scene.draws) {
    const VertexStreams streams{{from.vertices.streams.data(), static_cast<std::size_t>(from.vertices.stream_count)},
                                from.vertices.has_instance_streams};
    Draw& d = c.draws.emplace_back(geometry_kernels(from.shader), KeptShader(shader_address(from.shader), [](const void*) {}),
                                           from.indices, streams, from.state);
    d.vertex_count = d.indices->used_count() * d.state.instances;
    count_primitives(d);
    place_draw(c, d);
  }
}

void run_vertex_stage(PassContext& context, const Workers& workers) {
  context.shaded.resize(context.draws.size());
  workers.for_each(static_cast<int>(context.draws.size()), [&](int i) {
    const Draw& d = context.draws[static_cast<std::size_t>(i)];
    ShadedVertices& out = context.shaded[static_cast<std::size_t>(i)];
    allocate_vertices(d, out);
    out.any_outcode = shade_vertices(d, 0, d.vertex_count, out);
  });
}

std::vector<DrawRange> ranges_of(const PassContext& context) {
  std::vector<DrawRange> ranges;
  for (uint32_t i = 0; i < context.draws.size(); ++i) {
    const Draw& d = context.draws[i];
    const uint32_t most = std::min(kMaxPrimitivesPerChunk, kMaxTrianglesPerChunk / max_triangles_per_primitive(d, context.samples));
    for (uint32_t instance = 0; instance < d.state.instances; ++instance) {
      for (uint32_t first = 0; first < d.primitive_count; first += most)
        ranges.push_back({i, instance, first, std::min(most, d.primitive_count - first)});
    }
  }
  return ranges;
}

void run_chunks(PassContext& c, const std::vector<DrawRange>& ranges, const Workers& workers) {
  c.chunks.resize(ranges.size());
  workers.for_each(static_cast<int>(ranges.size()), [&](int i) {
    Chunk& chunk = c.chunks[static_cast<std::size_t>(i)];
    chunk.ranges = {ranges[static_cast<std::size_t>(i)]};
    set_up_chunk(c, chunk);
    bin_chunk(c, chunk);
  });
}

}  // namespace

PassContext stage_context(const PreparedScene& scene, const Workers& workers) {
  const FloatMode mode;
  PassContext c = context_of(scene);
  add_draws(scene, c);
  run_vertex_stage(c, workers);
  run_chunks(c, ranges_of(c), workers);
  return c;
}

}  // namespace halfspace
