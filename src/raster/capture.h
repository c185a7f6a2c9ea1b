// SPDX-License-Identifier: Apache-2.0
//
// Transform feedback (OpenGL 4.6, section 13.3) as a function: runs the vertex, tessellation and geometry functions of a draw, and
// returns the vertices of its primitives. What many passes draw can so be computed once, and drawn with a vertex function that only hands
// it on. Primitives do not share vertices, so those of a mesh are repeated:
//
//   const auto skinned = capture(SkinShader{...}, view, indices, workers);
//   pass.draw(PlainShader{...}, make_vertex_view(stream(skinned.positions), stream(skinned.varyings,
//   &SkinShader::Varyings<float>::normal)));
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "halfspace/core/parallel.h"
#include "halfspace/raster/amplify/emitted_primitives.h"
#include "halfspace/raster/detail/pass_kernels.h"
#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/vertex_input.h"

namespace halfspace::HS_LANES {

/// The vertices of primitives before clipping, and the varyings V that the fragment function would receive at them. Each primitive has its
/// own vertices: strips, loops and fans become lists, with the order of vertices of OpenGL 4.6, section 13.3.2.
template <class V>
struct CapturedVertices {
  Topology topology = Topology::points;  ///< points, lines or triangles
  std::vector<glm::vec4> positions;      ///< clip space
  std::vector<V> varyings;               ///< one per position
  std::size_t primitives = 0;            ///< GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN
};

namespace detail {
/// The kernels of the stages before primitive assembly.
template <class S>
inline constexpr ShaderKernels kCaptureKernels = [] {
  ShaderKernels k;
  if constexpr (HasTessellationLayout<S> || HasGeometryLayout<S>) {
    k.emitting = &kEmittingStages<S>;
    if constexpr (HasTessellationLayout<S>) k.patch_vertices = S::tessellation_layout.patch_vertices;
  } else {
    k.vertex = vertex_kernel<S, VertexOutput::varyings>;
  }
  k.varying_count = static_cast<int>(kComponents<typename S::template Varyings<float>>);
  return k;
}();

/// Returns true if the vertices of S can be captured. Otherwise, compilation fails with a message that states the reason.
template <class S, class V>
consteval bool require_capture() {
  if constexpr (require_vertex_shader<S>()) return require_streams<S, V>();
  return false;
}

/// Returns the primitives of a draw. The shader must outlive the call.
EmittedPrimitives capture_primitives(const ShaderKernels& kernels, KeptShader shader, const VertexView& vertices,
                                     std::shared_ptr<const Indices> indices, const DrawState& state, const Workers& workers);

template <class S, class V>
CapturedVertices<typename S::template Varyings<float>> capture(const S& shader, const V& vertices, std::shared_ptr<const Indices> indices,
                                                               const Workers& workers, const DrawState& state) {
  using Varyings = typename S::template Varyings<float>;
  if constexpr (std::same_as<V, VertexView>) check_streams<typename S::template Attributes<float>>(vertices);
  const EmittedPrimitives from =
      capture_primitives(kCaptureKernels<S>, {&shader, [](const void*) {}}, vertices, std::move(indices), state, workers);
  CapturedVertices<Varyings> out{.topology = from.topology, .positions = {}, .varyings = {}, .primitives = from.primitive_count()};
  out.positions.reserve(from.indices.size());
  out.varyings.reserve(from.indices.size());
  for (const uint32_t i : from.indices) {
    const float* const row = from.rows.data() + from.row * i;
    out.positions.push_back({row[0], row[1], row[2], row[3]});
    std::array<float, kComponents<Varyings>> components;
    std::copy_n(row + from.row - components.size(), components.size(), components.begin());
    out.varyings.push_back(from_components<Varyings, float>(components));
  }
  return out;
}
}  // namespace detail

/// Returns the vertices of an indexed draw. The arguments are those of Pass::draw(), and so are the errors; of the state, only the
/// topology, the vertices, the instances and the provoking vertex are used. The result does not depend on the number of threads.
template <class S, class V, detail::IndexList I>
auto capture(const S& shader, const V& vertices, I&& indices, const Workers& workers, const DrawState& state = {}) {
  if constexpr (detail::require_capture<S, V>())
    return detail::capture(shader, vertices, detail::view_indices(indices, vertices.vertex_count, state), workers, state);
}
/// The same for a draw without indices.
template <class S, class V>
auto capture(const S& shader, const V& vertices, const Workers& workers, const DrawState& state = {}) {
  if constexpr (detail::require_capture<S, V>())
    return detail::capture(shader, vertices, detail::sequential_indices(vertices.vertex_count, state), workers, state);
}

}  // namespace halfspace::HS_LANES
