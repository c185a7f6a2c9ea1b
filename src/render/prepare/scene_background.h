// SPDX-License-Identifier: Apache-2.0
//
// The background behind all objects.
#pragma once

#include <optional>

#include "halfspace/render/prepare/scene_environments.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/view.h"

namespace halfspace::HS_LANES {

/// Returns the color of a background of one color, with an alpha of 1.
glm::vec4 background_color(const BackgroundDescription& background);

/// Returns the draw of the background: one triangle behind everything. There is none if the background is the clear color.
std::optional<PreparedDraw> background_draw(const BackgroundDescription& background, const View& view, SceneEnvironments& environments);

}  // namespace halfspace::HS_LANES
