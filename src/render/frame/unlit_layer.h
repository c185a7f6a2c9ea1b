// SPDX-License-Identifier: Apache-2.0
//
// Surfaces without lighting (KHR_materials_unlit, illum 0, shading none, points and lines) show their color as it is: exposure and tone
// curve apply to light only. A second pass draws these surfaces alone. The post step subtracts their color from the light of the frame,
// converts the rest, and adds the color again, each weighted by the part of the pixel that it covers:
//
//   display = (a − u) · tone((T − U) / (a − u)) + U
//
// T: light of the frame; U: color of its unlit surfaces, with coverage u; a: coverage of all surfaces, 1 unless the background is
// transparent. T, U and the result are premultiplied. Where a pixel is unlit as a whole, u = a, and the result is U exactly.
#pragma once

#include <vector>

#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// Returns whether the picture differs from one in which all surfaces are lit: a draw is unlit, and light is converted for display.
bool separates_unlit(const PreparedScene& scene);

/// Returns the draws of a pass whose result is U, with u as alpha, if it is cleared to 0. Lit surfaces hide what is behind them, without
/// being shaded.
std::vector<PreparedDraw> unlit_layer(const PreparedScene& scene);

}  // namespace halfspace::HS_LANES
