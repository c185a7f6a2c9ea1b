// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/adaptive_meshes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "halfspace/core/resource_limits.h"
#include "halfspace/geometry/displaced_sphere.h"
#include "halfspace/geometry/point_surface.h"
#include "halfspace/geometry/shapes.h"

namespace halfspace::HS_LANES {

namespace {

// Patches are about square on a shape of default size.
PatchGrid grid_of(Shape shape) {
  switch (shape) {
    case Shape::plane: return {.columns = 8, .rows = 8, .closed_u = false, .closed_v = false};
    case Shape::torus: return {.columns = 40, .rows = 8, .closed_u = true, .closed_v = true};
    case Shape::torus_knot: return {.columns = 96, .rows = 8, .closed_u = true, .closed_v = true};
    default: return {.columns = 32, .rows = 16, .closed_u = true, .closed_v = false};
  }
}

std::unique_ptr<const ParametricSurface> surface_of(const ObjectDescription& o, const HeightField* field) {
  if (o.shape == Shape::uv_sphere) {
    const ReliefNormals normals = o.normals == NormalSource::undisplaced ? ReliefNormals::undisplaced : ReliefNormals::displaced;
    return std::make_unique<SphereSurface>(field, o.radius, o.height_scale, o.height_zero, normals);
  }
  std::optional<Displacement> displacement;
  if (field != nullptr) displacement = Displacement{field, o.height_scale, o.height_zero};
  const auto make = [&](auto point) { return std::make_unique<PointSurface>(point, displacement); };
  if (o.shape == Shape::plane) return make([size = o.size](double u, double v) { return plane_point(size, u, v); });
  const double radius = o.radius, tube = o.tube;
  if (o.shape == Shape::torus) return make([=](double u, double v) { return torus_point(radius, tube, u, v); });
  return make([=](double u, double v) { return torus_knot_point(radius, tube, u, v); });
}

// What is outside of the view or behind the horizon is seen only by its shadow. Its error may be this many times as large.
constexpr double kUnseenFactor = 4.0;

// Returns true if a ball is hidden by a sphere around the origin. eye: a point, or a unit vector with w = 0 towards an infinitely distant
// eye.
bool is_hidden(const glm::dvec4& eye, const glm::dvec3& center, double radius, double sphere) {
  if (sphere <= 0.0) return false;
  if (eye.w == 0.0) {
    const double towards_eye = glm::dot(center, glm::dvec3(eye));
    const double aside = std::sqrt(std::max(0.0, glm::dot(center, center) - towards_eye * towards_eye));
    return towards_eye + radius < 0.0 && aside + radius < sphere;
  }
  const glm::dvec3 to_origin = -glm::dvec3(eye), to_center = center + to_origin;
  const double distance = glm::length(to_origin), to_ball = glm::length(to_center);
  if (distance <= sphere || to_ball <= radius) return false;
  // The ball is inside of the cone that touches the sphere, and beyond the plane of the circle where it does.
  const double along = glm::dot(to_center, to_origin) / distance;
  const double horizon = (distance * distance - sphere * sphere) / distance;
  const double half_angle = std::asin(sphere / distance), angle = std::acos(std::clamp(along / to_ball, -1.0, 1.0));
  return along - radius > horizon && angle + std::asin(radius / to_ball) < half_angle;
}

// The copies of an object in the view. All lengths are in object space.
class Copies {
 public:
  // solid: radius of a sphere inside of the surface that hides what is behind it; 0: none.
  Copies(const View& view, const std::vector<glm::dmat4>& places, double solid, bool casts) : view_(view), solid_(solid), casts_(casts) {
    for (const glm::dmat4& world : places) {
      const glm::dvec3 scale(glm::length(world[0]), glm::length(world[1]), glm::length(world[2]));
      const bool orthographic = view.to_eye_ws != glm::dvec3(0.0);
      glm::dvec4 eye = glm::inverse(world) * (orthographic ? glm::dvec4(view.to_eye_ws, 0.0) : glm::dvec4(view.eye_ws, 1.0));
      if (orthographic) eye /= glm::length(eye);
      copies_.push_back({world, eye, std::max({scale.x, scale.y, scale.z})});
    }
  }

  // Returns an upper bound on the pixels by which a point in the ball is displaced per unit, in any copy.
  double px_per_unit(const glm::dvec3& center, double radius) const {
    double px = 0.0;
    for (const Copy& c : copies_) px = std::max(px, c.scale * px_per_world_unit(c, center, radius));
    return px;
  }

