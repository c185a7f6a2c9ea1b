// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "halfspace/geometry/shapes.h"
#include "halfspace/render/view.h"

namespace halfspace {
namespace {

constexpr double kRadius = 2.0, kTube = 0.375;  // exactly representable as floats

// Returns how far the planes of the triangles are below the sphere at most: the radius minus the distance of a plane from the center.
double deepest_plane(const Mesh& mesh, double radius) {
  double deepest = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const glm::dvec3 a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]), c(mesh.positions[mesh.indices[i + 2]]);
    deepest = std::max(deepest, radius - std::abs(glm::dot(glm::normalize(glm::cross(b - a, c - a)), a)));
  }
  return deepest;
}

// Allows for the rounding of positions to float, which is 2^-24 of the radius per coordinate.
constexpr double kRounding = kRadius * 0x1p-22;

TEST(ChordError, BoundsTheDepthOfSphereTriangles) {
  for (const int bands : {8, 17, 64}) {
    ObjectDescription o;
    o.radius = kRadius;
    o = with_parts(o, bands, false);
    const double measured = deepest_plane(uv_sphere(o.latitudes, o.longitudes, kRadius), kRadius);
    EXPECT_LE(measured, chord_error(o) + kRounding) << bands;
    // The widest quads are at the equator. The bound is exact there, except that their centers are half a band away from it.
    EXPECT_GE(measured, 0.95 * chord_error(o)) << bands;
  }
}

TEST(ChordError, IsQuarteredPerIcosphereLevel) {
  for (const int level : {0, 1, 2, 3, 5}) {
    ObjectDescription o;
    o.shape = Shape::icosphere;
    o.radius = kRadius;
    o.level = level;
    const double measured = deepest_plane(icosphere(level, kRadius), kRadius);
    EXPECT_LE(measured, chord_error(o) + kRounding) << level;
    EXPECT_GE(measured, 0.7 * chord_error(o)) << level;  // one constant is used for all levels
  }
}

// Compares a mesh with one that has four times its resolution in both directions, and returns the largest distance, along the normal,
// between the middle of a quad's diagonal and the corresponding vertex of the fine mesh. A row has columns + 1 vertices.
double deepest_diagonal(const Mesh& mesh, const Mesh& fine, int rows, int columns) {
  constexpr int kFiner = 4;
  double deepest = 0.0;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const auto at = [&](int row, int column) {
        return glm::dvec3(mesh.positions[static_cast<std::size_t>(row * (columns + 1) + column)]);
      };
      const auto middle = static_cast<std::size_t>((kFiner * i + kFiner / 2) * (kFiner * columns + 1) + kFiner * j + kFiner / 2);
      const glm::dvec3 off = glm::dvec3(fine.positions[middle]) - 0.5 * (at(i, j) + at(i + 1, j + 1));
      deepest = std::max(deepest, std::abs(glm::dot(off, glm::dvec3(fine.normals[middle]))));
    }
  }
  return deepest;
}

// Expects that the measured error is between `min_ratio` and `max_ratio` times chord_error at several resolutions.
void expect_ring(Shape shape, Mesh (*make)(float, float, int, int, const Displacement*), double min_ratio, double max_ratio) {
  for (const int parts : {8, 16, 48}) {
    ObjectDescription o;
    o.shape = shape;
    o.radius = kRadius;
    o.tube = kTube;
    o = with_parts(o, parts, false);
    const Mesh mesh = make(kRadius, kTube, o.latitudes, o.longitudes, nullptr);
    const Mesh fine = make(kRadius, kTube, 4 * o.latitudes, 4 * o.longitudes, nullptr);
    const double measured = deepest_diagonal(mesh, fine, o.latitudes, o.longitudes);
    EXPECT_LE(measured, max_ratio * chord_error(o)) << parts;
    EXPECT_GE(measured, min_ratio * chord_error(o)) << parts;
  }
}

TEST(ChordError, SumsBothDirectionsForATorus) { expect_ring(Shape::torus, torus, 0.9, 1.001); }

// The second derivative is evaluated at the outermost point, which is not quite where the error is largest.
TEST(ChordError, IsApproximateForTorusKnots) { expect_ring(Shape::torus_knot, torus_knot, 0.6, 1.05); }

TEST(ChordError, MatchesACircleForCylinders) {
  ObjectDescription o;
  o.shape = Shape::cylinder;
  o.radius = kRadius;
  o = with_parts(o, 12, true);
  EXPECT_EQ(o.latitudes, 2);
  EXPECT_NEAR(chord_error(o), kRadius * (1.0 - std::cos(std::numbers::pi / 12)), 1e-12);
  o.shape = Shape::cube;
  EXPECT_EQ(chord_error(o), 0.0);
}

