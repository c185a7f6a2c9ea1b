// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/adaptive_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "halfspace/core/resource_limits.h"
#include "halfspace/geometry/displaced_sphere.h"
#include "halfspace/geometry/point_surface.h"
#include "halfspace/geometry/shapes.h"

namespace halfspace::HS_LANES {

namespace {

// Of all copies of an object: two per vertex that the regular meshes of a scene may have.
constexpr uint64_t kMaxAdaptiveTriangles = uint64_t{1} << 26;

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
  if (o.shape == Shape::uv_sphere)
    return std::make_unique<SphereSurface>(field, o.radius, o.height_scale, o.height_zero, relief_normals(o));
  std::optional<Displacement> displacement;
  if (field != nullptr) displacement = Displacement{field, o.height_scale, o.height_zero};
  const auto make = [&](auto point) { return std::make_unique<PointSurface>(point, displacement); };
  if (o.shape == Shape::plane) return make([size = o.size](double u, double v) { return plane_point(size, u, v); });
  const double radius = o.radius, tube = o.tube;
  if (o.shape == Shape::torus) return make([=](double u, double v) { return torus_point(radius, tube, u, v); });
  return make([=](double u, double v) { return torus_knot_point(radius, tube, u, v); });
}

// What is outside of the view or behind the horizon is seen only by its shadow. Its error may be this many times as large.
constexpr double kHiddenFactor = 4.0;

// Returns true if a ball is hidden by a sphere around the origin. eye: a point, or a unit vector with w = 0 towards an infinitely distant
// eye.
bool is_hidden(const glm::dvec4& eye, const glm::dvec3& center, double radius, double sphere) {
  const glm::dvec3 from_eye = eye.w == 0.0 ? center : center - glm::dvec3(eye);
  const double distance = eye.w == 0.0 ? 0.0 : glm::length(glm::dvec3(eye));
  if (sphere <= 0.0 || (eye.w != 0.0 && distance <= sphere)) return false;
  // The ball is inside of the cone that touches the sphere, or of the cylinder for a distant eye, and beyond the circle where it does.
  const glm::dvec3 axis = -glm::dvec3(eye) / (eye.w == 0.0 ? 1.0 : distance);
  const double along = glm::dot(from_eye, axis), aside = std::sqrt(std::max(0.0, glm::dot(from_eye, from_eye) - along * along));
  if (eye.w == 0.0) return along - radius > 0.0 && aside + radius < sphere;
  const double sine = sphere / distance, cosine = std::sqrt(1.0 - sine * sine);
  return along - radius > distance * cosine * cosine && along * sine - aside * cosine > radius;
}

// The copies of an object in the view. All lengths are in object space.
class Copies {
 public:
  // solid: radius of a sphere inside of the surface that hides what is behind it; 0: none.
  Copies(const View& view, const std::vector<glm::dmat4>& places, double solid, bool casts) : view_(view), casts_(casts) {
    for (const glm::dmat4& world : places) {
      const bool orthographic = view.to_eye_ws != glm::dvec3(0.0);
      glm::dvec4 eye = glm::inverse(world) * (orthographic ? glm::dvec4(view.to_eye_ws, 0.0) : glm::dvec4(view.eye_ws, 1.0));
      if (orthographic) eye /= glm::length(eye);
      const double stretch = stretch_of(world), depth = glm::dot(glm::dvec3(world[3]) - view.eye_ws, view.forward_ws);
      const bool is_cut = depth - solid * stretch < view.near;  // the near plane may cut the front of the sphere off
      copies_.push_back({world, eye, stretch, is_cut ? 0.0 : solid});
    }
  }

  // Returns an upper bound on the pixels by which a point in the ball is displaced per unit, in any copy.
  double px_per_unit(const glm::dvec3& center, double radius) const {
    double px = 0.0;
    for (const Copy& c : copies_) px = std::max(px, c.stretch * px_per_world_unit(c, center, radius));
    return px;
  }

 private:
  struct Copy {
    glm::dmat4 world;
    glm::dvec4 eye;  // in object space; w is 0 if it is a direction
    double stretch, solid;
  };

  double px_per_world_unit(const Copy& c, const glm::dvec3& center, double radius) const {
    const glm::dvec3 center_ws(c.world * glm::dvec4(center, 1.0));
    const double radius_ws = c.stretch * radius, turned = turned_pixels_per_unit(view_, center_ws, radius_ws);
    const bool is_behind = glm::dot(center_ws - view_.eye_ws, view_.forward_ws) + radius_ws < view_.near;
    if (is_behind || is_outside(view_, center_ws, radius_ws) || is_hidden(c.eye, center, radius, c.solid))
      return casts_ ? turned / kHiddenFactor : 0.0;
    return std::min(turned, pixels_per_unit(view_, center_ws, radius_ws));
  }

