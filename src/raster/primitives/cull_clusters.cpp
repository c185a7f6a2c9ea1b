// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/primitives/cull_clusters.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "halfspace/core/float_mode.h"
#include "halfspace/core/lanes.h"
#include "halfspace/raster/clusters.h"
#include "halfspace/raster/pipeline/window.h"
#include "halfspace/raster/primitives/cluster_boxes.h"
#include "halfspace/raster/primitives/hidden_clusters.h"
#include "halfspace/raster/primitives/primitive_assembly.h"
#include "halfspace/raster/primitives/vertex_stage.h"

namespace halfspace::HS_LANES {

namespace {

// Smaller values have lost precision or may soon.
constexpr float kTiny = 0x1p-100f;

class Culling {
 public:
  explicit Culling(const Draw& draw);

  // Returns the clusters [first, first + W) that can be skipped.
  Mask skipped(const Clusters& clusters, std::size_t first) const {
    const Boxes boxes = load_boxes(clusters, first);
    Mask outside(false);
    for (std::size_t k = 0; k < sides_; ++k) outside = outside | (interval(planes_[k], boxes).high() < Real(0.0f));
    return culls_faces_ ? outside | faces_away(clusters, first, boxes) : outside;
  }

 private:
  // Adds the half-space p ≥ 0.
  void add_side(const glm::dvec4& p, const glm::dvec4& sums) { planes_[sides_++] = {plane_of(p), plane_of(sums)}; }
  Mask faces_away(const Clusters& clusters, std::size_t first, const Boxes& boxes) const;

