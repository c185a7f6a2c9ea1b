// SPDX-License-Identifier: Apache-2.0
//
// The properties of each shape that do not require its mesh, as a table with one row per shape. render/prepare/shape_mesh.cpp creates the
// meshes.
#pragma once

#include <cstdint>
#include <string_view>

#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

/// The names of the shapes, in the order of the table.
template <>
struct ChoiceNames<Shape> {
  static const std::array<std::string_view, kShapes> names;
};

/// Sizes of an object in object space, without displacement.
struct ShapeExtent {
  double map_width;  ///< width of a map on the surface, in scene units; 0: the shape has no maps
  double radius;     ///< of a bounding sphere around the origin
};

/// One row of the table. Functions that do not apply to a shape return 0.
struct ShapeKind {
  Shape shape;
  std::string_view name;
  std::string_view keys;  ///< keys of ObjectDescription that only some shapes have, separated by spaces
  bool is_ring;           ///< a closed tube
  bool has_flat_faces;    ///< only height maps need more than one part
  bool is_sphere_mesh;    ///< its smooth surface is a sphere of radius ObjectDescription::radius
  int max_parts;          ///< for set_parts

  /// Returns the approximate number of vertices, without the additional vertices at seams and poles. 0 for files, whose counts are known
  /// after they are read.
  int64_t (*vertices)(const ObjectDescription& o);
  ShapeExtent (*extent)(const ObjectDescription& o);
  /// Returns how far the surface can be displaced inwards before it intersects itself.
  double (*thickness)(const ObjectDescription& o);
  /// Returns the number of columns of the mesh along u. Height maps with more columns are box filtered to this width.
  int (*columns)(const ObjectDescription& o);
  /// Returns the maximum distance between the triangles and the smooth surface, in object space.
  ///
  /// The chord of an arc of 2π/n is r·(1 − cos(π/n)) below the arc. On a surface curved in both directions, the diagonal of a quad is
  /// below the surface by the sum of the chord errors of its two sides. (This is exact for the sphere, where the circumcenter of the
  /// triangle is the lowest point.)
  double (*chord_error)(const ObjectDescription& o);
  /// Returns the angle between the normals at the ends of a quad's diagonal, in radians.
  double (*diagonal_angle)(const ObjectDescription& o);
  /// Sets the tessellation: `parts` is the number of parts from top to bottom, around a tube, or along an edge. The count in the other
  /// direction is chosen to give both directions the same chord error. An icosphere gets the lowest level whose triangles are small enough.
  ///
  /// places_maps: texture coordinates must also be accurate to within the chord error. This only affects cones. Their bands narrow towards
  /// the apex, so interpolation across a triangle bends straight lines of a map by up to s/4n, where s is the width of a sector and n the
  /// number of bands.
  void (*set_parts)(ObjectDescription& o, int parts, bool places_maps);
};

/// Returns the row of a shape.
const ShapeKind& kind_of(Shape shape);
inline const ShapeKind& kind_of(const ObjectDescription& o) { return kind_of(o.shape); }

/// Returns the names of the shapes that have a key, separated by spaces, in the form that Limits::only requires. The string lives until the
/// program ends.
const char* shapes_with(std::string_view key);

/// Rounds up to one of the part counts used for meshes: 1, 2, 3, 4, 6, 8, 12, 16, … There are only a few, so that a moving
/// camera rarely changes a mesh.
int part_step(int minimum);

/// Returns the object with the tessellation that ShapeKind::set_parts chooses.
inline ObjectDescription with_parts(ObjectDescription o, int parts, bool places_maps) {
  kind_of(o).set_parts(o, parts, places_maps);
  return o;
}

/// Returns ShapeKind::chord_error of the object.
inline double chord_error(const ObjectDescription& o) { return kind_of(o).chord_error(o); }

}  // namespace halfspace::HS_LANES
