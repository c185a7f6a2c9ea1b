// SPDX-License-Identifier: Apache-2.0
//
// The color formats by their definitions (OpenGL 4.6, sections 2.3.4 and 2.3.5), in double. Input and output: the bytes of one texel.
#pragma once

#include <cstddef>

#include "halfspace/core/texel_format.h"

#include <glm/glm.hpp>

namespace halfspace::oracle {

/// Return a texel as a color, and store the nearest one. Channels that the format does not have are 0, and alpha 1. Integers are the bits
/// of floats.
glm::vec4 read_texel(TexelFormat format, const std::byte* texel);
void write_texel(TexelFormat format, const glm::vec4& color, std::byte* texel);

}  // namespace halfspace::oracle
