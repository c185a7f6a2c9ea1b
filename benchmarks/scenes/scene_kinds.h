// SPDX-License-Identifier: Apache-2.0
//
// The generators of the scenes.
#pragma once

#include "scenes/scene.h"

namespace halfspace {

Scene make_hall();
Scene make_garden();
Scene make_workshop();

/// A town of columns x rows houses with 20,000 triangles on average.
struct TownSize {
  int columns, rows;
};
inline constexpr TownSize kTownSize{10, 10};
Scene make_street(TownSize town);

/// Triangles of the statue, or of each model.
inline constexpr int kDetailTriangles = 1'000'000, kTurnTriangles = 200'000, kFarTriangles = 200'000;
Scene make_detail(int triangles);
/// The cameras stand in a circle around the statue.
Scene make_turn(int triangles);
/// Five models, each drawn eight times.
Scene make_far(int triangles);

Scene make_leaves();

}  // namespace halfspace
