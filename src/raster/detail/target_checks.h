// SPDX-License-Identifier: Apache-2.0
//
// Checks of the targets of a pass: sizes, samples, pitches, and memory that two of them share. A failed check is one line.
#pragma once

#include <cstdlib>

#include "halfspace/core/check.h"
#include "halfspace/raster/pipeline/pipeline_data.h"
#include "halfspace/raster/target.h"
#include "halfspace/raster/tile/texel_overlap.h"

namespace halfspace::HS_LANES::detail {

/// Largest width and height of a target, in pixels.
inline constexpr int kMaxTargetSize = static_cast<int>(kGuardBand);

/// Returns whether the contents of the image are read at the start of the pass.
inline bool loads(const ColorTarget& target) { return target.load == LoadOp::load; }
inline bool loads(const DepthTarget& target) { return target.load == LoadOp::load || stencil_load_of(target) == LoadOp::load; }

/// Returns whether a pass can draw to a format.
inline bool can_be_drawn(ColorFormat format) { return !is_depth(format) && format != ColorFormat::rgb9_e5; }

/// Largest number of layers of a pass.
inline constexpr int kMaxLayers = 2048;

/// Checks that the image of a target has the size of the pass, width x height pixels with 1 or `samples` values, and its layers, or is not
/// needed.
template <class Target>
void check_target(const Target& target, int width, int height, int samples, int layers) {
  HS_CHECK(target.data != nullptr || (!loads(target) && !is_stored(target)),
           "target: it has no image, but is loaded or stored; expected an image, or clear and dont_care");
  if (target.data == nullptr) return;
  HS_CHECK(loads(target) || is_stored(target), "target: its image is neither loaded nor stored; expected StoreOp::store, or no image");
  HS_CHECK_OP(target.width, ==, width, "target: its image has another width than the pass; expected an image of the size of the pass");
  HS_CHECK_OP(target.height, ==, height, "target: its image has another height than the pass; expected an image of the size of the pass");
  HS_CHECK(target.samples == 1 || target.samples == samples,
           "target: its image has another number of samples than the pass; expected 1 or the samples of the pass");
  HS_CHECK_OP(target.layers, ==, layers, "target: it has another number of layers than the pass; expected those of PassOptions::layers");
  HS_CHECK(target.layers == 1 || target.samples == 1, "target: its image has layers and stored samples; expected one of the two");
  const TexelView texels = target_texels(target);
  HS_CHECK_OP(std::abs(texels.row_pitch), >=, std::ptrdiff_t{width} * bytes_per_pixel(target.format),
              "target: the row pitch is smaller than a row; expected at least the width times the bytes of a pixel, or 0");
  HS_CHECK(!has_overlapping_layers(texels), "target: the images of its samples or layers overlap; expected a pitch of at least an image");
}

/// Checks that no target is stored to memory of another one that is loaded or stored.
template <class A, class B>
void check_overlap(const A& a, const B& b) {
  const auto is_used = [](const auto& target) { return target.data != nullptr && (is_stored(target) || loads(target)); };
  if (!is_used(a) || !is_used(b) || (!is_stored(a) && !is_stored(b))) return;
  HS_CHECK(!overlap(target_texels(a), target_texels(b)),
           "Pass: two targets use the same memory, and one of them is stored; expected an image of its own for each target");
}

}  // namespace halfspace::HS_LANES::detail
