// SPDX-License-Identifier: Apache-2.0
//
// Runs the geometry function of a shader for W primitives at a time. Output: strips of vertices, in the order of the primitives and, for
// each, of the invocations.
#pragma once

#include <memory>

#include "halfspace/raster/amplify/load_primitives.h"
#include "halfspace/shading/vertex_traits.h"

namespace halfspace::HS_LANES::detail {

/// Appends the vertices that were emitted in lane i for a primitive.
template <class E>
void append_strips(const E& emitted, int i, int primitive, EmittedStrips& out) {
  out.rows.insert(out.rows.end(), emitted.row(i, 0), emitted.row(i, emitted.count(i)));
  uint32_t size = 0;
  for (int v = 0; v < emitted.count(i); ++v) {
    ++size;
    if (!emitted.ends_strip(i, v)) continue;
    out.sizes.push_back(size);
    out.sources.push_back(primitive);
    size = 0;
  }
}

template <class S>
HS_FLATTEN void geometry_kernel(const void* shader, const PrimitiveRows& primitives, EmittedStrips& strips) {
  constexpr GeometryLayout layout = S::geometry_layout;
  const S& s = *static_cast<const S*>(shader);
  std::vector<EmitterOf<S, Real>> emitters;
  for (int i = 0; i < layout.invocations; ++i) emitters.emplace_back(layout.max_vertices);
  const auto input = std::make_unique<GeometryInputOf<S, Real>>();  // it can be too large for the stack of a thread
  GeometryInputOf<S, Real>& in = *input;
  for (int begin = 0; begin < primitives.count; begin += kLanes) {
    const auto number = [&](int i) { return std::min(begin + i, primitives.count - 1); };  // the last lanes repeat a primitive
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
      for (const EmitterOf<S, Real>& out : emitters) append_strips(out, i, begin + i, strips);
    }
  }
}

template <class S>
inline constexpr GeometryStage kGeometryStage{
    .geometry = geometry_kernel<S>, .layout = S::geometry_layout, .row = static_cast<int>(EmitterOf<S, Real>::kRow)};

}  // namespace halfspace::HS_LANES::detail
