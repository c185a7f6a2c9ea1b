// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/lanes.h"

namespace halfspace::HS_LANES {

namespace {

// Triangles with a smaller ratio of height and length are too thin for a reliable normal, and cones with a larger angle cull too little.
constexpr double kMinRatio = 1e-5, kMinCos = 0.05;

struct Bounds {
  glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};
  glm::dvec3 axis{0.0};
  double min_cos = 1.0, min_height = std::numeric_limits<double>::infinity();
};

struct Shape {
  glm::dvec3 normal;  // unit length
  double height;      // on the longest side
  double longest;
};

// Each difference and product has an error of 2^-53, which is far below the margins of the cone.
Shape shape_of(const std::array<glm::vec3, 3>& p) {
  const glm::dvec3 ab(glm::dvec3(p[1]) - glm::dvec3(p[0])), ac(glm::dvec3(p[2]) - glm::dvec3(p[0])), bc = ac - ab, n = glm::cross(ab, ac);
  const double twice_area = glm::length(n), longest = std::sqrt(std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)}));
  return {n / twice_area, twice_area / longest, longest};
}

bool is_finite(const glm::vec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }
// A triangle with a corner that is not finite is never drawn.
bool is_finite(const std::array<glm::vec3, 3>& p) { return is_finite(p[0]) && is_finite(p[1]) && is_finite(p[2]); }
// A triangle with two equal corners is never filled. Its outline can be drawn.
bool has_area(const std::array<glm::vec3, 3>& p) { return p[0] != p[1] && p[1] != p[2] && p[2] != p[0]; }

Bounds bounds_of(std::span<const std::array<glm::vec3, 3>> triangles) {
  Bounds out;
  std::array<Shape, kClusterTriangles> shapes;
  std::size_t filled = 0;
  for (const std::array<glm::vec3, 3>& t : triangles) {
    if (!is_finite(t)) continue;
    for (const glm::vec3& p : t) {
      out.low = glm::min(out.low, p);
      out.high = glm::max(out.high, p);
    }
    if (!has_area(t)) continue;
    shapes[filled] = shape_of(t);
    out.axis += shapes[filled++].normal;
  }
  const double length = glm::length(out.axis);
  out.axis /= length;
  for (const Shape& s : std::span(shapes).first(filled)) {
    out.min_cos = std::min(out.min_cos, glm::dot(s.normal, out.axis));
    out.min_height = std::min(out.min_height, s.height >= kMinRatio * s.longest ? s.height : 0.0);
  }
  // The comparisons are written so that NaN means no cone.
  if (!(length > 0.0 && out.min_cos >= kMinCos && out.min_height < std::numeric_limits<double>::infinity())) {
    out.axis = {0.0, 0.0, 1.0};
    out.min_cos = 1.0;
    out.min_height = 0.0;
  }
  return out;
}

// Returns the number of an index among the distinct indices of the list.
uint32_t number_of(const Indices& indices, uint32_t index) {
  const std::span<const uint32_t> used = indices.used();
  if (used.empty()) return index - indices.first_vertex();
  return static_cast<uint32_t>(std::ranges::lower_bound(used, index) - used.begin());
}

}  // namespace

Clusters::Clusters(const VertexStream& positions, const Indices& indices)
    : count_((indices.size() / 3 + kClusterTriangles - 1) / kClusterTriangles),
      index_count_(indices.size()),
      vertex_count_(indices.used_count()),
      first_vertex_(indices.first_vertex()),
      end_vertex_(indices.end_vertex()) {
  const FloatMode mode;
  HS_CHECK_OP(positions.components, ==, 3, "Clusters: the stream has another number of components; expected positions of three");
  HS_CHECK_OP(positions.divisor, ==, 0u, "Clusters: the stream has rows per instance; expected one row per vertex");
  HS_CHECK(positions.read_as != ReadAs::integers, "Clusters: the stream contains integers; expected positions that are read as floats");
  HS_CHECK(indices.restarts().empty(), "Clusters: the index list has restarts; expected a list of triangles");
  HS_CHECK_OP(indices.end_vertex(), <=, positions.count, "Clusters: an index is too large; expected less than the number of positions");
  const std::size_t padded = (count_ + kLanes - 1) / kLanes * kLanes;
  for (std::vector<float>& v : values_) v.resize(padded);
  first_block_.reserve(count_ + 1);
  first_block_.push_back(0);
  std::array<std::array<glm::vec3, 3>, kClusterTriangles> triangles;
  std::array<uint32_t, 3 * kClusterTriangles> corners;
  std::vector<uint32_t> blocks;
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t first = i * corners.size(), count = std::min(corners.size(), indices.size() / 3 * 3 - first);
    blocks.clear();
    for (std::size_t k = 0; k < count; ++k) {
      corners[k] = indices[first + k];
      const uint32_t block = number_of(indices, corners[k]) / kClusterVertexBlock;
      if (blocks.empty() || blocks.back() != block) blocks.push_back(block);
    }
    read_rows(positions, std::span(corners).first(count), &triangles[0][0].x);
    const Bounds b = bounds_of(std::span(triangles).first(count / 3));
    for (std::size_t k = 0; k < 3; ++k) {
      const int axis = static_cast<int>(k);
      values_[kLowX + k][i] = b.low[axis];
      values_[kHighX + k][i] = b.high[axis];
      values_[kAxisX + k][i] = static_cast<float>(b.axis[axis]);
    }
    // The cone is enlarged by more than the rounding of its values to floats.
    const double cosine = std::max(b.min_cos - 1e-6, 0.0);
    values_[kCos][i] = static_cast<float>(cosine);
    values_[kSin][i] = static_cast<float>(std::sqrt(1.0 - cosine * cosine));
    values_[kMinHeight][i] = static_cast<float>(b.min_height * (1.0 - 1e-6));
    std::ranges::sort(blocks);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    blocks_.insert(blocks_.end(), blocks.begin(), blocks.end());
    first_block_.push_back(static_cast<uint32_t>(blocks_.size()));
  }
}

}  // namespace halfspace::HS_LANES
