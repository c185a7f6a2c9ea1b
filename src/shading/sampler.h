// SPDX-License-Identifier: Apache-2.0
//
// How a texture is read: filters, wrap modes and the sampler state that a shader keeps apart from the texture.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace halfspace {

/// GL's NEAREST and LINEAR (both of level 0) and LINEAR_MIPMAP_LINEAR. As a magnification filter trilinear means bilinear.
enum class Filter : uint8_t { nearest, bilinear, trilinear };
/// GL's REPEAT, MIRRORED_REPEAT, CLAMP_TO_EDGE and CLAMP_TO_BORDER.
enum class Wrap : uint8_t { repeat, mirrored, clamp, border };

/// How a texture is read: uniform state, kept apart from the texture as in GL's sampler objects.
struct Sampler {
  Filter mag = Filter::bilinear;   ///< where a texel is larger than a pixel (level of detail <= 0)
  Filter min = Filter::trilinear;  ///< where it is smaller
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  /// At most so many probes along a long footprint (footprint.h): 1 (isotropic) … 16. Ignored by sample_level.
  int anisotropy = 1;
  /// Linear; what lies outside of the image where an axis wraps by border. Used as the texture's format could hold it: of
  /// the coded formats held to [0, 1], of those of one channel the red alone.
  glm::vec4 border_color{0.0f};
};

}  // namespace halfspace