  const View& view_;
  bool casts_;
  std::vector<Copy> copies_;
};

// The surface of an object and what has been measured of it.
class MeasuredSurface {
 public:
  MeasuredSurface(const ObjectDescription& o, std::shared_ptr<const HeightField> field)
      : field_(std::move(field)), surface_(surface_of(o, field_.get())), grid_(grid_of(o.shape)), adaptive_(*surface_, grid_) {
    if (o.shape != Shape::uv_sphere) return;
    const auto [low, high] = field_ == nullptr ? std::pair(o.height_zero, o.height_zero) : field_->range();
    solid_ = o.radius + std::min({0.0, o.height_scale * (low - o.height_zero), o.height_scale * (high - o.height_zero)});
  }

  // Measuring more does not change results. A thread that finds another one at work measures for itself.
  AdaptiveMesh mesh(const ViewedError& viewed, const Workers& workers, const std::string& place) const {
    if (is_busy_.test_and_set()) return AdaptiveSurface(*surface_, grid_).mesh(viewed, workers, place);
    const std::unique_ptr<std::atomic_flag, void (*)(std::atomic_flag*)> busy(&is_busy_, [](std::atomic_flag* flag) { flag->clear(); });
    return adaptive_.mesh(viewed, workers, place);
  }

  // Returns the radius of a sphere that the surface contains, in object space, or 0.
  double solid() const { return solid_; }

 private:
  std::shared_ptr<const HeightField> field_;
  std::unique_ptr<const ParametricSurface> surface_;
  PatchGrid grid_;
  double solid_ = 0.0;
  mutable AdaptiveSurface adaptive_;
  mutable std::atomic_flag is_busy_{};
};

std::string bytes_of(const glm::dmat4& m) { return {reinterpret_cast<const char*>(&m), sizeof m}; }

}  // namespace

std::shared_ptr<const FittedMesh> AdaptiveMeshes::mesh_of(const ObjectDescription& o, const Relief& relief,
                                                          const std::vector<glm::dmat4>& places, bool casts, const std::string& where) {
  const std::string place = where + ".mesh_error";
  if (places.size() > kMaxAdaptiveCopies)
    throw InputError(fmt::format("{}: the object has {} copies; expected at most {}, or 0 for a regular mesh", place, places.size(),
                                 kMaxAdaptiveCopies));
  const std::string surface_recipe =
      recipe("adaptive surface", static_cast<int>(o.shape), o.radius, o.tube, o.size, relief.recipe, static_cast<int>(o.normals));
  if (!used_.contains(surface_recipe)) used_.add(surface_recipe, std::make_shared<const MeasuredSurface>(o, relief.field));
  const auto surface = used_.existing<MeasuredSurface>(surface_recipe);
  const double solid = o.surface.opacity < 1.0 ? 0.0 : surface->solid();
  std::string words = surface_recipe +
                      recipe(o.mesh_error, solid, casts ? 1 : 0, o.tiles_u, o.tiles_v, view_.width_px, view_.height_px, view_.near) +
                      bytes_of(view_.clip_from_world);
  for (const glm::dmat4& world : places) words += bytes_of(world);
  const std::shared_ptr<const ReliefDetail> detail = maps_.relief_detail(o, where + ".height");
  return used_.asset<FittedMesh>(words, [&] {
    const Copies copies(view_, places, solid, casts);
    ViewedError viewed;
    viewed.of = [&](const glm::dvec3& center, double radius, double error) { return error * copies.px_per_unit(center, radius); };
    viewed.allowed = o.mesh_error;
    if (detail != nullptr) {
      const double aspect = static_cast<double>(relief.field->width()) / relief.field->height();
      viewed.between = [&, aspect](int columns, int rows) {
        return std::fabs(o.height_scale) * detail->error(std::min(static_cast<double>(columns), aspect * rows));
      };
    }
    AdaptiveMesh mesh = surface->mesh(viewed, workers_, place);
    for (glm::vec2& uv : mesh.mesh.uvs) uv *= glm::vec2(o.tiles_u, o.tiles_v);
    const uint64_t copies_drawn = places.size(), triangles = mesh.mesh.indices.size() / 3 * copies_drawn;
    check_primitive_limit(triangles, place);
    if (triangles > kMaxAdaptiveTriangles)
      throw InputError(fmt::format("{}: {} triangles in {} copies; expected at most {}: a larger error or fewer copies", place, triangles,
                                   copies_drawn, kMaxAdaptiveTriangles));
    const SimplifiedObject report{.triangles = 2 * static_cast<uint64_t>(mesh.columns) * static_cast<uint64_t>(mesh.rows) * copies_drawn,
                                  .drawn = triangles,
                                  .error_px = mesh.error,
                                  .is_estimate = true};
    return FittedMesh(std::move(mesh.mesh), report);
  });
}

}  // namespace halfspace::HS_LANES