  Viewport viewport_;
  std::size_t sides_ = 0, first_depth_side_ = 0;
  std::array<Computed, 6> planes_;
  bool culls_faces_ = false;
  Computed x_, y_, w_;
  // The eye in homogeneous object space: the point that has no image. Its sign is such that the triangles to be culled are those with
  // dot(normal, eye.xyz − eye.w · corner) < 0. It is divided by eye_scale_, so that its largest component is 1.
  glm::vec4 eye_{0.0f};
  double eye_scale_ = 1.0;
};

// Returns the vector e with dot(e, v) = det(a, b, c, v).
glm::dvec4 cross4(const glm::dvec4& a, const glm::dvec4& b, const glm::dvec4& c) {
  const auto minor = [&](int i, int j, int k) {
    return a[i] * (b[j] * c[k] - b[k] * c[j]) - a[j] * (b[i] * c[k] - b[k] * c[i]) + a[k] * (b[i] * c[j] - b[j] * c[i]);
  };
  return {-minor(1, 2, 3), minor(0, 2, 3), -minor(0, 1, 3), minor(0, 1, 2)};
}

Culling::Culling(const Draw& draw) : viewport_(draw.viewport) {
  const DrawState& state = draw.state;
  const ClipTransform transform(*state.clusters);
  const glm::dvec4 &x = transform.rows[0], &y = transform.rows[1], &z = transform.rows[2], &w = transform.rows[3];
  const glm::dmat4& sums = transform.sums;
  for (const int axis : {0, 1}) {
    add_side(w + transform.rows[axis], sums[3] + sums[axis]);
    add_side(w - transform.rows[axis], sums[3] + sums[axis]);
  }
  first_depth_side_ = sides_;
  if (!state.depth.clamp) {
    const bool both = state.depth.clip == ClipDepth::negative_one_to_one;
    add_side(both ? w + z : z, both ? sums[3] + sums[2] : sums[2]);
    add_side(w - z, sums[3] + sums[2]);
  }
  x_ = transform.computed(0);
  y_ = transform.computed(1);
  w_ = transform.computed(3);
  // Clip distances cut triangles, and the pieces of a triangle can face another way after snapping.
  culls_faces_ = (state.cull == CullMode::back || state.cull == CullMode::front) && state.polygon_mode == PolygonMode::fill &&
                 draw.kernels.clip_distance_count == 0;
  // The doubled area of a triangle in the window, positive if it is counter-clockwise, is half_width · half_height / (w0 · w1 · w2) times
  // the determinant of the x, y and w of its corners, which is dot(n, e.w · corner − e.xyz) by the Cauchy–Binet formula, where n is the
  // cross product of two edges and e = cross4(x, y, w).
  const double culled_area = is_culled(state.cull, is_front(state, true)) ? 1.0 : -1.0;
  const double mirrored = (viewport_.half_width < 0.0f) == (viewport_.half_height < 0.0f) ? 1.0 : -1.0;
  const glm::dvec4 eye = cross4(x, y, w) * (culled_area * mirrored);
  eye_scale_ = std::max({std::fabs(eye.x), std::fabs(eye.y), std::fabs(eye.z), std::fabs(eye.w)});
  eye_ = glm::vec4(eye / eye_scale_);
}

// A triangle is culled if its doubled area after snapping has the sign of a culled one. Snapping moves a corner by up to D px, so the
// doubled area changes by up to 2D(|e1| + |e2|) + 4D², with edges of the length |e|. A triangle whose longest side in object space is L,
// and whose height on it is h, has edges of at most L · S px and a doubled area of at least L · h · K px², where K depends on the angle at
// which it is seen. Therefore all triangles of a cluster are culled if h·K > 4·D·S + 4·D²/h, because L ≥ h.
Mask Culling::faces_away(const Clusters& clusters, std::size_t first, const Boxes& boxes) const {
  const Interval w = interval(w_, boxes), x = interval(x_, boxes), y = interval(y_, boxes);
  const Real w_low = w.low(), inverse_w = Real(1.0f) / w_low;
  const Real ndc_x = max(abs(x.low()), abs(x.high())) * inverse_w, ndc_y = max(abs(y.low()), abs(y.high())) * inverse_w;
  // No triangle is clipped.
  Mask whole = (w_low > Real(2.0f * kMinW)) & (ndc_x < Real(0.999f * std::min(-viewport_.guard_left, viewport_.guard_right))) &
               (ndc_y < Real(0.999f * std::min(-viewport_.guard_bottom, viewport_.guard_top)));
  for (std::size_t k = first_depth_side_; k < sides_; ++k) whole = whole & (interval(planes_[k], boxes).low() > Real(0.0f));

  // The largest dot(n, eye.xyz − eye.w · corner) for all unit normals n in the cone and all corners in the box.
  const auto value = [&](Clusters::Value v) { return load<Real>(clusters.values(v) + first); };
  const std::array<Real, 3> axis{value(Clusters::kAxisX), value(Clusters::kAxisY), value(Clusters::kAxisZ)};
  std::array<Real, 3> to_eye;
  Real along(0.0f), square(0.0f), radius_square(0.0f), largest(0.0f);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<int>(k);
    to_eye[k] = Real(eye_[i]) - Real(eye_.w) * boxes.center[k];
    along += to_eye[k] * axis[k];
    square += to_eye[k] * to_eye[k];
    radius_square += boxes.half[k] * boxes.half[k];
    largest += Real(std::fabs(eye_[i])) + Real(std::fabs(eye_.w)) * boxes.largest[k];
  }
  // The difference of squares has an error of a few 2^-24 of them.
  const Real across = sqrt(max(square - along * along, Real(0.0f)) + Real(0x1p-20f) * square);
  const Real radius = sqrt(radius_square) * Real(1.0f + 0x1p-20f);
  const Real facing =
      along * value(Clusters::kCos) + across * value(Clusters::kSin) + Real(std::fabs(eye_.w)) * radius + Real(kError) * largest;

  const float half_width = std::fabs(viewport_.half_width), half_height = std::fabs(viewport_.half_height);
  const Real w_high = w.high();
  const Real cubed = w_high * w_high * w_high;
  const Real area = Real(static_cast<float>(static_cast<double>(half_width * half_height) * eye_scale_)) * -facing / cubed;  // K
  whole = whole & (cubed > Real(kTiny)) & (square > Real(kTiny)) & (area < Real(1.0f / kTiny));  // no underflow and no overflow
  const float slope_x = glm::length(x_.plane.normal), slope_y = glm::length(y_.plane.normal), slope_w = glm::length(w_.plane.normal);
  const Real scale =
      (Real(half_width) * (Real(slope_x) + ndc_x * Real(slope_w)) + Real(half_height) * (Real(slope_y) + ndc_y * Real(slope_w))) *
      inverse_w;  // S
  const Real error_w = error_bound(w_, boxes);
  const Real moved = Real(1.01f / 256.0f) + (Real(half_width) * (error_bound(x_, boxes) + ndc_x * error_w) +
                                             Real(half_height) * (error_bound(y_, boxes) + ndc_y * error_w)) *
                                                inverse_w;  // D, the sum of both axes
  const Real height = value(Clusters::kMinHeight);
  return whole & (facing < Real(0.0f)) & (height * area > Real(4.01f) * moved * (scale + moved / height));
}

void append(std::vector<IndexRange>& ranges, std::size_t begin, std::size_t end) {
  if (!ranges.empty() && ranges.back().end == begin) {
    ranges.back().end = end;
  } else {
    ranges.push_back({begin, end});
  }
}

bool triangle_is_culled(const Draw& draw, uint32_t triangle) {
  const DrawState& state = draw.state;
  Outcode all = kOutView, any = 0;
  std::array<std::array<int64_t, 2>, 3> window;
  const std::array<uint32_t, 3> index = Assembly(draw, triangle).next();
  const std::array<glm::vec4, 3> clip = clip_positions(draw, 0, index);
  for (std::size_t k = 0; k < 3; ++k) {
    const WindowVertex<float> v = window_vertex(draw.viewport, state.depth, clip[k].x, clip[k].y, clip[k].z, clip[k].w);
    all &= static_cast<Outcode>(v.outcode);
    any |= static_cast<Outcode>(v.outcode);
    window[k] = {v.x, v.y};
  }
  if (all != 0 || (any & kOutNonFinite) != 0) return true;
  if ((any & kOutNeedsClip) != 0) return false;
  const auto edge = [&](std::size_t k, std::size_t axis) { return window[k][axis] - window[0][axis]; };
  const int64_t area = edge(1, 0) * edge(2, 1) - edge(1, 1) * edge(2, 0);
  return area == 0 || is_culled(state.cull, is_front(state, area > 0));
}

}  // namespace

