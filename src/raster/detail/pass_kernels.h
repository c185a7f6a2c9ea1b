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

/// Returns the kernels of a shader. Kernels for functions that do not exist, or that the draw ignores, are null.
template <class S, DrawKind kind>
constexpr ShaderKernels kernels_of() {
  using V = typename S::template Varyings<float>;
  // Do not compute varyings that no function reads.
  constexpr bool has_varyings = kind == DrawKind::color || HasVisibilityFunction<S>;
  ShaderKernels k;
  k.vertex = vertex_kernel<S, has_varyings, true>;
  k.position = vertex_kernel<S, false, false>;
  k.gives_point_size = kGivesPointSize<S>;
  k.gives_point_sprite = kGivesPointSprite<S>;
  static_assert(kClipDistances<S> <= kMaxClipDistances);
  k.clip_distance_count = static_cast<int>(kClipDistances<S>);
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
    k.is_constant = kIsConstant<S>;
    // Without a visibility function, the fragment function is compiled a second time, to compute only the keep mask and the depth. This is
    // faster if the shader replaces the depth, because no fragment can be rejected before it is shaded. A shader that only discards usually
    // decides by a texture lookup, which is most of its work, so it is faster to shade it once.
    if constexpr (kWritesDepth<S> && !HasPrimitive<S> && !kUsesPrimitiveId<S>) k.visibility = visibility_kernel<S>;
  }
  if constexpr (HasFragmentFunction<S>) k.writes_depth = kWritesDepth<S>;
  if constexpr (HasVisibilityFunction<S>) k.visibility = visibility_kernel<S>;
  return k;
}
template <class S, DrawKind kind>
inline constexpr ShaderKernels kKernels = kernels_of<S, kind>();

/// Copies the shader to memory that outlives the call.
template <class S>
KeptShader keep_shader(const S& shader, std::pmr::memory_resource& memory) {
  return {::new (memory.allocate(sizeof(S), alignof(S))) S(shader), [](const void* kept) { static_cast<const S*>(kept)->~S(); }};
}

/// Number of floats of each member of an attribute struct, in order; 0 for absent members.
template <class Tuple>
struct MemberSizes;
template <class... F>
struct MemberSizes<std::tuple<F&...>> {
  static constexpr std::array<std::size_t, sizeof...(F)> value{FieldTraits<std::remove_const_t<F>>::components...};
};

/// Returns true if streams with elements T... provide the floats for each member of the attributes A. An element is one attribute, or
/// several consecutive ones if it is a struct.
template <class A, class... T>
constexpr bool streams_match() {
  constexpr auto members = MemberSizes<FieldsOf<A>>::value;
  std::size_t next = 0;
  const auto skip_absent = [&] {
    while (next < members.size() && members[next] == 0) ++next;
  };
  const auto take = [&](std::size_t floats, bool is_one_attribute) {
    skip_absent();
    if (is_one_attribute) return next < members.size() && members[next++] == floats;
    while (floats != 0 && next < members.size() && members[next] <= floats) floats -= members[next++];
    return floats == 0;
  };
  const auto is_one = []<class E>(std::type_identity<E>) {
    return std::same_as<E, float> || requires { E::length(); };
  };
  const bool all_taken = (take(sizeof(T) / sizeof(float), is_one(std::type_identity<T>())) && ...);
  skip_absent();
  return all_taken && next == members.size();
}

template <class A, class V>
inline constexpr bool kStreamsMatch = true;  // for a plain VertexView, the pass checks the number of floats at run time
template <class A, class... T>
inline constexpr bool kStreamsMatch<A, VertexViewOf<T...>> = streams_match<A, T...>();

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
  if constexpr (require_vertex_shader<S>()) return require_streams<S, V>();
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

/// Index list that can be drawn: Indices, or a contiguous range of uint32_t or uint16_t.
template <class T>
concept IndexList = std::same_as<std::remove_cvref_t<T>, Indices> || std::convertible_to<T, std::span<const uint32_t>> ||
    std::convertible_to<T, std::span<const uint16_t>>;

/// Returns a non-owning pointer to an Indices object, or creates one from a raw list.
template <IndexList I>
std::shared_ptr<const Indices> view_indices(I& indices, std::size_t vertex_count) {
  if constexpr (std::same_as<std::remove_const_t<I>, Indices>) {
    return {std::shared_ptr<void>(), &indices};
  } else if constexpr (std::convertible_to<I&, std::span<const uint32_t>>) {
    return std::make_shared<const Indices>(std::span<const uint32_t>(indices), vertex_count);
  } else {
    return std::make_shared<const Indices>(std::span<const uint16_t>(indices), vertex_count);
  }
}

template <DrawKind kind, class S>
void draw(PassState& state, const S& shader, const VertexView& vertices, std::shared_ptr<const Indices> indices,
          const DrawState& draw_state) {
  HS_CHECK_OP(vertices.components, ==, static_cast<int>(kComponents<typename S::template Attributes<float>>),
              "Pass::draw: the vertex streams have another number of components than the attributes of the shader; expected one stream per "
              "attribute, in their order");
  add_draw(state, kKernels<S, kind>, keep_shader(shader, memory_of(state)), vertices, std::move(indices), draw_state);
}

}  // namespace detail

}  // namespace halfspace::HS_LANES
