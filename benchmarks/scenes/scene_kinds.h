// SPDX-License-Identifier: Apache-2.0
//
// The generators of the scenes.
#pragma once

#include "scenes/scene.h"

namespace halfspace {

Scene make_hall();
Scene make_garden();
Scene make_workshop();

}  // namespace halfspace
