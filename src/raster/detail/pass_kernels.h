// SPDX-License-Identifier: Apache-2.0
//
// Connects the templates of Pass to the pipeline: creates the kernels of a shader type and adds draws to a pass. Private, but installed
// because pass.h includes it.
#pragma once

#include <array>
#include <concepts>
#include <memory>
#include <span>
#include <tuple>

#include "halfspace/raster/amplify/geometry_kernel.h"
#include "halfspace/raster/amplify/tessellation_kernel.h"
#include "halfspace/raster/detail/draw_input.h"
#include "halfspace/raster/detail/stream_match.h"
#include "halfspace/raster/primitives/primitive_stage.h"
#include "halfspace/raster/primitives/vertex_kernel.h"
#include "halfspace/raster/shade/fragment_kernel.h"
#include "halfspace/raster/tile/post_step.h"

namespace halfspace::HS_LANES {

namespace detail {

/// Parts of a shader that a draw uses.
enum class DrawKind : uint8_t {
  color,
  depth_only  ///< ignores the fragment function but not the visibility function
};

/// Whether the fragment function discards fragments or replaces their depth.
template <class S>
inline constexpr bool kDecidesVisibility = kDiscards<S> || kWritesDepth<S>;

/// Whether stages of the shader emit primitives, or its vertex function chooses a layer, so that the primitives of a layer become draws.
template <class S>
inline constexpr bool kEmitsPrimitives = HasTessellationLayout<S> || HasGeometryLayout<S> || kGivesLayer<S>;
/// These stages.
template <class S>
inline constexpr EmittingStages kEmittingStages = [] {
  constexpr bool only_layers = !HasTessellationLayout<S> && !HasGeometryLayout<S>;
  constexpr VertexOutput output = only_layers ? VertexOutput::whole_row : VertexOutput::varyings;
  constexpr std::size_t extra = only_layers ? kExtraValues<VertexOf<S>> : 0;
  EmittingStages stages{vertex_kernel<S, output>, static_cast<int>(extra + kComponents<VertexVaryingsOf<S, float>>), nullptr, nullptr,
                        nullptr};
  if constexpr (only_layers && kGivesLayer<S>) stages.layer = vertex_kernel<S, VertexOutput::layer>;
  if constexpr (HasTessellationLayout<S>) stages.tessellation = &kTessellationStage<S>;
  if constexpr (HasGeometryLayout<S>) stages.geometry = &kGeometryStage<S>;
  return stages;
}();

/// Returns the kernels of the stages after the emitting ones, and of the vertex function if there are none. Kernels for functions that do
/// not exist, or that the draw ignores, are null.
template <class S, DrawKind kind>
constexpr ShaderKernels drawing_kernels() {
  using V = typename S::template Varyings<float>;
  // Do not compute varyings that no function reads.
  constexpr bool has_varyings = kind == DrawKind::color || HasVisibilityFunction<S>;
  ShaderKernels k;
  if constexpr (!HasTessellationLayout<S> && !HasGeometryLayout<S>) {
    constexpr VertexOutput output = has_varyings ? VertexOutput::all : VertexOutput::all_but_varyings;
    k.vertex = vertex_kernel<S, output>;
  }
  k.gives_point_size = kGivesPointSize<S>;
  k.gives_layer = kGivesLayer<S>;
  k.gives_point_sprite = kGivesPointSprite<S>;
  k.clip_distance_count = static_cast<int>(kClipDistances<S>);
  k.cull_distance_count = static_cast<int>(kCullDistances<S>);
  if constexpr (has_varyings) {
    k.uses_centroid = kUsesCentroid<V>;
    k.varying_count = static_cast<int>(kComponents<V>);
    k.interpolations = kInterpolations<V>.data();
  }
  if constexpr (kind == DrawKind::color) {
    if constexpr (HasPrimitive<S>) {
      k.primitive = primitive_kernel<S>;
      k.primitive_count = static_cast<int>(kComponents<typename S::template Primitive<float>>);
    }
    if constexpr (kUsesPrimitiveId<S>) {
      k.uses_id = true;
      k.primitive_count = static_cast<int>(kIdRow);
    }
    static_assert(kColors<S> <= kMaxColorTargets, "a fragment function returns at most 12 colors");
    k.fragment = fragment_kernel<S, true>;
    k.color = fragment_kernel<S, !kDecidesVisibility<S>>;
    k.color_count = static_cast<int>(kColors<S>);
    k.color_types = kColorTypes<S>.data();
    k.discards = kDiscards<S>;
    k.tests_early = kTestsEarly<S>;
    k.writes_sample_mask = kWritesSampleMask<S>;
    k.is_constant = kIsConstant<S>;
    // Without a visibility function, the fragment function is compiled a second time, to compute only the keep mask and the depth. This is
    // faster if the shader replaces the depth, because no fragment can be rejected before it is shaded. A shader that only discards usually
    // decides by a texture lookup, which is most of its work, so it is faster to shade it once.
    if constexpr (kWritesDepth<S> && !HasPrimitive<S> && !kUsesPrimitiveId<S>) k.visibility = visibility_kernel<S>;
  }
  if constexpr (HasFragmentFunction<S>) {
    k.writes_depth = kWritesDepth<S>;
    k.runs_per_sample = kRunsPerSample<S>;
    k.conservative_depth = kConservativeDepth<S>;
  }
  if constexpr (HasVisibilityFunction<S> && !kTestsEarly<S>) k.visibility = visibility_kernel<S>;
  return k;
}
template <class S, DrawKind kind>
inline constexpr ShaderKernels kDrawingKernels = drawing_kernels<S, kind>();
/// All kernels of a shader.
template <class S, DrawKind kind>
inline constexpr ShaderKernels kKernels = [] {
  ShaderKernels k = kDrawingKernels<S, kind>;
  if constexpr (kEmitsPrimitives<S>) {
    k.emitting = &kEmittingStages<S>;
    if constexpr (kEmittingStages<S>.layer != nullptr) k.one_layer = &kDrawingKernels<S, kind>;
    k.vertex = copy_emitted_vertices;
    if constexpr (HasTessellationLayout<S>) k.patch_vertices = S::tessellation_layout.patch_vertices;
  }
  return k;
}();

/// Copies the shader to memory that outlives the call.
template <class S>
KeptShader keep_shader(const S& shader, std::pmr::memory_resource& memory) {
  return {::new (memory.allocate(sizeof(S), alignof(S))) S(shader), [](const void* kept) { static_cast<const S*>(kept)->~S(); }};
}

/// Returns true if the view's streams match the shader's Attributes. Otherwise, compilation fails with a message that names both types.
template <class S, class V>
consteval bool require_streams() {
  static_assert(std::derived_from<V, VertexView>, "the vertices must be a VertexView; see make_vertex_view()");
  using A = typename S::template Attributes<float>;
  static_assert(kStreamsMatch<A, V>, "the streams do not match the members of the shader's Attributes in order");
  return kStreamsMatch<A, V>;
}

/// Returns true if the pass can draw the view with the shader. Otherwise, compilation fails with a message that states the reason.
template <class S, class V>
consteval bool require_draw() {
  if constexpr (require_shader<S>()) return require_streams<S, V>();
  return false;
}
template <class S, class V>
consteval bool require_depth_draw() {
  if constexpr (require_depth_shader<S>()) return require_streams<S, V>();
  return false;
}

/// State of a Pass: its attachments, draws and work. Pass only stores a pointer to it.
class PassState;
/// Gives the private code of this module access to the state of a Pass.
struct PassAccess;
std::pmr::memory_resource& memory_of(PassState& state);
void add_draw(PassState& state, const ShaderKernels& kernels, KeptShader shader, const VertexView& vertices,
              std::shared_ptr<const Indices> indices, const DrawState& draw_state);
void set_post_step(PassState& state, PostStep post);

template <DrawKind kind, class S, class V>
void draw(PassState& state, const S& shader, const V& vertices, std::shared_ptr<const Indices> indices, const DrawState& draw_state) {
  if constexpr (std::same_as<V, VertexView>) check_streams<typename S::template Attributes<float>>(vertices);
  add_draw(state, kKernels<S, kind>, keep_shader(shader, memory_of(state)), vertices, std::move(indices), draw_state);
}

}  // namespace detail

}  // namespace halfspace::HS_LANES
