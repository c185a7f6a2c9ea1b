// SPDX-License-Identifier: Apache-2.0
#include "raster/visibility.h"

#include <algorithm>
#include <bit>

#include "raster/compare.h"
#include "raster/edge.h"
#include "raster/setup.h"

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

// A triangle's edge functions at the tile's first sample and their steps from pixel to pixel. For a small triangle in
// full (1/256 px)²; for others shifted down by kSubPixelBits, which keeps their sign and makes the steps whole numbers.
// The fill rule's bias is taken off. An edge that the whole tile is inside of is zero throughout.
struct TileEdges {
  std::array<int32_t, 3> e, step_x, step_y;
  std::array<int32_t, 3> bias;
  bool outside = false;  ///< no sample of the tile is inside
};

TileEdges tile_edges(const Triangle& t, const Tile& tile) {
  TileEdges r;
  constexpr int half = kSubPixels / 2;
  const int64_t x = int64_t{tile.x0} * kSubPixels + half;
  const int64_t y = int64_t{tile.y0} * kSubPixels + half;
  const bool small = t.is(kSmall);
  const int64_t last = tile.size - 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Edge edge = edge_of(t, i);
    const int64_t shift = small ? 0 : kSubPixelBits;
    const int64_t step_x = -(int64_t{edge.ey} * kSubPixels) >> shift;
    const int64_t step_y = (int64_t{edge.ex} * kSubPixels) >> shift;
    r.bias[i] = fill_bias(edge);
    const int64_t e = (edge.at(x, y) - r.bias[i]) >> shift;
    const int64_t low = e + std::min<int64_t>(0, step_x * last) + std::min<int64_t>(0, step_y * last);
    const int64_t high = e + std::max<int64_t>(0, step_x * last) + std::max<int64_t>(0, step_y * last);
    if (high < 0) r.outside = true;
    const bool drop = low >= 0 && !small;
    r.e[i] = drop || high < 0 ? 0 : static_cast<int32_t>(e);
    r.step_x[i] = drop || high < 0 ? 0 : static_cast<int32_t>(step_x);
    r.step_y[i] = drop || high < 0 ? 0 : static_cast<int32_t>(step_y);
  }
  return r;
}

// The depth of a triangle at the pixels of packets.
template <bool small>
class DepthPlane {
 public:
  DepthPlane(const Triangle& t, const TileEdges& edges, const Draw& draw, const Tile& tile)
      : z0_(t.z0),
        z_edge1_(t.z_edge1),
        z_edge2_(t.z_edge2),
        low_(draw.depth_low),
        high_(std::clamp(t.z_max, draw.depth_low, draw.depth_high)),
        format_(tile.depth_format) {
    if constexpr (small) {
      bias1_ = edges.bias[1];
      bias2_ = edges.bias[2];
    } else {
      e1x_ = static_cast<float>(t.x[1] - t.x[0]);
      e1y_ = static_cast<float>(t.y[1] - t.y[0]);
      e2x_ = static_cast<float>(t.x[2] - t.x[0]);
      e2y_ = static_cast<float>(t.y[2] - t.y[0]);
      dx_ = static_cast<float>(tile.x0 * kSubPixels + kSubPixels / 2 - t.x[0]);
      dy_ = static_cast<float>(tile.y0 * kSubPixels + kSubPixels / 2 - t.y[0]);
    }
  }

  // e1, e2: the biased edge values of the packet's pixels (small triangles); x, y: their place in the tile.
  HS_INLINE Real at(Int e1, Int e2, Int x, Int y) const {
    Real w1, w2;
    if constexpr (small) {
      w1 = to_real<Real>(e1 + bias1_);
      w2 = to_real<Real>(e2 + bias2_);
    } else {
      const Real dx = Real(dx_) + to_real<Real>(x * kSubPixels);
      const Real dy = Real(dy_) + to_real<Real>(y * kSubPixels);
      w1 = difference_of_products(dx, Real(e2y_), dy, Real(e2x_));
      w2 = difference_of_products(Real(e1x_), dy, Real(e1y_), dx);
    }
    const Real z = fma(w1, Real(z_edge1_), fma(w2, Real(z_edge2_), Real(z0_)));
    return depth_value(format_, clamp(z, Real(low_), Real(high_)));
  }

  // Bounds of what at() gives.
  float low() const { return depth_value(format_, std::clamp(z0_, low_, high_)); }
  float high() const { return depth_value(format_, high_); }

