// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "halfspace/render/prepared_scene.h"

namespace halfspace::HS_LANES {

/// Returns the draw of a lit surface with the shader variant that has the minimum features it needs. Surfaces that are not opaque are
/// drawn as transparent layers.
PreparedDraw surface_draw(const LitSurface& s, ShadingRate rate, NormalDetail detail, const MeshStreams& mesh,
                          const std::shared_ptr<const Indices>& indices);

/// Returns how a surface covers the texels of shadow maps: nullopt if it is opaque.
std::optional<OpacityTest> shadow_opacity(const LitSurface& s);

}  // namespace halfspace::HS_LANES
