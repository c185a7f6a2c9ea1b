// SPDX-License-Identifier: Apache-2.0
//
// Texture filters, wrap modes and the sampler state.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "halfspace/core/compare_op.h"
#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// OpenGL's NEAREST and LINEAR, which sample only level 0, LINEAR_MIPMAP_LINEAR, NEAREST_MIPMAP_NEAREST, LINEAR_MIPMAP_NEAREST and
/// NEAREST_MIPMAP_LINEAR. Magnification uses only level 0, with the filter within a level: trilinear means bilinear there.
enum class Filter : uint8_t { nearest, bilinear, trilinear, nearest_mipmap_nearest, bilinear_mipmap_nearest, nearest_mipmap_linear };
/// Returns whether the filter reads a single texel of each level.
constexpr bool reads_nearest_texel(Filter f) {
  return f == Filter::nearest || f == Filter::nearest_mipmap_nearest || f == Filter::nearest_mipmap_linear;
}

/// OpenGL's REPEAT, MIRRORED_REPEAT, CLAMP_TO_EDGE, CLAMP_TO_BORDER and MIRROR_CLAMP_TO_EDGE.
enum class Wrap : uint8_t { repeat, mirrored, clamp, border, mirrored_clamp };

/// How the level of detail is changed before it selects mip levels (OpenGL 4.6, section 8.14.1). The bias is added first. min must not
/// exceed max.
struct LodControl {
  float bias = 0.0f;
  float min = -1000.0f, max = 1000.0f;
  friend constexpr bool operator==(const LodControl&, const LodControl&) = default;
};

inline constexpr int kMaxAnisotropy = 16;  ///< GL_MAX_TEXTURE_MAX_ANISOTROPY

/// How a texture is sampled: uniform state that is separate from the texture, like OpenGL's sampler objects.
struct Sampler {
  Filter mag = Filter::bilinear;   ///< magnification: texels are larger than pixels (level of detail <= 0)
  Filter min = Filter::trilinear;  ///< minification
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  /// Maximum number of probes along an elongated footprint (footprint.h): 1 (isotropic) … kMaxAnisotropy. Larger numbers mean
  /// kMaxAnisotropy. Only for two-dimensional textures and layers of them. sample_level ignores it, because it knows no footprint.
  int anisotropy = 1;
  /// Linear color outside the image for axes with Wrap::border. It is clamped to the range of the texture format, which is [0, 1] for
  /// unsigned normalized formats. Formats with one channel use only red. Integer formats use the nearest integers.
  glm::vec4 border_color{0.0f};
  Wrap wrap_r = Wrap::repeat;  ///< along the third axis of a 3D texture
  LodControl lod{};
  CompareOp compare = CompareOp::less_equal;  ///< of the reference with the texel, for lookups that compare
  friend constexpr bool operator==(const Sampler&, const Sampler&) = default;
};

}  // namespace halfspace::HS_LANES
