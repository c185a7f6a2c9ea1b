// SPDX-License-Identifier: Apache-2.0
#include "raster/pass.h"

#include <algorithm>
#include <utility>

#include "core/float_mode.h"
#include "raster/assembly.h"
#include "raster/bin.h"
#include "raster/frame_memory.h"
#include "raster/primitive_setup.h"
#include "raster/setup.h"

namespace halfspace {

namespace {

constexpr int kMaxTargetSize = static_cast<int>(kGuardBand);
constexpr std::size_t kVerticesPerTask = 8 * kVertexBatch;
// Bytes of a tile's memory, so that it stays in the cache next to the core (L2).
constexpr int kTileBudget = 160 << 10;
// Chunks that go through setup between two looks at the budget.
constexpr std::size_t kWave = 32;

Chunk take_or_make(std::vector<Chunk>& from) {
  if (from.empty()) return {};
  Chunk c = std::move(from.back());
  from.pop_back();
  return c;
}
// Moves all chunks, emptied. Those that were taken first are taken first again: they have the memory that fits.
void put_aside(std::vector<Chunk>& chunks, std::vector<Chunk>& to) {
  for (auto c = chunks.rbegin(); c != chunks.rend(); ++c) {
    c->clear();
    to.push_back(std::move(*c));
  }
  chunks.clear();
}

PixelBounds to_bounds(const Rect& r) { return {r.x, r.y, r.x + r.width, r.y + r.height}; }

void check_rect(const Rect& r, int smallest) {
  HS_CHECK_OP(r.width, >=, smallest);
  HS_CHECK_OP(r.height, >=, smallest);
  HS_CHECK_OP(r.width, <=, kMaxTargetSize);
  HS_CHECK_OP(r.height, <=, kMaxTargetSize);
  HS_CHECK(r.x >= -kMaxTargetSize && r.x <= kMaxTargetSize && r.y >= -kMaxTargetSize && r.y <= kMaxTargetSize);
}

}  // namespace

Pass::Pass(std::span<const ColorTarget> colors, int width, int height, const DepthTarget& depth, const PassOptions& options)
    : colors_(colors.begin(), colors.end()), depth_(depth), options_(options) {
  HS_CHECK(width >= 1 && width <= kMaxTargetSize && height >= 1 && height <= kMaxTargetSize);
  HS_CHECK(options.tile_size == 8 || options.tile_size == 16 || options.tile_size == 32 || options.tile_size == 64);
  HS_CHECK(options.chunk_triangles >= 1 && options.chunk_triangles <= 4096);
  HS_CHECK(options.samples == 1 || options.samples == 2 || options.samples == 4 || options.samples == 8);
  HS_CHECK_OP(colors.size(), <=, std::size_t{kMaxColorTargets});
  for (const ColorTarget& c : colors) {
    HS_CHECK(c.data != nullptr || c.format == ColorFormat::none || (c.load != LoadOp::load && c.store == StoreOp::dont_care));
    has_color_ |= c.format != ColorFormat::none;
  }
  HS_CHECK(depth.data != nullptr || depth.format == DepthFormat::none || (depth.load != LoadOp::load && depth.store == StoreOp::dont_care));
  frame_.width = width;
  frame_.height = height;
  frame_.samples = options.samples;
  frame_.samples_at = sample_span(options.samples);
  frame_.tile_size = tile_size();
  frame_.tiles_x = (width + frame_.tile_size - 1) / frame_.tile_size;
  frame_.tiles_y = (height + frame_.tile_size - 1) / frame_.tile_size;
  frame_.depth_format = depth_part(depth.format);
}

int Pass::tile_size() const {
  int sample_bytes = 9;  // depth, triangle, stencil
  for (const ColorTarget& c : colors_) sample_bytes += bytes_per_pixel(c.format);
  int size = std::min(options_.tile_size, largest_tile(options_.samples));
  while (size > kBlockSize && sample_bytes * options_.samples * size * size > kTileBudget) size /= 2;
  return size;
}

void Pass::add_draw(const ShaderKernels& kernels, std::shared_ptr<const void> shader, const VertexView& vertices,
                    std::shared_ptr<const Indices> indices, const DrawState& state) {
  const FloatMode mode;  // the viewport transform is computed here, not in a task
  HS_CHECK_OP(int64_t{indices->first_vertex()} + state.base_vertex, >=, 0);
  HS_CHECK_OP(int64_t{indices->end_vertex()} + state.base_vertex, <=, static_cast<int64_t>(vertices.vertex_count));
  HS_CHECK_OP(std::size_t{state.instances}, <=, vertices.instance_count);
  HS_CHECK(state.depth.range_near >= 0 && state.depth.range_near <= 1 && state.depth.range_far >= 0 && state.depth.range_far <= 1);
  if (frame_.draws.capacity() == 0) frame_.draws = take_draw_memory();
  Draw& d = frame_.draws.emplace_back();
  d.kernels = kernels;
  d.shader = std::move(shader);
  d.vertices = vertices;
  d.indices = std::move(indices);
  d.state = state;
  count_primitives(d);
  const Rect whole{0, 0, frame_.width, frame_.height};
  const Rect viewport = state.viewport.value_or(whole);
  check_rect(viewport, 1);
  d.viewport = make_viewport(viewport, state.depth);
  Rect bounds = intersect(whole, viewport);
  if (state.scissor) {
    check_rect(*state.scissor, 0);
    bounds = intersect(bounds, *state.scissor);
  }
  d.bounds = to_bounds(bounds);
  d.depth_low = std::min(state.depth.range_near, state.depth.range_far);
  d.depth_high = std::max(state.depth.range_near, state.depth.range_far);
  d.shades_samples = frame_.samples > 1 && (state.sample_shading || options_.supersample);
  d.sample_mask = frame_.samples == 1 ? 1u : state.sample_mask & ((1u << frame_.samples) - 1);
  const bool replaces = resolve_attachments(d);
  const bool decides_visibility = kernels.discards || kernels.writes_depth;
  const bool covers_by_alpha = state.alpha_to_coverage && frame_.samples > 1;
  const bool defers = options_.defer && replaces && !covers_by_alpha && (!decides_visibility || kernels.visibility != nullptr);
  d.deferred = defers || !has_color_;  // without colour there is nothing to blend or to shade at once
}

bool Pass::resolve_attachments(Draw& d) const {
  bool replaces = true;
  for (std::size_t i = 0; i < colors_.size(); ++i) {
    AttachmentState& a = d.attachments[i];
    a = d.state.attachments[i].value_or(AttachmentState{d.state.blend, d.state.color_mask});
    if (a.blend && uses_second_source(*a.blend)) HS_CHECK(d.kernels.color_count > 1 && colors_.size() == 1);
    if (colors_[i].format == ColorFormat::none) continue;
    const bool has_color = d.kernels.fragment != nullptr && static_cast<int>(i) < d.kernels.color_count;
    replaces &= has_color && !a.blend && a.mask.all();
    d.writes_color |= has_color && (a.mask.r || a.mask.g || a.mask.b || a.mask.a);
  }
  return replaces;
}

void Pass::run_vertex_stage(const Workers& workers, PassStatistics& statistics) {
  struct Task {
    std::size_t draw, begin, end;
    Outcode any;
  };
  std::vector<Task> tasks;
  frame_.shaded.resize(frame_.draws.size());
  for (std::size_t d = 0; d < frame_.draws.size(); ++d) {
    const Draw& draw = frame_.draws[d];
    allocate_vertices(draw, frame_.shaded[d]);
    const std::size_t count = draw.indices->used_count() * draw.state.instances;
    statistics.vertices_in += (draw.indices->size() - draw.indices->restarts().size()) * draw.state.instances;
    statistics.vertices_shaded += count;
    for (std::size_t b = 0; b < count; b += kVerticesPerTask) tasks.push_back({d, b, std::min(count, b + kVerticesPerTask), 0});
  }
  workers.for_each(static_cast<int>(tasks.size()), [&](int i) {
    Task& t = tasks[static_cast<std::size_t>(i)];
    t.any = shade_vertices(frame_.draws[t.draw], t.begin, t.end, frame_.shaded[t.draw]);
  });
  for (const Task& t : tasks) frame_.shaded[t.draw].any_outcode |= t.any;
}

std::vector<std::vector<Segment>> Pass::split_into_chunks() const {
  std::vector<std::vector<Segment>> chunks;
  uint32_t room = 0;     // for primitives in the last chunk
  uint32_t records = 0;  // for what they may become
  for (uint32_t d = 0; d < frame_.draws.size(); ++d) {
    const Draw& draw = frame_.draws[d];
    const uint32_t each = most_records(draw, frame_.samples);
    for (uint32_t instance = 0; instance < draw.state.instances; ++instance) {
      for (uint32_t first = 0; first < draw.primitive_count;) {
        if (room == 0 || records < each) {
          chunks.emplace_back();
          room = options_.chunk_triangles;
          records = kMaxTrianglesPerChunk;
        }
        const uint32_t n = std::min({room, records / each, draw.primitive_count - first});
        chunks.back().push_back({d, instance, first, n});
        first += n;
        room -= n;
        records -= n * each;
      }
    }
  }
  return chunks;
}

PassStatistics Pass::run(const Workers& workers) {
  PassStatistics statistics;
  for (const Draw& d : frame_.draws) {
    if (d.state.query) statistics.queries.resize(std::max(statistics.queries.size(), std::size_t{*d.state.query} + 1));
  }
  FrameMemory memory = take_frame_memory();
  frame_.shaded = std::move(memory.shaded);
  run_vertex_stage(workers, statistics);
  const std::vector<std::vector<Segment>> work = split_into_chunks();
  bool first_round = true;
  std::size_t next = 0;
  do {
    // Waves of chunks (at least one) until the budget or the ids are used up, or all is set up.
    std::size_t bytes = 0;
    put_aside(frame_.chunks, memory.chunks);
    while (next < work.size() && (frame_.chunks.empty() || bytes < options_.bin_budget) && frame_.chunks.size() + kWave <= kMaxChunks) {
      const std::size_t begin = frame_.chunks.size();
      const std::size_t count = std::min(kWave, work.size() - next);
      for (std::size_t i = 0; i < count; ++i) frame_.chunks.push_back(take_or_make(memory.chunks));
      workers.for_each(static_cast<int>(count), [&](int i) {
        Chunk& chunk = frame_.chunks[begin + static_cast<std::size_t>(i)];
        chunk.segments = work[next + static_cast<std::size_t>(i)];
        set_up_chunk(frame_, chunk);
        run_primitive_stage(frame_, chunk);
        bin_chunk(frame_, chunk);
      });
      next += count;
      for (std::size_t c = begin; c < frame_.chunks.size(); ++c) {
        bytes += frame_.chunks[c].bytes();
        statistics += frame_.chunks[c].statistics;
      }
    }
    const bool last_round = next == work.size();
    if (!last_round) {
      keep_between_flushes();
      ++statistics.flushes;
    }
    run_tiles(workers, {first_round, last_round}, statistics);
    first_round = false;
  } while (next < work.size());
  keep_draw_memory(std::exchange(frame_.draws, {}));
  put_aside(frame_.chunks, memory.chunks);
  memory.shaded = std::exchange(frame_.shaded, {});
  keep_frame_memory(std::move(memory));
  return statistics;
}

}  // namespace halfspace
