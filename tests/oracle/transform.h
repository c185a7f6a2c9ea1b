// SPDX-License-Identifier: Apache-2.0
//
// From clip space to the window. Input: the output of the vertex function. Output: corners in the window, and whether a primitive is
// outside of the view volume or must be clipped.
#pragma once

#include <array>
#include <cstdint>

#include "halfspace/raster/draw_state.h"
#include "oracle/shader_data.h"
#include "oracle/window.h"

namespace halfspace::oracle {

inline constexpr float kMinW = 0x1p-96f;  ///< smallest w of a vertex that is not clipped

/// Maps clip space to the window for one viewport and depth range.
struct Transform {
  float half_width, half_height, center_x, center_y;
  float z_scale, z_bias;
  float left, right, bottom, top;  ///< the guard band in units of w
};

/// The transform of a draw to a target of this size. Viewports with fractions of a pixel are clipped at their sides if there are several
/// samples, if they are filled triangles.
Transform make_transform(const DrawState& s, int width, int height, int samples);

/// Rounds x/w·half + center to the nearest multiple of 1/256 px.
int64_t snap(float x, float w, float half, float center);
Corner project(const Transform& t, const ShadedVertex& v);

/// Whether the position and the clip distances of a vertex are finite.
bool is_finite(const ShadedVertex& v);

bool beyond_near(const DepthState& d, const glm::vec4& p);
bool beyond_far(const glm::vec4& p);
bool needs_clip(const Transform& t, const DepthState& d, const glm::vec4& p);

/// Returns whether all three vertices are outside of the same plane of the view volume.
bool all_outside(const DepthState& d, const std::array<const ShadedVertex*, 3>& v);

}  // namespace halfspace::oracle
