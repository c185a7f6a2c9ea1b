// SPDX-License-Identifier: Apache-2.0
//
// Positions, radii and colors of the spheres in a particle system, generated or read from a file.
#pragma once

#include <filesystem>
#include <vector>

#include "halfspace/core/vec.h"
#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

/// Spheres in structure-of-arrays layout, one element per sphere.
struct Particles {
  std::vector<glm::dvec3> centers_ws;
  std::vector<float> radii;       ///< units
  std::vector<glm::vec3> colors;  ///< linear
};

/// Returns the radius of generated spheres: p.radius if it is not 0. Otherwise it is a fifth of p.orbit_radius for 12 spheres; for other
/// counts, it keeps the total volume the same. In a galaxy, which is flat, it is less than half of that.
double particle_radius(const ParticlesDescription& p);

/// Generates p.count spheres in the given arrangement. They are bit-identical on every machine. All are rotated by p.angle from x to z.
///   helix   heights y evenly spaced from −height/2 to height/2, at an angle of y radians and a distance of orbit_radius from the y axis
///   grid    a cube from −orbit_radius to orbit_radius, filled row by row
///   ball    uniformly random in a ball of radius orbit_radius
///   galaxy  a disk of radius orbit_radius with three spiral arms, in the plane y = 0
Particles make_particles(const ParticlesDescription& p);

/// Reads rows x,y,z[,radius[,r,g,b]] of numbers. Empty lines and lines that begin with # are ignored. The default radius is
/// particle_radius(p), and the default color is white. Throws InputError with the file, the line, the problem and what was expected.
Particles read_particles(const std::filesystem::path& path, const ParticlesDescription& p);

}  // namespace halfspace::HS_LANES
