// SPDX-License-Identifier: Apache-2.0
//
// Normals are computed in double and rounded once. Only the angles are floats, with an error of at most 2 ulp (atan2 in lane_math.h). This
// changes normals by less than 1e-6, and atan2 is bit-identical on every machine.
#include "halfspace/model/geometry/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/core/trig_double.h"
#include "halfspace/model/geometry/mesh_vertices.h"
#include "halfspace/model/geometry/position_ids.h"

namespace halfspace::HS_LANES {

glm::vec3 unit_vector(const glm::dvec3& n) {
  constexpr double kRounding = 2e-7;  // rounding error of the squared length of a unit vector of floats
  const double squared = glm::dot(n, n);
  return std::fabs(squared - 1.0) <= kRounding ? glm::vec3(n) : glm::vec3(n / std::sqrt(squared));
}

namespace {

constexpr glm::vec3 kDefaultNormal{0.0f, 1.0f, 0.0f};
constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

// Added to the cosine of the angle between two planes, so that rounded positions do not create creases in a flat surface.
constexpr double kCosineTolerance = 1e-6;

// Each triangle at an edge is compared with at most 16 others, so that an edge shared by very many triangles does not take quadratic time.
constexpr std::size_t kMaxComparisons = 16;

double length_of(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

/// Converts to float; −0 becomes 0.
glm::vec3 rounded(const glm::dvec3& v) { return glm::vec3(v + 0.0); }

struct Triangle {
  std::array<glm::dvec3, 3> corners;

  Triangle(const ModelMesh& mesh, std::size_t t) {
    for (std::size_t k = 0; k < 3; ++k) corners[k] = glm::dvec3(mesh.positions[mesh.indices[3 * t + k]]);
  }

  /// Returns the unit normal, or zero if the triangle is degenerate.
  glm::dvec3 normal() const {
    const glm::dvec3 n = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = length_of(n);
    return length > 0.0 ? n / length : glm::dvec3(0.0);
  }

  /// Returns the angle at corner k in radians. The triangle must not be degenerate.
  float angle(std::size_t k) const {
    const glm::dvec3 a = corners[(k + 1) % 3] - corners[k], b = corners[(k + 2) % 3] - corners[k];
    const double scale = 1.0 / std::sqrt(glm::dot(a, a) * glm::dot(b, b));
    return atan2(static_cast<float>(length_of(glm::cross(a, b)) * scale), static_cast<float>(glm::dot(a, b) * scale));
  }
};

void remove_tangents(ModelMesh& mesh) {
  mesh.tangents.clear();
  for (MorphTarget& target : mesh.targets) target.tangents.clear();
}

/// Decides which triangles share a normal. A corner is numbered 3·triangle + k.
class Facets {
 public:
  Facets(const ModelMesh& mesh, float crease_degrees, std::span<const uint32_t> groups)
      : min_cosine_(sincos_turns(static_cast<double>(crease_degrees) / 360.0).cos - kCosineTolerance), groups_(groups) {
    const std::size_t count = mesh.indices.size() / 3;
    normals_.resize(count);
    angles_.resize(3 * count);
    for (std::size_t t = 0; t < count; ++t) {
      const Triangle triangle(mesh, t);
      normals_[t] = triangle.normal();
      if (is_degenerate(t)) continue;
      for (std::size_t k = 0; k < 3; ++k) angles_[3 * t + k] = triangle.angle(k);
    }
  }

  bool is_degenerate(std::size_t triangle) const { return normals_[triangle] == glm::dvec3(0.0); }
  const glm::dvec3& normal(uint32_t corner) const { return normals_[corner / 3]; }
  glm::dvec3 weighted_normal(uint32_t corner) const { return static_cast<double>(angles_[corner]) * normals_[corner / 3]; }

  bool is_smooth(uint32_t corner_a, uint32_t corner_b) const {
    const uint32_t a = corner_a / 3, b = corner_b / 3;
    if (!groups_.empty()) return groups_[a] == groups_[b] && groups_[a] != 0;
    return glm::dot(normals_[a], normals_[b]) >= min_cosine_;
  }

 private:
  double min_cosine_;
  std::span<const uint32_t> groups_;
  std::vector<glm::dvec3> normals_;
  std::vector<float> angles_;
};

/// The corners of all triangles that are not degenerate, ordered by the point that they share.
struct PointCorners {
  std::vector<uint32_t> first, corners;  ///< the corners of point p are corners[first[p]] … corners[first[p + 1] − 1]

  PointCorners(const ModelMesh& mesh, std::span<const uint32_t> points, const Facets& facets) : first(points.size() + 1) {
    const auto for_each_corner = [&](auto&& f) {
      for (uint32_t c = 0; c < mesh.indices.size(); ++c) {
        if (!facets.is_degenerate(c / 3)) f(points[mesh.indices[c]], c);
      }
    };
    for_each_corner([&](uint32_t point, uint32_t) { ++first[point + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    corners.resize(first.back());
    std::vector<uint32_t> next(first.begin(), first.end() - 1);
    for_each_corner([&](uint32_t point, uint32_t c) { corners[next[point]++] = c; });
  }

  std::span<const uint32_t> of(std::size_t point) const {
    return std::span(corners).subspan(first[point], first[point + 1] - first[point]);
  }
};

/// Divides the corners around a point into fans, which are connected by smooth edges.
class Fans {
 public:
  /// Calls fan(corners) for each fan.
  template <class F>
  void for_each(const ModelMesh& mesh, std::span<const uint32_t> points, const Facets& facets, std::span<const uint32_t> corners, F&& fan) {
    connect(mesh, points, facets, corners);
    order_.clear();
    for (uint32_t i = 0; i < corners.size(); ++i) order_.push_back(key(root(i), i));
    std::ranges::sort(order_);
    for (std::size_t i = 0; i < order_.size();) {
      const uint64_t root = order_[i] >> 32;
      fan_.clear();
      for (; i < order_.size() && order_[i] >> 32 == root; ++i) fan_.push_back(corners[static_cast<uint32_t>(order_[i])]);
      fan(std::span<const uint32_t>(fan_));
    }
  }

 private:
  static uint64_t key(uint32_t high, uint32_t low) { return uint64_t{high} << 32 | low; }

  uint32_t root(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void unite(uint32_t a, uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  void connect(const ModelMesh& mesh, std::span<const uint32_t> points, const Facets& facets, std::span<const uint32_t> corners) {
    parent_.resize(corners.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
    edges_.clear();  // for each edge, its other point and a corner of its triangle
    for (uint32_t i = 0; i < corners.size(); ++i) {
      const uint32_t first = corners[i] - corners[i] % 3, k = corners[i] % 3;
      for (const uint32_t other : {(k + 1) % 3, (k + 2) % 3}) edges_.push_back(key(points[mesh.indices[first + other]], i));
    }
    std::ranges::sort(edges_);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const std::size_t end = std::min(edges_.size(), e + 1 + kMaxComparisons);
      for (std::size_t f = e + 1; f < end && edges_[f] >> 32 == edges_[e] >> 32; ++f) {
        const auto a = static_cast<uint32_t>(edges_[e]), b = static_cast<uint32_t>(edges_[f]);
        if (facets.is_smooth(corners[a], corners[b])) unite(a, b);
      }
    }
  }

  std::vector<uint32_t> parent_, fan_;
  std::vector<uint64_t> edges_, order_;
};

/// Assigns normals to vertices. A vertex whose corners are in several fans is split.
class VertexNormals {
 public:
  explicit VertexNormals(std::size_t count) : sources_(count), normals_(count, kDefaultNormal), fan_of_(count, kNone), copy_of_(count) {
    std::iota(sources_.begin(), sources_.end(), 0u);
  }

  void add_fan(std::span<uint32_t> indices, std::span<const uint32_t> corners, const glm::vec3& normal) {
    for (const uint32_t corner : corners) {
      const uint32_t vertex = indices[corner];
      if (fan_of_[vertex] != fans_) {
        copy_of_[vertex] = fan_of_[vertex] == kNone ? vertex : add_copy(vertex);
        fan_of_[vertex] = fans_;
        normals_[copy_of_[vertex]] = normal;
      }
      indices[corner] = copy_of_[vertex];
    }
    ++fans_;
  }

  void store(ModelMesh& mesh) && {
    if (sources_.size() > mesh.positions.size()) copy_vertices(mesh, sources_);
    mesh.normals = std::move(normals_);
  }

 private:
  uint32_t add_copy(uint32_t vertex) {
    sources_.push_back(vertex);
    normals_.push_back(kDefaultNormal);
    return static_cast<uint32_t>(sources_.size() - 1);
  }

  std::vector<uint32_t> sources_;
  std::vector<glm::vec3> normals_;
  std::vector<uint32_t> fan_of_, copy_of_;  // per original vertex: the last fan that used it, and its copy for this fan
  uint32_t fans_ = 0;
};

glm::vec3 normal_of_fan(const Facets& facets, std::span<const uint32_t> corners) {
  glm::dvec3 sum(0.0);
  for (const uint32_t corner : corners) sum += facets.weighted_normal(corner);
  const double length = length_of(sum);
  return rounded(length > 0.0 ? sum / length : facets.normal(corners[0]));
}

}  // namespace

void add_flat_normals(ModelMesh& mesh) {
  HS_CHECK(mesh.topology == MeshTopology::triangles, "normals: the mesh has lines or points; expected triangles");
  std::vector<glm::vec3> normals;
  normals.reserve(mesh.indices.size());
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    const glm::dvec3 normal = Triangle(mesh, t).normal();
    normals.insert(normals.end(), 3, normal == glm::dvec3(0.0) ? kDefaultNormal : rounded(normal));
  }
  remove_tangents(mesh);
  copy_vertices(mesh, mesh.indices);
  std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
  mesh.normals = std::move(normals);
}

void add_smooth_normals(ModelMesh& mesh, float crease_degrees, std::span<const uint32_t> groups) {
  HS_CHECK(mesh.topology == MeshTopology::triangles, "normals: the mesh has lines or points; expected triangles");
  HS_CHECK(groups.empty() || groups.size() == mesh.indices.size() / 3,
           "add_smooth_normals: the number of groups differs from that of triangles; expected one group per triangle, or none");
  HS_CHECK_OP(mesh.indices.size(), <, kNone, "add_smooth_normals: too many indices; expected fewer than 2^32 - 1");
  remove_tangents(mesh);
  const std::vector<uint32_t> points = position_ids(mesh.positions);
  const Facets facets(mesh, crease_degrees, groups);
  const PointCorners point_corners(mesh, points, facets);
  VertexNormals normals(mesh.positions.size());
  Fans fans;
  std::vector<uint32_t> indices = mesh.indices;  // a copy, because the fans of other points need the original indices
  for (std::size_t p = 0; p < points.size(); ++p) {
    fans.for_each(mesh, points, facets, point_corners.of(p),
                  [&](std::span<const uint32_t> corners) { normals.add_fan(indices, corners, normal_of_fan(facets, corners)); });
  }
  mesh.indices = std::move(indices);
  std::move(normals).store(mesh);
}

}  // namespace halfspace::HS_LANES
