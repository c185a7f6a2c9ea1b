// SPDX-License-Identifier: Apache-2.0
//
// The trace of a pass: what the pipeline did with every fragment. A fragment is one sample of one triangle, point or line.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "halfspace/raster/target.h"

namespace halfspace::HS_LANES {

/// The outcome of a fragment.
enum class FragmentOutcome : uint8_t {
  tile_rejected,          ///< hierarchical Z: the primitive cannot pass the depth test anywhere in the tile
  block_rejected,         ///< hierarchical Z: the primitive cannot pass the depth test anywhere in the block of 8x8 pixels
  depth_failed,           ///< failed the depth test
  stencil_failed,         ///< failed the stencil test
  discarded,              ///< the shader discarded it, or its alpha did not cover the sample
  hidden_before_shading,  ///< passed, but a later primitive replaced it before it was shaded
  depth_only,             ///< passed; the draw writes no color
  shaded,                 ///< shaded; its color replaced that of the sample
  blended,                ///< shaded and blended with the color of the sample
  layered,                ///< shaded and kept as a transparent layer; the sorted layers are blended when all are known
  layer_merged            ///< layered, but the sample already had the maximum number of layers, so its two farthest layers were merged
};
inline constexpr std::size_t kFragmentOutcomes = 11;

/// A fragment, with the values that the pipeline computed for it. Depths are window depths, or integer values for d16 and d24.
struct TracedFragment {
  uint32_t id = 0;         ///< TriangleId, valid within its round
  uint32_t draw = 0;       ///< index of the draw, in the order of the Pass::draw() calls
  uint32_t instance = 0;   ///< instance of the draw
  uint32_t primitive = 0;  ///< index of the triangle, point or line in the draw, in submission order
  uint16_t round = 0;      ///< tiles are drawn in several rounds if the memory exceeds PassTuning::bin_budget
  uint8_t sample = 0;
  FragmentOutcome outcome = FragmentOutcome::hidden_before_shading;
  bool is_tested = false;     ///< the depth was tested
  bool is_shaded = false;     ///< the fragment function ran
  float depth = 0.0f;         ///< depth of the fragment
  float tested_depth = 0.0f;  ///< the tested depth: `depth`, or the nearest depth of the primitive for block_rejected and tile_rejected
  float stored_depth = 0.0f;  ///< the depth that tested_depth was compared with: of the sample, or the farthest of the block or tile
  glm::vec4 color{0.0f};      ///< output of the fragment function, linear with straight alpha; 0 if !is_shaded
  glm::vec4 value{0.0f};      ///< linear color of the sample after this fragment; 0 if the fragment did not change it
};

/// The fragments of a tile, in submission order for each pixel.
struct TileFragments {
  int x0 = 0, y0 = 0, width = 0, height = 0;  ///< in window coordinates, from the lower left
  std::vector<uint32_t> first;                ///< width · height + 1 offsets into `fragments`, by row from the lower left
  std::vector<TracedFragment> fragments;
};

/// The trace of a pass.
struct PassTrace {
  int width = 0, height = 0, samples = 1;
  ColorFormat format = ColorFormat::none;          ///< format of the first attachment
  std::vector<std::vector<TileFragments>> rounds;  ///< for each round, the fragments of each tile
  /// Linear color of each sample of each pixel at the end of the pass, before resolving, row by row from the upper left.
  std::vector<glm::vec4> values;
  /// Linear color of each pixel after resolving, rounded to the format of the attachment.
  std::vector<glm::vec4> resolved;
};

}  // namespace halfspace::HS_LANES
