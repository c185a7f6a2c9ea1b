// SPDX-License-Identifier: Apache-2.0
//
// The part of a pass that works on tiles: load or clear, draw, resolve, post step, store.
#include <algorithm>
#include <numeric>
#include <optional>

#include "halfspace/raster/pass.h"
#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/primitives/bin.h"
#include "halfspace/raster/shade/shade.h"
#include "halfspace/raster/tile/resolve.h"
#include "halfspace/raster/visibility/covered_area.h"
#include "halfspace/raster/visibility/full_tile.h"
#include "halfspace/raster/visibility/visibility.h"

namespace halfspace {

void Pass::keep_between_flushes() {
  const std::size_t samples =
      static_cast<std::size_t>(frame_.width) * static_cast<std::size_t>(frame_.height) * static_cast<std::size_t>(frame_.samples);
  const auto spill = [&](const auto& target, std::vector<std::byte>& bytes) {
    const bool is_image_enough = target.data != nullptr && frame_.samples == 1;
    if (!is_image_enough) bytes.resize(samples * static_cast<std::size_t>(bytes_per_pixel(target.format)));
  };
  color_spills_.resize(colors_.size());
  for (std::size_t i = 0; i < colors_.size(); ++i) spill(colors_[i], color_spills_[i]);
  spill(depth_, depth_spill_);
}

std::vector<int> Pass::fill_flat_rows(const Workers& workers, PassStatistics& statistics) const {
  std::vector<PassStatistics> by_row(static_cast<std::size_t>(frame_.tiles_y));
  std::vector<uint8_t> filled(by_row.size());
  workers.for_each(frame_.tiles_y, [&](int y) {
    const std::optional<const Draw*> flat = flat_tiles(0, frame_.tiles_x, y, by_row[static_cast<std::size_t>(y)]);
    filled[static_cast<std::size_t>(y)] = flat.has_value();
    if (flat) fill_images({pixels_of(0, frame_.tiles_x, y), *flat});
  });
  std::vector<int> rest;
  for (int y = 0; y < frame_.tiles_y; ++y) {
    const auto row = static_cast<std::size_t>(y);
    if (filled[row] != 0) {
      statistics += by_row[row];
    } else {
      rest.push_back(y);
    }
  }
  return rest;
}

// A task takes some neighbouring tiles of a row, so that those of one colour are filled in one go: writes of a few hundred bytes
// each reach two thirds of memory's speed. But there must be tasks enough for all threads.
constexpr int kMostTilesATask = 8, kTasksAThread = 8;

void Pass::run_tiles(const Workers& workers, Round round, PassStatistics& statistics) {
  std::vector<int> rows(static_cast<std::size_t>(frame_.tiles_y));
  std::iota(rows.begin(), rows.end(), 0);
  if (is_alone(round)) rows = fill_flat_rows(workers, statistics);
  const int row_count = static_cast<int>(rows.size());
  const int length = std::clamp(frame_.tiles_x * row_count / (workers.threads() * kTasksAThread), 1, kMostTilesATask);
  const int strips_x = (frame_.tiles_x + length - 1) / length;
  std::vector<PassStatistics> by_strip(static_cast<std::size_t>(strips_x * row_count));
  workers.for_each(strips_x * row_count, [&](int i) {
    const int x0 = i % strips_x * length;
    run_strip(x0, std::min(x0 + length, frame_.tiles_x), rows[static_cast<std::size_t>(i / strips_x)], round,
              by_strip[static_cast<std::size_t>(i)]);
  });
  for (const PassStatistics& s : by_strip) statistics += s;
}

void Pass::run_strip(int tile_x0, int tile_x1, int tile_y, Round round, PassStatistics& statistics) const {
  const bool alone = is_alone(round);
  FlatArea area{};  // of the tiles before this one
  for (int x = tile_x0; x < tile_x1; ++x) {
    const std::optional<const Draw*> flat = alone ? flat_tiles(x, x + 1, tile_y, statistics) : std::nullopt;
    const Draw* const draw = flat.value_or(nullptr);
    const PixelBounds pixels = pixels_of(x, x + 1, tile_y);
    if (flat && !area.pixels.empty() && area.draw == draw) {
      area.pixels.x1 = pixels.x1;
      continue;
    }
    fill_images(area);
    area = flat ? FlatArea{pixels, draw} : FlatArea{};
    if (!flat) run_tile(x, tile_y, alone || is_drawn(x, tile_y), round, statistics);  // what is alone and not drawn is flat
  }
  fill_images(area);
}

namespace {

// A target between flushes: in its image, or in the spill where it has none or holds several samples.
template <class Target>
Target between_flushes(Target target, const std::vector<std::byte>& spill) {
  if (!spill.empty()) target.data = const_cast<std::byte*>(spill.data());
  target.load = LoadOp::load;
  target.store = StoreOp::store;
  return target;
}

}  // namespace

bool Pass::is_drawn(int tile_x, int tile_y) const {
  return std::any_of(frame_.chunks.begin(), frame_.chunks.end(), [&](const Chunk& c) { return !bin_of(c, tile_x, tile_y).empty(); });
}

PixelBounds Pass::pixels_of(int tile_x0, int tile_x1, int tile_y) const {
  const int size = frame_.tile_size;
  return {tile_x0 * size, tile_y * size, std::min(tile_x1 * size, frame_.width), std::min(tile_y * size + size, frame_.height)};
}

void Pass::run_tile(int tile_x, int tile_y, bool drawn, Round round, PassStatistics& statistics) const {
  if (drawn) ++statistics.tiles_touched;
  // What was neither cleared nor drawn stays as it is in its image (several samples go through the spill and back); under
  // LoadOp::dont_care the tile does not know it.
  const bool spills = frame_.samples > 1 && !(round.first && round.last);
  const auto changes = [&](const auto& target) {
    return drawn || spills || (round.first && target.load == LoadOp::clear && bytes_per_pixel(target.format) != 0);
  };
  const bool changes_color = std::any_of(colors_.begin(), colors_.end(), changes), changes_depth = changes(depth_);
  if (!changes_color && !changes_depth && !(round.last && post_kernel_ != nullptr)) return;

  Tile tile;
  place_tile(tile, tile_x, tile_y);
  const int width = frame_.width, height = frame_.height;
  const Samples kept = frame_.samples > 1 ? Samples::all : Samples::one;
  for (std::size_t i = 0; i < colors_.size(); ++i) {
    if (round.first) load_color(colors_[i], width, height, Samples::one, tile, tile.color[i]);
    if (!round.first) load_color(between_flushes(colors_[i], color_spills_[i]), width, height, kept, tile, tile.color[i]);
  }
  if (round.first) load_depth(depth_, width, height, Samples::one, tile);
  if (!round.first) load_depth(between_flushes(depth_, depth_spill_), width, height, kept, tile);
  if (drawn) draw_tile(tile, tile_x, tile_y, statistics);
  for (std::size_t i = 0; changes_color && i < colors_.size(); ++i) {
    if (round.last) {
      resolve_color(tile, tile.color[i]);
      store_color(colors_[i], width, height, Samples::one, tile, tile.color[i]);
    } else {
      store_color(between_flushes(colors_[i], color_spills_[i]), width, height, kept, tile, tile.color[i]);
    }
  }
  if (changes_depth && round.last) store_depth(depth_, width, height, Samples::one, tile);
  if (changes_depth && !round.last) store_depth(between_flushes(depth_, depth_spill_), width, height, kept, tile);
  if (round.last && post_kernel_ != nullptr) run_post_step(tile);
}

void Pass::place_tile(Tile& tile, int tile_x, int tile_y) const {
  const PixelBounds pixels = pixels_of(tile_x, tile_x + 1, tile_y);
  tile.size = frame_.tile_size;
  tile.samples = frame_.samples;
  tile.color_count = static_cast<int>(colors_.size());
  tile.x0 = pixels.x0;
  tile.y0 = pixels.y0;
  tile.width = pixels.x1 - pixels.x0;
  tile.height = pixels.y1 - pixels.y0;
}

std::optional<const Draw*> Pass::flat_tiles(int tile_x0, int tile_x1, int tile_y, PassStatistics& statistics) const {
  std::array<const Triangle*, 2> triangles{};
  std::size_t count = 0;
  const Draw* draw = nullptr;
  for (const Chunk& c : frame_.chunks) {
    for (int x = tile_x0; x < tile_x1; ++x) {
      for (const uint16_t index : bin_of(c, x, tile_y)) {
        const Triangle& t = c.triangles[index];
        if (&t == triangles[0] || &t == triangles[1]) continue;
        const Draw& of = frame_.draws[c.segments[t.segment()].draw];
        if (count == triangles.size() || (draw != nullptr && draw != &of)) return std::nullopt;
        draw = &of;
        triangles[count++] = &t;
      }
    }
  }
  if (draw == nullptr) return nullptr;
  const bool is_one_color = draw->deferred && draw->kernels.is_constant && draw->kernels.visibility == nullptr &&
                            draw->kernels.color_count >= static_cast<int>(colors_.size());
  if (!is_one_color || depth_.format != DepthFormat::none || frame_.samples != 1) return std::nullopt;
  const PixelBounds area = pixels_of(tile_x0, tile_x1, tile_y);
  const bool is_triangle =
      std::none_of(triangles.begin(), triangles.begin() + count, [](const Triangle* t) { return t->is(kSprite | kLine); });
  if (cut(area, draw->bounds) != area || !is_triangle ||
      !(count == 1 ? covers(*triangles[0], area) : cover_together(*triangles[0], *triangles[1], area))) {
    return std::nullopt;
  }
  const auto samples = static_cast<uint64_t>(area.x1 - area.x0) * static_cast<uint64_t>(area.y1 - area.y0);
  statistics.tiles_touched += static_cast<uint64_t>(tile_x1 - tile_x0);
  statistics.samples_tested += samples;
  statistics.samples_passed += samples;
  statistics.fragments_shaded += samples;
  if (draw->state.query) statistics.add_to_query(*draw->state.query, samples);
  return draw;
}

void Pass::fill_images(const FlatArea& area) const {
  if (area.pixels.empty()) return;
  FragmentOutput out;
  if (area.draw != nullptr) constant_colors(*area.draw, out);
  for (std::size_t i = 0; i < colors_.size(); ++i) {
    const ColorTarget& c = colors_[i];
    const glm::vec4& v = c.clear_value;
    if (area.draw != nullptr) {
      fill_color(c, frame_.width, frame_.height, area.pixels, out.packet_color(i, 0));
    } else if (c.load == LoadOp::clear) {
      fill_color(c, frame_.width, frame_.height, area.pixels, {Real(v.x), Real(v.y), Real(v.z), Real(v.w)});
    }
  }
  if (area.draw == nullptr && depth_.load == LoadOp::clear) fill_depth(depth_, frame_.width, frame_.height, area.pixels);
}

void Pass::run_post_step(const Tile& tile) const {
  ColorBuffer finished;
  finished.format = post_target_.format;
  std::array<PacketMask, kFragmentBatch> packets;
  std::array<PacketColor, kFragmentBatch> colors;
  std::size_t count = 0;
  for (int p = 0; p < kPackets; ++p) {
    const bool is_last = p == kPackets - 1;
    if (packet_x(p) < tile.width && packet_y(p) < tile.height)
      packets[count++] = {static_cast<uint16_t>(p), static_cast<uint16_t>(kAllBits<Mask>)};
    if (count < packets.size() && !is_last) continue;
    const std::span<const PacketMask> batch = std::span(packets).first(count);
    read_batch(tile.color[0], batch, colors.data());
    post_kernel_(post_function_.get(), {tile.x0, tile.y0, batch, colors.data()});
    write_batch(finished, batch, colors.data(), colors.data(), {});
    count = 0;
  }
  store_color(post_target_, frame_.width, frame_.height, Samples::one, tile, finished);
}

// A tile's triangles lie scattered in their chunk, and their vertices too: so many are fetched ahead.
constexpr std::size_t kTrianglesAhead = 16, kVerticesAhead = 3;

HS_INLINE void prefetch(const Triangle& t) {
  __builtin_prefetch(&t);
  __builtin_prefetch(&t.flags);  // which may lie in the next cache line
}

// What shading, or a shader that decides on visibility, reads of a triangle's first vertex.
void prefetch_vertex(const Frame& frame, const Chunk& chunk, const Triangle& t) {
  if (t.is(kClipped)) return;
  const ShadedVertices& shaded = frame.shaded[chunk.segments[t.segment()].draw];
  const auto count = static_cast<std::size_t>(shaded.varying_count);
  const float* row = shaded.varyings.get() + t.vertex[0] * count;
  __builtin_prefetch(&shaded.screen[t.vertex[0]]);
  __builtin_prefetch(row);
  __builtin_prefetch(row + count);
}

// How many of a list's first triangles are small and of one draw, W at the most.
std::size_t small_run(const Chunk& chunk, std::span<const uint16_t> bin) {
  const std::size_t most = std::min(bin.size(), static_cast<std::size_t>(kLanes));
  const uint32_t segment = chunk.triangles[bin[0]].segment();
  std::size_t n = 0;
  while (n < most && is_small_triangle(chunk.triangles[bin[n]]) && chunk.triangles[bin[n]].segment() == segment) ++n;
  return n;
}

// waiting: there are visible pixels of the tile that are not shaded yet.
void Pass::draw_triangle(const DrawInTile& d, uint32_t chunk, uint32_t index, bool& waiting, CoverageList& list,
                         PassStatistics& statistics) const {
  if (d.mode == VisibilityMode::deferred || d.mode == VisibilityMode::depth_only) {
    rasterize(d, chunk, index, nullptr, statistics);
    waiting |= d.mode == VisibilityMode::deferred;
    return;
  }
  // Without colours there is nothing to wait for: what waits keeps its own.
  const bool shades = d.mode != VisibilityMode::early || d.draw.writes_color;
  if (shades && waiting && has_color_) shade_deferred(frame_, d.tile, statistics);
  if (shades) waiting = false;
  list.count = 0;
  rasterize(d, chunk, index, &list, statistics);
  if (shades && list.count != 0) shade_immediate(frame_, d.draw, triangle_id(chunk, index), d.mode, list, d.tile, statistics);
}

void Pass::draw_tile(Tile& tile, int tile_x, int tile_y, PassStatistics& statistics) const {
  bool waiting = false;
  CoverageList list;
  tile.id.fill(kNoTriangle);
  std::optional<DrawInTile> here;
  WholeTile whole;
  for (uint32_t c = 0; c < frame_.chunks.size(); ++c) {
    const Chunk& chunk = frame_.chunks[c];
    const std::span<const uint16_t> bin = bin_of(chunk, tile_x, tile_y);
    const auto ahead = [&](std::size_t i) -> const Triangle& { return chunk.triangles[bin[std::min(i, bin.size() - 1)]]; };
    for (std::size_t i = 0; i < bin.size();) {
      const uint16_t t = bin[i];
      const Draw& draw = frame_.draws[chunk.segments[chunk.triangles[t].segment()].draw];
      if (!here || &here->draw != &draw) here.emplace(frame_, draw, visibility_mode(draw), tile);
      const uint64_t passed_before = statistics.samples_passed;
      const std::size_t small = here->is_plain && !whole.waits() ? small_run(chunk, bin.subspan(i)) : 0;
      for (std::size_t k = i; k < i + std::max<std::size_t>(small, 1); ++k) {
        prefetch(ahead(k + kTrianglesAhead));
        if (here->fetches_vertices) prefetch_vertex(frame_, chunk, ahead(k + kVerticesAhead));
      }
      if (small != 0) {
        rasterize_small(*here, c, bin.subspan(i, small), statistics);
        waiting |= here->mode == VisibilityMode::deferred;
        i += small;
      } else {
        const bool showed = whole.shows();
        const bool is_done = whole.take(*here, c, t, statistics);
        waiting |= showed && !whole.shows();
        if (!is_done) draw_triangle(*here, c, t, waiting, list, statistics);
        ++i;
      }
      if (draw.state.query) statistics.add_to_query(*draw.state.query, statistics.samples_passed - passed_before);
    }
  }
  if (whole.shows() && has_color_) return whole.shade(statistics);
  whole.write();
  if (waiting && has_color_) shade_deferred(frame_, tile, statistics);
}

}  // namespace halfspace
