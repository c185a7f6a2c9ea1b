// SPDX-License-Identifier: Apache-2.0
//
// The images that the oracle draws into. Input: colors, depths and stencil values. Output: the bytes of the images, in the formats of the
// targets. Each sample is encoded and decoded on its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/target.h"

namespace halfspace::oracle {

/// A sample of a pixel.
struct Sample {
  int x = 0, y = 0;  ///< window coordinates of the pixel
  int number = 0;
};

/// Color and depth images in the formats and layout of the targets (top row first), accessed by window coordinates. With several samples,
/// there is one image per sample, stored one after the other.
class Framebuffer {
 public:
  Framebuffer(int width, int height, std::vector<ColorFormat> colors, DepthFormat depth, int samples = 1);

  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return samples_; }
  const std::vector<ColorFormat>& color_formats() const { return color_formats_; }
  DepthFormat depth_format() const { return depth_format_; }

  void clear_color(std::size_t attachment, glm::vec4 value);
  void clear_depth(float value);
  void clear_stencil(uint8_t value);

  /// Returns the decoded color of a sample.
  glm::vec4 color(std::size_t attachment, const Sample& s) const;
  void set_color(std::size_t attachment, const Sample& s, glm::vec4 value);
  /// Combines the bits of a color with those of the sample, in the channels of the mask.
  void combine_color(std::size_t attachment, const Sample& s, glm::vec4 value, LogicOp op, const ColorMask& mask);
  /// Returns the depth of a sample as stored in the format: an integer (UNORM), or the depth itself for float formats.
  double depth(const Sample& s) const;
  void set_depth(const Sample& s, double value);
  uint8_t stencil(const Sample& s) const;
  void set_stencil(const Sample& s, uint8_t value);
  /// Returns the stored value for a window depth in [0, 1].
  double depth_value(float z) const;
  /// Returns a framebuffer with one sample per pixel: the mean of the colors, and the integers, depth and stencil of the first sample.
  Framebuffer resolved() const;

  std::vector<std::vector<std::byte>> color_bytes;
  std::vector<std::byte> depth_bytes;

 private:
  std::size_t pixel(const Sample& s) const;
  std::size_t texel(std::size_t attachment, const Sample& s) const;  // index of its first byte

  int width_, height_, samples_;
  std::vector<ColorFormat> color_formats_;
  DepthFormat depth_format_;
};

}  // namespace halfspace::oracle
