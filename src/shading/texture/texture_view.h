// SPDX-License-Identifier: Apache-2.0
//
// Textures of every kind and format of OpenGL, in memory that the caller owns: images, targets of earlier passes, and TextureStorage.
//
// A lookup follows OpenGL 4.6, sections 8.13 to 8.19. It converts every format while it reads, so nothing is copied or prepared. Texture2D
// keeps its own copy of an image in a layout that makes filtering of rgba8, srgb8a8, rgba16f and rgba32f faster; both give the same values.
//
// Row 0 is t = 0 (core/texel_view.h). What a pass has drawn into a view is sampled at the same place with s = 0.5 + 0.5·x and
// t = 0.5 + 0.5·y of normalized device coordinates (x, y), as in OpenGL.
//
// All inputs are safe: a coordinate that is NaN counts as 0 or as the border, array layers are clamped, and texels that fetch() does not
// find are 0.
#pragma once

#include <span>
#include <type_traits>

#include "halfspace/core/discrete_vec.h"
#include "halfspace/core/lane_pairs.h"
#include "halfspace/core/vec.h"
#include "halfspace/shading/texture/texture_table.h"

namespace halfspace::HS_LANES {

namespace detail {

template <class P>
struct RealOfCoordinates {
  using type = P;
};
template <glm::length_t L, class R>
struct RealOfCoordinates<VecN<L, R>> {
  using type = R;
};

/// Number of coordinates of a lookup, without the array layer.
constexpr int texture_axes(TextureKind kind) {
  switch (kind) {
    case TextureKind::one_d:
    case TextureKind::one_d_array: return 1;
    case TextureKind::three_d:
    case TextureKind::cube:
    case TextureKind::cube_array: return 3;
    default: return 2;
  }
}

template <int count, class R>
struct Coordinates {
  using type = VecN<count, R>;
};
template <class R>
struct Coordinates<1, R> {
  using type = R;
};

/// Where a lookup samples: coordinates, or a direction for cubes, and the number of the array layer before it is rounded.
template <class R>
struct TexturePlace {
  vec3<R> p;
  R layer;
};
/// Derivatives of the coordinates to the right and up, per pixel.
template <class R>
struct TextureSlopes {
  vec3<R> dx, dy;
};

/// A texture in memory.
struct TextureSource {
  const std::byte* base;
  const TextureTable& table;
};

}  // namespace detail

/// Coordinates of a lookup in a texture of this kind: R for 1D textures, else a vector, whose last component is the layer of an array.
template <TextureKind kind, class R>
using TextureCoordinates = typename detail::Coordinates<detail::texture_axes(kind) + (is_array(kind) ? 1 : 0), R>::type;
/// Their derivatives, without a layer.
template <TextureKind kind, class R>
using TextureDerivatives = typename detail::Coordinates<detail::texture_axes(kind), R>::type;
/// The number type of coordinates.
template <class P>
using CoordinateReal = typename detail::RealOfCoordinates<P>::type;

/// Optional arguments of a lookup, uniform as in GLSL 3.30, where offsets are constants.
struct LookupOptions {
  float bias = 0.0f;     ///< added to the level of detail; not for lookups at a given level
  glm::ivec3 offset{0};  ///< added to the coordinates, in texels of the level that is read; ignored by cubes
};

/// A non-owning view of a texture. Copies are cheap enough for members of shaders. The texels must outlive it, and must not change while a
/// pass that samples it runs.
template <TextureKind kind>
class TextureView {
 public:
  /// Creates a view of levels, the finest first. Level k has the size of level 0 divided by 2^k, rounded down, but at least 1; only 3D
  /// textures have fewer layers in coarser levels. Layers are slices (3D), array layers, faces +x −x +y −y +z −z (cubes; six for each cube
  /// of an array) or samples. The chain may end before 1 x 1. Addresses and pitches must be multiples of the size of a texel up to 4 bytes.
  explicit TextureView(std::span<const ConstTexelView> levels)
      : table_(detail::make_texture_table(kind, levels.data(), levels.size())), base_(levels[0].data) {}
  explicit TextureView(const ConstTexelView& level) : TextureView(std::span<const ConstTexelView>(&level, 1)) {}

