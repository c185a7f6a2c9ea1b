// SPDX-License-Identifier: Apache-2.0
//
// The lookup of all textures: wraps coordinates, reads texels of one or two levels, and filters them. Lanes are independent: each has its
// own levels and texels. The texels of lanes that need different levels are read one level after the other.
#pragma once

#include <bit>

#include "halfspace/core/compare.h"
#include "halfspace/shading/texture/cube_faces.h"
#include "halfspace/shading/texture/footprint.h"
#include "halfspace/shading/texture/level_choice.h"
#include "halfspace/shading/texture/texel_reader.h"
#include "halfspace/shading/texture/texture_axis.h"
#include "halfspace/shading/texture/texture_table.h"

namespace halfspace::HS_LANES::detail {

/// Coordinates within a level, and the layer: of an array, or the face of a cube.
template <class R>
struct LevelPlace {
  vec3<R> st;
  IntOf<R> layer;
};

/// Clamps the border color to the range of the format (OpenGL 4.6, section 8.14.2), and sets channels that the format does not have.
inline glm::vec4 clamped_border(const glm::vec4& color, TexelFormat format) {
  const TexelInfo& info = texel_info(format);
  glm::vec4 border(0.0f, 0.0f, 0.0f, 1.0f);
  const auto range = [&]() -> glm::vec2 {
    switch (info.kind) {
      case TexelKind::unorm:
      case TexelKind::srgb: return {0.0f, 1.0f};
      case TexelKind::depth:
        if (format == TexelFormat::d32f || format == TexelFormat::d32fs8) break;
        return {0.0f, 1.0f};
      case TexelKind::snorm: return {-1.0f, 1.0f};
      case TexelKind::shared_exponent: return {0.0f, kMaxTexel};
      case TexelKind::floats:
        if (info.bits == 16) return {-kMaxHalf, kMaxHalf};
        return {info.bits == 0 ? 0.0f : -kMaxTexel, kMaxTexel};
      default: break;
    }
    return {-kMaxTexel, kMaxTexel};
  }();
  for (int k = 0; k < info.channels; ++k) border[k] = color[k] == color[k] ? clamp(color[k], range.x, range.y) : std::max(range.x, 0.0f);
  return border;
}

/// Whether the second coordinate of a texture applies to rows.
constexpr bool has_rows(TextureKind kind) { return kind != TextureKind::one_d && kind != TextureKind::one_d_array; }

/// Calls f(k) for each level that a lane of `index` names, and returns in each lane the value for its level.
template <class Value, class R, class F>
Value for_each_level(IntOf<R> index, const F& f) {
  const uint32_t all_lanes = bits(MaskOf<R>(true));
  Value value{};
  for (uint32_t left = all_lanes; left != 0;) {
    const int32_t k = lane(index, std::countr_zero(left));
    const MaskOf<R> here = index == IntOf<R>(k);
    const uint32_t lanes = bits(here);
    if (lanes == all_lanes) return f(k);
    value = select(here, f(k), value);
    left &= ~lanes;
  }
  return value;
}

/// The kind of a texture and an offset that are known only at run time.
struct AnyKind {
  static constexpr bool has_layers = true;
  TextureKind kind;
  glm::ivec3 offset{0};  ///< in texels of the level that is read
};
/// A 2D texture without an offset, as Texture2D. The lookup contains no code for other kinds.
struct OnlyTwoD {
  static constexpr bool has_layers = false;
  static constexpr TextureKind kind = TextureKind::two_d;
  static constexpr glm::ivec3 offset{0};
};

/// Kind: AnyKind or OnlyTwoD. Texels reads the value of a texel, given the reader of a level (texel_reader.h) and the index of the texel in
/// units of the format: operator()(reader, i), to_linear(reader, value), which converts a value, filtered or not, to a linear one, and
/// border(color, format), the value of the border. is_one_unit: a texel of all its formats is one unit.
template <class R, class Texels, class Kind = AnyKind>
struct TextureLookup {
  using Value = typename Texels::Value;
  using I = IntOf<R>;

