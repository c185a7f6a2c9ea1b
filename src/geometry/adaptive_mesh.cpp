// SPDX-License-Identifier: Apache-2.0
#include "halfspace/geometry/adaptive_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"

namespace halfspace::HS_LANES {

namespace {

double length_of(const glm::dvec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

double distance(const glm::vec3& a, const glm::vec3& b) { return length_of(glm::dvec3(a) - glm::dvec3(b)); }

// Twice the signed area of a triangle of grid vertices.
int cross(GridVertex a, GridVertex b, GridVertex c) { return (b.i - a.i) * (c.j - a.j) - (b.j - a.j) * (c.i - a.i); }

float rounded_up(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}

}  // namespace

PatchErrors::PatchErrors(const ParametricSurface& surface, const PatchGrid& grid, int patch, int level) : level_(level) {
  const FloatMode float_mode;
  HS_CHECK_OP(level, >=, 2, "PatchErrors: the level is too low; expected at least 2");
  HS_CHECK_OP(level, <=, 10, "PatchErrors: the level is too high; expected at most 10");
  const int n = cells();
  positions_.reserve(index({n, n}) + 1);
  glm::dvec3 sum(0.0);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      positions_.push_back(surface.at(grid.u(patch, i, level), grid.v(patch, j, level)).position);
      sum += glm::dvec3(positions_.back());
    }
  }
  center_ = sum / static_cast<double>(positions_.size());
  for (const glm::vec3& p : positions_) radius_ = std::max(radius_, length_of(glm::dvec3(p) - center_));
  errors_.resize(positions_.size());
  for (const int half : {0, 1}) measure(patch_half(half, n));
}

// Returns the error of a triangle, at least that of its parts, and stores it at the vertex that bisects the triangle.
double PatchErrors::measure(const GridTriangle& t) {
  if (!t.can_split()) return 0.0;
  const double parts = std::max(measure(t.first()), measure(t.second())), own = deviation(t);
  const GridVertex v = t.split();
  float& error = errors_[index(v)];
  error = std::max(error, rounded_up(std::max(own, parts)));
  if (std::abs(cross(t.apex, t.b, t.c)) == 4) finest_error_ = std::max(finest_error_, rounded_up(own));
  return std::max(own, parts);
}

// Returns the largest distance between a vertex of the grid in a triangle and the point of the triangle with the same (u, v).
double PatchErrors::deviation(const GridTriangle& t) const {
  const glm::dvec3 apex(position(t.apex)), to_b = glm::dvec3(position(t.b)) - apex, to_c = glm::dvec3(position(t.c)) - apex;
  const int area = cross(t.apex, t.b, t.c), sign = area < 0 ? -1 : 1;
  const auto [i0, i1] = std::minmax({t.apex.i, t.b.i, t.c.i});
  const auto [j0, j1] = std::minmax({t.apex.j, t.b.j, t.c.j});
  double largest = 0.0;
  for (int j = j0; j <= j1; ++j) {
    for (int i = i0; i <= i1; ++i) {
      const int b = sign * cross(t.apex, {i, j}, t.c), c = sign * cross(t.apex, t.b, {i, j});  // barycentric coordinates, times the area
      if (b < 0 || c < 0 || b + c > sign * area) continue;
      const double weight = 1.0 / (sign * area);
      const glm::dvec3 flat = apex + (b * weight) * to_b + (c * weight) * to_c, off = glm::dvec3(position({i, j})) - flat;
      largest = std::max(largest, off.x * off.x + off.y * off.y + off.z * off.z);
    }
  }
  return std::sqrt(largest);
}

namespace {

// Collects the vertices of a patch that bisect triangles.
void find_splits(const PatchErrors& patch, const GridTriangle& t, const SplitTest& must_split, std::vector<GridVertex>& splits) {
  if (!t.can_split()) return;
  const GridVertex v = t.split();
  const glm::vec3& center = patch.position(v);
  const double error = static_cast<double>(patch.error(v));
  const double radius = error + std::max({distance(center, patch.position(t.apex)), distance(center, patch.position(t.b)),
                                          distance(center, patch.position(t.c))});
  if (!must_split(glm::dvec3(center), radius, error)) return;
  splits.push_back(v);
  find_splits(patch, t.first(), must_split, splits);
  find_splits(patch, t.second(), must_split, splits);
}

// Makes the part of the mesh that belongs to a patch.
class PatchMesher {
 public:
  PatchMesher(const ParametricSurface& surface, const PatchGrid& grid, const GridVertices& vertices, int level)
      : surface_(surface), grid_(grid), vertices_(vertices), level_(level), numbers_(side() * side(), kNone) {}

