// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/detail/triangle_tree.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kLeafTriangles = 4;
constexpr std::size_t kMaxDepth = 64;  // halving 2^32 triangles takes 32 levels

double squared_length(const glm::dvec3& v) { return glm::dot(v, v); }

double segment_distance_squared(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length = squared_length(along);
  const double t = length > 0.0 ? std::clamp(glm::dot(p - a, along) / length, 0.0, 1.0) : 0.0;
  return squared_length(p - (a + along * t));
}

}  // namespace

TriangleTree::TriangleTree(std::span<const glm::vec3> positions, std::span<const uint32_t> indices) {
  std::vector<Corners> triangles(indices.size() / 3);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) triangles[i][k] = positions[indices[3 * i + k]];
  }
  std::vector<uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  triangles_.reserve(triangles.size());
  build(order, triangles);
}

// The triangles are divided at the median of their centers. Equal centers are ordered by their numbers, so that the halves do not depend on
// the implementation of nth_element.
void TriangleTree::build(std::span<uint32_t> order, std::span<const Corners> triangles) {
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  const auto center = [&](uint32_t i) { return triangles[i][0] + triangles[i][1] + triangles[i][2]; };  // three times the center
  glm::vec3 low = triangles[order[0]][0], high = low, low_center = center(order[0]), high_center = low_center;
  for (const uint32_t i : order) {
    for (const glm::vec3& p : triangles[i]) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    low_center = glm::min(low_center, center(i));
    high_center = glm::max(high_center, center(i));
  }
  nodes_[index].low = low;
  nodes_[index].high = high;
  if (order.size() <= kLeafTriangles) {
    std::ranges::sort(order);
    nodes_[index].first = static_cast<uint32_t>(triangles_.size());
    nodes_[index].count = static_cast<uint32_t>(order.size());
    for (const uint32_t i : order) triangles_.push_back(triangles[i]);
    return;
  }
  const glm::vec3 size = high_center - low_center;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto before = [&](uint32_t i, uint32_t j) { return std::tuple(center(i)[axis], i) < std::tuple(center(j)[axis], j); };
  const std::size_t half = order.size() / 2;
  std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(half), before);
  build(order.first(half), triangles);
  nodes_[index].first = static_cast<uint32_t>(nodes_.size());
  build(order.subspan(half), triangles);
}

double TriangleTree::longest_side() const {
  const glm::dvec3 sides = glm::dvec3(nodes_[0].high) - glm::dvec3(nodes_[0].low);
  return std::max({sides.x, sides.y, sides.z});
}

double TriangleTree::box_distance_squared(const glm::dvec3& p, uint32_t node) const {
  return squared_length(p - glm::clamp(p, glm::dvec3(nodes_[node].low), glm::dvec3(nodes_[node].high)));
}

double TriangleTree::distance_squared(const glm::dvec3& p, uint32_t triangle) const {
  const glm::dvec3 a(triangles_[triangle][0]), b(triangles_[triangle][1]), c(triangles_[triangle][2]);
  const glm::dvec3 ab = b - a, ac = c - a, n = glm::cross(ab, ac), from_a = p - a;
  const double nn = squared_length(n);
  if (nn > 1e-12 * squared_length(ab) * squared_length(ac)) {
    // p = a + v·ab + w·ac + a multiple of n
    const double v = glm::dot(glm::cross(from_a, ac), n), w = glm::dot(glm::cross(ab, from_a), n);
    if (v >= 0.0 && w >= 0.0 && v + w <= nn) {
      const double height = glm::dot(from_a, n);
      return height * height / nn;
    }
  }
  return std::min({segment_distance_squared(p, a, b), segment_distance_squared(p, b, c), segment_distance_squared(p, c, a)});
}

TriangleTree::Nearest TriangleTree::nearest(const glm::dvec3& p, uint32_t hint, int64_t& visits) const {
  Nearest best{distance_squared(p, hint), hint};
  struct Entry {
    double squared;
    uint32_t node;
  };
  std::array<Entry, kMaxDepth> stack;
  std::size_t size = 0;
  stack[size++] = {box_distance_squared(p, 0), 0};
  for (; size > 0 && visits > 0; --visits) {
    const auto [squared, index] = stack[--size];
    if (squared >= best.squared) continue;
    const Node& node = nodes_[index];
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (const double d = distance_squared(p, i); d < best.squared) best = {d, i};
    }
    if (node.count > 0) continue;
    Entry near{box_distance_squared(p, index + 1), index + 1}, far{box_distance_squared(p, node.first), node.first};
    if (far.squared < near.squared) std::swap(near, far);
    stack[size++] = far;
    stack[size++] = near;
  }
  return best;
}

}  // namespace halfspace::HS_LANES
