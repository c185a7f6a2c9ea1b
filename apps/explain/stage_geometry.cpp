// SPDX-License-Identifier: Apache-2.0
#include "explain/stage_geometry.h"

#include <algorithm>

#include "halfspace/core/float_mode.h"
#include "halfspace/raster/pipeline/edge.h"
#include "halfspace/raster/pipeline/line.h"
#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/raster/primitives/bin.h"
#include "halfspace/raster/primitives/primitive_assembly.h"
#include "halfspace/raster/primitives/setup.h"
#include "halfspace/raster/primitives/vertex_stage.h"

namespace halfspace {

namespace {

StageOutcome outcome_of(const Chunk& chunk) {
  const PassStatistics& s = chunk.statistics;
  if (s.culled_non_finite != 0) return StageOutcome::non_finite;
  if (s.culled_outside != 0) return StageOutcome::outside;
  if (s.culled_face != 0) return StageOutcome::face;
  if (s.culled_degenerate != 0) return StageOutcome::degenerate;
  if (s.culled_no_sample != 0) return StageOutcome::no_sample;
  return s.clipped != 0 ? StageOutcome::clipped : StageOutcome::kept;
}

// Sets up each primitive again, in a chunk of its own. The statistics of the chunk show whether the primitive was kept, clipped or culled.
void list_primitives(const PassContext& context, const DrawRange& range, Chunk& chunk, StageGeometry& g) {
  for (uint32_t i = range.first; i < range.first + range.count; ++i) {
    chunk.clear();
    chunk.ranges.push_back({range.draw, range.instance, i, 1});
    set_up_chunk(context, chunk);
    const auto first = static_cast<uint32_t>(g.triangles.size());
    g.triangles.insert(g.triangles.end(), chunk.triangles.begin(), chunk.triangles.end());
    g.primitive_of.resize(g.triangles.size(), static_cast<uint32_t>(g.primitives.size()));
    g.primitives.push_back({range.draw, range.instance, i, outcome_of(chunk), first, static_cast<uint32_t>(chunk.triangles.size())});
  }
}

// x and y are in 1/256 px.
bool line_covers(const Draw& draw, const Triangle& t, int64_t x, int64_t y) {
  const LineRange range = t.line_range();
  const int64_t along = (is_y_major(t.x[1] - t.x[0], t.y[1] - t.y[0]) ? y : x) >> kSubPixelBits;
  if (along < range.first || along >= range.end) return false;
  for (const BandEdge& e : band_edges(t, line_pixels(draw.state.line_width))) {
    if (e.edge.at(x, y) + e.offset - e.bias < 0) return false;
  }
  return true;
}

bool covers_pixel(const PassContext& context, const Draw& draw, const Triangle& t, int x, int y) {
  for (int s = 0; s < context.samples; ++s) {
    if (covers(context, draw, t, x, y, s)) return true;
  }
  return false;
}

}  // namespace

StageGeometry stage_geometry(const PassContext& context) {
  const FloatMode mode;
  StageGeometry g;
  Chunk chunk;
  for (const Chunk& set_up : context.chunks) {
    for (const DrawRange& range : set_up.ranges) list_primitives(context, range, chunk, g);
  }
  return g;
}

std::array<uint32_t, 3> slots_of(const PassContext& context, const StagePrimitive& primitive) {
  const ShadedVertices& shaded = context.shaded[primitive.draw];
  std::array<uint32_t, 3> slots = Assembly(context.draws[primitive.draw], primitive.index).next();
  for (uint32_t& s : slots) s += primitive.instance * shaded.count - shaded.first;
  return slots;
}

std::array<glm::vec4, 3> clip_positions(const PassContext& context, const StagePrimitive& primitive) {
  const FloatMode mode;
  const Draw& draw = context.draws[primitive.draw];
  return clip_positions(draw, primitive.instance, Assembly(draw, primitive.index).next());
}

bool covers(const PassContext& context, const Draw& draw, const Triangle& t, int x, int y, int sample) {
  const SamplePosition at = sample_position(context.samples, sample);
  const PixelBounds box = pixel_bounds(draw, t, draw.bounds, at);
  if (x < box.x0 || x >= box.x1 || y < box.y0 || y >= box.y1) return false;
  if (t.is_point()) return true;
  const int64_t sx = int64_t{x} * kSubPixels + at.x, sy = int64_t{y} * kSubPixels + at.y;
  if (t.is_line()) return line_covers(draw, t, sx, sy);
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge e = edge_of(t, i);
    if (e.at(sx, sy) - fill_bias(e) < 0) return false;
  }
  return true;
}

uint64_t covered_pixels(const PassContext& context, const Draw& draw, std::span<const Triangle> triangles) {
  uint64_t count = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::span<const Triangle> before = triangles.first(i);
    const PixelBounds box = pixel_bounds(draw, triangles[i], draw.bounds, context.samples_at);
    for (int y = box.y0; y < box.y1; ++y) {
      for (int x = box.x0; x < box.x1; ++x) {
        const auto has_sample = [&](const Triangle& t) { return covers_pixel(context, draw, t, x, y); };
        count += has_sample(triangles[i]) && std::ranges::none_of(before, has_sample);
      }
    }
  }
  return count;
}

std::vector<uint32_t> triangles_per_tile(const PassContext& context) {
  std::vector<uint32_t> counts;
  for (int y = 0; y < context.tiles_y; ++y) {
    for (int x = 0; x < context.tiles_x; ++x) {
      uint32_t n = 0;
      for (const Chunk& chunk : context.chunks) n += static_cast<uint32_t>(bin_of(chunk, x, y).size());
      counts.push_back(n);
    }
  }
  return counts;
}

}  // namespace halfspace
