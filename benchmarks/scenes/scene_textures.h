// SPDX-License-Identifier: Apache-2.0
//
// Textures of the scenes. All repeat in both directions unless stated otherwise. Colors are display values, from 0 to 1.
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/procedural/patterns.h"

namespace halfspace {

using SceneTexels = Image<glm::u8vec4>;

struct TexelSize {
  int width, height;
};

/// Two colors mixed by noise with the given number of cells along each axis.
SceneTexels mottled(TexelSize size, glm::vec3 dark, glm::vec3 light, glm::ivec2 cells, int octaves, int seed);
/// Blocks in running bond with mortar. Each block has its own shade.
SceneTexels masonry(TexelSize size, glm::vec3 stone, glm::vec3 mortar, glm::ivec2 blocks, int seed);
/// Squares of two kinds of marble.
SceneTexels marble_tiles(TexelSize size, glm::vec3 a, glm::vec3 b, int squares);
/// Boards along v with grain and joints.
SceneTexels boards(TexelSize size, glm::vec3 dark, glm::vec3 light, int count, int seed);
/// Rows of round roof tiles.
SceneTexels roof_tiles(TexelSize size, glm::vec3 clay, glm::ivec2 tiles);
/// A carpet with borders at u = 0 and u = 1.
SceneTexels carpet(TexelSize size);
/// Gold stars on blue.
SceneTexels starry_vault(TexelSize size);
/// A lead frame and panes of colored glass, which are translucent. Does not repeat.
SceneTexels stained_glass(TexelSize size, int seed);
/// The sky from the horizon (row 0) to the zenith. Repeats along u.
SceneTexels cloudy_sky(TexelSize size, glm::vec3 horizon, glm::vec3 zenith);
/// One of the patterns of procedural_pattern.
SceneTexels natural(Pattern pattern, int width, float brightness = 1.0f);

/// Textures with an alpha of 0 or 1, apart from the edges.
/// A lattice of bars, upright or turned by 45 degrees.
SceneTexels lattice(TexelSize size, glm::vec3 metal, int bars, float bar_width, bool is_diagonal);
/// A twig with leaves. Does not repeat.
SceneTexels leaves(TexelSize size, glm::vec3 dark, glm::vec3 light, int count, double length, int seed);
/// A tuft of blades that grow upwards from row `height`. Does not repeat.
SceneTexels blades(TexelSize size, glm::vec3 dark, glm::vec3 light, int count, int seed);
/// Flower heads on stalks. Does not repeat.
SceneTexels flowers(TexelSize size, glm::vec3 petals, glm::vec3 leaf, int seed);

}  // namespace halfspace