  TexelFormat format() const { return table_.format; }
  int levels() const { return table_.levels; }
  int width(int level = 0) const { return of(level).width; }
  int height(int level = 0) const { return of(level).height; }
  /// Slices of a 3D texture, layers of an array (six times the number of cubes), 6 for a cube, or samples.
  int depth(int level = 0) const { return of(level).depth; }

  /// Returns a view that reads other channels (TEXTURE_SWIZZLE_RGBA). `red` also applies to the results of comparisons, which are the red
  /// of (result, 0, 0, 1).
  TextureView swizzled(Swizzle red, Swizzle green, Swizzle blue, Swizzle alpha) const {
    TextureView view = *this;
    view.table_.swizzle = {red, green, blue, alpha};
    return view;
  }
  /// Returns a view of some of the levels, which must exist (TEXTURE_BASE_LEVEL and TEXTURE_MAX_LEVEL). Levels of detail count from the
  /// first of them.
  TextureView part_of_levels(int first, int count) const {
    HS_CHECK(first >= 0 && count >= 1 && first <= levels() - count, "TextureView: there are no such levels; expected levels of the view");
    TextureView view = *this;
    for (int k = 0; k < count; ++k) view.table_.level[static_cast<std::size_t>(k)] = of(first + k);
    view.table_.levels = count;
    return view;
  }

  /// GLSL's texture() and textureGrad(). dx and dy are the changes in the coordinates to the next pixel to the right and to the next pixel
  /// up, including factors that multiply a varying. Not for integer formats, which builds with asserts check. Depths are returned in red.
  template <class P, class R = CoordinateReal<P>>
  requires std::is_same_v<P, TextureCoordinates<kind, R>> vec4<R> sample(const Sampler& sampler, const P& p,
                                                                         const TextureDerivatives<kind, R>& dx,
                                                                         const TextureDerivatives<kind, R>& dy,
                                                                         const LookupOptions& options = {})
  const;
  /// GLSL's textureLod(): samples at a given level of detail, to which the bias and the limits of the sampler apply.
  template <class P, class R = CoordinateReal<P>>
  requires std::is_same_v<P, TextureCoordinates<kind, R>> vec4<R> sample_level(const Sampler& sampler, const P& p,
                                                                               std::type_identity_t<R> lod,
                                                                               const glm::ivec3& offset = glm::ivec3(0))
  const;

  /// GLSL's textureProj(): divides the coordinates by `divisor`, and derives the derivatives of the quotients. Not for arrays and cubes.
  template <class P, class R = CoordinateReal<P>>
  requires(std::is_same_v<P, TextureCoordinates<kind, R>> && !is_array(kind) &&
           !is_cube(kind)) vec4<R> sample_projected(const Sampler& sampler, const P& p, const P& dp_dx, const P& dp_dy,
                                                    std::type_identity_t<R> divisor, std::type_identity_t<R> divisor_dx,
                                                    std::type_identity_t<R> divisor_dy, const LookupOptions& options = {})
  const {
    const Quotients<P> q = quotients<R>(p, dp_dx, dp_dy, divisor, divisor_dx, divisor_dy);
    return sample(sampler, q.at, q.dx, q.dy, options);
  }

  /// Lookups of GLSL's shadow samplers: compares `reference` with the red of each texel (Sampler::compare), and filters the results, 1
  /// where the comparison passes and 0 where it does not. The reference is clamped to [0, 1] for formats that are not floats.
  template <class P, class R = CoordinateReal<P>>
  requires std::is_same_v<P, TextureCoordinates<kind, R>> R sample_compare(const Sampler& sampler, const P& p,
                                                                           std::type_identity_t<R> reference,
                                                                           const TextureDerivatives<kind, R>& dx,
                                                                           const TextureDerivatives<kind, R>& dy,
                                                                           const LookupOptions& options = {})
  const;
  template <class P, class R = CoordinateReal<P>>
  requires std::is_same_v<P, TextureCoordinates<kind, R>> R sample_compare_level(const Sampler& sampler, const P& p,
                                                                                 std::type_identity_t<R> reference,
                                                                                 std::type_identity_t<R> lod,
                                                                                 const glm::ivec3& offset = glm::ivec3(0))
  const;

