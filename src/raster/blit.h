// SPDX-License-Identifier: Apache-2.0
//
// Copies of rectangles of texels, with scaling, flips and conversion between formats, and resolves of stored samples (glBlitFramebuffer).
#pragma once

#include <cstdint>

#include "halfspace/core/parallel.h"
#include "halfspace/core/texel_view.h"
#include "halfspace/raster/draw_state.h"

namespace halfspace::HS_LANES {

enum class BlitFilter : uint8_t { nearest, linear };

/// Copies a rectangle of all layers of a view to a rectangle of another view (OpenGL 4.6, section 18.3.2). The rectangles are in texels,
/// row 0 of the view at the bottom. A negative width or height begins at the other corner: if only one of the two rectangles has it, the
/// copy is mirrored. Coordinates are mapped linearly, pixel centers to positions in the source. Linear filtering blends in linear light and
/// does not read texels outside of the source rectangle. Texels outside of `to`, and those whose source is outside of `from`, are left
/// out.
///
/// Integers are copied to integers with the same sign, which are clamped, and depth (with its stencil) to the same format; neither is
/// filtered. All other formats are converted to each other. If the formats are the same and nothing is filtered, the bits are the same.
/// The views must have the same number of layers, and the rectangles must not share memory. Violations fail an HS_CHECK. No coordinate or
/// size may be beyond ±2^20. The result does not depend on `workers`, which share the rows unless null.
void blit(const ConstTexelView& from, const Rect& from_rect, const TexelView& to, const Rect& to_rect,
          BlitFilter filter = BlitFilter::nearest, const Workers* workers = nullptr);

/// What is made of the samples of a pixel.
enum class ResolveMode : uint8_t {
  mean,      ///< in linear light, as at the end of a pass; not for integers and depth
  sample_0,  ///< the first sample, for all formats
  min,       ///< the smallest depth, with the stencil of its sample; only for depth
  max        ///< the greatest depth, with the stencil of its sample; only for depth
};

/// Makes one texel of all layers of a view, which are the samples of a multisampled target: 1, 2, 4 or 8. `to` must have the same size, one
/// layer and other memory. Formats can differ as in blit(), except for min and max. Violations fail an HS_CHECK.
void resolve(const ConstTexelView& samples, const TexelView& to, ResolveMode mode = ResolveMode::mean, const Workers* workers = nullptr);

}  // namespace halfspace::HS_LANES