  const std::byte* base;
  const TextureTable& table;
  const Sampler& sampler;
  const Texels& texels;
  [[no_unique_address]] Kind of{};
  int stride = texel_info(table.format).bytes / texel_unit(table.format);
  bool has_border = uses_border();
  Value border = has_border ? texels.border(sampler.border_color, table.format) : Value{};

  bool uses_border() const {
    if (is_cube(of.kind)) return false;
    return sampler.wrap_s == Wrap::border || (has_rows(of.kind) && sampler.wrap_t == Wrap::border) ||
           (of.kind == TextureKind::three_d && sampler.wrap_r == Wrap::border);
  }

  HS_INLINE TexelAxis axis_of(int size, Wrap wrap) const {
    return {size, of.kind == TextureKind::rectangle ? 1.0f : static_cast<float>(size), wrap};
  }
  HS_INLINE static WrappedCoordinate<R> wrapped_at(R coordinate, const TexelAxis& axis, int offset) {
    const R moved = offset == 0 ? coordinate : coordinate + R(static_cast<float>(offset) / axis.scale);
    return wrap_coordinate(moved, axis);
  }
  HS_INLINE static AxisTaps<R> taps_at(R coordinate, const TexelAxis& axis, int offset, MaskOf<R> nearest) {
    return taps(wrapped_at(coordinate, axis, offset), axis, nearest);
  }
  /// The taps of a linear filter, the one at the smaller coordinate first, also where the image is mirrored. Without weights.
  HS_INLINE static AxisTaps<R> ordered_taps_at(R coordinate, const TexelAxis& axis, int offset) {
    const WrappedCoordinate<R> at = wrapped_at(coordinate, axis, offset);
    AxisTaps<R> t = taps(at, axis, MaskOf<R>(false));
    const IntOf<R> first = t.first;
    t.first = select(at.mirrored, t.second, first);
    t.second = select(at.mirrored, first, t.second);
    return t;
  }

  /// The distance of a texel from the first one of its row.
  HS_INLINE I in_row(I x) const {
    if constexpr (Texels::is_one_unit) {
      return x;
    } else {
      return x * I(stride);
    }
  }
  /// The index of the first texel of a layer.
  HS_INLINE I start_of_layer(const TextureLevel& l, I layer) const {
    if constexpr (Kind::has_layers) {
      return layer * I(l.layer_pitch);
    } else {
      return I(0);
    }
  }
  HS_INLINE TexelReader<R> reader(const TextureLevel& level) const { return {table.format, base + level.offset}; }

  HS_INLINE Value texel(const TexelReader<R>& from, I index, MaskOf<R> inside) const {
    const Value v = texels(from, index);
    return has_border ? select(inside, texels.to_linear(from, v), border) : v;
  }

  /// Filters within a layer. layer: the index of its first texel.
  HS_INLINE Value in_layer(const TextureLevel& l, const AxisTaps<R>& x, const AxisTaps<R>& y, I layer, MaskOf<R> inside,
                           bool single) const {
    const TexelReader<R> from = reader(l);
    const I row0 = layer + y.first * I(l.row_pitch), row1 = layer + y.second * I(l.row_pitch);
    const I column0 = in_row(x.first), column1 = in_row(x.second);
    const MaskOf<R> first_row = y.first_inside && inside, second_row = y.second_inside && inside;
    const Value first = texel(from, row0 + column0, x.first_inside && first_row);
    if (single) return first;
    const Value upper = lerp(first, texel(from, row0 + column1, x.second_inside && first_row), x.fraction);
    if (l.height == 1 && !has_border) return upper;
    const Value lower = lerp(texel(from, row1 + column0, x.first_inside && second_row),
                             texel(from, row1 + column1, x.second_inside && second_row), x.fraction);
    return lerp(upper, lower, y.fraction);
  }

