// SPDX-License-Identifier: Apache-2.0
//
// Primitive stage, for shaders with a primitive function or with a PrimitiveId. Input: the triangles of a chunk. Output: Chunk::primitives,
// with one row per triangle. The primitive function is called with the varyings of the three submitted vertices, so all pieces of a clipped
// triangle have the same result. Rows of ids are described by IdRow.
#pragma once

#include <algorithm>

#include "halfspace/raster/pipeline/pass_context.h"
#include "halfspace/shading/contract.h"

namespace halfspace::HS_LANES {

/// Triangles for a primitive kernel: varyings of the three vertices, in submission order.
struct PrimitiveBatch {
  const std::array<const float*, 3>* rows;
  int count;
  float* out;  ///< output: count rows of primitive_count floats
};

/// Fills chunk.primitives for the draw ranges whose shader has a primitive function or uses a PrimitiveId.
void run_primitive_stage(const PassContext& context, Chunk& chunk);

/// The primitive that a triangle of a chunk was created from.
struct SubmittedPrimitive {
  uint32_t primitive;              ///< index in its draw
  std::array<uint32_t, 3> vertex;  ///< slots of its vertices, in the order of OpenGL 4.6, table 13.2
};
/// Returns the primitive of each triangle of the chunk. The tile runner of the pass must inspect primitives (TileRunner).
std::vector<SubmittedPrimitive> submitted_primitives(const PassContext& context, const Chunk& chunk);

namespace detail {

template <class V>
HS_INLINE V load_rows(const PrimitiveBatch& batch, int begin, std::size_t vertex) {
  constexpr std::size_t n = kComponents<V>;
  constexpr auto lanes = static_cast<std::size_t>(kLanes);
  std::array<Real, n> components{};
  if constexpr (n != 0) {
    std::array<float, n * lanes> by_lane;
    for (std::size_t i = 0; i < lanes; ++i) {
      const float* row = batch.rows[std::min(begin + static_cast<int>(i), batch.count - 1)][vertex];
      for (std::size_t c = 0; c < n; ++c) by_lane[c * lanes + i] = row[c];
    }
    components = load<std::array<Real, n>>(by_lane.data());
  }
  return from_components<V, Real>(components);
}

template <class S>
HS_FLATTEN void primitive_kernel(const void* shader, const PrimitiveBatch& batch) {
  using V = typename S::template Varyings<Real>;
  using P = typename S::template Primitive<Real>;
  constexpr std::size_t n = kComponents<P>;
  const S& s = *static_cast<const S*>(shader);
  for (int begin = 0; begin < batch.count; begin += kLanes) {
    const P value = s.primitive(load_rows<V>(batch, begin, 0), load_rows<V>(batch, begin, 1), load_rows<V>(batch, begin, 2));
    const std::array<Real, n> components = to_components<Real>(value);
    for (int i = 0; i < std::min(kLanes, batch.count - begin); ++i) {
      float* row = batch.out + static_cast<std::size_t>(begin + i) * n;
      for (std::size_t c = 0; c < n; ++c) row[c] = lane(components[c], i);
    }
  }
}

}  // namespace detail

}  // namespace halfspace::HS_LANES
