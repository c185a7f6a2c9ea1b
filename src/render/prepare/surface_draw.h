// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// Returns the draw of a lit surface with the shader variant that has the minimum features it needs.
PreparedDraw surface_draw(const LitSurface& s, ShadingRate rate, NormalDetail detail, const MeshStreams& mesh,
                          const std::shared_ptr<const Indices>& indices);

}  // namespace halfspace::HS_LANES
