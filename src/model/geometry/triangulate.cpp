// SPDX-License-Identifier: Apache-2.0
//
// Ear clipping. The polygon is projected along the coordinate axis closest to its normal, which keeps the coordinates exact. For a planar
// polygon, this differs from a projection along the normal only by an affine map that preserves orientations. The orientation of three
// vertices is computed exactly.
//
// A vertex is an ear if it is convex and the triangle that it forms with its neighbors contains no other vertex. Only vertices that are not
// convex can be inside, so these are sorted into a grid. The number of steps is limited to a multiple of the number of vertices, because a
// polygon that intersects itself could take quadratic time or worse. Beyond the limit, vertices are clipped without tests.
#include "halfspace/model/geometry/triangulate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace halfspace::HS_LANES {

namespace {

using glm::dvec2;
using glm::dvec3;

struct Split {
  double high, low;  // their exact sum is the value
};

Split product(double a, double b) {
  const double high = a * b;
  return {high, std::fma(a, b, -high)};
}

// Knuth's two-sum.
Split sum(double a, double b) {
  const double high = a + b, b_part = high - a;
  return {high, (a - (high - b_part)) + (b - b_part)};
}

// Returns a number with the exact sign of b.x·c.y − b.x·a.y − a.x·c.y − b.y·c.x + b.y·a.x + a.y·c.x. Adds the 12 parts of the products to a
// nonoverlapping expansion (Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
// predicates", 1997, section 2.3).
double exact_orient2d(const dvec2& a, const dvec2& b, const dvec2& c) {
  const Split products[] = {product(b.x, c.y),  product(-b.x, a.y), product(-a.x, c.y),
                            product(-b.y, c.x), product(b.y, a.x),  product(a.y, c.x)};
  double parts[12];
  int count = 0;
  for (const Split& p : products) {
    for (double value : {p.low, p.high}) {
      for (int i = 0; i < count; ++i) {
        const Split s = sum(parts[i], value);
        parts[i] = s.low;
        value = s.high;
      }
      parts[count++] = value;
    }
  }
  for (int i = count - 1; i >= 0; --i) {
    if (parts[i] != 0.0) return parts[i];
  }
  return 0.0;
}

// Returns a number with the exact sign of the area of the triangle: positive if it is counter-clockwise. Overflow and underflow of products
// are not handled.
double orient2d(const dvec2& a, const dvec2& b, const dvec2& c) {
  const double left = (b.x - a.x) * (c.y - a.y), right = (b.y - a.y) * (c.x - a.x), area = left - right;
  constexpr double kErrorBound = 4.0 * std::numeric_limits<double>::epsilon();  // Shewchuk's 3.33e-16, rounded up
  if (std::abs(area) > kErrorBound * (std::abs(left) + std::abs(right))) return area;
  return exact_orient2d(a, b, c);
}

// Newell's normal, computed relative to the first vertex. Its length is twice the area.
dvec3 normal_of(std::span<const dvec3> corners) {
  dvec3 normal(0.0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) normal += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return normal;
}

// Projects points by dropping the coordinate in which the normal is largest. The projected polygon is counter-clockwise.
class Projection {
 public:
  explicit Projection(const dvec3& normal) {
    const dvec3 size = glm::abs(normal);
    const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    first_ = (axis + 1) % 3;
    second_ = (axis + 2) % 3;
    if (normal[axis] < 0.0) std::swap(first_, second_);
  }
  dvec2 operator()(const dvec3& p) const { return {p[first_], p[second_]}; }

