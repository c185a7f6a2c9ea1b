// SPDX-License-Identifier: Apache-2.0
//
// Where the spheres of a scene's particles are: generated, or read from a file.
#pragma once

#include <filesystem>
#include <vector>

#include "halfspace/core/vec.h"
#include "halfspace/scene/description.h"

namespace halfspace {

/// Spheres, one a row.
struct Particles {
  std::vector<glm::dvec3> centers_ws;
  std::vector<float> radii;       ///< units
  std::vector<glm::vec3> colors;  ///< linear
};

/// The radius of generated spheres: p.radius, or where that is 0 a fifth of p.orbit_radius for 12 spheres, and for more or fewer
/// what keeps the volume of all; in a galaxy, which is flat, less than half as much.
double particle_radius(const ParticlesDescription& p);

/// p.count spheres as p.arrangement says, the same on every machine; all turned by p.angle from x to z:
///   helix   heights y evenly from −height/2 to height/2, at the angle of y radians, orbit_radius from the y axis
///   grid    a cube of rows, from −orbit_radius to orbit_radius, filled row by row
///   ball    at random, evenly in a ball of orbit_radius
///   galaxy  a disk of orbit_radius with three spiral arms, in the plane y = 0
Particles make_particles(const ParticlesDescription& p);

/// Rows x,y,z[,radius[,r,g,b]] of numbers; empty lines and lines that begin with # count for nothing. A row without a radius has
/// that of p (particle_radius), one without a colour is white. Throws InputError: file, line, what is wrong, what would be right.
Particles read_particles(const std::filesystem::path& path, const ParticlesDescription& p);

}  // namespace halfspace