  /// GLSL's textureProj() of shadow samplers: also divides the reference by `divisor`. Not for arrays and cubes.
  template <class P, class R = CoordinateReal<P>>
  requires(std::is_same_v<P, TextureCoordinates<kind, R>> && !is_array(kind) && !is_cube(kind)) R
      sample_compare_projected(const Sampler& sampler, const P& p, std::type_identity_t<R> reference, const P& dp_dx, const P& dp_dy,
                               std::type_identity_t<R> divisor, std::type_identity_t<R> divisor_dx, std::type_identity_t<R> divisor_dy,
                               const LookupOptions& options = {})
  const {
    const Quotients<P> q = quotients<R>(p, dp_dx, dp_dy, divisor, divisor_dx, divisor_dy);
    return sample_compare(sampler, q.at, reference / divisor, q.dx, q.dy, options);
  }

  /// GLSL's textureGather(): returns one component of the four texels of level 0 that a bilinear lookup blends, in the order
  /// (s0, t1), (s1, t1), (s1, t0), (s0, t0). Only for kinds with layers of two dimensions.
  template <class P, class R = CoordinateReal<P>>
  requires std::is_same_v<P, TextureCoordinates<kind, R>> vec4<R> gather(const Sampler& sampler, const P& p, int component = 0,
                                                                         const glm::ivec3& offset = glm::ivec3(0))
  const;
  /// The same with the results of comparisons.
  template <class P, class R = CoordinateReal<P>>
  requires std::is_same_v<P, TextureCoordinates<kind, R>> vec4<R> gather_compare(const Sampler& sampler, const P& p,
                                                                                 std::type_identity_t<R> reference,
                                                                                 const glm::ivec3& offset = glm::ivec3(0))
  const;

  /// The same as gather() for integer formats. Unsigned values are returned as their bits.
  template <class P, class R = CoordinateReal<P>>
  requires std::is_same_v<P, TextureCoordinates<kind, R>> ivec4<R> gather_integers(const Sampler& sampler, const P& p, int component = 0,
                                                                                   const glm::ivec3& offset = glm::ivec3(0))
  const;

  /// Reads the texel of an integer texture that contains the coordinates, in the nearest level. Unsigned values are returned as their bits.
  template <class P, class R = CoordinateReal<P>>
  requires std::is_same_v<P, TextureCoordinates<kind, R>> ivec4<R> sample_integers(const Sampler& sampler, const P& p,
                                                                                   std::type_identity_t<R> lod,
                                                                                   const glm::ivec3& offset = glm::ivec3(0))
  const;

  /// GLSL's texelFetch(): reads a texel by its column, row and layer (slice, face or sample). Outside of the level, all channels are 0.
  template <class R>
  vec4<R> fetch(const ivec3<R>& texel, std::type_identity_t<IntOf<R>> level = IntOf<R>(0)) const;
  /// The same for integer formats, and for the stencil of formats with depth, in the first channel; 0 if there is none.
  template <class R>
  ivec4<R> fetch_integers(const ivec3<R>& texel, std::type_identity_t<IntOf<R>> level = IntOf<R>(0)) const;

  /// GLSL's textureQueryLod(): the level that sample() reads, with a fraction if it is between two (x), and the level of detail after the
  /// bias, before the limits (y). As if the sampler were isotropic.
  template <class P, class R = CoordinateReal<P>>
  requires std::is_same_v<P, TextureCoordinates<kind, R>> vec2<R> query_lod(const Sampler& sampler, const P& p,
                                                                            const TextureDerivatives<kind, R>& dx,
                                                                            const TextureDerivatives<kind, R>& dy)
  const;

 private:
  /// Projected coordinates and their derivatives.
  template <class P>
  struct Quotients {
    P at, dx, dy;
  };
  template <class R, class P>
  static HS_INLINE Quotients<P> quotients(const P& p, const P& dp_dx, const P& dp_dy, R divisor, R divisor_dx, R divisor_dy) {
    const R inverse = R(1.0f) / divisor;
    const P q = p * inverse;
    return {q, P((dp_dx - q * divisor_dx) * inverse), P((dp_dy - q * divisor_dy) * inverse)};
  }

  const detail::TextureLevel& of(int level) const { return table_.level[static_cast<std::size_t>(level)]; }
  detail::TextureSource source() const { return {base_, table_}; }