 private:
  struct Copy {
    glm::dmat4 world;
    glm::dvec4 eye;  // in object space; w is 0 if it is a direction
    double scale;
  };

  double px_per_world_unit(const Copy& c, const glm::dvec3& center, double radius) const {
    const glm::dvec3 center_ws(c.world * glm::dvec4(center, 1.0));
    const double radius_ws = c.scale * radius, turned = turned_pixels_per_unit(view_, center_ws, radius_ws);
    const bool is_behind = glm::dot(center_ws - view_.eye_ws, view_.forward_ws) + radius_ws < view_.near;
    if (is_behind || is_outside(view_, center_ws, radius_ws) || is_hidden(c.eye, center, radius, solid_))
      return casts_ ? turned / kUnseenFactor : 0.0;
    return std::min(turned, pixels_per_unit(view_, center_ws, radius_ws));
  }

  const View& view_;
  double solid_;
  bool casts_;
  std::vector<Copy> copies_;
};

// Returns the radius of a sphere that an opaque object contains, in object space, or 0.
double solid_radius(const ObjectDescription& o) {
  return o.shape != Shape::uv_sphere || o.surface.opacity < 1.0 ? 0.0 : o.radius - relief_height(o);
}

// The surface of an object and what has been measured of it.
class MeasuredSurface {
 public:
  MeasuredSurface(const ObjectDescription& o, std::shared_ptr<const HeightField> field)
      : field_(std::move(field)), surface_(surface_of(o, field_.get())), adaptive_(*surface_, grid_of(o.shape)) {}

  AdaptiveMesh mesh(const ViewedError& viewed, const Workers& workers) const { return adaptive_.mesh(viewed, workers); }

 private:
  std::shared_ptr<const HeightField> field_;
  std::unique_ptr<const ParametricSurface> surface_;
  mutable AdaptiveSurface adaptive_;  // measuring more does not change results
};

std::string matrix_recipe(const glm::dmat4& m) {
  std::string text;
  for (int i = 0; i < 4; ++i) text += recipe(m[i][0], m[i][1], m[i][2], m[i][3]);
  return text;
}

}  // namespace

std::shared_ptr<const FittedMesh> AdaptiveMeshes::mesh_of(const ObjectDescription& o, const Relief& relief,
                                                          const std::vector<glm::dmat4>& places, bool casts, const std::string& where) {
  const std::string surface_recipe =
      recipe("adaptive surface", static_cast<int>(o.shape), o.radius, o.tube, o.size, relief.recipe, static_cast<int>(o.normals));
  std::string words = surface_recipe + recipe(o.mesh_error, casts ? 1 : 0, o.tiles_u, o.tiles_v, view_.width_px, view_.height_px) +
                      matrix_recipe(view_.clip_from_world);
  for (const glm::dmat4& world : places) words += matrix_recipe(world);
  if (!used_.contains(surface_recipe)) used_.add(surface_recipe, std::make_shared<const MeasuredSurface>(o, relief.field));
  const auto surface = used_.existing<MeasuredSurface>(surface_recipe);
  const std::shared_ptr<const ReliefDetail> detail = maps_.relief_detail(o, where + ".height");
  return used_.asset<FittedMesh>(words, [&] {
    const MemoryClaim claim(AdaptiveSurface::kMaxBytes, where + ".mesh_error");
    const Copies copies(view_, places, solid_radius(o), casts);
    ViewedError viewed;
    viewed.of = [&](const glm::dvec3& center, double radius, double error) { return error * copies.px_per_unit(center, radius); };
    viewed.allowed = o.mesh_error;
    if (detail != nullptr) viewed.unseen = [&](int columns) { return std::fabs(o.height_scale) * detail->error(columns); };
    AdaptiveMesh mesh = surface->mesh(viewed, workers_);
    for (glm::vec2& uv : mesh.mesh.uvs) uv *= glm::vec2(o.tiles_u, o.tiles_v);
    const PatchGrid grid = grid_of(o.shape);
    const auto columns = static_cast<uint64_t>(mesh.columns),
               rows = columns / static_cast<uint64_t>(grid.columns) * static_cast<uint64_t>(grid.rows);
    const SimplifiedObject report{.triangles = 2 * columns * rows, .drawn = mesh.mesh.indices.size() / 3, .error_px = mesh.error};
    return FittedMesh(std::move(mesh.mesh), report);
  });
}

}  // namespace halfspace::HS_LANES
