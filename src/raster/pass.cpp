// SPDX-License-Identifier: Apache-2.0
#include "raster/pass.h"

#include <algorithm>

#include "core/float_mode.h"
#include "raster/assembly.h"
#include "raster/bin.h"
#include "raster/clip.h"
#include "raster/setup.h"

namespace halfspace {

namespace {

constexpr int kMaxTargetSize = static_cast<int>(kGuardBand);
constexpr std::size_t kVerticesPerTask = 8 * kVertexBatch;
// Chunks that go through setup between two looks at the budget.
constexpr std::size_t kWave = 32;

static_assert(std::size_t{4096} * kMaxPieces <= kMaxTrianglesPerChunk, "a chunk's triangles are counted in 16 bits");

std::size_t bytes_of(const Chunk& c) {
  return c.triangles.capacity() * sizeof(Triangle) + c.bin_triangles.capacity() * sizeof(uint16_t) +
         c.bin_start.capacity() * sizeof(uint32_t) + c.clip_vertices.capacity() * sizeof(ClipVertex) +
         (c.clip_varyings.capacity() + c.primitives.capacity()) * sizeof(float);
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

Pass::Pass(int width, int height, const ColorTarget& color, const DepthTarget& depth, const PassOptions& options)
    : color_(color), depth_(depth), options_(options) {
  HS_CHECK(width >= 1 && width <= kMaxTargetSize && height >= 1 && height <= kMaxTargetSize);
  HS_CHECK(options.tile_size == 8 || options.tile_size == 16 || options.tile_size == 32 || options.tile_size == 64);
  HS_CHECK(options.chunk_triangles >= 1 && options.chunk_triangles <= 4096);
  HS_CHECK(color.data != nullptr || color.format == ColorFormat::none || (color.load != LoadOp::load && color.store == StoreOp::dont_care));
  HS_CHECK(depth.data != nullptr || depth.format == DepthFormat::none || (depth.load != LoadOp::load && depth.store == StoreOp::dont_care));
  frame_.width = width;
  frame_.height = height;
  frame_.tile_size = options.tile_size;
  frame_.tiles_x = (width + options.tile_size - 1) / options.tile_size;
  frame_.tiles_y = (height + options.tile_size - 1) / options.tile_size;
  frame_.depth_format = depth.format;
}

void Pass::add_draw(const ShaderKernels& kernels, std::shared_ptr<const void> shader, const VertexView& vertices,
                    std::shared_ptr<const Indices> indices, const DrawState& state) {
  const FloatMode mode;  // the viewport transform is computed here, not in a task
  HS_CHECK_OP(int64_t{indices->first_vertex()} + state.base_vertex, >=, 0);
  HS_CHECK_OP(int64_t{indices->end_vertex()} + state.base_vertex, <=, static_cast<int64_t>(vertices.vertex_count));
  HS_CHECK_OP(std::size_t{state.instances}, <=, vertices.instance_count);
  HS_CHECK(kernels.fragment != nullptr || color_.format == ColorFormat::none);
  HS_CHECK(state.depth.range_near >= 0 && state.depth.range_near <= 1 && state.depth.range_far >= 0 && state.depth.range_far <= 1);
  Draw d;
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
  const bool decides_visibility = kernels.discards || kernels.writes_depth;
  const bool defers = options_.defer && !state.blend && (!decides_visibility || kernels.visibility != nullptr);
  d.deferred = defers || kernels.fragment == nullptr;  // without colour there is nothing to blend or to shade at once
  frame_.draws.push_back(std::move(d));
}

void Pass::run_vertex_stage(const Workers& workers, PassStatistics& statistics) {
  struct Task {
    std::size_t draw, begin, end;
  };
  std::vector<Task> tasks;
  frame_.shaded.resize(frame_.draws.size());
  for (std::size_t d = 0; d < frame_.draws.size(); ++d) {
    const Draw& draw = frame_.draws[d];
    allocate_vertices(draw, frame_.shaded[d]);
    const std::size_t count = draw.indices->used_count() * draw.state.instances;
    statistics.vertices_shaded += count;
    for (std::size_t b = 0; b < count; b += kVerticesPerTask) tasks.push_back({d, b, std::min(count, b + kVerticesPerTask)});
  }
  workers.for_each(static_cast<int>(tasks.size()), [&](int i) {
    const Task& t = tasks[static_cast<std::size_t>(i)];
    shade_vertices(frame_.draws[t.draw], t.begin, t.end, frame_.shaded[t.draw]);
  });
}

std::vector<std::vector<Segment>> Pass::split_into_chunks() const {
  std::vector<std::vector<Segment>> chunks;
  uint32_t room = 0;
  for (uint32_t d = 0; d < frame_.draws.size(); ++d) {
    const uint32_t count = frame_.draws[d].primitive_count;
    for (uint32_t instance = 0; instance < frame_.draws[d].state.instances; ++instance) {
      for (uint32_t first = 0; first < count;) {
        if (room == 0) {
          chunks.emplace_back();
          room = options_.chunk_triangles;
        }
        const uint32_t n = std::min(room, count - first);
        chunks.back().push_back({d, instance, first, n});
        first += n;
        room -= n;
      }
    }
  }
  return chunks;
}

PassStatistics Pass::run(const Workers& workers) {
  PassStatistics statistics;
  run_vertex_stage(workers, statistics);
  const std::vector<std::vector<Segment>> work = split_into_chunks();
  bool first_round = true;
  std::size_t next = 0;
  do {
    // Waves of chunks (at least one) until the budget or the ids are used up, or all is set up.
    std::size_t bytes = 0;
    frame_.chunks.clear();
    while (next < work.size() && (frame_.chunks.empty() || bytes < options_.bin_budget) && frame_.chunks.size() + kWave <= kMaxChunks) {
      const std::size_t begin = frame_.chunks.size();
      const std::size_t count = std::min(kWave, work.size() - next);
      frame_.chunks.resize(begin + count);
      workers.for_each(static_cast<int>(count), [&](int i) {
        Chunk& chunk = frame_.chunks[begin + static_cast<std::size_t>(i)];
        chunk.segments = work[next + static_cast<std::size_t>(i)];
        set_up_chunk(frame_, chunk);
        run_primitive_stage(frame_, chunk);
        bin_chunk(frame_, chunk);
      });
      next += count;
      for (std::size_t c = begin; c < frame_.chunks.size(); ++c) {
        bytes += bytes_of(frame_.chunks[c]);
        statistics += frame_.chunks[c].statistics;
      }
    }
    const bool last_round = next == work.size();
    if (!last_round) {
      keep_between_flushes();
      ++statistics.flushes;
    }
    run_tiles(workers, first_round, last_round, statistics);
    first_round = false;
  } while (next < work.size());
  frame_.draws.clear();
  frame_.shaded.clear();
  frame_.chunks.clear();
  return statistics;
}

void Pass::keep_between_flushes() {
  const std::size_t pixels = static_cast<std::size_t>(frame_.width) * static_cast<std::size_t>(frame_.height);
  if (color_.format != ColorFormat::none && color_.data == nullptr && color_spill_.empty()) {
    color_spill_.resize(pixels * static_cast<std::size_t>(bytes_per_pixel(color_.format)));
  }
  if (depth_.format != DepthFormat::none && depth_.data == nullptr && depth_spill_.empty()) depth_spill_.resize(pixels * sizeof(float));
}

void Pass::run_tiles(const Workers& workers, bool first, bool last, PassStatistics& statistics) {
  const int tiles = frame_.tiles_x * frame_.tiles_y;
  std::vector<PassStatistics> by_tile(static_cast<std::size_t>(tiles));
  workers.for_each(tiles, [&](int i) { run_tile(i, first, last, by_tile[static_cast<std::size_t>(i)]); });
  for (const PassStatistics& s : by_tile) statistics += s;
}

void Pass::run_tile(int index, bool first, bool last, PassStatistics& statistics) const {
  const int tile_x = index % frame_.tiles_x, tile_y = index / frame_.tiles_x;
  const bool drawn =
      std::any_of(frame_.chunks.begin(), frame_.chunks.end(), [&](const Chunk& c) { return !bin_of(c, tile_x, tile_y).empty(); });
  if (drawn) ++statistics.tiles_touched;
  // Between flushes a target lives in its image, or in the spill where it has none.
  ColorTarget color = color_;
  DepthTarget depth = depth_;
  if (color.data == nullptr && !color_spill_.empty()) color.data = const_cast<std::byte*>(color_spill_.data());
  if (depth.data == nullptr && !depth_spill_.empty()) depth.data = const_cast<std::byte*>(depth_spill_.data());
  if (!first) color.load = depth.load = LoadOp::load;
  if (!last) color.store = depth.store = StoreOp::store;
  const auto clears = [](const auto& target) { return target.load == LoadOp::clear && target.format != decltype(target.format)::none; };
  const bool changes_color = drawn || clears(color), changes_depth = drawn || clears(depth);
  if (!changes_color && !changes_depth && !(last && post_kernel_ != nullptr)) return;

  Tile tile;
  tile.size = frame_.tile_size;
  tile.x0 = tile_x * tile.size;
  tile.y0 = tile_y * tile.size;
  tile.width = std::min(tile.size, frame_.width - tile.x0);
  tile.height = std::min(tile.size, frame_.height - tile.y0);
  load_color(color, frame_.width, frame_.height, tile);
  load_depth(depth, frame_.width, frame_.height, tile);
  if (drawn) draw_tile(tile, tile_x, tile_y, statistics);
  // What was neither cleared nor drawn stays as it is in its image; under LoadOp::dont_care the tile does not know it.
  if (changes_color) store_color(color, frame_.width, frame_.height, tile, tile.color);
  if (changes_depth) store_depth(depth, frame_.width, frame_.height, tile);
  if (!last || post_kernel_ == nullptr) return;
  ColorBuffer finished;
  finished.format = post_target_.format;
  for (int p = 0; p < kPackets; ++p) {
    if (packet_x(p) >= tile.width || packet_y(p) >= tile.height) continue;
    PacketColor c = read_color(tile.color, p);
    post_kernel_(post_function_.get(), c);
    write_color(finished, p, Mask(true), c, nullptr);
  }
  store_color(post_target_, frame_.width, frame_.height, tile, finished);
}

void Pass::draw_tile(Tile& tile, int tile_x, int tile_y, PassStatistics& statistics) const {
  const bool shades = color_.format != ColorFormat::none;
  bool waiting = false;  // there are visible pixels not shaded yet
  CoverageList list;
  tile.id.fill(kNoTriangle);
  for (uint32_t c = 0; c < frame_.chunks.size(); ++c) {
    const Chunk& chunk = frame_.chunks[c];
    for (const uint16_t t : bin_of(chunk, tile_x, tile_y)) {
      const Draw& draw = frame_.draws[chunk.segments[chunk.triangles[t].segment()].draw];
      const VisibilityMode mode = visibility_mode(draw);
      if (mode == VisibilityMode::deferred) {
        rasterize(frame_, c, t, mode, tile, nullptr, statistics);
        waiting = true;
        continue;
      }
      if (waiting && shades) shade_deferred(frame_, tile, statistics);
      waiting = false;
      list.count = 0;
      rasterize(frame_, c, t, mode, tile, &list, statistics);
      if (list.count != 0) shade_immediate(frame_, triangle_id(c, t), mode, list, tile, statistics);
    }
  }
  if (waiting && shades) shade_deferred(frame_, tile, statistics);
}

}  // namespace halfspace