  detail::TextureTable table_;
  const std::byte* base_;
};

using Texture1DView = TextureView<TextureKind::one_d>;
using Texture2DView = TextureView<TextureKind::two_d>;
using TextureRectangleView = TextureView<TextureKind::rectangle>;
using Texture3DView = TextureView<TextureKind::three_d>;
using Texture1DArrayView = TextureView<TextureKind::one_d_array>;
using Texture2DArrayView = TextureView<TextureKind::two_d_array>;
using TextureCubeView = TextureView<TextureKind::cube>;
using TextureCubeArrayView = TextureView<TextureKind::cube_array>;
using TextureMultisampleView = TextureView<TextureKind::multisample>;

// ---- lookups, compiled once for each number type in texture_view.cpp --------------------------------------------------------------------

namespace detail {

// Pure functions: a call does not keep the compiler from dropping unused values of a shader.
template <class R>
__attribute__((pure)) vec4<R> sample_texture(const TextureSource&, const Sampler&, const TexturePlace<R>&, const TextureSlopes<R>&,
                                             const LookupOptions&);
template <class R>
__attribute__((pure)) vec4<R> sample_texture_level(const TextureSource&, const Sampler&, const TexturePlace<R>&, const R& lod,
                                                   const glm::ivec3& offset);
template <class R>
__attribute__((pure)) R compare_texture(const TextureSource&, const Sampler&, const TexturePlace<R>&, const R& reference,
                                        const TextureSlopes<R>&, const LookupOptions&);
template <class R>
__attribute__((pure)) R compare_texture_level(const TextureSource&, const Sampler&, const TexturePlace<R>&, const R& reference,
                                              const R& lod, const glm::ivec3& offset);
template <class R>
__attribute__((pure)) vec4<R> gather_texture(const TextureSource&, const Sampler&, const TexturePlace<R>&, int component,
                                             const glm::ivec3& offset);
template <class R>
__attribute__((pure)) vec4<R> gather_compared(const TextureSource&, const Sampler&, const TexturePlace<R>&, const R& reference,
                                              const glm::ivec3& offset);
template <class R>
__attribute__((pure)) ivec4<R> gather_integer_texture(const TextureSource&, const Sampler&, const TexturePlace<R>&, int component,
                                                      const glm::ivec3& offset);
template <class R>
__attribute__((pure)) ivec4<R> sample_integer_texture(const TextureSource&, const Sampler&, const TexturePlace<R>&, const R& lod,
                                                      const glm::ivec3& offset);
template <class R>
__attribute__((pure)) vec4<R> fetch_texel(const TextureSource&, const ivec3<R>& texel, const IntOf<R>& level);
template <class R>
__attribute__((pure)) ivec4<R> fetch_integer_texel(const TextureSource&, const ivec3<R>& texel, const IntOf<R>& level);
template <class R>
__attribute__((pure)) vec2<R> query_texture_lod(const TextureSource&, const Sampler&, const TexturePlace<R>&, const TextureSlopes<R>&);

/// Unused components are 0.
template <int axes, class P, class R = CoordinateReal<P>>
HS_INLINE vec3<R> three_coordinates(const P& p) {
  if constexpr (std::is_same_v<P, R>) {
    return {p, R(0.0f), R(0.0f)};
  } else {
    return {p[0], axes > 1 ? p[1] : R(0.0f), axes > 2 ? p[axes > 2 ? 2 : 0] : R(0.0f)};
  }
}
template <TextureKind kind, class P, class R = CoordinateReal<P>>
HS_INLINE TexturePlace<R> texture_place(const P& p) {
  constexpr int axes = texture_axes(kind);
  R layer(0.0f);
  if constexpr (is_array(kind)) layer = p[axes];
  return {three_coordinates<axes>(p), layer};
}
template <TextureKind kind, class D, class R = CoordinateReal<D>>
HS_INLINE TextureSlopes<R> texture_slopes(const D& dx, const D& dy) {
  constexpr int axes = texture_axes(kind);
  return {three_coordinates<axes>(dx), three_coordinates<axes>(dy)};
}

}  // namespace detail

template <TextureKind kind>
template <class P, class R>
requires std::is_same_v<P, TextureCoordinates<kind, R>> HS_INLINE vec4<R> TextureView<kind>::sample(const Sampler& sampler, const P& p,
                                                                                                    const TextureDerivatives<kind, R>& dx,
                                                                                                    const TextureDerivatives<kind, R>& dy,
                                                                                                    const LookupOptions& options)
const {
  return detail::sample_texture<R>(source(), sampler, detail::texture_place<kind>(p), detail::texture_slopes<kind>(dx, dy), options);
}
template <TextureKind kind>
template <class P, class R>
requires std::is_same_v<P, TextureCoordinates<kind, R>> HS_INLINE vec4<R> TextureView<kind>::sample_level(const Sampler& sampler,
                                                                                                          const P& p,
                                                                                                          std::type_identity_t<R> lod,
                                                                                                          const glm::ivec3& offset)
const { return detail::sample_texture_level<R>(source(), sampler, detail::texture_place<kind>(p), lod, offset); }
template <TextureKind kind>
template <class P, class R>
requires std::is_same_v<P, TextureCoordinates<kind, R>> HS_INLINE R TextureView<kind>::sample_compare(const Sampler& sampler, const P& p,
                                                                                                      std::type_identity_t<R> reference,
                                                                                                      const TextureDerivatives<kind, R>& dx,
                                                                                                      const TextureDerivatives<kind, R>& dy,
                                                                                                      const LookupOptions& options)
const {
  return detail::compare_texture<R>(source(), sampler, detail::texture_place<kind>(p), reference, detail::texture_slopes<kind>(dx, dy),
                                    options);
}
template <TextureKind kind>
template <class P, class R>
requires std::is_same_v<P, TextureCoordinates<kind, R>> HS_INLINE R TextureView<kind>::sample_compare_level(
    const Sampler& sampler, const P& p, std::type_identity_t<R> reference, std::type_identity_t<R> lod, const glm::ivec3& offset)
const { return detail::compare_texture_level<R>(source(), sampler, detail::texture_place<kind>(p), reference, lod, offset); }
template <TextureKind kind>
template <class P, class R>
requires std::is_same_v<P, TextureCoordinates<kind, R>> HS_INLINE vec4<R> TextureView<kind>::gather(const Sampler& sampler, const P& p,
                                                                                                    int component, const glm::ivec3& offset)
const { return detail::gather_texture<R>(source(), sampler, detail::texture_place<kind>(p), component, offset); }
template <TextureKind kind>
template <class P, class R>
requires std::is_same_v<P, TextureCoordinates<kind, R>> HS_INLINE vec4<R> TextureView<kind>::gather_compare(
    const Sampler& sampler, const P& p, std::type_identity_t<R> reference, const glm::ivec3& offset)
const { return detail::gather_compared<R>(source(), sampler, detail::texture_place<kind>(p), reference, offset); }
template <TextureKind kind>
template <class P, class R>
requires std::is_same_v<P, TextureCoordinates<kind, R>> HS_INLINE ivec4<R> TextureView<kind>::gather_integers(const Sampler& sampler,
                                                                                                              const P& p, int component,
                                                                                                              const glm::ivec3& offset)
const { return detail::gather_integer_texture<R>(source(), sampler, detail::texture_place<kind>(p), component, offset); }
template <TextureKind kind>
template <class P, class R>
requires std::is_same_v<P, TextureCoordinates<kind, R>> HS_INLINE ivec4<R> TextureView<kind>::sample_integers(const Sampler& sampler,
                                                                                                              const P& p,
                                                                                                              std::type_identity_t<R> lod,
                                                                                                              const glm::ivec3& offset)
const { return detail::sample_integer_texture<R>(source(), sampler, detail::texture_place<kind>(p), lod, offset); }
template <TextureKind kind>
template <class R>
HS_INLINE vec4<R> TextureView<kind>::fetch(const ivec3<R>& texel, std::type_identity_t<IntOf<R>> level) const {
  return detail::fetch_texel<R>(source(), texel, level);
}
template <TextureKind kind>
template <class R>
HS_INLINE ivec4<R> TextureView<kind>::fetch_integers(const ivec3<R>& texel, std::type_identity_t<IntOf<R>> level) const {
  return detail::fetch_integer_texel<R>(source(), texel, level);
}
template <TextureKind kind>
template <class P, class R>
requires std::is_same_v<P, TextureCoordinates<kind, R>> HS_INLINE vec2<R> TextureView<kind>::query_lod(
    const Sampler& sampler, const P& p, const TextureDerivatives<kind, R>& dx, const TextureDerivatives<kind, R>& dy)
const { return detail::query_texture_lod<R>(source(), sampler, detail::texture_place<kind>(p), detail::texture_slopes<kind>(dx, dy)); }

}  // namespace halfspace::HS_LANES