// Returns the largest texture displacement on the side of a cone, measured along the circle.
double map_error_of_cone(const ObjectDescription& o) {
  const Mesh mesh = cone(static_cast<float>(o.radius), static_cast<float>(o.length), o.latitudes, o.longitudes);
  const int side = o.longitudes * (2 * o.latitudes - 1), steps = 8;
  double worst = 0.0;
  for (int t = 0; t < side; ++t) {
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const double weights[] = {static_cast<double>(i) / steps, static_cast<double>(j) / steps,
                                  static_cast<double>(steps - i - j) / steps};
        glm::dvec3 p(0.0);
        double u = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
          const uint32_t v = mesh.indices[3 * static_cast<std::size_t>(t) + k];
          p += weights[k] * glm::dvec3(mesh.positions[v]);
          u += weights[k] * static_cast<double>(mesh.uvs[v].x);
        }
        const double turns = u - std::atan2(-p.z, p.x) / (2.0 * std::numbers::pi);
        worst = std::max(worst, std::abs(turns - std::round(turns)) * 2.0 * std::numbers::pi * std::hypot(p.x, p.z));
      }
    }
  }
  return worst;
}

TEST(ChordError, BoundsTheTextureDisplacementOnCones) {
  ObjectDescription o;
  o.shape = Shape::cone;
  EXPECT_EQ(with_parts(o, 48, true).latitudes, 2) << "without a map";
  o.surface.color = TextureName{"squares"};
  for (const int parts : {12, 48, 96}) {
    const ObjectDescription placed = with_parts(o, parts, true), coarse = with_parts(o, parts, false);
    EXPECT_EQ(coarse.latitudes, 2);
    EXPECT_LE(map_error_of_cone(placed), chord_error(placed) * 1.01) << parts;  // uv is rounded to float
    EXPECT_GT(map_error_of_cone(coarse), chord_error(coarse) * (parts / 12.0))
        << parts << ": with two bands the displacement is about 0.16 parts times the chord error";
  }
}

TEST(ChordError, PartCountsAreRoundedUpToFewSteps) {
  EXPECT_EQ(part_step(1), 1);
  EXPECT_EQ(part_step(2), 2);
  EXPECT_EQ(part_step(3), 3);
  EXPECT_EQ(part_step(5), 6);
  EXPECT_EQ(part_step(7), 8);
  EXPECT_EQ(part_step(97), 128);
  EXPECT_EQ(part_step(96), 96);
}

// The expected value, computed in double, is how far the silhouette of a sphere moves in the image when its radius changes.
TEST(PixelsPerUnit, MatchTheMotionOfAnOutline) {
  CameraDescription camera;
  camera.position = {0, 0, 5};
  const View view = make_view(camera, 1600, 900);
  for (const double x : {0.0, 1.0, 2.0}) {
    const auto outer_px = [&](double radius) {
      const double center = std::atan2(x, 5.0), own = std::asin(radius / std::sqrt(x * x + 25.0));
      return 450.0 / view.tan_y * std::tan(center + own);
    };
    constexpr double kStep = 1e-6;
    const double moved = (outer_px(1.0 + kStep) - outer_px(1.0)) / kStep;
    EXPECT_NEAR(silhouette_pixels_per_unit(view, {x, 0, 0}, 1.0), moved, 1e-3 * moved) << x;  // forward difference, first order in the step
    EXPECT_GT(pixels_per_unit(view, {x, 0, 0}, 1.0), moved) << x;
  }
  // In the corner of the image, the bound by distance is the motion of a point; at the center, the bound by depth is.
  const glm::dvec3 corner = glm::normalize(view.ray_ws + view.ray_x_ws + view.ray_y_ws), at = camera.position + 4.0 * corner;
  const double moved = 450.0 / view.tan_y * std::sqrt(1.0 + view.tan_x * view.tan_x + view.tan_y * view.tan_y) /
                       glm::dot(at - camera.position, view.forward_ws);
  EXPECT_NEAR(turned_pixels_per_unit(view, at, 0.0), moved, 1e-9 * moved);
  EXPECT_NEAR(pixels_per_unit(view, at, 0.0), moved, 1e-9 * moved);
  EXPECT_GT(turned_pixels_per_unit(view, {0, 0, 0}, 1.0), pixels_per_unit(view, {0, 0, 0}, 1.0));
  EXPECT_LT(turned_pixels_per_unit(view, {5, 0, 5}, 1.0), pixels_per_unit(view, {5, 0, 5}, 1.0)) << "beside the eye";
  EXPECT_FALSE(is_outside(view, {0, 0, 0}, 1.0));
  EXPECT_TRUE(is_outside(view, {20, 0, 0}, 1.0));
  EXPECT_FALSE(is_outside(view, {20, 0, 0}, 19.0));
}

}  // namespace
}  // namespace halfspace