 private:
  int first_, second_;
};

void add_fan(std::size_t apex, std::size_t count, std::vector<uint32_t>& triangles) {
  for (std::size_t i = 1; i + 1 < count; ++i) {
    for (const std::size_t corner : {apex, apex + i, apex + i + 1}) triangles.push_back(static_cast<uint32_t>(corner % count));
  }
}

// A quad with a vertex that is not convex is split at this vertex; all other quads are split along the shorter diagonal.
void add_quad(const dvec2 (&p)[4], std::span<const dvec3> corners, std::vector<uint32_t>& triangles) {
  for (std::size_t i = 0; i < 4; ++i) {
    if (orient2d(p[(i + 3) % 4], p[i], p[(i + 1) % 4]) <= 0.0) return add_fan(i, 4, triangles);
  }
  constexpr double kTie = 1.0 - 1e-6;  // equal diagonals of a regular grid are cut in the same direction
  const dvec3 d02 = corners[2] - corners[0], d13 = corners[3] - corners[1];
  add_fan(glm::dot(d13, d13) < kTie * glm::dot(d02, d02) ? 1 : 0, 4, triangles);
}

// Returns true if the fan from vertex 0 is a triangulation: all other vertices are in order around vertex 0, within half a turn.
bool is_fan(std::span<const dvec2> p) {
  for (std::size_t i = 2; i < p.size(); ++i) {
    if (orient2d(p[0], p[1], p[i]) <= 0.0 || orient2d(p[0], p[i - 1], p[i]) <= 0.0) return false;
  }
  return true;
}

class EarClipper {
 public:
  explicit EarClipper(std::vector<dvec2> points) : points_(std::move(points)), count_(points_.size()), budget_(kBudgetPerCorner * count_) {
    previous_.resize(count_);
    next_.resize(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      previous_[i] = static_cast<uint32_t>((i + count_ - 1) % count_);
      next_[i] = static_cast<uint32_t>((i + 1) % count_);
    }
    states_.resize(count_);
    for (uint32_t i = 0; i < count_; ++i) {
      update(i);
      if (states_[i] == State::convex) queue_.push_back(i);
    }
    make_grid();
  }

  void clip(std::vector<uint32_t>& triangles) {
    uint32_t any = 0;  // clipped if no vertex is an ear, i.e. if the polygon intersects itself or is degenerate
    for (std::size_t left = count_; left > 2; --left) {
      const uint32_t ear = take_ear(any), corner = ear == kNone ? any : ear;
      const uint32_t before = previous_[corner], after = next_[corner];
      triangles.insert(triangles.end(), {before, corner, after});
      next_[before] = after;
      previous_[after] = before;
      states_[corner] = State::removed;
      for (const uint32_t i : {before, after}) {
        update(i);
        if (states_[i] == State::convex) queue_.push_back(i);
      }
      any = after;
    }
  }

 private:
  // A vertex that is not convex is blocking: it may be inside the triangle of another vertex.
  enum class State : uint8_t { convex, blocking, removed };
  static constexpr uint32_t kNone = 0xffffffffu;
  static constexpr std::size_t kBudgetPerCorner = 300;
  static constexpr std::size_t kTestCost = 10;  // cost of testing a vertex against a triangle; all other steps cost 1

  double orientation(uint32_t i) const { return orient2d(points_[previous_[i]], points_[i], points_[next_[i]]); }

  void update(uint32_t i) { states_[i] = orientation(i) > 0.0 ? State::convex : State::blocking; }

  // Returns kNone if there is no ear or if the budget is exhausted. `any` is one of the remaining vertices.
  uint32_t take_ear(uint32_t any) {
    for (const bool all : {false, true}) {
      if (all) queue_all(any);
      while (queue_at_ < queue_.size() && budget_ > 0) {
        const uint32_t corner = queue_[queue_at_++];
        spend(1);
        if (states_[corner] == State::convex && is_ear(corner)) return corner;
      }
    }
    return kNone;
  }

  // Vertices that were blocked when they were tested may have become ears since.
  void queue_all(uint32_t any) {
    if (budget_ == 0) return;
    queue_.clear();
    queue_at_ = 0;
    uint32_t i = any;
    do {
      spend(1);
      if (states_[i] == State::convex) queue_.push_back(i);
      i = next_[i];
    } while (i != any);
  }

