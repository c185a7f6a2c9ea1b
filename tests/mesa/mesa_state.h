// SPDX-License-Identifier: Apache-2.0
//
// Our states in OpenGL's words.
#pragma once

#include <epoxy/gl.h>

#include "mesa/mesa_draw.h"

namespace halfspace::test {

GLenum gl(Topology topology);
GLenum gl(ColorFormat format);
GLenum gl(DepthFormat format);

/// glEnable or glDisable.
void enable(GLenum what, bool on);
/// Sets all of the context's state that a draw into the target asks for; nothing of an earlier draw stays.
void set_state(const MesaDraw& draw, const TargetSpec& target);

}  // namespace halfspace::test