  Mesh mesh_of(int patch) {
    mesh_ = {};
    used_.clear();
    patch_ = patch;
    for (const int half : {0, 1}) add(patch_half(half, 1 << level_));
    for (const std::size_t v : used_) numbers_[v] = kNone;
    return std::move(mesh_);
  }

 private:
  static constexpr uint32_t kNone = ~uint32_t{0};
  std::size_t side() const { return (std::size_t{1} << level_) + 1; }

  void add(const GridTriangle& t) {
    if (t.can_split() && vertices_.contains(patch_, t.split())) {
      add(t.first());
      add(t.second());
      return;
    }
    const uint32_t a = number_of(t.apex), b = number_of(t.b), c = number_of(t.c);
    const glm::vec3 &p = mesh_.positions[a], &q = mesh_.positions[b], &r = mesh_.positions[c];
    if (p == q || q == r || r == p) return;  // an edge at a pole
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
  }

  uint32_t number_of(GridVertex v) {
    const std::size_t at = static_cast<std::size_t>(v.j) * side() + static_cast<std::size_t>(v.i);
    if (numbers_[at] != kNone) return numbers_[at];
    used_.push_back(at);
    const double u = grid_.u(patch_, v.i, level_), w = grid_.v(patch_, v.j, level_);
    const SurfaceVertex vertex = surface_.at(u, w);
    mesh_.positions.push_back(vertex.position);
    mesh_.normals.push_back(vertex.normal);
    mesh_.tangents.push_back(vertex.tangent);
    mesh_.uvs.emplace_back(glm::dvec2(u, w));
    return numbers_[at] = static_cast<uint32_t>(mesh_.positions.size() - 1);
  }

  const ParametricSurface& surface_;
  const PatchGrid& grid_;
  const GridVertices& vertices_;
  int level_, patch_ = 0;
  std::vector<uint32_t> numbers_;  // in the mesh, of the vertices of the patch
  std::vector<std::size_t> used_;
  Mesh mesh_;
};

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

Mesh joined(const std::vector<Mesh>& parts) {
  Mesh out;
  for (const Mesh& part : parts) {
    const auto first = static_cast<uint32_t>(out.positions.size());
    append(out.positions, part.positions);
    append(out.normals, part.normals);
    append(out.tangents, part.tangents);
    append(out.uvs, part.uvs);
    for (const uint32_t i : part.indices) out.indices.push_back(first + i);
  }
  return out;
}

}  // namespace

Mesh adaptive_mesh(const ParametricSurface& surface, const PatchGrid& grid, std::span<const std::shared_ptr<const PatchErrors>> patches,
                   const SplitTest& must_split, const Workers& workers) {
  HS_CHECK_OP(static_cast<int>(patches.size()), ==, grid.patches(),
              "adaptive_mesh: a patch is missing; expected one per patch of the grid");
  std::vector<std::vector<GridVertex>> splits(patches.size());
  workers.for_each(grid.patches(), [&](int p) {
    const PatchErrors& patch = *patches[static_cast<std::size_t>(p)];
    for (const int half : {0, 1}) find_splits(patch, patch_half(half, patch.cells()), must_split, splits[static_cast<std::size_t>(p)]);
  });
  int level = 0;
  for (const auto& patch : patches) level = std::max(level, patch->level());
  GridVertices vertices(grid, level);
  for (int p = 0; p < grid.patches(); ++p) {
    const int scale = level - patches[static_cast<std::size_t>(p)]->level();
    for (const GridVertex v : splits[static_cast<std::size_t>(p)]) vertices.add(p, {v.i << scale, v.j << scale});
  }
  std::vector<Mesh> parts(patches.size());
  const int tasks = std::min(grid.patches(), 4 * workers.threads());
  workers.for_each(tasks, [&](int task) {
    PatchMesher mesher(surface, grid, vertices, level);
    for (int p = task; p < grid.patches(); p += tasks) parts[static_cast<std::size_t>(p)] = mesher.mesh_of(p);
  });
  return joined(parts);
}

}  // namespace halfspace::HS_LANES
