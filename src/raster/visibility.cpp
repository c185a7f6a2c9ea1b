// SPDX-License-Identifier: Apache-2.0
#include "raster/visibility.h"

#include <algorithm>
#include <bit>

#include "raster/centroid.h"
#include "raster/compare.h"
#include "raster/primitive_setup.h"
#include "raster/stencil.h"
#include "raster/tile_edges.h"

namespace halfspace {

namespace {

// Can no value in [low, high] pass against any stored value in [block_min, block_max]?
bool never_passes(CompareOp op, float low, float high, float block_min, float block_max) {
  switch (op) {
    case CompareOp::never: return true;
    case CompareOp::less: return low >= block_max;
    case CompareOp::less_equal: return low > block_max;
    case CompareOp::greater: return high <= block_min;
    case CompareOp::greater_equal: return high < block_min;
    case CompareOp::equal: return high < block_min || low > block_max;
    default: return false;
  }
}

bool tests_depth(const DepthState& state, const Tile& tile) { return state.test && tile.depth_format != DepthFormat::none; }

// Writes after which a block's bounds are made exact again before they are asked: a refresh costs about one packet.
constexpr uint8_t kRefreshAfter = 8;

void widen_bounds(CompareOp op, Tile& tile, int block, float low, float high) {
  // What passes LESS only lowers the values, what passes GREATER only raises them.
  const bool lowers = op == CompareOp::less || op == CompareOp::less_equal;
  const bool raises = op == CompareOp::greater || op == CompareOp::greater_equal;
  const auto b = static_cast<std::size_t>(block);
  if (!raises) tile.block_min[b] = std::min(tile.block_min[b], low);
  if (!lowers) tile.block_max[b] = std::max(tile.block_max[b], high);
  if (tile.block_writes[b] < kRefreshAfter) ++tile.block_writes[b];
}

// Everything that the packets of one triangle share.
struct Context {
  const Frame& frame;
  const Draw& draw;
  const Triangle& triangle;
  TriangleId id;
  VisibilityMode mode;
  Tile& tile;
  CoverageList* list;
  PassStatistics& statistics;
  const StencilFace* stencil;  // null: no stencil test here
  bool tests;                  // there is a depth test here
  bool writes;                 // and it writes
  bool asks_shader;            // the shader's visibility function decides
  bool rejects;                // blocks whose depths no sample can pass are passed over
  bool is_rare;                // the shader or the stencil has a say
  SampleGrid grid;             // which sample of the pixels
  float low, high;             // bounds of the triangle's depth
};

// The shader's say on a packet: narrows mask, replaces z.
void ask_shader(const Context& c, int packet, Real& z, Mask& mask) {
  alignas(64) std::array<float, kLanes> depth;
  uint32_t lanes = bits(mask);
  const SamplePosition at = c.draw.shades_samples ? c.grid.position : SamplePosition{kSubPixels / 2, kSubPixels / 2};
  const int x = c.grid.x0 + packet_x(packet), y = c.grid.y0 + packet_y(packet);
  std::array<SamplePosition, kLanes> centroids;
  const bool looks_inside = c.draw.kernels.uses_centroid && c.tile.samples > 1 && !c.draw.shades_samples;
  if (looks_inside) find_centroids(c.frame, x, y, nullptr, c.id, centroids.data());
  c.draw.kernels.visibility(c.draw.shader.get(),
                            {&c.frame, c.id, x, y, at, looks_inside ? centroids.data() : nullptr, depth.data(), &lanes});
  const Real shader_z = clamp(load<Real>(depth.data()), Real(c.draw.depth_low), Real(c.draw.depth_high));
  if (c.draw.kernels.writes_depth) z = depth_value(c.tile.depth_format, shader_z);
  mask = mask & mask_from_bits<Mask>(lanes);
}

// Both tests; the stencil remembers what became of each sample.
Mask test_with_stencil(const Context& c, int packet, Real z, Mask mask) {
  const Mask stencil_passed = stencil_test(*c.stencil, c.tile, packet, mask);
  Mask passed = stencil_passed;
  if (c.tests) {
    passed = passed & compare(c.draw.state.depth.compare, z, load<Real>(&c.tile.depth[static_cast<std::size_t>(packet) * kLanes]));
  }
  update_stencil(*c.stencil, c.tile, packet, mask & !stencil_passed, stencil_passed & !passed, passed);
  return passed;
}

// What becomes of the lanes that passed.
HS_INLINE void finish_packet(const Context& c, int packet, Mask mask, Real z) {
  const uint32_t lanes = bits(mask);
  if (lanes == 0) return;
  Tile& tile = c.tile;
  const std::size_t first = static_cast<std::size_t>(packet) * kLanes;
  if (c.writes && c.mode != VisibilityMode::test_only) {
    store(&tile.depth[first], select(mask, z, load<Real>(&tile.depth[first])));
  }
  if (c.mode == VisibilityMode::deferred) {
    c.statistics.samples_passed += static_cast<uint64_t>(std::popcount(lanes));
    store(&tile.id[first], select(mask, Int(std::bit_cast<int32_t>(c.id)), load<Int>(&tile.id[first])));
    return;
  }
  if (c.mode == VisibilityMode::early) c.statistics.samples_passed += static_cast<uint64_t>(std::popcount(lanes));
  if (c.mode == VisibilityMode::test_only) store(&c.list->depth[first], z);
  c.list->packets[static_cast<std::size_t>(c.list->count++)] = {static_cast<uint16_t>(packet), static_cast<uint16_t>(lanes)};
}

// Where the shader or the stencil has a say.
__attribute__((noinline)) void visit_rare_packet(const Context& c, int packet, Mask mask, Real z) {
  if (c.mode == VisibilityMode::cover_only) {
    c.list->packets[static_cast<std::size_t>(c.list->count++)] = {static_cast<uint16_t>(packet), static_cast<uint16_t>(bits(mask))};
    return;
  }
  if (c.asks_shader) ask_shader(c, packet, z, mask);
  if (c.stencil != nullptr) {
    mask = test_with_stencil(c, packet, z, mask);
  } else if (c.tests) {
    mask = mask & compare(c.draw.state.depth.compare, z, load<Real>(&c.tile.depth[static_cast<std::size_t>(packet) * kLanes]));
  }
  finish_packet(c, packet, mask, z);
}

void visit_packet(const Context& c, int packet, Mask mask, Real z) {
  c.statistics.samples_tested += static_cast<uint64_t>(std::popcount(bits(mask)));
  if (c.is_rare) return visit_rare_packet(c, packet, mask, z);
  if (c.tests) mask = mask & compare(c.draw.state.depth.compare, z, load<Real>(&c.tile.depth[static_cast<std::size_t>(packet) * kLanes]));
  finish_packet(c, packet, mask, z);
}

// Pixels of the tile's room, half open.
struct TileRect {
  int x0, y0, x1, y1;
};

template <bool small>
void visit_block(const Context& c, const TileEdges& edges, const DepthPlane<small>& plane, const TileRect& rect, bool cut, int block_x0,
                 int block_y0) {
  const int block = block_y0 / kBlockSize * kBlocksPerRow + block_x0 / kBlockSize;
  if (c.rejects) {
    const auto b = static_cast<std::size_t>(block);
    if (c.tile.block_writes[b] >= kRefreshAfter) refresh_block_bounds(c.tile, block);
    if (never_passes(c.draw.state.depth.compare, c.low, c.high, c.tile.block_min[b], c.tile.block_max[b])) return;
  }
  for (int p = 0; p < kPacketsPerBlock; ++p) {
    const int packet = block * kPacketsPerBlock + p;
    const int x = packet_x(packet), y = packet_y(packet);
    if (x >= rect.x1 || y >= rect.y1 || x + kPacketWidth <= rect.x0 || y + kPacketHeight <= rect.y0) continue;
    const Int px = lane_x() + x;
    const Int py = lane_y() + y;
    std::array<Int, 3> e;
    for (std::size_t i = 0; i < 3; ++i) e[i] = px * edges.step_x[i] + (py * edges.step_y[i] + edges.e[i]);
    Mask mask = (e[0] | e[1] | e[2]) >= Int(0);
    if (cut) mask = mask & (px >= Int(rect.x0)) & (px < Int(rect.x1)) & (py >= Int(rect.y0)) & (py < Int(rect.y1));
    if (none(mask)) continue;
    visit_packet(c, packet, mask, plane.at(e[1], e[2], px, py));
  }
  if (c.writes && c.mode != VisibilityMode::cover_only) {
    widen_bounds(c.asks_shader ? CompareOp::always : c.draw.state.depth.compare, c.tile, block, c.low, c.high);
  }
}

// No sample of the block is inside of some edge.
bool misses_block(const TileEdges& edges, int x, int y) {
  for (std::size_t i = 0; i < 3; ++i) {
    const int32_t e = edges.e[i] + edges.step_x[i] * x + edges.step_y[i] * y;
    constexpr int32_t last = kBlockSize - 1;
    if (e + std::max(0, edges.step_x[i] * last) + std::max(0, edges.step_y[i] * last) < 0) return true;
  }
  return false;
}

template <bool small>
void visit_triangle(Context& c, const TileEdges& edges, const TileRect& rect, bool cut) {
  const DepthPlane<small> plane(c.triangle, edges, c.draw, c.grid, c.tile.depth_format);
  const bool any_depth = c.asks_shader && c.draw.kernels.writes_depth;
  c.low = any_depth ? depth_value(c.tile.depth_format, c.draw.depth_low) : plane.low();
  c.high = any_depth ? depth_value(c.tile.depth_format, c.draw.depth_high) : plane.high();
  constexpr int mask = ~(kBlockSize - 1);
  for (int y = rect.y0 & mask; y < rect.y1; y += kBlockSize) {
    for (int x = rect.x0 & mask; x < rect.x1; x += kBlockSize) {
      if (!misses_block(edges, x, y)) visit_block<small>(c, edges, plane, rect, cut, x, y);
    }
  }
}

}  // namespace

VisibilityMode visibility_mode(const Draw& draw) {
  if (draw.deferred) return VisibilityMode::deferred;
  if (draw.kernels.fragment == nullptr) return VisibilityMode::early;
  if (draw.kernels.writes_depth) return VisibilityMode::cover_only;
  if (draw.kernels.discards || draw.state.alpha_to_coverage) return VisibilityMode::test_only;
  return VisibilityMode::early;
}

namespace {

void rasterize_sample(Context& c) {
  const Triangle& t = c.triangle;
  const Tile& tile = c.tile;
  const PixelBounds& allowed = c.draw.bounds;
  const PixelBounds b = pixel_bounds(c.draw, t,
                                     {std::max(allowed.x0, tile.x0), std::max(allowed.y0, tile.y0),
                                      std::min(allowed.x1, tile.x0 + tile.width), std::min(allowed.y1, tile.y0 + tile.height)},
                                     c.grid.position);
  if (b.empty()) return;
  const TileEdges edges = tile_edges(c.draw, t, c.grid, tile.size);
  if (edges.outside) return;
  // Only where the bounds cut the tile can a covered pixel lie outside of them; and a cell has others beside it.
  const bool cut = t.is(kSprite | kLine) || tile.size != kMaxTileSize || allowed.x0 > tile.x0 || allowed.y0 > tile.y0 ||
                   allowed.x1 < tile.x0 + tile.size || allowed.y1 < tile.y0 + tile.size;
  const TileRect rect{b.x0 - c.grid.x0, b.y0 - c.grid.y0, b.x1 - c.grid.x0, b.y1 - c.grid.y0};
  if (t.is(kSmall)) {
    visit_triangle<true>(c, edges, rect, cut);
  } else {
    visit_triangle<false>(c, edges, rect, cut);
  }
}

}  // namespace

void rasterize(const Frame& frame, uint32_t chunk, uint32_t index, VisibilityMode mode, Tile& tile, CoverageList* list,
               PassStatistics& statistics) {
  const Chunk& source = frame.chunks[chunk];
  const Triangle& t = source.triangles[index];
  const Draw& draw = frame.draws[source.segments[t.segment()].draw];
  const StencilFace* stencil = stencil_face(draw.state, tile, t.is(kFrontFacing));
  // A stencil value changes with what becomes of the sample: where the shader speaks later, so do both tests.
  const bool late = mode == VisibilityMode::test_only && stencil != nullptr;
  const bool tests = !late && tests_depth(draw.state.depth, tile);
  const bool asks_shader = mode == VisibilityMode::deferred && draw.kernels.visibility != nullptr;
  const bool counts_failures = stencil != nullptr && (stencil->fail != StencilOp::keep || stencil->depth_fail != StencilOp::keep);
  Context c{frame,
            draw,
            t,
            triangle_id(chunk, index),
            mode,
            tile,
            list,
            statistics,
            late ? nullptr : stencil,
            tests,
            tests && draw.state.depth.write,
            asks_shader,
            tests && !asks_shader && !counts_failures && mode != VisibilityMode::cover_only,
            asks_shader || mode == VisibilityMode::cover_only || (stencil != nullptr && !late),
            SampleGrid(tile, 0),
            0.0f,
            1.0f};
  for (int s = 0; s < tile.samples; ++s) {
    if (s != 0) c.grid = SampleGrid(tile, s);
    if ((draw.sample_mask >> s & 1) != 0) rasterize_sample(c);
    if (list != nullptr) list->sample_end[static_cast<std::size_t>(s)] = list->count;
  }
}

Mask depth_test(const DepthState& state, const Tile& tile, int packet, Real z, Mask mask) {
  if (!tests_depth(state, tile)) return mask;
  return mask & compare(state.compare, z, load<Real>(&tile.depth[static_cast<std::size_t>(packet) * kLanes]));
}

void write_depth(const DepthState& state, Tile& tile, int packet, Real z, Mask mask) {
  if (!tests_depth(state, tile) || !state.write) return;
  float* stored = &tile.depth[static_cast<std::size_t>(packet) * kLanes];
  store(stored, select(mask, z, load<Real>(stored)));
  const int block = packet / kPacketsPerBlock;
  // The shader may have written anything: bounds are made exact when next asked for.
  tile.block_writes[static_cast<std::size_t>(block)] = kRefreshAfter;
}

}  // namespace halfspace
