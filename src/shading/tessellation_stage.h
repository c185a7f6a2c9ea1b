// SPDX-License-Identifier: Apache-2.0
//
// The tessellation stages of a shader (OpenGL 4.6, section 11.2), which are optional. A draw with them draws patches (Topology::patches): N
// vertices without a shape of their own. The control function returns how finely a patch is divided, and the evaluation function moves
// each vertex of the divided patch to its place. A shader with tessellation has
//
//   static constexpr TessellationLayout tessellation_layout{.patch_vertices = 16, .domain = TessellationDomain::quads};
//   template <class R> TessellationLevels<R> control(const PatchInput<R, Varyings<R>, 16>& in) const;
//   template <class R> vec4<R> evaluate(const PatchInput<R, Varyings<R>, 16>& in, const vec3<R>& at, Varyings<R>& out) const;  → clip space
//
// In `control` a lane of R is a patch, and in `evaluate` a vertex, at the coordinates (u, v, w) in its domain. Each vertex of a patch is
// evaluated once.
//
// The following are optional:
//
//   template <class R> struct VertexVaryings { … };
//     What the vertex function passes to these functions, if it differs from Varyings. PatchInput then has VertexVaryings<R>.
//   template <class R> struct Patch { … };
//     Values of a patch, up to 256 components: numbers for the whole patch, or a std::array of control points. The functions are then `control(in, Patch<R>& patch)` and `evaluate(in, patch, at, out)`.
//   PerVertex<R, N> or LayeredVertex<R, N> as the return type of evaluate: adds a point size and clip distances, and a layer and a
//     viewport. They have no effect if there is a geometry function.
//   A geometry function (shading/geometry_stage.h), which receives the divided patches as triangles, lines or points:
//     template <class R> struct EvaluatedVaryings { … };   what `evaluate` passes to it, if it differs from Varyings
//
// Without a crack between two patches: give the shared edge the same level in both, and compute the place of a vertex on it from the
// vertices of the edge alone, in an order that does not depend on the patch. The coordinates on an edge depend only on its level.
#pragma once

#include <array>
#include <cstddef>

#include "halfspace/core/vec.h"
#include "halfspace/shading/tessellation_types.h"

namespace halfspace::HS_LANES {

/// How patches are divided (the layout qualifiers of GLSL).
struct TessellationLayout {
  int patch_vertices = 3;  ///< 1 to 32
  TessellationDomain domain = TessellationDomain::triangles;
  TessellationSpacing spacing = TessellationSpacing::equal;
  bool clockwise = false;   ///< winding of the triangles in the (u, v) plane, with u to the right and v up
  bool point_mode = false;  ///< a point per vertex instead of triangles or lines
};
inline constexpr int kMaxPatchVertices = 32;
inline constexpr std::size_t kMaxPatchComponents = 256;

/// A patch with N vertices.
template <class R, class V, std::size_t N>
struct PatchInput {
  std::array<vec4<R>, N> position;  ///< as the vertex function returns it; often not yet in clip space
  std::array<V, N> varyings;
  IntOf<R> patch;     ///< 0, 1, … in submission order; starts again in each instance (gl_PrimitiveID)
  IntOf<R> instance;  ///< 0 … DrawState::instances − 1
};

}  // namespace halfspace::HS_LANES
