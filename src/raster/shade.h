// SPDX-License-Identifier: Apache-2.0
//
// Shade. In: packets of a tile, each lane with the triangle it shows. Out: linear colours, and for shaders that ask,
// keep masks and depths. A packet may show one triangle, a few, or a different one in every lane: the values of each
// are merged into the lanes that show it, and the shader runs once.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include "raster/output.h"
#include "raster/tile.h"
#include "raster/visibility.h"
#include "shading/contract.h"

namespace halfspace {

/// Packets that a fragment kernel shades in one call.
inline constexpr int kFragmentBatch = 16;

/// Colours, and where the shader decides them keep masks and depths, of a batch.
struct FragmentOutput {
  alignas(64) std::array<PacketColor, kFragmentBatch * kMaxColorTargets> color;  ///< see packet_color()
  alignas(64) std::array<Real, kFragmentBatch> depth;                            ///< if the shader writes depth
  std::array<uint16_t, kFragmentBatch> keep;                                     ///< bit a lane; if the shader discards

  /// The n-th colour of packet i.
  PacketColor& packet_color(std::size_t n, std::size_t i) { return color[n * kFragmentBatch + i]; }
  const PacketColor& packet_color(std::size_t n, std::size_t i) const { return color[n * kFragmentBatch + i]; }
};

struct FragmentBatch {
  const Frame* frame;
  int tile_x0, tile_y0;     ///< window coordinates of pixel (0, 0) of the tile's room
  SamplePosition position;  ///< where in their pixels the shader looks
  const TriangleId* ids;    ///< the tile's triangle of each pixel, or null: uniform_id everywhere
  TriangleId uniform_id;
  const PacketMask* packets;
  int count;                        ///< ≤ kFragmentBatch
  const SamplePosition* centroids;  ///< where centroid varyings are looked up, a row of W for each packet; or null: at position
  FragmentOutput* out;
};

/// The draw that a triangle belongs to.
inline const Draw& draw_of(const Frame& frame, TriangleId id) {
  const Chunk& chunk = frame.chunks[id >> 16];
  const std::size_t segment = chunk.segments.size() == 1 ? 0 : chunk.triangles[id & 0xffff].segment();
  return frame.draws[chunk.segments[segment].draw];
}

/// What the kernels read of one triangle, wherever it is kept.
struct TriangleSource {
  const Triangle* triangle;
  std::array<const ScreenVertex*, 3> vertex;
  std::array<ScreenVertex, 3> corners;  ///< what vertex points to, of points and lines
  std::array<const float*, 3> varyings;
  const float* flat_varyings;  ///< the provoking vertex's row
  const float* primitive;      ///< the primitive stage's row, or null
  float z_low;                 ///< the least depth in the window
};
void find_triangle(const Frame& frame, TriangleId id, TriangleSource& out);

/// What the kernels read where each lane may show another triangle: which rows of the draw's varyings.
struct TriangleRows {
  const float* varyings;
  std::array<Int, 3> row;  ///< of the vertices, in the order of TriangleLanes
  Int provoking_row;
  std::array<const float*, kLanes> primitive;  ///< the primitive stage's rows
};
/// Gathers the triangles of `lanes` (not empty; all of one draw); other lanes repeat the first. False, and nothing is said, if
/// one of them is clipped, a point or a line, or the draw has too many vertices for gathers.
bool gather_rows(const Frame& frame, const TriangleId* ids, uint32_t lanes, TriangleLanes<Real>& triangles, Mask& front,
                 TriangleRows& rows);

/// Where Pixel::z() of a packet looks: the triangles of `lanes`.
struct PacketTriangleIds {
  const Frame* frame;
  const TriangleId* ids;  ///< or null: uniform_id everywhere
  TriangleId uniform_id;
  uint32_t lanes;
};
/// The window depth of a packet's pixels, within an ulp of what the visibility stage tested. px.z_source: PacketTriangleIds.
Real packet_depth(const Pixel<Real>& px);

/// Shades all pixels of the tile that wait for it, and writes their colours.
void shade_deferred(const Frame& frame, Tile& tile, PassStatistics& statistics);

/// The same where all pixels of the tile's room show one triangle.
void shade_whole_tile(const Frame& frame, TriangleId id, Tile& tile, PassStatistics& statistics);

/// The colours of a draw whose shader is constant.
void constant_colors(const Draw& draw, FragmentOutput& out);

/// Shades one triangle's packets now: late tests where needed, blending, colour write.
void shade_immediate(const Frame& frame, const Draw& draw, TriangleId id, VisibilityMode mode, const CoverageList& list, Tile& tile,
                     PassStatistics& statistics);

/// Writes all colours of packet i of a batch to the tile's packet where mask says.
void write_colors(const Draw& draw, const FragmentOutput& out, std::size_t i, int packet, Mask mask, Tile& tile);

namespace detail {

/// 1/w of three vertices over a power of two near the largest: products with areas up to 2^47 then neither overflow nor underflow.
template <class R>
struct ScaledInverseW {
  R q0, q1, q2, unscale;
};
template <class R>
HS_INLINE ScaledInverseW<R> scaled(R q0, R q1, R q2) {
  const IntOf<R> exponent = as_int(max(q0, max(q1, q2))) & 0x7f800000;
  const R scale = as_real(IntOf<R>(0x7f000000) - exponent);  // 2^(127 − e) for the largest in [2^(e−127), 2^(e−126))
  return {q0 * scale, q1 * scale, q2 * scale, as_real(exponent)};
}

/// What interpolation needs of one triangle, before it is spread to lanes. Vertex 0 is the one with the smallest 1/w.
template <std::size_t N>
struct TriangleScalars {
  float x0, y0, e1x, e1y, e2x, e2y, area, q0, q1, q2, q_unscale;
  std::array<float, N> value0, delta1, delta2;
  const float* primitive;  ///< the primitive stage's row, or null
  bool front;
};

/// V is the Varyings struct with R = float, which tells how each component is interpolated.
template <class V, std::size_t N = kComponents<V>>
HS_INLINE TriangleScalars<N> triangle_scalars(const TriangleSource& s) {
  std::size_t a = 0;
  if (s.vertex[1]->inv_w < s.vertex[a]->inv_w) a = 1;
  if (s.vertex[2]->inv_w < s.vertex[a]->inv_w) a = 2;
  const std::size_t b = a == 2 ? 0 : a + 1;
  const std::size_t c = b == 2 ? 0 : b + 1;
  const ScreenVertex &v0 = *s.vertex[a], &v1 = *s.vertex[b], &v2 = *s.vertex[c];
  TriangleScalars<N> r;
  r.x0 = static_cast<float>(v0.x);
  r.y0 = static_cast<float>(v0.y);
  r.e1x = static_cast<float>(v1.x - v0.x);
  r.e1y = static_cast<float>(v1.y - v0.y);
  r.e2x = static_cast<float>(v2.x - v0.x);
  r.e2y = static_cast<float>(v2.y - v0.y);
  r.area = difference_of_products(r.e1x, r.e2y, r.e1y, r.e2x);
  const ScaledInverseW<float> q = scaled(v0.inv_w, v1.inv_w, v2.inv_w);
  r.q_unscale = q.unscale;
  r.q0 = q.q0;
  r.q1 = q.q1;
  r.q2 = q.q2;
  for (std::size_t i = 0; i < N; ++i) {
    const bool flat = kInterpolations<V>[i] == Interpolation::flat;
    r.value0[i] = flat ? s.flat_varyings[i] : s.varyings[a][i];
    r.delta1[i] = flat ? 0.0f : s.varyings[b][i] - s.varyings[a][i];
    r.delta2[i] = flat ? 0.0f : s.varyings[c][i] - s.varyings[a][i];
  }
  r.primitive = s.primitive;
  r.front = s.triangle->is(kFrontFacing);
  return r;
}

template <class V>
HS_INLINE TriangleScalars<kComponents<V>> scalars_of(const Frame& frame, TriangleId id) {
  TriangleSource source;
  find_triangle(frame, id, source);
  return triangle_scalars<V>(source);
}

/// The scalars of the triangles that were asked for last: neighbouring packets show the same ones.
template <class V>
class RecentTriangles {
 public:
  HS_INLINE const TriangleScalars<kComponents<V>>& of(const Frame& frame, TriangleId id) {
    uint32_t same = 0;
    for (std::size_t i = 0; i < kMost; i += kLanes) same |= bits(load<Int>(&ids_[i]) == Int(std::bit_cast<int32_t>(id))) << i;
    if (same != 0) return scalars_[static_cast<std::size_t>(std::countr_zero(same))];
    newest_ = (newest_ + 1) % kMost;
    ids_[newest_] = id;
    return scalars_[newest_] = scalars_of<V>(frame, id);
  }

