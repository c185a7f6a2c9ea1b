// SPDX-License-Identifier: Apache-2.0
//
// Draws all draws of a prepared scene with the naive pipeline. Including this header instantiates every shader; only naive_render.cpp and
// one test file do so.
#pragma once

#include "halfspace/raster/naive.h"
#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// Whether the naive pipeline can draw with a shader. It cannot draw points, nor the lines that the geometry functions of scenes emit.
template <class S>
inline constexpr bool kDrawsTriangles = !kGivesPointSprite<S> && !kGivesPointSize<S> && !HasGeometryLayout<S>;

/// For each draw, calls shader_of(shader) and draws with the shader that it returns. An HS_CHECK fails for other draws.
template <class R, class F>
void draw_all_naive(NaiveTarget<R>& target, const PreparedScene& scene, const F& shader_of) {
  for (const PreparedDraw& draw : scene.draws) {
    std::visit(
        [&]<class S>(const S& shader) {
          if constexpr (kDrawsTriangles<S>) {
            draw_naive(target, shader_of(shader), draw.vertices, *draw.indices, draw.state);
          } else {
            HS_CHECK(false, "naive pipeline: the scene draws points or normals; expected triangles or lines");
          }
        },
        draw.shader);
  }
}

}  // namespace halfspace::HS_LANES
