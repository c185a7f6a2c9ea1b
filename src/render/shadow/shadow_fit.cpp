// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/shadow/shadow_fit.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "halfspace/core/units.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/scene/lights.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

// Maximum angle from the axis, in degrees, for a single view of a spot light. Above it, texels at the border become too large, and at 90
// degrees or more a single projection plane is impossible, so cube faces are used instead.
constexpr double kWidestSpot = 60.0;

// The bounds of a mesh, or of a set of spheres.
struct Extent {
  const PlacedMesh* mesh;  // if null, `particles` is set
  const Particles* particles;
  Box box_ws;
};

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

Box bounds_along(const Extent& e, const glm::dmat3& axes) {
  return e.mesh != nullptr ? bounds_along(*e.mesh, axes) : bounds_along(*e.particles, axes);
}

Box common(const Box& a, const Box& b) { return {glm::max(a.low, b.low), glm::min(a.high, b.high)}; }

Box joined(Box a, const Box& b) {
  if (!b.empty()) {
    a.add(b.low);
    a.add(b.high);
  }
  return a;
}

// Computes the views of one light.
class ViewFinder {
 public:
  ViewFinder(const View& view, const std::vector<PlacedMesh>& meshes, const std::vector<PlacedSpheres>& spheres, int size, double margin)
      : frustum_(frustum_corners(view.clip_from_world)), eye_ws_(view.eye_ws), forward_ws_(view.forward_ws), size_(size), margin_(margin) {
    for (const PlacedMesh& m : meshes) add({&m, nullptr, bounds_along(m, glm::dmat3(1.0))}, m.casts_shadow, m.receives_shadow);
    for (const PlacedSpheres& s : spheres)
      add({nullptr, s.particles.get(), bounds_along(*s.particles, glm::dmat3(1.0))}, s.casts_shadow, s.receives_shadow);
  }

  bool nothing_received() const { return receivers_.empty(); }

  std::vector<LightView> directional(const glm::dvec3& to_light_ws, int cascades, double growth) const {
    const glm::dmat3 axes = light_axes(to_light_ws);
    std::vector<Box> receivers, casters;
    for (const Extent& r : receivers_) receivers.push_back(bounds_along(r, axes));
    for (const Extent& c : casters_) casters.push_back(bounds_along(c, axes));
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

  // reach: distance beyond which there is no light; may be infinity.
  std::vector<LightView> spot(const glm::dvec3& position, const glm::dvec3& forward, double angle, double reach) const {
    const glm::dvec3 axis = unit_or_zero(forward);
    double near = 1e300, far = 0.0;
    for (const Extent& e : casters_)
      for (const glm::dvec3& c : corners_of(e.box_ws)) near = std::min(near, glm::dot(c - position, axis));
    for (const Extent& e : receivers_)
      for (const glm::dvec3& c : corners_of(e.box_ws)) far = std::max(far, glm::dot(c - position, axis));
    far = std::min(far, reach);
    if (far <= 0.0) return {};
    return {spot_view(position, axis, angle, near_end(near, far), far * 1.001, size_, margin_)};
  }

  std::vector<LightView> cube(const glm::dvec3& position, double reach) const {
    double near = 1e300, far = 0.0;
    // The distance along the axis of the face that contains the point is the largest component.
    for (const Extent& e : casters_) {
      const glm::dvec3 gap = glm::max(glm::max(e.box_ws.low - position, position - e.box_ws.high), glm::dvec3(0.0));
      near = std::min(near, std::max({gap.x, gap.y, gap.z}));
    }
    for (const Extent& e : receivers_) {
      const glm::dvec3 distance = glm::max(glm::abs(e.box_ws.low - position), glm::abs(e.box_ws.high - position));
      far = std::max({far, distance.x, distance.y, distance.z});
    }
    far = std::min(far, reach);
    std::vector<LightView> views;
    for (const LightView& view : cube_views(position, near_end(near, far), far * 1.001, size_, margin_)) {
      const auto seen = frustum_corners(view.clip_from_world);
      const auto sees = [&](const Extent& e) { return !common_corners(seen, e.box_ws).empty(); };
      if (std::ranges::any_of(receivers_, sees) && std::ranges::any_of(casters_, sees)) views.push_back(view);
    }
    return views;
  }

 private:
  void add(const Extent& e, bool casts, bool receives) {
    if (casts) casters_.push_back(e);
    if (receives && !common_corners(frustum_, e.box_ws).empty()) receivers_.push_back(e);
  }

  // Returns a distance slightly in front of the nearest caster, but at least far/1000, in case the light is among the casters.
  static double near_end(double nearest, double far) { return std::max(std::min(0.9 * nearest, 0.5 * far), 1e-3 * far); }

  // Returns the range of distances along the view axis in which receivers are visible.
  std::pair<double, double> seen_distances() const {
    double near = 1e300, far = 0.0;
    for (const Extent& r : receivers_) {
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
  int size_;
  double margin_;
  std::vector<Extent> casters_, receivers_;
};

}  // namespace

std::vector<LightView> fitted_views(const View& view, const std::vector<PlacedMesh>& meshes, const std::vector<PlacedSpheres>& spheres,
                                    const LightDescription& light, const ShadowDescription& shadow, int size, double margin) {
  const ViewFinder finder(view, meshes, spheres, size, margin);
  if (finder.nothing_received()) return {};
  const LightKind& kind = kind_of(light.type);
  if (kind.is_distant) return finder.directional(light.direction, shadow.cascades, shadow.cascade_growth);
  const double reach = light.range > 0.0 ? light.range : std::numeric_limits<double>::infinity();
  if (kind.has_cone && light.outer <= kWidestSpot)
    return finder.spot(light.position, -light.direction, 2.0 * light.outer * kRadiansPerDegree, reach);
  return finder.cube(light.position, reach);
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
