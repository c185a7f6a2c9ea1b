// SPDX-License-Identifier: Apache-2.0
//
// Conversion of linear light to display values: exposure, tone curve and encoding. Also computes a histogram of the light.
#pragma once

#include <array>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/shading/values/tone.h"

namespace halfspace {

/// The histogram covers luminances from 2^kLowStop to 2^kHighStop. Each stop is divided into kBinsPerStop bins of equal width: with
/// e = kLowStop + i, bin 8·i + m contains [2^e·(1 + m/8), 2^e·(1 + (m + 1)/8)). These are the exponent and the first three mantissa bits of
/// a float, so no logarithm is needed.
inline constexpr int kLowStop = -16, kHighStop = 16, kBinsPerStop = 8;

struct StageTone {
  ToneMapping tone;          ///< contains the exposure of this frame
  double log_average = 0.0;  ///< geometric mean of the luminance, if auto_exposure is set
  bool hdr = false;
  std::vector<uint32_t> histogram;          ///< of the luminance of all pixels
  uint32_t dark = 0, bright = 0;            ///< pixels below the first bin, and above the last
  std::vector<std::array<float, 2>> curve;  ///< light before exposure, and display light
};

/// Returns how the scene's light is displayed. light: the rendered frame, linear, before exposure.
StageTone stage_tone(const PreparedScene& scene, const Image<glm::vec4>& light, const Workers& workers);

/// The steps of the conversion of one color.
struct ToneSteps {
  glm::vec3 light, exposed, display, encoded;
  glm::ivec3 code;  ///< encoded · 255, rounded
};
ToneSteps tone_steps(const PreparedScene& scene, const ToneMapping& tone, const glm::vec3& light);

}  // namespace halfspace
