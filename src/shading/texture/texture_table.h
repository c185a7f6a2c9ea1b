// SPDX-License-Identifier: Apache-2.0
//
// What a lookup needs to know of a texture: its kind, its format, and where its levels are in memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "halfspace/core/texel_view.h"
#include "halfspace/shading/texture/sampler.h"

namespace halfspace::HS_LANES {

/// The kinds of textures (OpenGL 4.6, chapter 8). Rectangle textures have coordinates in texels.
enum class TextureKind : uint8_t { one_d, two_d, rectangle, three_d, one_d_array, two_d_array, cube, cube_array, multisample };
constexpr bool is_cube(TextureKind kind) { return kind == TextureKind::cube || kind == TextureKind::cube_array; }
constexpr bool is_array(TextureKind kind) {
  return kind == TextureKind::one_d_array || kind == TextureKind::two_d_array || kind == TextureKind::cube_array;
}

/// What a lookup returns in a channel: a channel of the texel, 0 or 1 (OpenGL 4.6, section 8.14.2, texture swizzle).
enum class Swizzle : uint8_t { red, green, blue, alpha, zero, one };

namespace detail {

inline constexpr int kMaxLevels = 16;

/// A level. All distances are in units of the format (texel_unit), and below 2^31 of them within a level.
struct TextureLevel {
  std::ptrdiff_t offset = 0;  ///< bytes from the base of the texture to texel (0, 0) of layer 0
  int32_t width = 0, height = 0;
  int32_t depth = 0;  ///< layers: slices, array layers, faces or samples
  int32_t row_pitch = 0, layer_pitch = 0;
};

struct TextureTable {
  TextureKind kind = TextureKind::two_d;
  TexelFormat format = TexelFormat::none;
  std::array<Swizzle, 4> swizzle{Swizzle::red, Swizzle::green, Swizzle::blue, Swizzle::alpha};
  int levels = 0;
  std::array<TextureLevel, kMaxLevels> level{};
};

/// Returns the table of a texture whose levels are given, the finest first. Offsets are relative to the data of the first. A failed check
/// names what is wrong with the levels.
TextureTable make_texture_table(TextureKind kind, const ConstTexelView* levels, std::size_t count);

}  // namespace detail

}  // namespace halfspace::HS_LANES
