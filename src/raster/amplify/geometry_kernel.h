// SPDX-License-Identifier: Apache-2.0
//
// Runs the geometry function of a shader for W primitives at a time. Output: strips of vertices, in the order of the primitives and, for
// each, of the invocations.
#pragma once

#include "halfspace/raster/amplify/load_primitives.h"
#include "halfspace/shading/vertex_traits.h"

namespace halfspace::HS_LANES::detail {

/// Appends the vertices that were emitted in lane i.
template <class E>
void append_strips(const E& emitted, int i, EmittedStrips& out) {
  uint32_t size = 0;
  for (int v = 0; v < emitted.count(i); ++v) {
    out.rows.insert(out.rows.end(), emitted.row(i, v), emitted.row(i, v) + E::kRow);
    ++size;
    if (!emitted.ends_strip(i, v)) continue;
    out.sizes.push_back(size);
    size = 0;
  }
}

template <class S>
HS_FLATTEN void geometry_kernel(const void* shader, const PrimitiveRows& primitives, EmittedStrips& strips) {
  constexpr GeometryLayout layout = S::geometry_layout;
  const S& s = *static_cast<const S*>(shader);
  std::vector<EmitterOf<S, Real>> emitters(static_cast<std::size_t>(layout.invocations), EmitterOf<S, Real>(layout.max_vertices));
  for (int begin = 0; begin < primitives.count; begin += kLanes) {
    const auto number = [&](int i) { return std::min(begin + i, primitives.count - 1); };  // the last lanes repeat a primitive
    GeometryInputOf<S, Real> in;
    load_vertices<static_cast<std::size_t>(vertices_of(layout.input))>(primitives, number, in);
    in.primitive = load_numbers(primitives.primitives, number);
    in.instance = load_numbers(primitives.instances, number);
    in.invocation = 0;
    for (EmitterOf<S, Real>& out : emitters) {
      out.clear();
      s.geometry(in, out);
      ++in.invocation;
    }
    for (int i = 0; i < std::min(kLanes, primitives.count - begin); ++i) {
      for (const EmitterOf<S, Real>& out : emitters) append_strips(out, i, strips);
    }
  }
}

template <class S>
inline constexpr GeometryStage kGeometryStage{
    .geometry = geometry_kernel<S>, .layout = S::geometry_layout, .row = static_cast<int>(EmitterOf<S, Real>::kRow)};

}  // namespace halfspace::HS_LANES::detail