 private:
  static constexpr std::size_t kMost = 16;
  static constexpr std::array<TriangleId, kMost> kNone = [] {
    std::array<TriangleId, kMost> none;
    none.fill(kNoTriangle);
    return none;
  }();
  std::array<TriangleId, kMost> ids_ = kNone;
  std::array<TriangleScalars<kComponents<V>>, kMost> scalars_;
  std::size_t newest_ = kMost - 1;
};

/// Everything a packet needs of its triangles, lane by lane. P: components of the primitive stage's struct.
template <std::size_t N, std::size_t P>
struct PacketTriangles {
  TriangleId only = kNoTriangle;  ///< where all lanes show one triangle, that
  TriangleLanes<Real> lanes;
  ComponentLanes<Real, N> components;
  std::array<Real, P> primitive;
  Mask front;
};

/// Spreads one triangle's values: the packet's first to all lanes, so that lanes without a triangle compute with finite
/// values; the others to the lanes of m.
template <bool first, std::size_t N, std::size_t P>
HS_INLINE void merge_triangle(const TriangleScalars<N>& s, Mask m, PacketTriangles<N, P>& out) {
  const auto put = [=](Real& to, float value) {
    if constexpr (first) {
      to = Real(value);
    } else {
      to = select(m, Real(value), to);
    }
  };
  TriangleLanes<Real>& t = out.lanes;
  put(t.x0, s.x0);
  put(t.y0, s.y0);
  put(t.e1x, s.e1x);
  put(t.e1y, s.e1y);
  put(t.e2x, s.e2x);
  put(t.e2y, s.e2y);
  put(t.area, s.area);
  put(t.q0, s.q0);
  put(t.q1, s.q1);
  put(t.q2, s.q2);
  put(t.q_unscale, s.q_unscale);
  for (std::size_t i = 0; i < N; ++i) {
    put(out.components.value0[i], s.value0[i]);
    put(out.components.delta1[i], s.delta1[i]);
    put(out.components.delta2[i], s.delta2[i]);
  }
  for (std::size_t i = 0; i < P; ++i) put(out.primitive[i], s.primitive[i]);
  out.front = first ? Mask(s.front) : select(m, Mask(s.front), out.front);
}

/// The components of rows, gathered.
template <class V, std::size_t N, std::size_t P>
HS_INLINE void gather_components(const TriangleRows& rows, PacketTriangles<N, P>& out) {
  constexpr auto n = static_cast<int32_t>(N);
  const std::array<Int, 4> at{rows.row[0] * n, rows.row[1] * n, rows.row[2] * n, rows.provoking_row * n};
  for (std::size_t i = 0; i < N; ++i) {
    const float* column = rows.varyings + i;
    const bool flat = kInterpolations<V>[i] == Interpolation::flat;
    out.components.value0[i] = gather(column, flat ? at[3] : at[0]);
    out.components.delta1[i] = flat ? Real(0.0f) : gather(column, at[1]) - out.components.value0[i];
    out.components.delta2[i] = flat ? Real(0.0f) : gather(column, at[2]) - out.components.value0[i];
  }
  for (std::size_t i = 0; i < P; ++i) {
    for (int lane = 0; lane < kLanes; ++lane) set_lane(out.primitive[i], lane, rows.primitive[static_cast<std::size_t>(lane)][i]);
  }
}

/// Triangles of a packet from which on they are gathered, not merged one by one.
inline constexpr int kGatherFrom = 4;

/// The triangles of a packet: one, few or many. t.only is the one that t holds already, if it holds one alone.
template <class V, std::size_t N, std::size_t P>
HS_INLINE void find_triangles(const FragmentBatch& batch, PacketMask packet, RecentTriangles<V>& recent, PacketTriangles<N, P>& t) {
  if (batch.ids == nullptr) {
    if (t.only != batch.uniform_id) merge_triangle<true>(recent.of(*batch.frame, batch.uniform_id), Mask(true), t);
    t.only = batch.uniform_id;
    return;
  }
  const TriangleId* ids = batch.ids + static_cast<std::size_t>(packet.packet) * kLanes;
  const Int packet_ids = load<Int>(ids);
  uint32_t rest = packet.lanes;
  const auto next = [&] { return ids[std::countr_zero(rest)]; };
  const auto showing = [&](TriangleId id) { return packet_ids == Int(std::bit_cast<int32_t>(id)); };
  int triangles = 0;
  for (; rest != 0 && triangles < kGatherFrom; ++triangles) rest &= ~bits(showing(next()));
  if (triangles == 1 && t.only == ids[std::countr_zero(static_cast<uint32_t>(packet.lanes))]) return;
  t.only = kNoTriangle;
  if (triangles == kGatherFrom) {
    TriangleRows rows;
    if (gather_rows(*batch.frame, ids, packet.lanes, t.lanes, t.front, rows)) return gather_components<V>(rows, t);
  }
  rest = packet.lanes;
  TriangleId id = next();
  merge_triangle<true>(recent.of(*batch.frame, id), Mask(true), t);
  if (triangles == 1) t.only = id;
  for (rest &= ~bits(showing(id)); rest != 0; rest &= ~bits(showing(id))) {
    id = next();
    merge_triangle<false>(recent.of(*batch.frame, id), showing(id), t);
  }
}

/// Sets up the Pixel of a packet and interpolates its varyings.
template <class S, std::size_t N, std::size_t P>
HS_INLINE typename S::template Varyings<Real> begin_packet(int x, int y, const SamplePosition& at, const SamplePosition* centroids,
                                                           const PacketTriangles<N, P>& t, const PacketTriangleIds& ids, Pixel<Real>& px) {
  using V = typename S::template Varyings<Real>;
  const Int ix = lane_x() + x, iy = lane_y() + y;
  const Real x_sub = to_real<Real>(ix * kSubPixels + at.x);
  const Real y_sub = to_real<Real>(iy * kSubPixels + at.y);
  px.dx = x_sub - t.lanes.x0;
  px.dy = y_sub - t.lanes.y0;
  px.triangle = &t.lanes;
  px.component_lanes = &t.components;
  px.weights = weights_at<kUsesLinear<V>>(t.lanes, px.dx, px.dy);
  px.x = x_sub * Real(1.0f / kSubPixels);
  px.y = y_sub * Real(1.0f / kSubPixels);
  px.quad_x = to_real<Real>(ix & Int(1));
  px.quad_y = to_real<Real>(iy & Int(1));
  px.find_z = packet_depth;
  px.z_source = &ids;
  px.front_facing = t.front;
  if constexpr (kUsesCentroid<typename S::template Varyings<float>>) {
    if (centroids != nullptr) {
      Int cx{}, cy{};
      for (int i = 0; i < kLanes; ++i) {
        set_lane(cx, i, centroids[i].x);
        set_lane(cy, i, centroids[i].y);
      }
      const Weights<Real> inside =
          weights_at(t.lanes, to_real<Real>(ix * kSubPixels + cx) - t.lanes.x0, to_real<Real>(iy * kSubPixels + cy) - t.lanes.y0);
      return interpolate_all<V>(px.weights, inside, t.components, std::make_index_sequence<N>());
    }
  }
  (void)centroids;
  return interpolate_all<V>(px.weights, t.components, std::make_index_sequence<N>());
}

template <class S>
HS_FLATTEN void fragment_kernel(const void* shader, const FragmentBatch& batch) {
  using V = typename S::template Varyings<Real>;
  using F = typename S::template Varyings<float>;
  using P = PrimitiveOf<S, Real>;
  constexpr std::size_t n = kComponents<V>;
  constexpr std::size_t p = HasPrimitive<S> ? kComponents<P> : 0;
  const S& s = *static_cast<const S*>(shader);
  if constexpr (kIsConstant<S>) {
    const auto fragment = s.fragment(V{});
    for (std::size_t n_color = 0; n_color < kColors<S>; ++n_color) {
      const vec4<Real>& color = nth_color(fragment.color, n_color);
      for (int i = 0; i < batch.count; ++i) {
        batch.out->packet_color(n_color, static_cast<std::size_t>(i)) = {color.x, color.y, color.z, color.w};
      }
    }
    return;
  }
  // A packet's interpolation is a long chain of operations that wait for each other, and so is its shading: while one packet is shaded the
  // next is already interpolated.
  struct Ready {
    PacketTriangles<n, p> triangles;
    PacketTriangleIds ids;
    Pixel<Real> px;
    V in;
  };
  std::array<Ready, 2> ready;
  RecentTriangles<F> recent;
  for (int next = 0; next <= batch.count; ++next) {
    if (next < batch.count) {
      Ready& r = ready[static_cast<std::size_t>(next) % 2];
      const PacketMask packet = batch.packets[next];
      find_triangles(batch, packet, recent, r.triangles);
      r.ids = {batch.frame, batch.ids == nullptr ? nullptr : batch.ids + static_cast<std::size_t>(packet.packet) * kLanes, batch.uniform_id,
               packet.lanes};
      r.in = begin_packet<S>(batch.tile_x0 + packet_x(packet.packet), batch.tile_y0 + packet_y(packet.packet), batch.position,
                             batch.centroids == nullptr ? nullptr : batch.centroids + next * kLanes, r.triangles, r.ids, r.px);
    }
    if (next == 0) continue;
    const auto at = static_cast<std::size_t>(next - 1);
    const Ready& r = ready[at % 2];
    P face{};
    if constexpr (p != 0) face = from_components<P, Real>(r.triangles.primitive);
    const auto fragment = call_fragment<S, Real>(s, r.in, face, r.px);
    for (std::size_t n_color = 0; n_color < kColors<S>; ++n_color) {
      const vec4<Real>& color = nth_color(fragment.color, n_color);
      batch.out->packet_color(n_color, at) = {color.x, color.y, color.z, color.w};
    }
    if constexpr (kDiscards<S>) batch.out->keep[at] = static_cast<uint16_t>(bits(fragment.keep));
    if constexpr (kWritesDepth<S>) batch.out->depth[at] = fragment.depth;
  }
}

template <class S>
HS_FLATTEN void visibility_kernel(const void* shader, VisibilityBatch& batch) {
  using V = typename S::template Varyings<Real>;
  using F = typename S::template Varyings<float>;
  PacketTriangles<kComponents<V>, 0> triangles;
  merge_triangle<true>(scalars_of<F>(*batch.frame, batch.id), Mask(true), triangles);
  const PacketTriangleIds ids{batch.frame, nullptr, batch.id, kAllBits<Mask>};
  for (int i = 0; i < batch.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    Pixel<Real> px;
    const V in = begin_packet<S>(batch.tile_x0 + packet_x(batch.packets[at]), batch.tile_y0 + packet_y(batch.packets[at]), batch.position,
                                 batch.centroids == nullptr ? nullptr : batch.centroids + i * kLanes, triangles, ids, px);
    const Visibility<Real> v = static_cast<const S*>(shader)->visibility(in, px);
    if constexpr (kWritesDepth<S>) batch.depth[at] = v.depth;
    batch.lanes[at] &= bits(v.keep);
  }
}

}  // namespace detail

}  // namespace halfspace