 private:
  float z0_, z_edge1_, z_edge2_, low_, high_;
  DepthFormat format_;
  int32_t bias1_ = 0, bias2_ = 0;
  float e1x_ = 0, e1y_ = 0, e2x_ = 0, e2y_ = 0, dx_ = 0, dy_ = 0;
};

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
  bool tests;        ///< there is a depth test
  bool writes;       ///< and it writes
  bool asks_shader;  ///< the shader's visibility function decides
  float low, high;   ///< bounds of the triangle's depth
};

// The shader's say on a packet: narrows mask, replaces z.
void ask_shader(const Context& c, int packet, Real& z, Mask& mask) {
  alignas(64) std::array<float, kLanes> depth;
  uint32_t lanes = bits(mask);
  c.draw.kernels.visibility(c.draw.shader.get(),
                            {&c.frame, c.id, c.tile.x0 + packet_x(packet), c.tile.y0 + packet_y(packet), depth.data(), &lanes});
  const Real shader_z = clamp(load<Real>(depth.data()), Real(c.draw.depth_low), Real(c.draw.depth_high));
  if (c.draw.kernels.writes_depth) z = depth_value(c.tile.depth_format, shader_z);
  mask = mask & mask_from_bits<Mask>(lanes);
}

void visit_packet(const Context& c, int packet, Mask mask, Real z) {
  c.statistics.samples_tested += static_cast<uint64_t>(std::popcount(bits(mask)));
  Tile& tile = c.tile;
  const std::size_t first = static_cast<std::size_t>(packet) * kLanes;
  if (c.mode == VisibilityMode::cover_only) {
    c.list->packets[static_cast<std::size_t>(c.list->count++)] = {static_cast<uint16_t>(packet), static_cast<uint16_t>(bits(mask))};
    return;
  }
  if (c.asks_shader) ask_shader(c, packet, z, mask);
  if (c.tests) mask = mask & compare(c.draw.state.depth.compare, z, load<Real>(&tile.depth[first]));
  const uint32_t lanes = bits(mask);
  if (lanes == 0) return;
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

// Pixels of the tile, half open.
struct TileRect {
  int x0, y0, x1, y1;
};

template <bool small>
void visit_block(const Context& c, const TileEdges& edges, const DepthPlane<small>& plane, const TileRect& rect, bool cut, int block_x0,
                 int block_y0) {
  const int block = block_y0 / kBlockSize * kBlocksPerRow + block_x0 / kBlockSize;
  if (c.tests && !c.asks_shader && c.mode != VisibilityMode::cover_only) {
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
void visit_triangle(const Context& context, const TileEdges& edges, const TileRect& rect, bool cut) {
  Context c = context;
  const DepthPlane<small> plane(c.triangle, edges, c.draw, c.tile);
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
  if (draw.kernels.writes_depth) return VisibilityMode::cover_only;
  if (draw.kernels.discards) return VisibilityMode::test_only;
  return VisibilityMode::early;
}

void rasterize(const Frame& frame, uint32_t chunk, uint32_t index, VisibilityMode mode, Tile& tile, CoverageList* list,
               PassStatistics& statistics) {
  const Chunk& source = frame.chunks[chunk];
  const Triangle& t = source.triangles[index];
  const Draw& draw = frame.draws[source.segments[t.segment()].draw];
  const PixelBounds& allowed = draw.bounds;
  const PixelBounds b = pixel_bounds(t, {std::max(allowed.x0, tile.x0), std::max(allowed.y0, tile.y0),
                                         std::min(allowed.x1, tile.x0 + tile.width), std::min(allowed.y1, tile.y0 + tile.height)});
  if (b.empty()) return;
  const TileEdges edges = tile_edges(t, tile);
  if (edges.outside) return;
  // Only where the bounds cut the tile can a covered pixel lie outside of them.
  const bool cut = allowed.x0 > tile.x0 || allowed.y0 > tile.y0 || allowed.x1 < tile.x0 + tile.size || allowed.y1 < tile.y0 + tile.size;
  const TileRect rect{b.x0 - tile.x0, b.y0 - tile.y0, b.x1 - tile.x0, b.y1 - tile.y0};
  const bool tests = tests_depth(draw.state.depth, tile);
  const Context c{frame,
                  draw,
                  t,
                  triangle_id(chunk, index),
                  mode,
                  tile,
                  list,
                  statistics,
                  tests,
                  tests && draw.state.depth.write,
                  mode == VisibilityMode::deferred && draw.kernels.visibility != nullptr,
                  0.0f,
                  1.0f};
  if (t.is(kSmall)) {
    visit_triangle<true>(c, edges, rect, cut);
  } else {
    visit_triangle<false>(c, edges, rect, cut);
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
