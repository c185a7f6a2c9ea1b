// SPDX-License-Identifier: Apache-2.0
//
// The trace of a pass: what the pipeline did with every fragment. A fragment is one sample of one triangle, point or line.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "halfspace/raster/target.h"

namespace halfspace {

/// What became of a fragment.
enum class FragmentOutcome : uint8_t {
  tile_rejected,          ///< hierarchical Z: nothing of the primitive can pass in this tile
  block_rejected,         ///< hierarchical Z: nothing of the primitive can pass in this block of 8x8 pixels
  depth_failed,           ///< failed the depth test
  stencil_failed,         ///< failed the stencil test
  discarded,              ///< the shader discarded it, or its alpha did not cover the sample
  hidden_before_shading,  ///< passed, but a later primitive replaced it before it was shaded
  depth_only,             ///< passed; the draw writes no color
  shaded,                 ///< shaded; its color replaced that of the sample
  blended,                ///< shaded and blended with the color of the sample
  layered,                ///< shaded and kept as a transparent layer; layers are sorted and blended when all are known
  layer_merged            ///< the same, but the sample already had the maximum number of layers, so two of them were merged
};
inline constexpr std::size_t kFragmentOutcomes = 11;

/// A fragment, as far as the pipeline computed it. Depths are window depths, or integer codes for d16 and d24.
struct TracedFragment {
  uint32_t id = 0;         ///< TriangleId, valid in its round
  uint32_t draw = 0;       ///< in the order of Pass::draw() calls
  uint32_t instance = 0;   ///< of the draw
  uint32_t primitive = 0;  ///< triangle, point or line of the draw, in submission order
  uint16_t round = 0;      ///< the tiles are run several times if the bins exceed PassOptions::bin_budget
  uint8_t sample = 0;
  FragmentOutcome outcome = FragmentOutcome::hidden_before_shading;
  bool is_tested = false;     ///< there was a depth test
  bool is_shaded = false;     ///< the fragment function ran for it
  float depth = 0.0f;         ///< at the sample
  float tested_depth = 0.0f;  ///< what was compared: `depth`, or the nearest depth of the primitive for blocks and tiles
  float stored_depth = 0.0f;  ///< what it was compared with: the depth of the sample, or the farthest of the block or tile
  glm::vec4 color{0.0f};      ///< output of the fragment function: linear, with straight alpha. 0 if !is_shaded
  glm::vec4 value{0.0f};      ///< linear color of the sample afterwards. 0 if the fragment did not change it
};

/// The fragments of a tile, in submission order per pixel.
struct TileFragments {
  int x0 = 0, y0 = 0, width = 0, height = 0;  ///< in window coordinates, from the lower left
  std::vector<uint32_t> first;                ///< width · height + 1 offsets into `fragments`, by row from the lower left
  std::vector<TracedFragment> fragments;
};

/// The trace of a pass.
struct PassTrace {
  int width = 0, height = 0, samples = 1;
  ColorFormat format = ColorFormat::none;          ///< of the first attachment
  std::vector<std::vector<TileFragments>> rounds;  ///< one element per tile, in each round
  /// Linear color of each sample of each pixel at the end of the pass, before samples are resolved. By row from the upper left.
  std::vector<glm::vec4> values;
  /// Linear color of each pixel after its samples were resolved, as stored by the format of the attachment.
  std::vector<glm::vec4> resolved;
};

}  // namespace halfspace
