// SPDX-License-Identifier: Apache-2.0
//
// Runs a shader's vertex function on W vertices at a time.
#pragma once

#include <algorithm>

#include "halfspace/core/transpose.h"
#include "halfspace/raster/pipeline/pipeline_data.h"
#include "halfspace/shading/shader_traits.h"

namespace halfspace::HS_LANES {

namespace detail {

/// Loads the attributes of W vertices from streams of floats. ids: rows in the streams.
template <class A>
HS_INLINE A load_attributes(std::span<const VertexStream> streams, Int ids) {
  static_assert(kComponents<A> <= kMaxComponents, "the attributes of a shader must not have more than 64 components");
  std::array<Real, kComponents<A>> components;
  alignas(64) std::array<int32_t, kLanes> rows;
  std::size_t c = 0;
  for (const VertexStream& stream : streams) {
    const auto* const data = reinterpret_cast<const float*>(stream.data);
    const Int row = ids * static_cast<int32_t>(static_cast<uint32_t>(stream.stride) / sizeof(float));
    store(rows.data(), row);
    int32_t k = 0;
    if constexpr (kComponents<A> >= 4) {
      for (; k + 4 <= stream.components && c + 4 <= components.size(); k += 4) {
        const std::array<Int, 4> words = load_aos4<Int>([&](int i) { return data + k + rows[static_cast<std::size_t>(i)]; });
        for (const Int& word : words) components[c++] = as_real(word);
      }
    }
    for (; k < stream.components && c < components.size(); ++k) components[c++] = gather(data + k, row);
  }
  return from_components<A, Real>(components);
}

/// Writes the varyings of `count` vertices to their rows.
template <std::size_t N>
HS_INLINE void store_varyings(const std::array<Real, N>& components, float* const (&row)[kLanes], int count) {
  if constexpr (N >= 4) {
    alignas(64) std::array<float, 4> spare;
    // The last group of four components may overlap the previous one.
    for (std::size_t c = 0; c < N; c += 4) {
      const std::size_t first = std::min(c, N - 4);
      store_aos4<Int>(
          {as_int(components[first]), as_int(components[first + 1]), as_int(components[first + 2]), as_int(components[first + 3])},
          [&](int k) { return k < count ? row[k] + first : spare.data(); });
    }
  } else {
    for (int k = 0; k < count; ++k) {
      for (std::size_t c = 0; c < N; ++c) row[k][c] = lane(components[c], k);
    }
  }
}

template <std::size_t N, std::size_t M>
HS_INLINE void store_extra(const PerVertex<Real, N, M>& v, float* rows) {
  store(rows, v.point_size);
  for (std::size_t i = 0; i < N; ++i) store(rows + (1 + i) * kVertexBatch, v.clip_distance[i]);
  for (std::size_t i = 0; i < M; ++i) store(rows + (1 + N + i) * kVertexBatch, v.cull_distance[i]);
}
HS_INLINE void store_extra(const PointSpriteVertex<Real>& v, float* rows) {
  store(rows, v.low.x);
  store(rows + kVertexBatch, v.low.y);
  store(rows + 2 * kVertexBatch, v.high.x);
  store(rows + 3 * kVertexBatch, v.high.y);
}

template <std::size_t N, std::size_t M>
HS_INLINE void store_extra(const LayeredVertex<Real, N, M>& v, float* rows) {
  store_extra(PerVertex<Real, N, M>{v.position, v.point_size, v.clip_distance, v.cull_distance}, rows);
}
template <std::size_t N, std::size_t M>
HS_INLINE void store_layer(const LayeredVertex<Real, N, M>& v, float* rows) {
  store(rows, as_real(v.layer));
  store(rows + kVertexBatch, as_real(v.viewport));
}

/// Outputs of a vertex kernel. The others are the point size, distances or point sprite that the vertex function returns.
enum class VertexOutput : uint8_t {
  varyings,          ///< position and varyings
  all_but_varyings,  ///< position and others
  all,
  layer,     ///< the layer and the viewport in two rows of VertexBatch::extra, without the position
  whole_row  ///< the position, and a row of the other values of an EmittedStrips instead of the varyings
};

/// Returns the values of a vertex that VertexBatch::varyings receives.
template <VertexOutput output, class Vertex, class V>
HS_INLINE auto vertex_values(const Vertex& vertex, const V& varyings) {
  const std::array<Real, kComponents<V>> components = to_components<Real>(varyings);
  if constexpr (output != VertexOutput::whole_row) {
    return components;
  } else {
    constexpr std::size_t extra = kExtraValues<Vertex>;
    std::array<Real, 4 + extra> row;
    put_vertex(vertex, row);
    std::array<Real, extra + kComponents<V>> values;
    std::copy(components.begin(), components.end(), std::copy(row.begin() + 4, row.end(), values.begin()));
    return values;
  }
}

template <class S, VertexOutput output>
HS_FLATTEN void vertex_kernel(const void* shader, const VertexBatch& batch) {
  constexpr bool with_extra = output == VertexOutput::all || output == VertexOutput::all_but_varyings;
  constexpr bool with_varyings = output != VertexOutput::all_but_varyings && output != VertexOutput::layer;
  using Attributes = typename S::template Attributes<Real>;
  using Varyings = VertexVaryingsOf<S, Real>;
  const S& s = *static_cast<const S*>(shader);
  for (int begin = 0; begin < batch.count; begin += kLanes) {
    const int count = std::min(kLanes, batch.count - begin);
    const Int lane_index = min(iota<Int>(), Int(count - 1)) + begin;
    const Int ids =
        batch.ids ? gather(reinterpret_cast<const int32_t*>(batch.ids), lane_index) : lane_index + static_cast<int32_t>(batch.first);
    Varyings out;
    const VertexId<Real> id{ids + batch.base_vertex, batch.instance};
    const Int rows = batch.is_converted ? lane_index : id.vertex;
    const auto vertex = call_vertex<S, Real>(s, load_attributes<Attributes>(batch.streams, rows), id, out);
    if constexpr (output != VertexOutput::layer) {
      const vec4<Real> clip = position_of(vertex);
      for (int k = 0; k < 4; ++k) store(batch.clip + k * kVertexBatch + begin, clip[k]);
    }
    if constexpr (with_extra && !std::is_same_v<std::remove_const_t<decltype(vertex)>, vec4<Real>>) {
      if (batch.extra != nullptr) store_extra(vertex, batch.extra + begin);
    }
    if constexpr (output == VertexOutput::layer) store_layer(vertex, batch.extra + begin);
    if constexpr (with_varyings) {
      const auto values = vertex_values<output>(vertex, out);
      constexpr std::size_t n = std::tuple_size_v<std::remove_const_t<decltype(values)>>;
      if constexpr (n != 0) {
        if (batch.varyings == nullptr) continue;
        float* row[kLanes];
        for (int k = 0; k < kLanes; ++k)
          row[k] = batch.varyings + static_cast<std::size_t>(static_cast<uint32_t>(lane(ids, k)) - batch.slot_base) * n;
        store_varyings(values, row, count);
      }
    }
  }
}

}  // namespace detail

}  // namespace halfspace::HS_LANES
