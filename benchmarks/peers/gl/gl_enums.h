// SPDX-License-Identifier: Apache-2.0
//
// Converts the enumerations of a draw state to OpenGL constants. Also used by tests/mesa.
#pragma once

#include <epoxy/gl.h>

#include <array>
#include <cstddef>

#include "halfspace/raster/draw_state.h"

namespace halfspace {

inline GLenum gl(Topology t) {
  constexpr std::array<GLenum, 12> k{GL_TRIANGLES,
                                     GL_TRIANGLE_STRIP,
                                     GL_TRIANGLE_FAN,
                                     GL_POINTS,
                                     GL_LINES,
                                     GL_LINE_STRIP,
                                     GL_LINE_LOOP,
                                     GL_LINES_ADJACENCY,
                                     GL_LINE_STRIP_ADJACENCY,
                                     GL_TRIANGLES_ADJACENCY,
                                     GL_TRIANGLE_STRIP_ADJACENCY,
                                     GL_PATCHES};
  return k[static_cast<std::size_t>(t)];
}

inline GLenum gl(CompareOp op) {
  constexpr std::array<GLenum, 8> k{GL_NEVER, GL_LESS, GL_EQUAL, GL_LEQUAL, GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
  return k[static_cast<std::size_t>(op)];
}

inline GLenum gl(StencilOp op) {
  constexpr std::array<GLenum, 8> k{GL_KEEP, GL_ZERO, GL_REPLACE, GL_INCR, GL_DECR, GL_INVERT, GL_INCR_WRAP, GL_DECR_WRAP};
  return k[static_cast<std::size_t>(op)];
}

inline GLenum gl(BlendFactor f) {
  constexpr std::array<GLenum, 19> k{GL_ZERO,
                                     GL_ONE,
                                     GL_SRC_COLOR,
                                     GL_ONE_MINUS_SRC_COLOR,
                                     GL_DST_COLOR,
                                     GL_ONE_MINUS_DST_COLOR,
                                     GL_SRC_ALPHA,
                                     GL_ONE_MINUS_SRC_ALPHA,
                                     GL_DST_ALPHA,
                                     GL_ONE_MINUS_DST_ALPHA,
                                     GL_CONSTANT_COLOR,
                                     GL_ONE_MINUS_CONSTANT_COLOR,
                                     GL_CONSTANT_ALPHA,
                                     GL_ONE_MINUS_CONSTANT_ALPHA,
                                     GL_SRC_ALPHA_SATURATE,
                                     GL_SRC1_COLOR,
                                     GL_ONE_MINUS_SRC1_COLOR,
                                     GL_SRC1_ALPHA,
                                     GL_ONE_MINUS_SRC1_ALPHA};
  return k[static_cast<std::size_t>(f)];
}

inline GLenum gl(BlendEquation e) {
  constexpr std::array<GLenum, 5> k{GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX};
  return k[static_cast<std::size_t>(e)];
}

}  // namespace halfspace
