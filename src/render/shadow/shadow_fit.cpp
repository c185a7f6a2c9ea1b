// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/shadow/shadow_fit.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "halfspace/core/units.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/scene/lights.h"

namespace halfspace::HS_LANES {

namespace {

// Maximum angle from the axis, in degrees, for a single view of a spot light. Above it, texels at the border become too large, and at 90
// degrees or more a single projection plane is impossible, so cube faces are used instead.
constexpr double kWidestSpot = 60.0;

// Returns the bounds of the mesh's vertices along the columns of a rotation.
Box bounds_along(const PlacedMesh& placed, const glm::dmat3& axes) {
  const glm::dmat3 turn = glm::transpose(axes) * glm::dmat3(placed.world_from_object);
  const glm::dvec3 shift = glm::transpose(axes) * glm::dvec3(placed.world_from_object[3]);
  Box box;
  for (const glm::vec3& p : placed.positions) box.add(turn * glm::dvec3(p) + shift);
  return box;
}

Box bounds_along(const Particles& spheres, const glm::dmat3& axes) {
  Box box;
  for (std::size_t i = 0; i < spheres.radii.size(); ++i) {
    const glm::dvec3 center = glm::transpose(axes) * spheres.centers_ws[i], reach(static_cast<double>(spheres.radii[i]));
    box.add(center - reach);
    box.add(center + reach);
  }
  return box;
}

Box bounds_along(const ShadowExtent& e, const glm::dmat3& axes) {
  return e.mesh != nullptr ? bounds_along(*e.mesh, axes) : bounds_along(*e.spheres->particles, axes);
}

Box common(const Box& a, const Box& b) { return {glm::max(a.low, b.low), glm::min(a.high, b.high)}; }

Box joined(Box a, const Box& b) {
  if (!b.empty()) {
    a.add(b.low);
    a.add(b.high);
  }
  return a;
}

// Returns the part of a box within `reach` of a point along each axis; reach may be infinity.
Box part_within(const Box& box, const glm::dvec3& point, double reach) { return common(box, {point - reach, point + reach}); }

// Computes the views of one light. Objects count if a part of them is within `reach` of `position`; receivers only if that part is visible.
class ViewFinder {
 public:
  ViewFinder(const ShadowScene& scene, const glm::dvec3& position, double reach, int size, double margin)
      : frustum_(scene.frustum_ws), eye_ws_(scene.eye_ws), forward_ws_(scene.forward_ws), reach_(reach), size_(size), margin_(margin) {
    for (const ShadowExtent& e : scene.objects) {
      const Box part = part_within(e.box_ws, position, reach);
      if (glm::any(glm::greaterThan(part.low, part.high))) continue;
      ShadowExtent& object = objects_.emplace_back(e);
      object.receives_shadow = e.receives_shadow && !common_corners(frustum_, part).empty();
      if (object.casts_shadow) casters_.push_back(object);
      if (object.receives_shadow) receivers_.push_back(object);
    }
  }

  bool nothing_received() const { return receivers_.empty(); }

  std::vector<LightView> directional(const glm::dvec3& to_light_ws, int cascades, double growth) const {
    const glm::dmat3 axes = light_axes(to_light_ws);
    std::vector<Box> receivers, casters;
    for (const ShadowExtent& e : objects_) {
      if (!e.casts_shadow && !e.receives_shadow) continue;
      const Box box = bounds_along(e, axes);
      if (e.casts_shadow) casters.push_back(box);
      if (e.receives_shadow) receivers.push_back(box);
    }
    const auto view_of = [&](const std::array<glm::dvec3, 8>& part) -> std::optional<LightView> {
      Box seen;
      for (std::size_t i = 0; i < receivers_.size(); ++i) {
        Box in_view;
        for (const glm::dvec3& p : common_corners(part, receivers_[i].box_ws)) in_view.add(glm::transpose(axes) * p);
        if (!in_view.empty()) seen = joined(seen, common(in_view, receivers[i]));
      }
      if (seen.empty()) return std::nullopt;
      return directional_view(axes, seen, casters, size_, margin_);
    };
    std::vector<LightView> views;
    if (cascades == 1) {
      if (const auto view = view_of(frustum_)) views.push_back(*view);
      return views;
    }
    const auto [near, far] = seen_distances();
    const std::vector<double> splits = cascade_splits(near, far, cascades, growth);
    for (int i = 0; i < cascades; ++i) {
      const auto share = [&](int k) { return share_at(splits[static_cast<std::size_t>(k)]); };
      if (const auto view = view_of(frustum_slice(frustum_, share(i), share(i + 1)))) views.push_back(*view);
    }
    return views;
  }

  std::vector<LightView> spot(const glm::dvec3& position, const glm::dvec3& forward, double angle) const {
    const glm::dvec3 axis = unit_or_zero(forward);
    double near = 1e300, far = 0.0;
    for (const ShadowExtent& e : casters_)
      for (const glm::dvec3& c : corners_of(e.box_ws)) near = std::min(near, glm::dot(c - position, axis));
    for (const ShadowExtent& e : receivers_)
      for (const glm::dvec3& c : corners_of(e.box_ws)) far = std::max(far, glm::dot(c - position, axis));
    far = std::min(far, reach_);
    if (far <= 0.0) return {};
    return {spot_view(position, axis, angle, near_end(near, far), far * 1.001, size_, margin_)};
  }

