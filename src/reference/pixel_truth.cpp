// SPDX-License-Identifier: Apache-2.0
#include "halfspace/reference/pixel_truth.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "halfspace/core/hash.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/scene/lights.h"

namespace halfspace::HS_LANES {

namespace {

constexpr float kFar = 1e30f;

// Returns two unit vectors that are perpendicular to `axis` and to each other.
std::pair<glm::dvec3, glm::dvec3> across(const glm::dvec3& axis) {
  const glm::dvec3 side = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 a = unit_or_zero(glm::cross(axis, side));
  return {a, glm::cross(axis, a)};
}

// Returns a random point in one of strata² cells of equal area of the unit disk. The cells are uniform in radius² and angle.
glm::dvec2 disk_point(int cell, int strata, uint32_t seed) {
  const auto random = [&](uint32_t salt) {
    return static_cast<double>(
        unit_fraction<float>(mix_bits(static_cast<int32_t>(seed ^ salt ^ (static_cast<uint32_t>(cell) * 0x9e3779b9u)))));
  };
  const double r = std::sqrt((cell / strata + random(0x51ed270bu)) / strata);
  const SinCosDouble a = sincos_turns(std::min((cell % strata + random(0x2545f491u)) / strata, 1.0 - 0x1p-30));
  return {r * a.cos, r * a.sin};
}

}  // namespace

PictureRay picture_ray(const View& view, int width, int height, double x, double y) {
  const double nx = 2.0 * x / width - 1.0, ny = 1.0 - 2.0 * y / height;
  if (view.to_eye_ws == glm::dvec3(0.0)) {
    const glm::dvec3 d = view.forward_ws + view.right_ws * (nx * view.tan_x) + view.up_ws * (ny * view.tan_y);
    return {glm::vec3(0.0f), glm::vec3(d)};
  }
  const glm::dmat4 world_from_clip = glm::inverse(view.clip_from_world);
  const glm::dvec4 start = world_from_clip * glm::dvec4(nx, ny, 1.0, 1.0);
  return {glm::vec3(glm::dvec3(start) / start.w - view.eye_ws - view.forward_ws * view.near), glm::vec3(view.forward_ws)};
}

Image<std::optional<RayHit>> primary_hits(const RayScene& rays, const View& view, int width, int height, const Workers& workers) {
  Image<std::optional<RayHit>> hits(width, height);
  workers.for_each(height, [&](int row) {
    for (int x = 0; x < width; ++x) {
      const PictureRay ray = picture_ray(view, width, height, x + 0.5, row + 0.5);
      hits.at(x, row) = rays.nearest(ray.origin_rws, ray.direction_ws, static_cast<float>(view.near), kFar);
    }
  });
  return hits;
}

VisibilityScore compare_visibility(const ShadowPicture& picture, const Image<std::optional<RayHit>>& hits, const RayScene& rays,
                                   const View& view, const Workers& workers) {
  const int width = hits.width(), height = hits.height();
  std::vector<VisibilityScore> rows(static_cast<std::size_t>(height));
  workers.for_each(height, [&](int row) {
    VisibilityScore& score = rows[static_cast<std::size_t>(row)];
    for (int x = 0; x < width; ++x) {
      const glm::vec4& seen = picture.mask.at(x, row);
      const auto is_seen = [&](const std::optional<RayHit>& hit) {
        if (!hit) return seen.z == 0.0f;
        return static_cast<float>(hit->mesh + 1) == seen.z && static_cast<float>(hit->triangle) == seen.w;
      };
      const std::optional<RayHit>& hit = hits.at(x, row);
      if (seen.z == 0.0f && !hit) continue;
      ++score.pixels;
      if (is_seen(hit)) {
        ++score.same;
        continue;
      }
      constexpr double kStep = 1.0 / 256.0;
      bool near_edge = false;
      double depth_change = 0.0;
      const auto depth_of = [&](const RayHit& h) {
        const glm::dvec4 clip = view.clip_from_world * glm::dvec4(h.position_rws + view.eye_ws, 1.0);
        return clip.z / clip.w;
      };
      for (int k = 0; k < 8 && !near_edge; ++k) {
        constexpr int kOffsets[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
        const PictureRay ray = picture_ray(view, width, height, x + 0.5 + kStep * kOffsets[k][0], row + 0.5 + kStep * kOffsets[k][1]);
        const auto shifted_hit = rays.nearest(ray.origin_rws, ray.direction_ws, static_cast<float>(view.near), kFar);
        near_edge = is_seen(shifted_hit);
        if (hit && shifted_hit) depth_change = std::max(depth_change, std::abs(depth_of(*shifted_hit) - depth_of(*hit)));
      }
      if (near_edge) {
        ++score.near_edge;
      } else if (hit && std::abs(depth_of(*hit) - static_cast<double>(picture.depth.at(x, row))) <= depth_change) {
        ++score.depth_tie;
      } else {
        ++score.unexplained;
      }
    }
  });
  VisibilityScore sum;
  for (const VisibilityScore& r : rows) {
    sum.pixels += r.pixels;
    sum.same += r.same;
    sum.near_edge += r.near_edge;
    sum.depth_tie += r.depth_tie;
    sum.unexplained += r.unexplained;
  }
  return sum;
}

LightTruth light_truth(const RayScene& casters, const RayLight& light, const glm::dvec3& position_rws, const glm::dvec3& face_normal_ws,
                       uint32_t seed) {
  const bool distant = kind_of(light.light.type).is_distant;
  const glm::dvec3 place(light.light.position_rws);
  const glm::dvec3 axis = distant ? place : unit_or_zero(place - position_rws);
  // Offset the origin by more than the errors of Embree's hit and of the float vertices, which are a few times 2^-24 of the largest
  // coordinate.
  const double scale = std::max({std::abs(position_rws.x), std::abs(position_rws.y), std::abs(position_rws.z), 1e-3});
  const glm::dvec3 outwards = glm::dot(face_normal_ws, axis) >= 0.0 ? face_normal_ws : -face_normal_ws;
  const glm::dvec3 origin = position_rws + outwards * (scale * 0x1p-20);
  const auto [side, up] = across(axis);
  const int strata = light.size > 0.0 ? std::max(1, static_cast<int>(std::lround(std::sqrt(light.rays)))) : 1;
  int arrived = 0;
  for (int cell = 0; cell < strata * strata; ++cell) {
    const glm::dvec2 p = light.size > 0.0 ? disk_point(cell, strata, seed) * light.size : glm::dvec2(0.0);
    const glm::dvec3 aside = side * p.x + up * p.y;
    const glm::dvec3 direction = distant ? axis + aside : place + aside - origin;
    arrived += !casters.occluded(glm::vec3(origin), glm::vec3(direction), 0.0f, distant ? kFar : 1.0f);
  }
  const double n = strata * strata, share = arrived / n;
  // This is the standard error of independent rays. Stratification makes the actual error smaller.
  return {static_cast<float>(share), n > 1 ? static_cast<float>(std::sqrt(share * (1.0 - share) / n)) : 0.0f};
}

}  // namespace halfspace::HS_LANES
