// SPDX-License-Identifier: Apache-2.0
//
// The distance to a triangle T is a convex function, because T is convex. On a triangle with the corners a, b, c, its maximum is therefore
// at a corner, so that
//
//   max d(p, to) ≤ max(d(a, T), d(b, T), d(c, T))   for every triangle T of `to`.                                          (1)
//
// If no T is near all three corners, the bound is far above the distance. But d(p, to) changes by at most the length of a step, and every
// point p of the triangle is within L/√3 of a corner, where L is the longest side: if p has the barycentric coordinates λ, the mean of the
// squared distances to the corners, weighted with λ, is Σ λi·λj·|vi − vj|² ≤ L²·Σ λi·λj ≤ L²/3 (sums over i < j). So
//
//   max d(p, to) ≤ max(d(a, to), d(b, to), d(c, to)) + L/√3.                                                              (2)
//
// SurfaceDistance divides a triangle until one of the two bounds is at most its limit, or until the task has visited too many nodes of the
// tree. The distance to any triangle is an upper bound of d, so a search that ends early makes the result higher, never too low.
#include "halfspace/model/detail/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace halfspace::HS_LANES {

namespace {

constexpr int kMaxDivisions = 10;  // of a triangle into four
constexpr double kSlack = 1.5;
constexpr std::size_t kBlock = 1024;  // vertices or triangles of a task
// Nodes of the tree that a task may visit, per triangle of the finer surface. Long triangles that cross many others reach this number, and
// their result is then higher. Each task has its own budget, so that the result does not depend on the number of threads.
constexpr int64_t kVisitsPerTriangle = 4096;

struct Corner {
  glm::dvec3 position;
  TriangleTree::Nearest nearest{};
};

class SurfaceDistance {
 public:
  // visits: see TriangleTree::nearest.
  SurfaceDistance(const TriangleTree& to, double limit, int64_t& visits) : to_(to), limit_(limit), visits_(visits) {}

  // Returns a bound for a triangle, after at most `depth` divisions of a part. The bound is hardly ever lower than the distance of a
  // corner, so the limit rises with these distances.
  double bound(const std::array<Corner, 3>& corners, int depth = kMaxDivisions) {
    for (const Corner& c : corners) limit_ = std::max(limit_, kSlack * std::sqrt(c.nearest.squared));
    const double whole = undivided_bound(corners);
    if (whole <= limit_ || depth == 0 || visits_ <= 0) return whole;
    std::array<Corner, 3> middle;  // middle[i] is opposite to corner i
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner &a = corners[(i + 1) % 3], &b = corners[(i + 2) % 3];
      middle[i].position = 0.5 * (a.position + b.position);
      middle[i].nearest = to_.nearest(middle[i].position, a.nearest.triangle, visits_);
    }
    double divided = bound(middle, depth - 1);
    for (std::size_t i = 0; i < 3; ++i)
      divided = std::max(divided, bound({corners[i], middle[(i + 1) % 3], middle[(i + 2) % 3]}, depth - 1));
    return std::min(whole, divided);
  }

 private:
  double undivided_bound(const std::array<Corner, 3>& corners) {
    double longest = 0.0, farthest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 side = corners[(i + 1) % 3].position - corners[i].position;
      longest = std::max(longest, glm::dot(side, side));
      farthest = std::max(farthest, corners[i].nearest.squared);
    }
    const double by_step = std::sqrt(farthest) + std::sqrt(longest) / std::numbers::sqrt3;  // (2)
    if (by_step <= limit_) return by_step;
    double by_triangle = std::numeric_limits<double>::infinity();
    for (const Corner& c : corners) by_triangle = std::min(by_triangle, distance_to(c.nearest.triangle, corners));
    if (by_triangle <= limit_) return by_triangle;
    // A corner may be equally near to several triangles. The one below the center is the best of them.
    const glm::dvec3 center = (corners[0].position + corners[1].position + corners[2].position) / 3.0;
    return std::min({by_step, by_triangle, distance_to(to_.nearest(center, corners[0].nearest.triangle, visits_).triangle, corners)});
  }

  // Returns the right side of (1).
  double distance_to(uint32_t triangle, const std::array<Corner, 3>& corners) const {
    double squared = 0.0;
    for (const Corner& c : corners) squared = std::max(squared, to_.distance_squared(c.position, triangle));
    return std::sqrt(squared);
  }

  const TriangleTree& to_;
  double limit_;
  int64_t& visits_;
};

// Calls task(first, end) for blocks of [0, count).
template <class F>
void for_blocks(std::size_t count, const Workers& workers, const F& task) {
  workers.for_each(static_cast<int>((count + kBlock - 1) / kBlock), [&](int block) {
    const std::size_t first = static_cast<std::size_t>(block) * kBlock;
    task(first, std::min(first + kBlock, count));
  });
}

}  // namespace

double distance_bound(const TriangleList& from, const TriangleTree& to, double resolution, const Workers& workers) {
  std::vector<Corner> corners(from.positions.size());
  std::vector<uint8_t> is_used(corners.size(), 0);
  for (const uint32_t i : from.indices) is_used[i] = 1;
  const std::size_t count = from.indices.size() / 3;
  const auto share = static_cast<int64_t>(std::max<std::size_t>(1, to.size() / std::max<std::size_t>(count, 1)));
  const int64_t visits_of_block = kVisitsPerTriangle * static_cast<int64_t>(kBlock) * share;
  for_blocks(corners.size(), workers, [&](std::size_t first, std::size_t end) {
    int64_t visits = visits_of_block;
    uint32_t hint = 0;  // each block starts with the same one, so that the results do not depend on the threads
    for (std::size_t i = first; i < end; ++i) {
      corners[i].position = glm::dvec3(from.positions[i]);
      if (is_used[i] == 0) continue;
      corners[i].nearest = to.nearest(corners[i].position, hint, visits);
      hint = corners[i].nearest.triangle;
    }
  });
  double farthest = 0.0;
  for (const Corner& c : corners) farthest = std::max(farthest, c.nearest.squared);
  const double limit = std::max(kSlack * std::sqrt(farthest), resolution);
  std::vector<double> bounds(count / kBlock + 1, 0.0);
  for_blocks(count, workers, [&](std::size_t first, std::size_t end) {
    double& bound = bounds[first / kBlock];
    int64_t visits = visits_of_block;
    for (std::size_t i = first; i < end; ++i) {
      const auto corner = [&](std::size_t k) { return corners[from.indices[3 * i + k]]; };
      bound = std::max(bound, SurfaceDistance(to, limit, visits).bound({corner(0), corner(1), corner(2)}));
    }
  });
  return *std::ranges::max_element(bounds);
}

}  // namespace halfspace::HS_LANES