  std::vector<LightView> cube(const glm::dvec3& position) const {
    double near = 1e300, far = 0.0;
    // The distance along the axis of the face that contains the point is the largest component.
    for (const ShadowExtent& e : casters_) {
      const glm::dvec3 gap = glm::max(glm::max(e.box_ws.low - position, position - e.box_ws.high), glm::dvec3(0.0));
      near = std::min(near, std::max({gap.x, gap.y, gap.z}));
    }
    for (const ShadowExtent& e : receivers_) {
      const glm::dvec3 distance = glm::max(glm::abs(e.box_ws.low - position), glm::abs(e.box_ws.high - position));
      far = std::max({far, distance.x, distance.y, distance.z});
    }
    far = std::min(far, reach_);
    std::vector<LightView> views;
    for (const LightView& view : cube_views(position, near_end(near, far), far * 1.001, size_, margin_)) {
      const auto seen = frustum_corners(view.clip_from_world);
      const auto sees = [&](const ShadowExtent& e) { return !common_corners(seen, e.box_ws).empty(); };
      if (std::ranges::any_of(receivers_, sees) && std::ranges::any_of(casters_, sees)) views.push_back(view);
    }
    return views;
  }

 private:
  // Returns a distance slightly in front of the nearest caster. If the light is among the casters, it is so near that it cuts off nothing,
  // for the reason given at near_plane() in render/view.h.
  static double near_end(double nearest, double far) { return std::max(std::min(0.9 * nearest, 0.5 * far), 0x1p-40 * far); }

  // Returns the range of distances along the view axis in which receivers are visible.
  std::pair<double, double> seen_distances() const {
    double near = 1e300, far = 0.0;
    for (const ShadowExtent& r : receivers_) {
      for (const glm::dvec3& p : common_corners(frustum_, r.box_ws)) {
        near = std::min(near, distance_to(p));
        far = std::max(far, distance_to(p));
      }
    }
    return {std::max(near, 1e-3 * far), far};
  }
  double distance_to(const glm::dvec3& p_ws) const { return glm::dot(p_ws - eye_ws_, forward_ws_); }
  // Returns the position of a distance between the near plane (0) and the far plane (1).
  double share_at(double distance) const {
    const double near = distance_to(frustum_[0]), far = distance_to(frustum_[4]);
    return std::clamp((distance - near) / (far - near), 0.0, 1.0);
  }

  std::array<glm::dvec3, 8> frustum_;
  glm::dvec3 eye_ws_, forward_ws_;
  double reach_;
  int size_;
  double margin_;
  std::vector<ShadowExtent> objects_, casters_, receivers_;  // within reach; receivers are visible
};

}  // namespace

ShadowScene shadow_scene(const View& view, const std::vector<PlacedMesh>& meshes, const std::vector<PlacedSpheres>& spheres) {
  ShadowScene scene{{}, frustum_corners(view), view.eye_ws, view.forward_ws};
  for (const PlacedMesh& m : meshes)
    scene.objects.push_back({&m, nullptr, bounds_along(m, glm::dmat3(1.0)), m.casts_shadow, m.receives_shadow});
  for (const PlacedSpheres& s : spheres)
    scene.objects.push_back({nullptr, &s, bounds_along(*s.particles, glm::dmat3(1.0)), s.casts_shadow, s.receives_shadow});
  return scene;
}

bool is_outside(const glm::dmat4& clip_from_world, const Box& box_ws) {
  const glm::dmat4 rows = glm::transpose(clip_from_world);
  const auto is_behind = [&](const glm::dvec4& plane) {  // true if dot(plane, (p, 1)) < 0 in the whole box
    const glm::dvec3 normal(plane);
    const glm::dvec3 farthest(normal.x > 0.0 ? box_ws.high.x : box_ws.low.x, normal.y > 0.0 ? box_ws.high.y : box_ws.low.y,
                              normal.z > 0.0 ? box_ws.high.z : box_ws.low.z);
    return glm::dot(normal, farthest) + plane.w < 0.0;
  };
  return is_behind(rows[3] + rows[0]) || is_behind(rows[3] - rows[0]) || is_behind(rows[3] + rows[1]) || is_behind(rows[3] - rows[1]) ||
         is_behind(rows[2]) || is_behind(rows[3] - rows[2]);
}

std::vector<LightView> fitted_views(const ShadowScene& scene, const LightDescription& light, const ShadowDescription& shadow, int size,
                                    double margin) {
  const LightKind& kind = kind_of(light.type);
  const bool is_limited = !kind.is_distant && light.range > 0.0;
  const double reach = is_limited ? light.range : std::numeric_limits<double>::infinity();
  const ViewFinder finder(scene, light.position, reach, size, margin);
  if (finder.nothing_received()) return {};
  if (kind.is_distant) return finder.directional(light.direction, shadow.cascades, shadow.cascade_growth);
  if (kind.has_cone && light.outer <= kWidestSpot)
    return finder.spot(light.position, -light.direction, 2.0 * light.outer * kRadiansPerDegree);
  return finder.cube(light.position);
}

}  // namespace halfspace::HS_LANES