  bool is_ear(uint32_t corner) {
    const dvec2 &a = points_[previous_[corner]], &b = points_[corner], &c = points_[next_[corner]];
    const dvec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
    const glm::ivec2 first = cell_of(low), last = cell_of(high);
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x; x <= last.x; ++x) {
        spend(1);
        const std::size_t cell = number_of({x, y});
        for (uint32_t i = cell_begin_[cell]; i < cell_begin_[cell + 1]; ++i) {
          const dvec2& p = points_[grid_[i]];
          spend(1);
          if (states_[grid_[i]] != State::blocking || p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) continue;
          spend(kTestCost);
          if (is_in_triangle(p, a, b, c)) return false;
        }
      }
    }
    return true;
  }

  // Includes the edges, but not points that coincide with a vertex: a hole connected by two coincident edges has such vertices.
  static bool is_in_triangle(const dvec2& p, const dvec2& a, const dvec2& b, const dvec2& c) {
    if (p == a || p == b || p == c) return false;
    return orient2d(a, b, p) >= 0.0 && orient2d(b, c, p) >= 0.0 && orient2d(c, a, p) >= 0.0;
  }

  void spend(std::size_t tests) { budget_ -= std::min(budget_, tests); }

  void make_grid() {
    low_ = high_ = points_[0];
    for (const dvec2& p : points_) {
      low_ = glm::min(low_, p);
      high_ = glm::max(high_, p);
    }
    const auto blocking = static_cast<std::size_t>(std::ranges::count(states_, State::blocking));
    // Roughly square cells, with two blocking vertices per cell on average.
    const double cells = static_cast<double>(blocking) / 2.0 + 1.0, width = high_.x - low_.x, height = high_.y - low_.y;
    const double columns = height > 0.0 ? std::clamp(std::sqrt(cells * (width / height)), 1.0, cells) : cells;
    cells_ = {static_cast<int>(columns), static_cast<int>(cells / columns)};
    cell_begin_.assign(static_cast<std::size_t>(cells_.x) * static_cast<std::size_t>(cells_.y) + 1, 0);
    const auto cell_number = [&](uint32_t i) { return number_of(cell_of(points_[i])); };
    for (uint32_t i = 0; i < count_; ++i) {
      if (states_[i] == State::blocking) ++cell_begin_[cell_number(i) + 1];
    }
    for (std::size_t i = 1; i < cell_begin_.size(); ++i) cell_begin_[i] += cell_begin_[i - 1];
    grid_.resize(blocking);
    std::vector<uint32_t> at(cell_begin_.begin(), cell_begin_.end() - 1);
    for (uint32_t i = 0; i < count_; ++i) {
      if (states_[i] == State::blocking) grid_[at[cell_number(i)]++] = i;
    }
  }

  std::size_t number_of(const glm::ivec2& cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(cells_.x) + static_cast<std::size_t>(cell.x);
  }

  glm::ivec2 cell_of(const dvec2& p) const {
    glm::ivec2 cell(0);
    for (int axis = 0; axis < 2; ++axis) {
      const double size = high_[axis] - low_[axis];
      const double at = size > 0.0 ? (p[axis] - low_[axis]) / size * cells_[axis] : 0.0;
      cell[axis] = static_cast<int>(std::clamp(at, 0.0, static_cast<double>(cells_[axis] - 1)));
    }
    return cell;
  }

  std::vector<dvec2> points_;
  std::size_t count_;
  std::size_t budget_;                     // remaining steps
  std::vector<uint32_t> previous_, next_;  // linked list of the remaining vertices
  std::vector<State> states_;
  std::vector<uint32_t> queue_;  // convex vertices that may be ears; the first queue_at_ have been taken
  std::size_t queue_at_ = 0;
  dvec2 low_{0.0}, high_{0.0};
  glm::ivec2 cells_{1};                      // number of grid cells per axis
  std::vector<uint32_t> cell_begin_, grid_;  // vertices that are blocking at the start, by cell
};

}  // namespace

void triangulate(std::span<const dvec3> corners, std::vector<uint32_t>& triangles) {
  const std::size_t count = corners.size();
  if (count < 4) return add_fan(0, count, triangles);
  const dvec3 normal = normal_of(corners);
  if (!(glm::dot(normal, normal) > 0.0)) return add_fan(0, count, triangles);
  const Projection project(normal);
  if (count == 4) {
    const dvec2 quad[4] = {project(corners[0]), project(corners[1]), project(corners[2]), project(corners[3])};
    return add_quad(quad, corners, triangles);
  }
  std::vector<dvec2> points(count);
  std::ranges::transform(corners, points.begin(), project);
  if (is_fan(points)) return add_fan(0, count, triangles);
  EarClipper(std::move(points)).clip(triangles);
}

}  // namespace halfspace::HS_LANES
