// SPDX-License-Identifier: Apache-2.0
//
// From the light of a frame to its codes: exposure, tone curve, encoding, and a histogram of the light.
#pragma once

#include <array>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/shading/tone.h"

namespace halfspace {

/// Luminances are counted in eighths of powers of two, from 2^kLowStop to 2^kHighStop. The bins are those of the float's exponent and its
/// first three bits, so that no logarithm is needed: bin 8·e + m contains [2^e·(1 + m/8), 2^e·(1 + (m + 1)/8)).
inline constexpr int kLowStop = -16, kHighStop = 16, kBinsPerStop = 8;

struct StageTone {
  ToneMapping tone;          ///< with the exposure of this frame
  double log_average = 0.0;  ///< with auto_exposure: the measured luminance
  bool hdr = false;
  std::vector<uint32_t> histogram;          ///< of the luminance of all pixels
  uint32_t dark = 0, bright = 0;            ///< pixels below the first bin, and above the last
  std::vector<std::array<float, 2>> curve;  ///< light before exposure, and display light
};

/// Returns how the scene displays its light. `light`: as rendered.
StageTone stage_tone(const PreparedScene& scene, const Image<glm::vec4>& light, const Workers& workers);

/// The steps from light to a code, for one color.
struct ToneSteps {
  glm::vec3 light, exposed, display, encoded;
  glm::ivec3 code;  ///< encoded · 255, rounded
};
ToneSteps tone_steps(const PreparedScene& scene, const ToneMapping& tone, const glm::vec3& light);

}  // namespace halfspace
