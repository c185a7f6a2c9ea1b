// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/clip.h"

#include <cmath>

#include "halfspace/core/check.h"
#include "halfspace/raster/pipeline/window.h"

namespace halfspace::HS_LANES {

namespace {

// Returns a value proportional to the distance of a polygon vertex from a plane, ≥ 0 on the inside. Planes are numbered in clipping order.
double plane_distance(int plane, const Viewport& v, const DepthState& depth, const ClipDistances& user, const ClipCorner& corner) {
  const glm::dvec4& p = corner.pos_clip;
  if (plane >= kFixedPlanes) {
    const auto of = [&](std::size_t i) { return static_cast<double>(user.vertex[i][plane - kFixedPlanes]); };
    if (corner.vertex >= 0) return of(static_cast<std::size_t>(corner.vertex));
    return corner.weights.x * of(0) + corner.weights.y * of(1) + corner.weights.z * of(2);
  }
  switch (plane) {
    case 0: return p.w - double{kMinW};
    case 1: return depth.clip == ClipDepth::negative_one_to_one ? p.z + p.w : p.z;
    case 2: return p.w - p.z;
    case 3: return p.x - static_cast<double>(v.guard_left) * p.w;
    case 4: return static_cast<double>(v.guard_right) * p.w - p.x;
    case 5: return p.y - static_cast<double>(v.guard_bottom) * p.w;
    default: return static_cast<double>(v.guard_top) * p.w - p.y;
  }
}

// Returns the intersection of an edge with a plane. If the distances are floats, their products with float coordinates are exact in double.
// The coordinates of the intersection then keep their relative accuracy even if they are much smaller than those of the end points.
ClipCorner cut(const ClipCorner& inside, double d_in, const ClipCorner& outside, double d_out) {
  const double length = d_in - d_out;
  return {(d_in * outside.pos_clip - d_out * inside.pos_clip) / length, (d_in * outside.weights - d_out * inside.weights) / length};
}

// Returns the intersection of an edge with w = kMinW: finds the point with w = 0 and moves back slightly towards the inside end. This
// preserves the direction of an edge that goes straight through the eye, where x = y = w = 0.
ClipCorner cut_at_min_w(const ClipCorner& inside, const ClipCorner& outside) {
  const double w_in = inside.pos_clip.w, w_out = outside.pos_clip.w;
  ClipCorner c = cut(inside, w_in, outside, w_out);
  const double back = double{kMinW} / (w_in - w_out);
  c.pos_clip += back * (inside.pos_clip - outside.pos_clip);
  c.weights += back * (inside.weights - outside.weights);
  c.pos_clip.w = double{kMinW};
  return c;
}

void clip_plane(int plane, const Viewport& v, const DepthState& depth, const ClipDistances& user, ClipPolygon& polygon) {
  std::array<double, kMaxCorners> d;
  bool all_inside = true;
  for (int i = 0; i < polygon.count; ++i) {
    d[static_cast<std::size_t>(i)] = plane_distance(plane, v, depth, user, polygon.corners[static_cast<std::size_t>(i)]);
    all_inside &= d[static_cast<std::size_t>(i)] >= 0;
  }
  if (all_inside) return;
  ClipPolygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const auto a = static_cast<std::size_t>(i);
    const auto b = static_cast<std::size_t>((i + 1) % polygon.count);
    const bool a_in = d[a] >= 0;
    const bool b_in = d[b] >= 0;
    const auto cut_edge = [&](std::size_t in, std::size_t out) {
      const ClipCorner &inside = polygon.corners[in], &outside = polygon.corners[out];
      return plane == 0 ? cut_at_min_w(inside, outside) : cut(inside, d[in], outside, d[out]);
    };
    const auto keep = [&kept](const ClipCorner& c) {
      HS_CHECK_OP(kept.count, <, kMaxCorners, "clipping: a polygon has too many corners; expected fewer than kMaxCorners");
      kept.corners[static_cast<std::size_t>(kept.count++)] = c;
    };
    if (a_in) keep(polygon.corners[a]);
    if (a_in && !b_in) keep(cut_edge(a, b));
    if (!a_in && b_in) keep(cut_edge(b, a));
  }
  polygon = kept;
}

ClipPolygon whole_polygon(const std::array<glm::vec4, 3>& pos_clip, int count) {
  ClipPolygon polygon;
  polygon.count = count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    polygon.corners[i] = {glm::dvec4(pos_clip[i]), glm::dvec3(i == 0, i == 1, i == 2), static_cast<int>(i)};
  }
  return polygon;
}

