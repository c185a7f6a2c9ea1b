// SPDX-License-Identifier: Apache-2.0
//
// Random scenes with all kinds of difficult triangles, and with random states.
#pragma once

#include "property/scene.h"
#include "support/random.h"

namespace halfspace {

/// The main feature that a scene tests.
enum class Theme {
  opaque,
  blended,
  discarding,
  depth_writing,
  faces,
  clipped,
  many_draws,
  primitives,
  operations,
  samples,
  points,
  lines,
  geometry
};
inline constexpr Theme kThemes[] = {Theme::opaque,  Theme::blended,    Theme::discarding, Theme::depth_writing, Theme::faces,
                                    Theme::clipped, Theme::many_draws, Theme::primitives, Theme::operations,    Theme::samples,
                                    Theme::points,  Theme::lines,      Theme::geometry};
inline constexpr const char* kThemeNames[] = {"Opaque",     "Blended",    "Discarding", "DepthWriting", "Faces", "Clipped", "ManyDraws",
                                              "Primitives", "Operations", "Samples",    "Points",       "Lines", "Geometry"};

/// Returns the scene for a seed. It is identical on every machine and compiler.
Scene random_scene(Theme theme, uint64_t seed);

/// Positions in clip space and the indices of triangles.
struct Geometry {
  std::vector<glm::vec4> positions;
  std::vector<uint32_t> indices;
};

/// Kinds of random triangles.
enum class Kind {
  tiny,
  small,
  medium,
  huge,
  beyond_guard,
  sliver,
  degenerate,
  on_the_grid,
  behind_the_eye,
  non_finite,
  whole_target,
  steep,
  tiny_w,
  fan,
  mesh,
  crossing_depth,
  about_63_px
};
inline constexpr int kKinds = 17;

/// Adds triangles of a kind to a viewport.
void add_triangles(Kind kind, const Rect& viewport, ClipDepth clip, Random& random, Geometry& out);

}  // namespace halfspace
