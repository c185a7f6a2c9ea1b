// SPDX-License-Identifier: Apache-2.0
//
// The final stage of rendering an image: measures its average brightness and converts linear light to pixel values.
#pragma once

#include "halfspace/raster/pass.h"
#include "halfspace/scene/description.h"
#include "halfspace/shading/values/tone_types.h"

namespace halfspace::HS_LANES {

/// Added to each luminance by log_average_luminance, because black has no logarithm.
inline constexpr float kMinLuminance = 1e-6f;

/// Returns exp of the mean of log(kMinLuminance + luminance) over all pixels (Reinhard et al. 2002, equation 1). The luminance is
/// clamped to [0, 65504], and NaN counts as 0. Tiles are summed in double in a fixed order, so the result does not depend on the
/// number of workers. The image must not be empty.
double log_average_luminance(const Image<U16Vec4>& light, const Workers& workers);
double log_average_luminance(const Image<glm::vec4>& light, const Workers& workers);

/// Returns the tone mapping of an image that is displayed with the given exposure.
ToneMapping tone_of(const PostDescription& post, double exposure);

inline const Image<glm::vec4> kNoUnlit;

/// Whether the colors of a pass are premultiplied by alpha. If so, they are divided by alpha before the tone curve is applied.
enum class Premultiplied : bool { no, yes };

/// Makes a pass write displayable pixel values to `picture`, as specified by `post` but with the given `exposure`. The color attachment of
/// the pass must hold linear light. unlit: the result of a pass with the draws of unlit_layer() (unlit_layer.h), or an empty image. The
/// images must have the size of the pass and outlive it.
void show(Pass& pass, const PostDescription& post, double exposure, Image<glm::u8vec4>& picture,
          Premultiplied premultiplied = Premultiplied::no, const Image<glm::vec4>& unlit = kNoUnlit);

/// Like show(), but writes encoded values in [0, 1] that are neither rounded nor dithered.
void show_fine(Pass& pass, const PostDescription& post, double exposure, Image<glm::vec4>& encoded, Premultiplied premultiplied,
               const Image<glm::vec4>& unlit = kNoUnlit);

/// Makes a pass write linear color with straight alpha to `light`. The colors of the pass must be premultiplied.
void show_light(Pass& pass, Image<glm::vec4>& light);

}  // namespace halfspace::HS_LANES
