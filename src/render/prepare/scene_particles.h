// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "halfspace/render/assets/used_assets.h"
#include "halfspace/render/particles.h"

namespace halfspace::HS_LANES {

/// Returns the spheres of a particle system, read from its file or generated, or null if it has none. path: the path of the system, for
/// error messages.
std::shared_ptr<const Particles> scene_particles(const ParticlesDescription& p, const std::string& path, UsedAssets& used);

}  // namespace halfspace::HS_LANES
