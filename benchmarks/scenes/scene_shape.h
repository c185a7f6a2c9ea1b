// SPDX-License-Identifier: Apache-2.0
//
// Shapes that the scenes are composed of. Lengths are in meters, y is up, and front faces are counter-clockwise. Angles are in turns.
#pragma once

#include <functional>
#include <span>

#include "scenes/scene.h"

namespace halfspace {

struct SceneShape {
  std::vector<SceneVertex> vertices;
  std::vector<uint32_t> indices;
};

/// Adds a grid of columns x rows quads over the unit square. `point` maps (u, v) to a position, and must also be defined slightly outside
/// the square. The front side faces the direction of ∂point/∂u x ∂point/∂v. Texture coordinates are (u, v) times `repeats`.
using SurfaceFunction = std::function<glm::dvec3(double u, double v)>;
void add_surface(SceneShape& shape, int columns, int rows, glm::dvec2 repeats, const SurfaceFunction& point);

/// Adds an axis-aligned box. Texture coordinates are in units of 1/scale meters.
void add_box(SceneShape& shape, glm::dvec3 center, glm::dvec3 size, double scale = 1.0);

/// Adds a surface of revolution around the y axis. The profile lists (radius, y), from the bottom to the top on the outside. Creases stay
/// sharp, unless `smooth` is set.
void add_lathe(SceneShape& shape, std::span<const glm::dvec2> profile, int sectors, glm::dvec2 repeats = {1, 1}, bool smooth = false);

/// Adds a tube around a curve, from v = 0 to v = 1. The curve must not be parallel to z.
void add_tube(SceneShape& shape, int sectors, int rows, glm::dvec2 repeats, const std::function<glm::dvec3(double v)>& curve,
              const std::function<double(double v)>& radius);

/// Adds a ring around the y axis.
void add_torus(SceneShape& shape, glm::dvec3 center, double radius, double tube, int sectors, int bands);

/// Adds a rectangle with the corners center ± right ± up and a single normal.
void add_card(SceneShape& shape, glm::dvec3 center, glm::dvec3 right, glm::dvec3 up, glm::dvec3 normal);

/// A wall in the plane z = 0, centered at x = 0 and standing on y = 0, with an opening that ends in a semicircle.
struct ArchedWall {
  double width, height, thickness;
  double radius;  ///< radius of the arch; half the width of the opening
  double base;    ///< y of the lower end of the opening
  double spring;  ///< y of the lower end of the semicircle
};
void add_arched_wall(SceneShape& shape, const ArchedWall& wall, double scale = 0.5);

/// Adds a copy of `part`, transformed.
void add_shape(SceneShape& shape, const SceneShape& part, const glm::dmat4& transform);

/// Returns a matrix that scales, rotates around the y axis and then translates. Normals stay correct only if the scale is uniform, or if
/// the shape is an axis-aligned box, or an upright cylinder with equal scales in x and z.
glm::dmat4 placed(glm::dvec3 position, double turns = 0.0, glm::dvec3 scale = glm::dvec3(1.0));
/// Returns a rotation around the x axis or the z axis.
glm::dmat4 turned_x(double turns);
glm::dmat4 turned_z(double turns);

std::size_t add_mesh(Scene& scene, const SceneShape& shape);
std::size_t add_texture(Scene& scene, const Image<glm::u8vec4>& image);
std::size_t add_material(Scene& scene, const SceneMaterial& material);
/// Adds an object.
void place(Scene& scene, std::size_t mesh, std::size_t material, const glm::dmat4& world_from_object = glm::dmat4(1.0));
/// Adds a mesh together with the only object that uses it.
void place(Scene& scene, const SceneShape& shape, std::size_t material, const glm::dmat4& world_from_object = glm::dmat4(1.0));

}  // namespace halfspace