// Calls f for every enabled plane.
template <class F>
void for_each_plane(const DepthState& depth, const ClipDistances& distances, F f) {
  for (int plane = 0; plane < kFixedPlanes + distances.count; ++plane) {
    const bool near_or_far = plane == 1 || plane == 2;
    if (near_or_far && depth.clamp) continue;
    f(plane);
  }
}

}  // namespace

ClipPolygon clip_triangle(const Viewport& viewport, const DepthState& depth, const std::array<glm::vec4, 3>& pos_clip,
                          const ClipDistances& distances) {
  ClipPolygon polygon = whole_polygon(pos_clip, 3);
  for_each_plane(depth, distances, [&](int plane) {
    if (polygon.count != 0) clip_plane(plane, viewport, depth, distances, polygon);
  });
  if (polygon.count < 3) polygon.count = 0;
  return polygon;
}

ClipPolygon clip_line(const Viewport& viewport, const DepthState& depth, const std::array<glm::vec4, 3>& pos_clip,
                      const ClipDistances& distances) {
  ClipPolygon line = whole_polygon(pos_clip, 2);
  for_each_plane(depth, distances, [&](int plane) {
    if (line.count == 0) return;
    ClipCorner &a = line.corners[0], &b = line.corners[1];
    const double da = plane_distance(plane, viewport, depth, distances, a), db = plane_distance(plane, viewport, depth, distances, b);
    if (!(da >= 0) && !(db >= 0)) {
      line.count = 0;
    } else if (!(da >= 0)) {
      a = plane == 0 ? cut_at_min_w(b, a) : cut(b, db, a, da);
    } else if (!(db >= 0)) {
      b = plane == 0 ? cut_at_min_w(a, b) : cut(a, da, b, db);
    }
  });
  return line;
}

ScreenVertex project_corner(const Viewport& v, const glm::dvec4& p) {
  const double inv_w = 1.0 / p.w;
  const double z = p.z * inv_w * static_cast<double>(v.depth_scale) + static_cast<double>(v.depth_bias);
  return {snap(p.x * inv_w, v.half_width, v.center_x), snap(p.y * inv_w, v.half_height, v.center_y),
          static_cast<float>(std::fmin(std::fmax(z, -1e30), 1e30)), static_cast<float>(inv_w)};
}

void interpolate_corner(const ClipCorner& c, const std::array<double, 3>& w, const std::array<const float*, 3>& rows, int provoking,
                        std::span<const Interpolation> modes, float* out) {
  const glm::dvec3& smooth = c.weights;
  // Linear in window space. The weight of a vertex is its clip-space weight times its w, divided by the w of the polygon vertex.
  const glm::dvec3 linear = glm::dvec3(smooth.x * w[0], smooth.y * w[1], smooth.z * w[2]) / c.pos_clip.w;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (modes[i] == Interpolation::flat) {
      out[i] = rows[static_cast<std::size_t>(provoking)][i];
      continue;
    }
    const glm::dvec3& weight = modes[i] == Interpolation::linear ? linear : smooth;
    out[i] = static_cast<float>(weight.x * static_cast<double>(rows[0][i]) + weight.y * static_cast<double>(rows[1][i]) +
                                weight.z * static_cast<double>(rows[2][i]));
  }
}

}  // namespace halfspace::HS_LANES
