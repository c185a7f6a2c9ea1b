// SPDX-License-Identifier: Apache-2.0
//
// Translates the state of a Halfspace draw call to OpenGL.
#pragma once

#include <epoxy/gl.h>

#include "halfspace/raster/draw_state.h"
#include "halfspace/raster/target.h"
#include "halfspace/shading/texture/sampler.h"

namespace halfspace {

/// Sets the complete state. has_depth: the framebuffer has a depth buffer.
void set_gl_state(const DrawState& state, bool has_depth);
GLenum gl_color_format(ColorFormat f);
GLenum gl_depth_format(DepthFormat f);  ///< 0 for none
/// Sets filters, wrap modes and anisotropy of the bound texture.
void set_gl_sampler(const Sampler& s, bool has_levels);

}  // namespace halfspace
