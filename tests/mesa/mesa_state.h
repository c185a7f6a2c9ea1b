// SPDX-License-Identifier: Apache-2.0
//
// Translates draw states to OpenGL.
#pragma once

#include <epoxy/gl.h>

#include "mesa/mesa_draw.h"
#include "peers/gl/gl_enums.h"

namespace halfspace::test {

GLenum gl(TexelFormat format);
GLenum gl(TextureKind kind);

/// Calls glEnable or glDisable.
void enable(GLenum what, bool on);
/// Sets all context state that a draw to the target depends on; nothing from an earlier draw remains.
void set_state(const MesaDraw& draw, const TargetSpec& target);

}  // namespace halfspace::test
