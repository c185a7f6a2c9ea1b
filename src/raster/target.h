// SPDX-License-Identifier: Apache-2.0
//
// What a pass draws into: views of images that the caller owns, and what happens to them at the pass's start and end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "halfspace/core/image.h"

namespace halfspace {

using U16Vec4 = glm::vec<4, uint16_t>;

enum class ColorFormat : uint8_t {
  none,
  rgba8,    ///< linear values, 8-bit unsigned normalized
  srgb8a8,  ///< linear colour encoded to sRGB on write and decoded on load; alpha linear
  rgba16f,  ///< IEEE half; finite values beyond ±65504 and infinities are held to ±65504
  rgba32f
};

/// d24s8 and d32fs8 hold 8 bits of stencil too.
enum class DepthFormat : uint8_t { none, d16, d24, d32f, d24s8, d32fs8 };

/// A pixel of d32fs8 (GL_FLOAT_32_UNSIGNED_INT_24_8_REV).
struct DepthStencil {
  float depth = 0.0f;
  uint32_t stencil = 0;  ///< in the low 8 bits; the others are 0
  friend bool operator==(const DepthStencil&, const DepthStencil&) = default;
};

/// Bytes of one pixel; 0 for none.
constexpr int bytes_per_pixel(ColorFormat f) {
  return f == ColorFormat::rgba32f ? 16 : f == ColorFormat::rgba16f ? 8 : f == ColorFormat::none ? 0 : 4;
}

constexpr int bytes_per_pixel(DepthFormat f) {
  return f == DepthFormat::none ? 0 : f == DepthFormat::d16 ? 2 : f == DepthFormat::d32fs8 ? 8 : 4;
}
constexpr bool has_stencil(DepthFormat f) { return f == DepthFormat::d24s8 || f == DepthFormat::d32fs8; }
/// The format without its stencil.
constexpr DepthFormat depth_part(DepthFormat f) {
  return f == DepthFormat::d24s8 ? DepthFormat::d24 : f == DepthFormat::d32fs8 ? DepthFormat::d32f : f;
}

enum class LoadOp : uint8_t { clear, load, dont_care };
enum class StoreOp : uint8_t { store, dont_care };

/// A colour attachment. data is null where the pass's colour is only an intermediate (StoreOp::dont_care).
struct ColorTarget {
  ColorFormat format = ColorFormat::none;
  std::byte* data = nullptr;  ///< not owned; rows from the top, tightly packed, width × height pixels
  LoadOp load = LoadOp::clear;
  StoreOp store = StoreOp::store;
  glm::vec4 clear_value = glm::vec4(0.0f);  ///< linear, straight alpha
};

/// A depth attachment; values in [0, 1]. Images hold d16 as uint16_t, d24 as uint32_t (0 … 2^24 − 1), d32f as float, d24s8 as
/// uint32_t (depth · 2^8 + stencil), d32fs8 as DepthStencil.
struct DepthTarget {
  DepthFormat format = DepthFormat::none;
  std::byte* data = nullptr;
  LoadOp load = LoadOp::clear;
  StoreOp store = StoreOp::dont_care;
  float clear_value = 1.0f;
  uint8_t stencil_clear_value = 0;
};

// Views of images as targets; the image must outlive the pass.
inline ColorTarget rgba8_target(Image<glm::u8vec4>& image) {
  return {.format = ColorFormat::rgba8, .data = reinterpret_cast<std::byte*>(image.data())};
}
inline ColorTarget srgb8a8_target(Image<glm::u8vec4>& image) {
  return {.format = ColorFormat::srgb8a8, .data = reinterpret_cast<std::byte*>(image.data())};
}
inline ColorTarget rgba16f_target(Image<U16Vec4>& image) {
  return {.format = ColorFormat::rgba16f, .data = reinterpret_cast<std::byte*>(image.data())};
}
inline ColorTarget rgba32f_target(Image<glm::vec4>& image) {
  return {.format = ColorFormat::rgba32f, .data = reinterpret_cast<std::byte*>(image.data())};
}
inline DepthTarget d16_target(Image<uint16_t>& image) {
  return {.format = DepthFormat::d16, .data = reinterpret_cast<std::byte*>(image.data()), .store = StoreOp::store};
}
inline DepthTarget d24_target(Image<uint32_t>& image) {
  return {.format = DepthFormat::d24, .data = reinterpret_cast<std::byte*>(image.data()), .store = StoreOp::store};
}
inline DepthTarget d24s8_target(Image<uint32_t>& image) {
  return {.format = DepthFormat::d24s8, .data = reinterpret_cast<std::byte*>(image.data()), .store = StoreOp::store};
}
inline DepthTarget d32fs8_target(Image<DepthStencil>& image) {
  return {.format = DepthFormat::d32fs8, .data = reinterpret_cast<std::byte*>(image.data()), .store = StoreOp::store};
}
inline DepthTarget d32f_target(Image<float>& image) {
  return {.format = DepthFormat::d32f, .data = reinterpret_cast<std::byte*>(image.data()), .store = StoreOp::store};
}
/// The same, cleared to another depth than 1: to 0 for reversed Z.
inline DepthTarget d32f_target(Image<float>& image, float clear_value) {
  DepthTarget target = d32f_target(image);
  target.clear_value = clear_value;
  return target;
}

}  // namespace halfspace
