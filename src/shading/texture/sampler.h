// SPDX-License-Identifier: Apache-2.0
//
// Texture filters, wrap modes and the sampler state.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// OpenGL's NEAREST and LINEAR (both sample only level 0) and LINEAR_MIPMAP_LINEAR. For magnification, trilinear means bilinear.
enum class Filter : uint8_t { nearest, bilinear, trilinear };
/// OpenGL's REPEAT, MIRRORED_REPEAT, CLAMP_TO_EDGE and CLAMP_TO_BORDER.
enum class Wrap : uint8_t { repeat, mirrored, clamp, border };

/// How a texture is sampled: uniform state that is separate from the texture, like OpenGL's sampler objects.
struct Sampler {
  Filter mag = Filter::bilinear;   ///< magnification: texels are larger than pixels (level of detail <= 0)
  Filter min = Filter::trilinear;  ///< minification
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  /// Maximum number of probes along an elongated footprint (footprint.h): 1 (isotropic) … 16. Ignored by sample_level.
  int anisotropy = 1;
  /// Linear color outside the image for axes with Wrap::border. It is clamped to the range of the texture format, which is [0, 1] for 8-bit
  /// and 16-bit integer formats. Formats with one channel use only red.
  glm::vec4 border_color{0.0f};
};

}  // namespace halfspace::HS_LANES
