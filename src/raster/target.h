// SPDX-License-Identifier: Apache-2.0
//
// Attachments of a pass: views of images that the caller owns, and what happens to them at the start and end of the pass.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/core/texel_format.h"
#include "halfspace/core/texel_view.h"

namespace halfspace::HS_LANES {

using U16Vec4 = glm::vec<4, uint16_t>;

/// Formats of color attachments: all but those of depths and rgb9_e5. Integers are neither blended nor averaged: sample 0 is stored.
using ColorFormat = TexelFormat;
/// Formats of depth attachments: d16, d24, d32f, d24s8 and d32fs8.
using DepthFormat = TexelFormat;

/// Pixel of a d32fs8 image (GL_FLOAT_32_UNSIGNED_INT_24_8_REV).
struct DepthStencil {
  float depth = 0.0f;
  uint32_t stencil = 0;  ///< in the low 8 bits; all other bits are 0
  friend bool operator==(const DepthStencil&, const DepthStencil&) = default;
};

/// Returns the size of a pixel in bytes, or 0 for none.
constexpr int bytes_per_pixel(TexelFormat f) { return texel_info(f).bytes; }
/// Returns the depth format without stencil.
constexpr DepthFormat depth_part(DepthFormat f) {
  return f == DepthFormat::d24s8 ? DepthFormat::d24 : f == DepthFormat::d32fs8 ? DepthFormat::d32f : f;
}

/// Contents of an attachment at the start of a pass: the clear value, the contents of the image, or undefined.
enum class LoadOp : uint8_t { clear, load, dont_care };
/// Whether an attachment is written to its image at the end of a pass.
enum class StoreOp : uint8_t { store, dont_care };

/// Color attachment. data can be null if the pass does not load the image and StoreOp is dont_care. The color is then only an intermediate
/// result, and its size does not matter. Otherwise, the size must be that of the pass, which an HS_CHECK verifies. Memory that is stored to
/// must not be that of another target of the pass, which is checked as well; rows of one atlas may alternate.
/// Neither the address nor the pitches need to be aligned.
struct ColorTarget {
  ColorFormat format = ColorFormat::none;
  std::byte* data = nullptr;     ///< not owned; width × height pixels, top row first
  int width = 0, height = 0;     ///< of the image, in pixels
  std::ptrdiff_t row_pitch = 0;  ///< bytes from a row to the one below it in the window, negative if that precedes it; 0: tightly packed
  /// Values of a pixel in the image: 1, or one for each sample of the pass, in an image of its own. If it is 1, the samples are resolved
  /// when they are stored, and all samples are loaded with the same value.
  int samples = 1;
  std::ptrdiff_t sample_pitch = 0;  ///< bytes from the image of a sample to that of the next one; 0: tightly packed
  int layers = 1;                   ///< images that a pass with PassOptions::layers draws into
  std::ptrdiff_t layer_pitch = 0;   ///< bytes from a layer to the next one, if there are several
  LoadOp load = LoadOp::clear;
  StoreOp store = StoreOp::store;
  glm::vec4 clear_value = glm::vec4(0.0f);  ///< linear, straight alpha; for integer formats, integers stored with std::bit_cast
};

/// Depth attachment with values in [0, 1]. Pixels are uint16_t for d16, uint32_t for d24 (0 to 2^24 − 1), float for d32f, uint32_t for
/// d24s8 (depth · 2^8 + stencil) and DepthStencil for d32fs8. data, size, pitches, samples and layers are the same as in ColorTarget. If
/// only one of depth and stencil is stored, the other one is undefined in the image after the pass.
struct DepthTarget {
  DepthFormat format = DepthFormat::none;
  std::byte* data = nullptr;
  int width = 0, height = 0;
  std::ptrdiff_t row_pitch = 0;
  int samples = 1;
  std::ptrdiff_t sample_pitch = 0;
  int layers = 1;
  std::ptrdiff_t layer_pitch = 0;
  LoadOp load = LoadOp::clear;
  StoreOp store = StoreOp::dont_care;
  float clear_value = 1.0f;
  uint8_t stencil_clear_value = 0;
  std::optional<LoadOp> stencil_load{};    ///< of the stencil; default: `load`
  std::optional<StoreOp> stencil_store{};  ///< of the stencil; default: `store`
};

/// Returns what happens to the stencil of a target at the start of a pass.
constexpr LoadOp stencil_load_of(const DepthTarget& target) { return target.stencil_load.value_or(target.load); }

/// Return whether a pass writes to the image of a target.
constexpr bool is_stored(const ColorTarget& target) { return target.store == StoreOp::store; }
constexpr bool is_stored(const DepthTarget& target) {
  return target.store == StoreOp::store || (has_stencil(target.format) && target.stencil_store == StoreOp::store);
}

namespace detail {

template <class Target, class Format, class Pixel>
Target target_of(Format format, Image<Pixel>& image) {
  Target target;
  target.format = format;
  target.data = reinterpret_cast<std::byte*>(image.data());
  target.width = image.width();
  target.height = image.height();
  target.store = StoreOp::store;
  return target;
}

template <class Target>
Target target_of(const TexelView& view) {
  const TexelView top_first = view.flipped();
  Target target;
  target.format = view.format;
  target.data = top_first.data;
  target.width = view.width;
  target.height = view.height;
  target.row_pitch = top_first.row_pitch;
  target.samples = view.layers;
  target.sample_pitch = view.layer_pitch;
  target.store = StoreOp::store;
  return target;
}

template <class Target>
Target layered_target_of(const TexelView& view) {
  Target target = target_of<Target>(view);
  target.samples = 1;
  target.sample_pitch = 0;
  target.layers = view.layers;
  target.layer_pitch = view.layer_pitch;
  return target;
}

template <class Target>
Target layer_of(Target target, int layer) {
  if (target.data != nullptr) target.data += layer * target.layer_pitch;
  target.layers = 1;
  return target;
}

template <class Target>
TexelView texels_of(const Target& target) {
  const std::ptrdiff_t tight = std::ptrdiff_t{target.width} * bytes_per_pixel(target.format);
  const std::ptrdiff_t row_pitch = target.row_pitch != 0 ? target.row_pitch : tight;
  const std::ptrdiff_t sample_pitch =
      target.sample_pitch != 0 ? target.sample_pitch : target.height * (row_pitch < 0 ? -row_pitch : row_pitch);
  const bool has_layers = target.layers > 1;
  return TexelView{target.format,
                   target.data,
                   target.width,
                   target.height,
                   has_layers ? target.layers : target.samples,
                   row_pitch,
                   has_layers ? target.layer_pitch : sample_pitch}
      .flipped();
}

}  // namespace detail

/// Each of these functions returns a target that is a view: row 0 of the view is the bottom row of the window, so what is drawn can be
/// sampled through the same view. Several layers are the samples of the pass. The view can be a rectangle, a level, a layer or a face of
/// something larger; nothing else is written.
inline ColorTarget color_target(const TexelView& view) { return detail::target_of<ColorTarget>(view); }
inline DepthTarget depth_target(const TexelView& view) { return detail::target_of<DepthTarget>(view); }

/// The same for a pass with several layers (PassOptions::layers): those of the view, such as the faces of a cube map.
inline ColorTarget layered_color_target(const TexelView& view) { return detail::layered_target_of<ColorTarget>(view); }
inline DepthTarget layered_depth_target(const TexelView& view) { return detail::layered_target_of<DepthTarget>(view); }

/// The inverse: returns a view of the texels of a target with an image. Layer k is layer k of the target, or has sample k.
inline TexelView target_texels(const ColorTarget& target) { return detail::texels_of(target); }
inline TexelView target_texels(const DepthTarget& target) { return detail::texels_of(target); }

// Each of these functions returns a target that refers to an image and has its size. The image must outlive the pass, and its size must
// not change.

/// A target of any color format. A pixel of the image must have the size of a texel.
template <class Pixel>
ColorTarget color_target(ColorFormat format, Image<Pixel>& image) {
  HS_CHECK_OP(sizeof(Pixel), ==, std::size_t{texel_info(format).bytes},
              "color_target: the pixels of the image have another size than the format; expected the size of a texel");
  return detail::target_of<ColorTarget>(format, image);
}
inline ColorTarget rgba8_target(Image<glm::u8vec4>& image) { return detail::target_of<ColorTarget>(ColorFormat::rgba8, image); }
inline ColorTarget srgb8a8_target(Image<glm::u8vec4>& image) { return detail::target_of<ColorTarget>(ColorFormat::srgb8a8, image); }
inline ColorTarget rgba16f_target(Image<U16Vec4>& image) { return detail::target_of<ColorTarget>(ColorFormat::rgba16f, image); }
inline ColorTarget rgba32f_target(Image<glm::vec4>& image) { return detail::target_of<ColorTarget>(ColorFormat::rgba32f, image); }
inline ColorTarget r32f_target(Image<float>& image, float clear_value = 0.0f) {
  ColorTarget target = detail::target_of<ColorTarget>(ColorFormat::r32f, image);
  target.clear_value = glm::vec4(clear_value);
  return target;
}
inline ColorTarget rg32f_target(Image<glm::vec2>& image) { return detail::target_of<ColorTarget>(ColorFormat::rg32f, image); }
inline ColorTarget rgb32f_target(Image<glm::vec3>& image) { return detail::target_of<ColorTarget>(ColorFormat::rgb32f, image); }
inline ColorTarget r32ui_target(Image<uint32_t>& image, uint32_t clear_value = 0) {
  ColorTarget target = detail::target_of<ColorTarget>(ColorFormat::r32ui, image);
  target.clear_value = glm::vec4(std::bit_cast<float>(clear_value));
  return target;
}
inline DepthTarget d16_target(Image<uint16_t>& image) { return detail::target_of<DepthTarget>(DepthFormat::d16, image); }
inline DepthTarget d24_target(Image<uint32_t>& image) { return detail::target_of<DepthTarget>(DepthFormat::d24, image); }
inline DepthTarget d24s8_target(Image<uint32_t>& image) { return detail::target_of<DepthTarget>(DepthFormat::d24s8, image); }
inline DepthTarget d32fs8_target(Image<DepthStencil>& image) { return detail::target_of<DepthTarget>(DepthFormat::d32fs8, image); }
inline DepthTarget d32f_target(Image<float>& image) { return detail::target_of<DepthTarget>(DepthFormat::d32f, image); }
/// The same with a clear depth other than 1, such as 0 for reversed Z.
inline DepthTarget d32f_target(Image<float>& image, float clear_value) {
  DepthTarget target = d32f_target(image);
  target.clear_value = clear_value;
  return target;
}

}  // namespace halfspace::HS_LANES
