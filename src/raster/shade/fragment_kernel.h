// SPDX-License-Identifier: Apache-2.0
//
// Runs a shader's fragment or visibility function on the packets of a batch, two packets at a time.
#pragma once

#include <algorithm>

#include "halfspace/raster/shade/packet_merge.h"
#include "halfspace/raster/tile/tile_format.h"

namespace halfspace::HS_LANES::detail {

/// Window coordinates of the pixels of two packets, and the positions of their centroid varyings.
struct PacketPixels {
  IntOf<FragmentReal> x, y;
  /// For each packet, one position per lane. Null if centroid varyings are evaluated at the same position as all others.
  std::array<const SamplePosition*, 2> centroids;
};
/// Returns the pixels of packets a and b of a batch.
HS_INLINE PacketPixels pixels_of(const PacketBatch& batch, int a, int b) {
  using I = IntOf<FragmentReal>;
  const auto at = [](int n) { return static_cast<std::size_t>(n) * kLanes; };
  if (batch.pixels != nullptr) {
    const I packed(load<Int>(batch.pixels + at(a)), load<Int>(batch.pixels + at(b)));
    return {(packed & I(0xffff)) + I(batch.tile_x0), (packed >> 16) + I(batch.tile_y0), {}};
  }
  const PacketPosition in_a = kPacketPositions[batch.packets[a].packet], in_b = kPacketPositions[batch.packets[b].packet];
  PacketPixels pixels{I(lane_x() + (batch.tile_x0 + in_a.x), lane_x() + (batch.tile_x0 + in_b.x)),
                      I(lane_y() + (batch.tile_y0 + in_a.y), lane_y() + (batch.tile_y0 + in_b.y)),
                      {}};
  if (batch.centroids != nullptr) pixels.centroids = {batch.centroids + at(a), batch.centroids + at(b)};
  return pixels;
}

/// Returns the triangles of packet n of a batch.
HS_INLINE PacketTriangleIds triangle_ids_of(const PacketBatch& batch, int n) {
  const PacketMask packet = batch.packets[n];
  if (batch.ids == nullptr) return {batch.context, nullptr, batch.packet_ids[n], packet.lanes};
  return {batch.context, batch.ids + static_cast<std::size_t>(packet.packet) * kLanes, kNoTriangle, packet.lanes};
}

/// Pixel::find_z and find_sample_mask of two packets. Pure functions, so that kernels which need no depth do not compute it.
__attribute__((pure)) inline FragmentReal depth_in_packets(const Pixel<FragmentReal>& px) noexcept {
  const auto& of = *static_cast<const std::array<PacketTriangleIds, 2>*>(px.z_source);
  return {packet_depth(px.x.low, px.y.low, of[0]), packet_depth(px.x.high, px.y.high, of[1])};
}
__attribute__((pure)) inline IntOf<FragmentReal> sample_mask_in_packets(const Pixel<FragmentReal>& px) noexcept {
  const auto& of = *static_cast<const std::array<PacketTriangleIds, 2>*>(px.z_source);
  return {packet_sample_mask(px.x.low, px.y.low, of[0]), packet_sample_mask(px.x.high, px.y.high, of[1])};
}

/// Sets up the Pixel of two packets of a batch and interpolates their varyings. ids: triangles for Pixel::z() and Pixel::sample_mask().
template <class S, std::size_t N, std::size_t P, bool with_id>
HS_INLINE typename S::template Varyings<FragmentReal> begin_packets(const PacketBatch& batch, const PacketPixels& pixels,
                                                                    const PacketTriangles<N, P, with_id>& t,
                                                                    const std::array<PacketTriangleIds, 2>& ids, Pixel<FragmentReal>& px) {
  using R = FragmentReal;
  using I = IntOf<R>;
  using V = typename S::template Varyings<R>;
  const I ix = pixels.x, iy = pixels.y;
  const SamplePosition& at = batch.position;
  place_pixel<V>(px, t.lanes, t.components, to_real<R>(ix * kSubPixels + at.x), to_real<R>(iy * kSubPixels + at.y), to_real<R>(ix & I(1)),
                 to_real<R>(iy & I(1)));
  px.find_z = depth_in_packets;
  px.find_sample_mask = sample_mask_in_packets;
  px.z_source = &ids;
  px.sample = batch.sample;
  px.samples = batch.context->samples;
  px.front_facing = t.front;
  if constexpr (kUsesCentroid<typename S::template Varyings<float>>) {
    if (pixels.centroids[0] != nullptr) {
      I cx(0), cy(0);
      for (int i = 0; i < kWidthOf<R>; ++i) {
        const SamplePosition& c = pixels.centroids[static_cast<std::size_t>(i / kLanes)][i % kLanes];
        set_lane(cx, i, c.x);
        set_lane(cy, i, c.y);
      }
      const Weights<R> inside =
          weights_at(t.lanes, to_real<R>(ix * kSubPixels + cx) - t.lanes.x0, to_real<R>(iy * kSubPixels + cy) - t.lanes.y0);
      return interpolate_all<V>(px.weights, inside, t.components, std::make_index_sequence<N>());
    }
  }
  return interpolate_all<V>(px.weights, t.components, std::make_index_sequence<N>());
}

/// Returns the PrimitiveId at the pixels with the given weights.
template <std::size_t N>
HS_INLINE PrimitiveId<FragmentReal> primitive_id(const PacketTriangles<N, kIdRow, true>& t, const Weights<FragmentReal>& weights) {
  using R = FragmentReal;
  const ComponentLanes<R, 2>& b = t.barycentrics;
  const R second = interpolate<Interpolation::smooth>(weights, b.value0[0], b.delta1[0], b.delta2[0]);
  const R third = interpolate<Interpolation::smooth>(weights, b.value0[1], b.delta1[1], b.delta2[1]);
  return {as_int(t.primitive[kIdPrimitive]), as_int(t.primitive[kIdInstance]), vec3<R>(R(1) - (second + third), second, third)};
}

/// Encodes the colors of a packet as rgba8; see FragmentBatch::codes.
HS_INLINE void encode_packet(int32_t* codes, PacketMask packet, const PacketColor& color) {
  const Int packed = packed_codes<ColorFormat::rgba8>(color);
  int32_t* to = codes + static_cast<std::size_t>(packet.packet) * kLanes;
  if (packet.lanes == kAllBits<Mask>) return store(to, packed);
  store(to, select(mask_from_bits<Mask>(packet.lanes), packed, load<Int>(to)));
}

/// Gives the first color of packets `first` and `second` of the batch to the codes or to the write program. Returns false if the batch has
/// neither, so that all colors belong in FragmentBatch::out.
HS_INLINE bool write_directly(const FragmentBatch& batch, int first, int second, const vec4<FragmentReal>& color) {
  const PacketMask a = batch.packets[first], b = batch.packets[second];
  if (batch.codes != nullptr) {
    encode_packet(batch.codes, a, {color.x.low, color.y.low, color.z.low, color.w.low});
    encode_packet(batch.codes, b, {color.x.high, color.y.high, color.z.high, color.w.high});
    return true;
  }
  const WriteTarget& to = batch.target;
  if (to.program == nullptr) return false;
  to.write(a, color.x.low, color.y.low, color.z.low, color.w.low);
  if (second != first) to.write(b, color.x.high, color.y.high, color.z.high, color.w.high);
  return true;
}

/// Stores color n of packets i and i + 1 of the batch.
HS_INLINE void write_color_pair(const FragmentBatch& batch, std::size_t n, std::size_t i, const vec4<FragmentReal>& color) {
  if (batch.pixels == nullptr) {
    batch.out->packet_color(n, i) = {color.x.low, color.y.low, color.z.low, color.w.low};
    batch.out->packet_color(n, i + 1) = {color.x.high, color.y.high, color.z.high, color.w.high};
    return;
  }
  const auto put = [&](std::size_t c, const FragmentReal& values) {
    float* to = batch.out->color_plane(n, c) + i * kLanes;
    store(to, values.low);
    store(to + kLanes, values.high);
  };
  put(0, color.x);
  put(1, color.y);
  put(2, color.z);
  put(3, color.w);
}

/// Runs the fragment function. decides: also return the keep mask and the depth.
template <class S, bool decides>
HS_FLATTEN void fragment_kernel(const void* shader, const FragmentBatch& batch) {
  using R = FragmentReal;
  using V = typename S::template Varyings<R>;
  using F = typename S::template Varyings<float>;
  using P = PrimitiveOf<S, R>;
  constexpr std::size_t n = kComponents<V>;
  constexpr std::size_t p = [] {
    if constexpr (HasPrimitive<S>) return kComponents<P>;
    return kUsesPrimitiveId<S> ? std::size_t{kIdRow} : 0;
  }();
  const S& s = *static_cast<const S*>(shader);
  if constexpr (kIsConstant<S>) {
    const auto fragment = s.fragment(typename S::template Varyings<Real>{});
    for (std::size_t n_color = 0; n_color < kColors<S>; ++n_color) {
      const vec4<Real>& color = nth_color(fragment.color, n_color);
      for (int i = 0; i < batch.count; ++i) {
        batch.out->packet_color(n_color, static_cast<std::size_t>(i)) = {color.x, color.y, color.z, color.w};
      }
    }
    return;
  }
  PacketTriangles<n, p, kUsesPrimitiveId<S>> triangles;
  RecentTriangles<F, kUsesPrimitiveId<S>> recent(cell_of(batch));
  for (int first = 0; first < batch.count; first += 2) {
    const int second = std::min(first + 1, batch.count - 1);  // if the count is odd, the last packet is shaded twice
    find_triangles<0>(batch, first, recent, triangles);
    find_triangles<1>(batch, second, recent, triangles);
    const std::array<PacketTriangleIds, 2> ids{triangle_ids_of(batch, first), triangle_ids_of(batch, second)};
    Pixel<R> px;
    const V in = begin_packets<S>(batch, pixels_of(batch, first, second), triangles, ids, px);
    P face{};
    if constexpr (kUsesPrimitiveId<S>) {
      face = primitive_id(triangles, px.weights);
    } else if constexpr (p != 0) {
      face = from_components<P, R>(triangles.primitive);
    }
    const auto fragment = call_fragment<S, R>(s, in, face, px);
    if constexpr (!decides || !(kDiscards<S> || kWritesDepth<S>)) {
      if (write_directly(batch, first, second, nth_color(fragment.color, 0))) continue;
    }
    const auto i = static_cast<std::size_t>(first);
    for (std::size_t n_color = 0; n_color < kColors<S>; ++n_color) {
      write_color_pair(batch, n_color, i, nth_color(fragment.color, n_color));
    }
    if constexpr (decides && kDiscards<S>) {
      batch.out->keep[i] = static_cast<uint16_t>(bits(fragment.keep.low));
      batch.out->keep[i + 1] = static_cast<uint16_t>(bits(fragment.keep.high));
    }
    if constexpr (decides && kWritesDepth<S>) {
      batch.out->depth[i] = fragment.depth.low;
      batch.out->depth[i + 1] = fragment.depth.high;
    }
    if constexpr (decides && kWritesSampleMask<S>) {
      batch.out->sample_mask[i] = fragment.sample_mask.low;
      batch.out->sample_mask[i + 1] = fragment.sample_mask.high;
    }
  }
}

/// Returns the keep mask and the depth of the fragments, from the visibility function or else from the fragment function.
template <class S, class R>
HS_INLINE Visibility<R> call_visibility(const S& s, const typename S::template Varyings<R>& in, const Pixel<R>& px) {
  if constexpr (HasVisibilityFunction<S>) {
    return s.visibility(in, px);
  } else {
    const auto fragment = call_fragment<S, R>(s, in, PrimitiveOf<S, R>{}, px);
    Visibility<R> v{MaskOf<R>(true), R(0.0f)};
    if constexpr (kDiscards<S>) v.keep = fragment.keep;
    if constexpr (kWritesDepth<S>) v.depth = fragment.depth;
    return v;
  }
}

/// True if the shader's depth replaces that of the triangle. A shader without a fragment function, for depth only, cannot.
template <class S>
inline constexpr bool kDecidesDepth = [] {
  if constexpr (HasFragmentFunction<S>) return kWritesDepth<S>;
  return false;
}();

/// Calls the visibility function for packets a and b of a batch, which show the given triangles.
template <class S, class Triangles>
HS_INLINE void decide_pair(const S& s, const VisibilityBatch& batch, int a, int b, const Triangles& triangles) {
  using R = FragmentReal;
  const std::array<PacketTriangleIds, 2> ids{triangle_ids_of(batch, a), triangle_ids_of(batch, b)};
  Pixel<R> px;
  const auto in = begin_packets<S>(batch, pixels_of(batch, a, b), triangles, ids, px);
  const Visibility<R> v = call_visibility<S, R>(s, in, px);
  if constexpr (kDecidesDepth<S>) {
    batch.depth[a] = v.depth.low;
    batch.depth[b] = v.depth.high;
  }
  batch.keep[a] = static_cast<uint16_t>(bits(v.keep.low));
  batch.keep[b] = static_cast<uint16_t>(bits(v.keep.high));
}

/// The visibility kernel for packed pixels. It is separate, because the other one is faster without this code.
template <class S>
__attribute__((noinline)) HS_FLATTEN void packed_visibility_kernel(const S& s, const VisibilityBatch& batch) {
  PacketTriangles<kComponents<typename S::template Varyings<FragmentReal>>, 0> triangles;
  RecentTriangles<typename S::template Varyings<float>> recent(cell_of(batch));
  for (int first = 0; first < batch.count; first += 2) {
    const int second = std::min(first + 1, batch.count - 1);  // if the count is odd, the last packet is evaluated twice
    find_triangles<0>(batch, first, recent, triangles);
    find_triangles<1>(batch, second, recent, triangles);
    decide_pair(s, batch, first, second, triangles);
  }
}

template <class S>
HS_FLATTEN void visibility_kernel(const void* shader, const VisibilityBatch& batch) {
  const S& s = *static_cast<const S*>(shader);
  if (batch.ids != nullptr) return packed_visibility_kernel(s, batch);
  PacketTriangles<kComponents<typename S::template Varyings<FragmentReal>>, 0> triangles;
  RecentTriangles<typename S::template Varyings<float>> recent(cell_of(batch));
  // Initializes all values, which GCC 12 cannot derive from `only`.
  triangles.only = {batch.packet_ids[0], batch.packet_ids[0]};
  const auto& scalars = recent.first(*batch.context, batch.packet_ids[0]);
  spread_triangle<0>(scalars, triangles);
  spread_triangle<1>(scalars, triangles);
  for (int first = 0; first < batch.count; first += 2) {
    const int second = std::min(first + 1, batch.count - 1);
    show_triangle<0>(*batch.context, batch.packet_ids[first], recent, triangles);
    show_triangle<1>(*batch.context, batch.packet_ids[second], recent, triangles);
    decide_pair(s, batch, first, second, triangles);
  }
}

}  // namespace halfspace::HS_LANES::detail
