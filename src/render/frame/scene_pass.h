// SPDX-License-Identifier: Apache-2.0
//
// Renders the color of a frame with a replacement for Pass::run(), for example a function that traces the pass.
#pragma once

#include <functional>

#include "halfspace/render/prepared_scene.h"
#include "halfspace/shading/values/tone_types.h"

namespace halfspace::HS_LANES {

/// Runs a pass that draws a scene.
using PassRunner = std::function<PassStatistics(Pass& pass)>;

/// Like render(), but calls run_pass for the pass that draws the scene. Attachment 0 of this pass holds linear colors: those of the picture
/// or, if the scene has a tone curve or a transparent background, light that a post step converts for display. The picture must have the
/// size for which the scene was prepared.
PassStatistics render_with(const PreparedScene& scene, Image<glm::u8vec4>& picture, const Workers& workers, const PassRunner& run_pass);

/// Returns the exposure that is used to display the scene's light. light: attachment 0 of its pass, for automatic exposure.
double frame_exposure(const PreparedScene& scene, const Image<glm::vec4>& light, const Workers& workers);

/// Returns the tone mapping that is used to display the scene's light. Without `hdr`, light is only clamped to [0, 1].
ToneMapping frame_tone(const PreparedScene& scene, double exposure);

}  // namespace halfspace::HS_LANES