  /// The four texels of a cube at (x, y), (x + 1, y), (x, y + 1) and (x + 1, y + 1), where those beyond an edge belong to the adjacent
  /// face. At a corner, where three faces meet, the fourth texel is the mean of the three.
  std::array<Value, 4> cube_square(const TextureLevel& l, I cube, I face, I x, I y) const {
    const TexelReader<R> from = reader(l);
    const I last(l.width - 1);
    const auto read = [&](const I& i, const I& j) {
      const CubeTexel<I> t = cube_texel<R>(face, i, j, l.width);
      return texels(from, (cube + t.face) * I(l.layer_pitch) + t.y * I(l.row_pitch) + in_row(t.x));
    };
    std::array<Value, 4> v{read(x, y), read(x + I(1), y), read(x, y + I(1)), read(x + I(1), y + I(1))};
    const MaskOf<R> left = x < I(0), right = x >= last, low = y < I(0), high = y >= last;
    if (any((left || right) && (low || high))) {
      const auto mend = [&](std::size_t k, MaskOf<R> corner) {
        const Value sum = v[(k + 1) % 4] + v[(k + 2) % 4] + v[(k + 3) % 4];
        v[k] = select(corner, sum * R(1.0f / 3.0f), v[k]);
      };
      mend(0, left && low);
      mend(1, right && low);
      mend(2, left && high);
      mend(3, right && high);
    }
    return v;
  }

  Value in_cube(const TextureLevel& l, const LevelPlace<R>& at, MaskOf<R> nearest, bool single) const {
    const TexelAxis axis = axis_of(l.width, Wrap::clamp);
    const I face = cube_face_of(at.layer), cube = at.layer - face;
    const Axis<R> x = between_texels(wrap_coordinate(at.st.x, axis), axis, nearest),
                  y = between_texels(wrap_coordinate(at.st.y, axis), axis, nearest);
    if (single) {
      return texels(reader(l), at.layer * I(l.layer_pitch) + y.i * I(l.row_pitch) + in_row(x.i));
    }
    const std::array<Value, 4> v = cube_square(l, cube, face, x.i, y.i);
    return lerp(lerp(v[0], v[1], x.fraction), lerp(v[2], v[3], x.fraction), y.fraction);
  }
  HS_INLINE static I cube_face_of(I layer) { return layer - truncate_to_int((to_real<R>(layer) + R(0.5f)) * R(1.0f / 6.0f)) * I(6); }

  /// Reads the nearest texel of one level. Not for cubes and volumes.
  HS_INLINE Value nearest_texel(const TextureLevel& l, const LevelPlace<R>& at) const {
    const TexelAxis columns = axis_of(l.width, sampler.wrap_s), rows = axis_of(l.height, has_rows(of.kind) ? sampler.wrap_t : Wrap::clamp);
    const I x = texel_at(wrapped_at(at.st.x, columns, of.offset.x), columns), y = texel_at(wrapped_at(at.st.y, rows, of.offset.y), rows);
    const I index = start_of_layer(l, at.layer) + clamped_index<R>(y, l.height) * I(l.row_pitch) + in_row(clamped_index<R>(x, l.width));
    const auto inside = [](I i, const TexelAxis& axis) { return axis.wrap == Wrap::border ? is_inside<R>(i, axis.size) : MaskOf<R>(true); };
    const MaskOf<R> is_texel = inside(x, columns) && inside(y, rows);
    if (has_border && !any(is_texel)) return border;
    return texel(reader(l), index, is_texel);
  }

  /// Filters one level, linearly or to the nearest texel.
  Value filter(const LevelPlace<R>& at, int level, MaskOf<R> nearest) const {
    const TextureLevel& l = table.level[static_cast<std::size_t>(level)];
    const bool single = all(nearest);
    if (is_cube(of.kind)) return in_cube(l, at, nearest, single);
    if (single && of.kind != TextureKind::three_d) return nearest_texel(l, at);
    const AxisTaps<R> x = taps_at(at.st.x, axis_of(l.width, sampler.wrap_s), of.offset.x, nearest),
                      y = taps_at(at.st.y, axis_of(l.height, has_rows(of.kind) ? sampler.wrap_t : Wrap::clamp), of.offset.y, nearest);
    if (of.kind != TextureKind::three_d) {
      // Large areas outside the image are common, for example around a decal.
      if (has_border && !any((x.first_inside || x.second_inside) && (y.first_inside || y.second_inside))) return border;
      return in_layer(l, x, y, start_of_layer(l, at.layer), MaskOf<R>(true), false);
    }
    const AxisTaps<R> z = taps_at(at.st.z, axis_of(l.depth, sampler.wrap_r), of.offset.z, nearest);
    const Value front = in_layer(l, x, y, start_of_layer(l, z.first), z.first_inside, single);
    if (single) return front;
    return lerp(front, in_layer(l, x, y, start_of_layer(l, z.second), z.second_inside, false), z.fraction);
  }

