// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/shapes.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "halfspace/scene/kind_table.h"
#include "halfspace/scene/shape_tessellation.h"

namespace halfspace::HS_LANES {

namespace {

using std::numbers::pi;
using Object = ObjectDescription;

// ---- counts ----------------------------------------------------------------------------------------------------

int64_t no_vertices(const Object&) { return 0; }
int64_t one_vertex(const Object&) { return 1; }
int64_t grid_vertices(const Object& o) { return int64_t{o.latitudes} * o.longitudes; }
int64_t cone_vertices(const Object& o) { return 2 * grid_vertices(o); }
int64_t cylinder_vertices(const Object& o) { return 3 * grid_vertices(o); }
int64_t icosphere_vertices(const Object& o) { return 10 * (int64_t{1} << (2 * o.level)) + 2; }
int64_t plane_vertices(const Object& o) { return int64_t{o.segments + 1} * (o.segments + 1); }
int64_t cube_vertices(const Object& o) { return 6 * plane_vertices(o); }

int sectors(const Object& o) { return o.longitudes; }
int segments(const Object& o) { return std::max(o.segments, 2); }
int icosphere_columns(const Object& o) { return 5 << o.level; }

// ---- sizes -----------------------------------------------------------------------------------------------------

double around(double radius) { return 2.0 * pi * radius; }

ShapeExtent no_extent(const Object&) { return {0.0, 0.0}; }
ShapeExtent ball_extent(const Object& o) { return {around(o.radius), o.radius}; }
ShapeExtent plane_extent(const Object& o) { return {o.size, o.size * std::numbers::sqrt2 / 2.0}; }
ShapeExtent cube_extent(const Object& o) { return {o.size, o.size * std::numbers::sqrt3 / 2.0}; }
ShapeExtent cylinder_extent(const Object& o) { return {around(o.radius), glm::length(glm::dvec2(o.radius, 0.5 * o.length))}; }
ShapeExtent torus_extent(const Object& o) { return {around(o.radius + o.tube), o.radius + o.tube}; }
ShapeExtent knot_extent(const Object& o) { return {around(3.0 * o.radius), 1.4 * o.radius + o.tube}; }  // the knot is about 3 circles long

double no_length(const Object&) { return 0.0; }
double radius(const Object& o) { return o.radius; }
double tube(const Object& o) { return o.tube; }
double half_size(const Object& o) { return 0.5 * o.size; }

// ---- table -----------------------------------------------------------------------------------------------------

constexpr ShapeKind kKinds[]{
    {.shape = Shape::uv_sphere,
     .name = "uv_sphere",
     .keys = "radius latitudes longitudes mesh_error normals",
     .is_ring = false,
     .has_flat_faces = false,
     .is_sphere_mesh = true,
     .max_parts = 1536,
     .vertices = grid_vertices,
     .extent = ball_extent,
     .thickness = radius,
     .columns = sectors,
     .chord_error = sphere_chord_error,
     .diagonal_angle = sphere_angle,
     .set_parts = sphere_parts},
    {.shape = Shape::icosphere,
     .name = "icosphere",
     .keys = "radius level tiles_u tiles_v",
     .is_ring = false,
     .has_flat_faces = false,
     .is_sphere_mesh = true,
     .max_parts = 1 << 8,
     .vertices = icosphere_vertices,
     .extent = ball_extent,
     .thickness = radius,
     .columns = icosphere_columns,
     .chord_error = icosphere_chord_error,
     .diagonal_angle = icosphere_angle,
     .set_parts = icosphere_parts},
    {.shape = Shape::sphere,
     .name = "sphere",
     .keys = "radius",
     .is_ring = false,
     .has_flat_faces = false,
     .is_sphere_mesh = false,
     .max_parts = 1,
     .vertices = one_vertex,
     .extent = ball_extent,
     .thickness = radius,
     .columns = sectors,
     .chord_error = no_length,
     .diagonal_angle = no_length,
     .set_parts = no_parts},
    {.shape = Shape::plane,
     .name = "plane",
     .keys = "size segments mesh_error tiles_u tiles_v shadow_only",
     .is_ring = false,
     .has_flat_faces = true,
     .is_sphere_mesh = false,
     .max_parts = 1024,
     .vertices = plane_vertices,
     .extent = plane_extent,
     .thickness = no_length,
     .columns = segments,
     .chord_error = no_length,
     .diagonal_angle = no_length,
     .set_parts = edge_parts},
    {.shape = Shape::cube,
     .name = "cube",
     .keys = "size segments tiles_u tiles_v",
     .is_ring = false,
     .has_flat_faces = true,
     .is_sphere_mesh = false,
     .max_parts = 1024,
     .vertices = cube_vertices,
     .extent = cube_extent,
     .thickness = half_size,
     .columns = segments,
     .chord_error = no_length,
     .diagonal_angle = no_length,
     .set_parts = edge_parts},
    {.shape = Shape::cylinder,
     .name = "cylinder",
     .keys = "radius length latitudes longitudes tiles_u tiles_v",
     .is_ring = false,
     .has_flat_faces = false,
     .is_sphere_mesh = false,
     .max_parts = 8192,
     .vertices = cylinder_vertices,
     .extent = cylinder_extent,
     .thickness = radius,
     .columns = sectors,
     .chord_error = cone_chord_error,
     .diagonal_angle = cone_angle,
     .set_parts = cylinder_parts},
    {.shape = Shape::cone,
     .name = "cone",
     .keys = "radius length latitudes longitudes tiles_u tiles_v",
     .is_ring = false,
     .has_flat_faces = false,
     .is_sphere_mesh = false,
     .max_parts = 8192,
     .vertices = cone_vertices,
     .extent = cylinder_extent,
     .thickness = radius,
     .columns = sectors,
     .chord_error = cone_chord_error,
     .diagonal_angle = cone_angle,
     .set_parts = cone_parts},
    {.shape = Shape::torus,
     .name = "torus",
     .keys = "radius tube latitudes longitudes mesh_error tiles_u tiles_v",
     .is_ring = true,
     .has_flat_faces = false,
     .is_sphere_mesh = false,
     .max_parts = 512,
     .vertices = grid_vertices,
     .extent = torus_extent,
     .thickness = tube,
     .columns = sectors,
     .chord_error = torus_chord_error,
     .diagonal_angle = ring_angle,
     .set_parts = torus_parts},
    {.shape = Shape::torus_knot,
     .name = "torus_knot",
     .keys = "radius tube latitudes longitudes mesh_error tiles_u tiles_v",
     .is_ring = true,
     .has_flat_faces = false,
     .is_sphere_mesh = false,
     .max_parts = 256,
     .vertices = grid_vertices,
     .extent = knot_extent,
     .thickness = tube,
     .columns = sectors,
     .chord_error = knot_chord_error,
     .diagonal_angle = ring_angle,
     .set_parts = knot_parts},
    {.shape = Shape::file,
     .name = "file",
     .keys = "file allow_outside up_axis model_scene model_animation model_time model_variant model_materials model_error",
     .is_ring = false,
     .has_flat_faces = false,
     .is_sphere_mesh = false,
     .max_parts = 1,
     .vertices = no_vertices,
     .extent = no_extent,
     .thickness = no_length,
     .columns = sectors,
     .chord_error = no_length,
     .diagonal_angle = no_length,
     .set_parts = no_parts},
};

static_assert(std::size(kKinds) == kShapes && is_in_order(kKinds, &ShapeKind::shape));

}  // namespace

constinit const std::array<std::string_view, kShapes> ChoiceNames<Shape>::names = names_of(kKinds);

const ShapeKind& kind_of(Shape shape) { return kKinds[static_cast<std::size_t>(shape)]; }

int part_step(int minimum) {
  int power = 1;
  while (2 * power <= minimum) power *= 2;
  if (minimum <= power) return power;
  return 2 * minimum <= 3 * power ? 3 * power / 2 : 2 * power;
}

const char* shapes_with(std::string_view key) { return names_with(kKinds, key); }

}  // namespace halfspace::HS_LANES
