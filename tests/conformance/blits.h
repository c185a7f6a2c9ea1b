// SPDX-License-Identifier: Apache-2.0
//
// Blits and resolves as plain data: formats, sizes, rectangles and filters. blit() and resolve(), a reference in double precision and Mesa
// (tests/mesa) copy the same texels.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "halfspace/raster/blit.h"
#include "halfspace/shading/texture/texture_memory.h"

namespace halfspace::conformance::blits {

struct BlitCase {
  std::string name;
  TexelFormat from = TexelFormat::rgba8, to = TexelFormat::rgba8;
  TextureSize from_size{24, 16}, to_size{32, 20};  ///< the depth is the number of layers, or of samples that are resolved
  Rect from_rect{0, 0, 24, 16}, to_rect{0, 0, 32, 20};
  BlitFilter filter = BlitFilter::nearest;
  std::optional<ResolveMode> resolve{};  ///< the rectangles and the filter have no effect
  bool flipped = false;                  ///< the destination begins with its top row, as windows and files do
  bool outside = false;                  ///< no texel is written
  const char* not_by_mesa = nullptr;     ///< reason why Mesa's texels are not comparable
};
using BlitCases = std::vector<BlitCase>;

/// A texel of the destination. Of depth formats, the first channel is the depth and the second one the stencil.
struct Texel {
  glm::dvec4 value{0.0};
  glm::dvec4 step{0.0};   ///< distance between neighboring values of the format
  glm::dvec4 error{0.0};  ///< of the value before it is rounded to the format
  bool written = false;   ///< else it keeps its bytes, which are 0
  bool varies = false;    ///< other implementations may select other texels: see texels_in_double()
};

/// The source: all codes of its format, or floats of magnitudes 1/4 to 4.
void fill_source(TextureMemory& from);
int compared_channels(TexelFormat format);
glm::dvec4 value_of(TexelFormat format, const std::byte* texel);

/// The texels of the destination in double precision (OpenGL 4.6, section 18.3.2), layer by layer and row by row. OpenGL leaves to the
/// implementation what is copied from outside of the source, and which texel is the nearest one to a position between two. Texels that are
/// filtered at the sides of the source rectangle vary as well, because llvmpipe reads beyond the rectangle.
std::vector<Texel> texels_in_double(const BlitCase& c, TextureMemory& from);
void run(const BlitCase& c, TextureMemory& from, TextureMemory& to);

/// Compares blit() or resolve() with the reference. Returns the difference; empty if there is none.
std::string check(const BlitCase& c);

BlitCases blit_cases();

}  // namespace halfspace::conformance::blits