  /// Filters the levels of a choice.
  Value operator()(const LevelPlace<R>& at, const LevelChoice<R>& levels) const {
    const auto level = [&](I index) { return for_each_level<Value, R>(index, [&](int k) { return filter(at, k, levels.nearest); }); };
    const Value c = level(levels.index);
    if (!any(levels.between)) return c;
    return lerp(c, level(min(levels.index + I(1), I(table.levels - 1))), levels.fraction);
  }

  /// Converts a filtered value to a linear one.
  HS_INLINE Value finish(const Value& v) const { return has_border ? v : texels.to_linear(reader(table.level[0]), v); }
};

/// Reads all channels.
template <class R>
struct AllChannels {
  using Value = vec4<R>;
  static constexpr bool is_one_unit = false;
  Value operator()(const TexelReader<R>& from, IntOf<R> i) const { return from(i); }
  HS_INLINE Value to_linear(const TexelReader<R>& from, const Value& v) const { return from.to_linear(v); }
  HS_INLINE Value border(const glm::vec4& color, TexelFormat format) const {
    const glm::vec4 c = clamped_border(color, format);
    return {R(c.x), R(c.y), R(c.z), R(c.w)};
  }
};

/// Reads all channels of an 8-bit format, which is known at compile time.
template <class R, TexelFormat format>
struct FourBytes : AllChannels<R> {
  using Value = vec4<R>;
  static constexpr bool is_one_unit = true;
  HS_INLINE Value operator()(const TexelReader<R>& from, IntOf<R> i) const { return decode_rgba8<Value, format, R>(from.word(i)); }
  HS_INLINE Value to_linear(const TexelReader<R>&, const Value& v) const { return rgba8_to_linear<format>(v); }
  HS_INLINE Value border(const glm::vec4& color, TexelFormat) const { return AllChannels<R>::border(color, format); }
};

/// Reads the result of a comparison of a reference with red: 1 if it passes, else 0.
template <class R>
struct ComparedRed {
  using Value = R;
  static constexpr bool is_one_unit = false;
  CompareOp op;
  R reference;

  HS_INLINE R compared(R texel) const { return select(compare(op, reference, texel), R(1.0f), R(0.0f)); }
  HS_INLINE Value operator()(const TexelReader<R>& from, IntOf<R> i) const {
    return compared(is_depth(from.format) ? from.depth(i) : from.to_linear(from(i)).x);
  }
  HS_INLINE Value to_linear(const TexelReader<R>&, Value v) const { return v; }
  HS_INLINE Value border(const glm::vec4& color, TexelFormat format) const { return compared(R(clamped_border(color, format).x)); }
};

/// Covers an elongated footprint with probes. probe(along) returns the value at the center plus along · area.span. The running mean stays
/// within the range of the probes, and is exact if all probes are equal.
template <class R, class Probe>
HS_INLINE auto mean_of_probes(const Footprint<R>& area, const Probe& probe) {
  const R step = R(1.0f) / max(to_real<R>(area.probes) - R(1.0f), R(1.0f));
  const auto at = [&](int i) __attribute__((always_inline)) { return probe(fma(R(static_cast<float>(i)), step, R(-0.5f))); };
  auto mean = at(0);
  for (int i = 1;; ++i) {
    const MaskOf<R> more = area.probes > IntOf<R>(i);
    if (!any(more)) return mean;
    mean = select(more, lerp(mean, at(i), R(1.0f / static_cast<float>(i + 1))), mean);
  }
}

}  // namespace halfspace::HS_LANES::detail
