// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/detail/emitted_draws.h"

#include <utility>

#include "halfspace/raster/amplify/emit_primitives.h"
#include "halfspace/raster/detail/draw_placement.h"
#include "halfspace/raster/pipeline/draw_stopwatch.h"
#include "halfspace/raster/primitives/primitive_assembly.h"

namespace halfspace::HS_LANES::detail {

namespace {

// Returns a draw that refers to the shader of another one.
Draw draw_like(const Draw& source, std::shared_ptr<const Indices> indices, const VertexStreams& vertices, const DrawState& state,
               const DrawPlacement& placement) {
  Draw d(source.kernels, {source.shader.get(), [](const void*) {}}, std::move(indices), vertices, state, placement);
  d.deferred = source.deferred;
  d.writes_color = source.writes_color;
  d.layer_group = source.layer_group;
  d.vertex_count = d.indices->used_count() * state.instances;
  count_primitives(d);
  return d;
}

bool viewports_overlap(const ViewportArray& viewports, const PassContext& context) {
  std::vector<Rect> rects;
  for (const IndexedViewport& v : viewports) {
    const ViewportRect viewport = rounded_viewport(v.viewport, context.width, context.height);
    const Rect r = drawable_rect(viewport, v.scissor, context.width, context.height, context.samples_at);
    for (const Rect& other : rects) {
      const Rect both = intersect(r, other);
      if (both.width > 0 && both.height > 0) return true;
    }
    rects.push_back(r);
  }
  return false;
}

}  // namespace

EmittedDraws::EmittedDraws(PassContext& context, const Attachments& attachments, int layers, bool supersample, const Workers& workers,
                           PassStatistics& statistics)
    : context_(context), attachments_(attachments), supersample_(supersample), sources_(std::exchange(context.draws, {})) {
  emitted_.resize(sources_.size());
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (sources_[i].kernels.emitting == nullptr) continue;
    if (sources_[i].state.query) statistics.add_to_query(*sources_[i].state.query, 0);  // also if nothing is emitted
    const DrawStopwatch stopwatch(sources_[i], &DrawTime::setup, statistics);
    emitted_[i] = emit(sources_[i], layers, workers, statistics);
  }
}

EmittedDraws::Emitted EmittedDraws::emit(const Draw& draw, int layers, const Workers& workers, PassStatistics& statistics) const {
  Emitted out{emit_primitives(draw, workers, statistics), {}};
  const ShaderKernels& kernels = draw.kernels;
  const ViewportArray* const viewports = draw.state.viewports;
  if (!kernels.gives_layer) {
    EmittedPrimitives& all = out.primitives;
    out.parts.push_back({0, 0, std::exchange(all.indices, {}), std::exchange(all.numbers, {}), std::exchange(all.instances, {})});
  } else {
    // After the position, the point size and the distances.
    const SplitOptions options{.place = 5 + static_cast<std::size_t>(kernels.clip_distance_count + kernels.cull_distance_count),
                               .first_provokes = draw.state.provoking == ProvokingVertex::first,
                               .layers = layers,
                               .viewports = viewports != nullptr ? static_cast<int32_t>(viewports->size()) : 1,
                               .viewports_overlap = viewports != nullptr && viewports_overlap(*viewports, context_)};
    out.parts = split_primitives(out.primitives, options);
  }
  return out;
}

void EmittedDraws::set_layer(int layer) {
  context_.draws.clear();
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Draw& source = sources_[i];
    if (source.kernels.emitting != nullptr) {
      for (const PrimitivePart& part : emitted_[i].parts) {
        if (part.layer == layer && !part.indices.empty()) add_part(source, emitted_[i].primitives, part);
      }
    } else if (layer == 0 || source.is_clear) {
      context_.draws.push_back(draw_like(source, source.indices, source.vertices, source.state, source));
    }
  }
}

void EmittedDraws::add_part(const Draw& source, const EmittedPrimitives& primitives, const PrimitivePart& part) {
  DrawState state = source.state;
  state.topology = primitives.topology;
  state.base_vertex = 0;
  state.instances = 1;
  if (state.viewports != nullptr) {
    const IndexedViewport& v = (*state.viewports)[static_cast<std::size_t>(part.viewport)];
    state.viewport = v.viewport;
    state.scissor = v.scissor;
    state.depth.range_near = v.range_near;
    state.depth.range_far = v.range_far;
  }
  std::pmr::memory_resource& memory = *context_.arena;
  const std::array<VertexStream, 3>& streams = keep(streams_of(primitives, source.kernels), memory);
  context_.draws.push_back(draw_like(source, std::make_shared<const Indices>(std::span(part.indices), primitives.vertex_count()),
                                     {streams, false, false}, keep(state, memory),
                                     place_draw(state, context_, attachments_, supersample_)));
  Draw& d = context_.draws.back();
  d.is_emitted = true;
  d.primitive_numbers = part.numbers.data();
  d.primitive_instances = part.instances.data();
}

}  // namespace halfspace::HS_LANES::detail
