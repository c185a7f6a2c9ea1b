// SPDX-License-Identifier: Apache-2.0
//
// The end of a picture: how bright it is on the whole, and its light as codes.
#pragma once

#include "halfspace/raster/pass.h"
#include "halfspace/scene/description.h"

namespace halfspace {

/// What log_average_luminance adds to each luminance: black has no logarithm.
inline constexpr float kMinLuminance = 1e-6f;

/// exp of the mean of log(kMinLuminance + luminance) over all pixels (Reinhard et al. 2002, equation 1). A luminance that is
/// NaN or below 0 counts as 0, one above 65504 as that. Summed in double, tile by tile in their order, so that the bits do
/// not depend on the workers. Pixels are halfs or floats; at least one.
double log_average_luminance(const Image<U16Vec4>& light, const Workers& workers);
double log_average_luminance(const Image<glm::vec4>& light, const Workers& workers);

/// Has the pass, whose colour is light, end in the picture's codes as `post` says, with its exposure replaced. The picture must
/// be the pass's size and outlive it.
void show(Pass& pass, const PostDescription& post, double exposure, Image<glm::u8vec4>& picture);

}  // namespace halfspace
