// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// Returns the draw of the vertex normals of a mesh of triangles as lines. mesh: the origin of its own draw. length: see
/// ObjectDescription::normal_lines.
PreparedDraw normal_lines(const DrawSource& mesh, const std::shared_ptr<const Indices>& indices, const View& view, double length);

}  // namespace halfspace::HS_LANES
