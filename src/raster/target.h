// SPDX-License-Identifier: Apache-2.0
//
// Attachments of a pass: views of images that the caller owns, and what happens to them at the start and end of the pass.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "halfspace/core/image.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

using U16Vec4 = glm::vec<4, uint16_t>;

enum class ColorFormat : uint8_t {
  none,
  rgba8,    ///< linear values, 8-bit unsigned normalized
  srgb8a8,  ///< linear colors that are encoded to sRGB on write and decoded on read; alpha is linear
  rgba16f,  ///< IEEE half; values beyond ±65504 and infinities are clamped to ±65504
  rgba32f,
  r32f,  ///< these three store the first channels of a color; the others are read as 0, and alpha as 1
  rg32f,
  rgb32f,
  r32ui  ///< an integer, see integer_color() in shading/contract.h; not blended; sample 0 is stored
};

/// Depth formats. d24s8 and d32fs8 also have 8 bits of stencil.
enum class DepthFormat : uint8_t { none, d16, d24, d32f, d24s8, d32fs8 };

/// Pixel of a d32fs8 image (GL_FLOAT_32_UNSIGNED_INT_24_8_REV).
struct DepthStencil {
  float depth = 0.0f;
  uint32_t stencil = 0;  ///< in the low 8 bits; all other bits are 0
  friend bool operator==(const DepthStencil&, const DepthStencil&) = default;
};

/// Returns the size of a pixel in bytes, or 0 for none.
constexpr int bytes_per_pixel(ColorFormat f) {
  switch (f) {
    case ColorFormat::none: return 0;
    case ColorFormat::rgba8:
    case ColorFormat::srgb8a8:
    case ColorFormat::r32f:
    case ColorFormat::r32ui: return 4;
    case ColorFormat::rgba16f:
    case ColorFormat::rg32f: return 8;
    case ColorFormat::rgb32f: return 12;
    case ColorFormat::rgba32f: return 16;
  }
  return 0;
}

constexpr int bytes_per_pixel(DepthFormat f) {
  return f == DepthFormat::none ? 0 : f == DepthFormat::d16 ? 2 : f == DepthFormat::d32fs8 ? 8 : 4;
}
constexpr bool has_stencil(DepthFormat f) { return f == DepthFormat::d24s8 || f == DepthFormat::d32fs8; }
/// Returns the depth format without stencil.
constexpr DepthFormat depth_part(DepthFormat f) {
  return f == DepthFormat::d24s8 ? DepthFormat::d24 : f == DepthFormat::d32fs8 ? DepthFormat::d32f : f;
}

/// Contents of an attachment at the start of a pass: the clear value, the contents of the image, or undefined.
enum class LoadOp : uint8_t { clear, load, dont_care };
/// Whether an attachment is written to its image at the end of a pass.
enum class StoreOp : uint8_t { store, dont_care };

/// Color attachment. data can be null if the pass does not load the image and StoreOp is dont_care. The color is then only an intermediate
/// result.
struct ColorTarget {
  ColorFormat format = ColorFormat::none;
  std::byte* data = nullptr;  ///< not owned; width × height pixels, tightly packed, top row first
  LoadOp load = LoadOp::clear;
  StoreOp store = StoreOp::store;
  glm::vec4 clear_value = glm::vec4(0.0f);  ///< linear, straight alpha; for r32ui, see r32ui_target()
};

/// Depth attachment with values in [0, 1]. Pixels are uint16_t for d16, uint32_t for d24 (0 to 2^24 − 1), float for d32f, uint32_t for
/// d24s8 (depth · 2^8 + stencil) and DepthStencil for d32fs8. data is the same as in ColorTarget.
struct DepthTarget {
  DepthFormat format = DepthFormat::none;
  std::byte* data = nullptr;
  LoadOp load = LoadOp::clear;
  StoreOp store = StoreOp::dont_care;
  float clear_value = 1.0f;
  uint8_t stencil_clear_value = 0;
};

// Each of these functions returns a target that refers to the image. The image must outlive the pass.
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
inline ColorTarget r32f_target(Image<float>& image, float clear_value = 0.0f) {
  return {.format = ColorFormat::r32f, .data = reinterpret_cast<std::byte*>(image.data()), .clear_value = glm::vec4(clear_value)};
}
inline ColorTarget rg32f_target(Image<glm::vec2>& image) {
  return {.format = ColorFormat::rg32f, .data = reinterpret_cast<std::byte*>(image.data())};
}
inline ColorTarget rgb32f_target(Image<glm::vec3>& image) {
  return {.format = ColorFormat::rgb32f, .data = reinterpret_cast<std::byte*>(image.data())};
}
inline ColorTarget r32ui_target(Image<uint32_t>& image, uint32_t clear_value = 0) {
  return {.format = ColorFormat::r32ui,
          .data = reinterpret_cast<std::byte*>(image.data()),
          .clear_value = glm::vec4(std::bit_cast<float>(clear_value))};
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
/// The same with a clear depth other than 1, such as 0 for reversed Z.
inline DepthTarget d32f_target(Image<float>& image, float clear_value) {
  DepthTarget target = d32f_target(image);
  target.clear_value = clear_value;
  return target;
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
