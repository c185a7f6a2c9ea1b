// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/detail/emitted_draws.h"

#include <utility>

#include "halfspace/raster/amplify/emit_primitives.h"
#include "halfspace/raster/amplify/emitting_stages.h"
#include "halfspace/raster/detail/draw_placement.h"
#include "halfspace/raster/pipeline/draw_stopwatch.h"
#include "halfspace/raster/primitives/primitive_assembly.h"

namespace halfspace::HS_LANES::detail {

namespace {

// Returns a draw that refers to the shader of another one.
Draw draw_like(const Draw& source, const ShaderKernels& kernels, std::shared_ptr<const Indices> indices, const VertexStreams& vertices,
               const DrawState& state, const DrawPlacement& placement) {
  Draw d(kernels, {source.shader.get(), [](const void*) {}}, std::move(indices), vertices, state, placement);
  d.deferred = source.deferred;
  d.writes_color = source.writes_color;
  d.layer_group = source.layer_group;
  d.number = source.number;
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

SplitOptions EmittedDraws::split_options(const Draw& draw, int layers) const {
  const ViewportArray* const viewports = draw.state.viewports;
  // The layer is after the position, the point size and the distances.
  return {.place = 5 + static_cast<std::size_t>(draw.kernels.clip_distance_count + draw.kernels.cull_distance_count),
          .first_provokes = draw.state.provoking == ProvokingVertex::first,
          .layers = layers,
          .viewports = viewports != nullptr ? static_cast<int32_t>(viewports->size()) : 1,
          .viewports_overlap = viewports != nullptr && viewports_overlap(*viewports, context_)};
}

EmittedDraws::Emitted EmittedDraws::emit(const Draw& draw, int layers, const Workers& workers, PassStatistics& statistics) const {
  const EmittingStages& stages = *draw.kernels.emitting;
  statistics.vertices_in += (draw.indices->size() - draw.indices->restarts().size()) * draw.state.instances;
  statistics.vertices_shaded += draw.vertex_count;
  Emitted out;
  if (stages.layer == nullptr) {
    out.primitives = emit_primitives(draw, workers, statistics);
  } else if (auto runs = split_instances(draw, stages.layer, split_options(draw, layers), workers)) {
    out.runs = std::move(*runs);
    return out;
  } else {
    out.primitives = assemble_primitives(draw, stages.vertex, stages.varying_count, workers);
  }
  EmittedPrimitives& all = out.primitives;
  if (draw.kernels.gives_layer)
    out.parts = split_primitives(all, split_options(draw, layers), workers);
  else
    out.parts.push_back({{}, std::exchange(all.indices, {}), std::exchange(all.numbers, {}), std::exchange(all.instances, {})});
  out.indices.resize(out.parts.size());
  workers.for_each(static_cast<int>(out.parts.size()), [&](int i) {
    const auto part = static_cast<std::size_t>(i);
    out.indices[part] = std::make_shared<const Indices>(std::span<const uint32_t>(out.parts[part].indices), all.vertex_count());
  });
  return out;
}

void EmittedDraws::set_layer(int layer) {
  context_.draws.clear();
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Draw& source = sources_[i];
    if (source.kernels.emitting != nullptr) {
      const Emitted& emitted = emitted_[i];
      for (const InstanceRun& run : emitted.runs) {
        if (run.to.layer == layer) add_instances(source, run);
      }
      for (std::size_t part = 0; part < emitted.parts.size(); ++part) {
        if (emitted.parts[part].to.layer == layer && !emitted.parts[part].indices.empty()) add_part(source, emitted, part);
      }
    } else if (layer == 0 || source.is_clear) {
      context_.draws.push_back(draw_like(source, source.kernels, source.indices, source.vertices, source.state, source));
    }
  }
}

void EmittedDraws::add_draw(const Draw& source, const ShaderKernels& kernels, std::shared_ptr<const Indices> indices,
                            const VertexStreams& vertices, DrawState state, int32_t viewport) {
  if (state.viewports != nullptr) {
    const IndexedViewport& v = (*state.viewports)[static_cast<std::size_t>(viewport)];
    state.viewport = v.viewport;
    state.scissor = v.scissor;
    state.depth.range_near = v.range_near;
    state.depth.range_far = v.range_far;
  }
  context_.draws.push_back(draw_like(source, kernels, std::move(indices), vertices, keep(state, *context_.arena),
                                     place_draw(state, context_, attachments_, supersample_)));
  context_.draws.back().is_emitted = true;
}

void EmittedDraws::add_instances(const Draw& source, const InstanceRun& run) {
  DrawState state = source.state;
  state.instances = run.count;
  add_draw(source, *source.kernels.one_layer, source.indices, source.vertices, state, run.to.viewport);
  context_.draws.back().first_instance = run.first;
}

void EmittedDraws::add_part(const Draw& source, const Emitted& emitted, std::size_t number) {
  const PrimitivePart& part = emitted.parts[number];
  DrawState state = source.state;
  state.topology = emitted.primitives.topology;
  state.base_vertex = 0;
  state.instances = 1;
  const std::array<VertexStream, 3>& streams = keep(streams_of(emitted.primitives, source.kernels), *context_.arena);
  add_draw(source, source.kernels, emitted.indices[number], {streams, false, false}, state, part.to.viewport);
  Draw& d = context_.draws.back();
  d.primitive_numbers = part.numbers.data();
  d.primitive_instances = part.instances.data();
}

}  // namespace halfspace::HS_LANES::detail
