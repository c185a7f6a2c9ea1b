// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/scene_particles.h"

namespace halfspace::HS_LANES {

std::shared_ptr<const Particles> scene_particles(const ParticlesDescription& p, const std::string& path, UsedAssets& used) {
  if (!p.file.path.empty()) {
    return used.asset<Particles>(recipe("particles", p.file.path.string(), p.radius, p.orbit_radius),
                                 [&] { return read_for(path + ".file", [&] { return read_particles(p.file.path, p); }); });
  }
  return p.count == 0 ? nullptr : std::make_shared<const Particles>(make_particles(p));
}

}  // namespace halfspace::HS_LANES