bool are_culled(const Draw& draw, std::size_t begin, std::size_t end) {
  for (std::size_t t = begin; t < end; ++t) {
    if (!triangle_is_culled(draw, static_cast<uint32_t>(t))) return false;
  }
  return true;
}

void check_clusters(const Draw& draw) {
  const DrawState& state = draw.state;
  HS_CHECK(state.clusters->clusters != nullptr, "DrawState::clusters: there are no clusters; expected a pointer to them");
  HS_CHECK(
      state.topology == Topology::triangles && state.instances == 1 && state.base_vertex == 0 && draw.kernels.emitting == nullptr &&
          !draw.kernels.gives_layer,
      "DrawState::clusters: the draw has another topology, several instances, a base_vertex, or a stage that emits primitives or chooses "
      "layers; expected a single instance of a triangle list");
  HS_CHECK(state.clusters->clusters->fits(*draw.indices),
           "DrawState::clusters: the draw has another index list; expected the one of the clusters");
}

VisibleClusters visible_clusters(const Draw& draw) {
  const FloatMode mode;
  const Clusters& clusters = *draw.state.clusters->clusters;
  const std::size_t triangles = draw.primitive_count, vertices = draw.vertex_count;
  VisibleClusters out;
  const Culling culling(draw);
  std::optional<HiddenClusters> hidden;
  if (draw.state.clusters->hidden_by != nullptr && can_hide(draw)) hidden.emplace(draw);
  std::vector<bool> is_used((vertices + kClusterVertexBlock - 1) / kClusterVertexBlock);
  for (std::size_t first = 0; first < clusters.size(); first += kLanes) {
    const uint32_t exists = bits(first_lanes<Mask>(static_cast<int>(std::min<std::size_t>(kLanes, clusters.size() - first))));
    const uint32_t skipped = bits(culling.skipped(clusters, first));
    for (uint32_t left = exists & skipped; left != 0; left &= left - 1) {
      const std::size_t begin = (first + static_cast<std::size_t>(std::countr_zero(left))) * kClusterTriangles;
      HS_DCHECK(are_culled(draw, begin, std::min(triangles, begin + kClusterTriangles)));
    }
    uint32_t left = exists & ~skipped;
    if (hidden && left != 0) left &= ~hidden->among(left, clusters, first);
    for (; left != 0; left &= left - 1) {
      const std::size_t i = first + static_cast<std::size_t>(std::countr_zero(left));
      append(out.triangles, i * kClusterTriangles, std::min<std::size_t>(triangles, (i + 1) * kClusterTriangles));
      for (const uint32_t block : clusters.vertex_blocks(i)) is_used[block] = true;
    }
  }
  for (std::size_t b = 0; b < is_used.size(); ++b) {
    if (is_used[b]) append(out.vertices, b * kClusterVertexBlock, std::min<std::size_t>(vertices, (b + 1) * kClusterVertexBlock));
  }
  for (const IndexRange& r : out.triangles) out.triangle_count += r.end - r.begin;
  for (const IndexRange& r : out.vertices) out.vertex_count += r.end - r.begin;
  return out;
}

}  // namespace halfspace::HS_LANES
