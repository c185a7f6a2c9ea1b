// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/obj/obj_meshes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <tuple>

#include "halfspace/model/geometry/face_triangles.h"
#include "halfspace/model/geometry/mesh_vertices.h"
#include "halfspace/model/geometry/normals.h"
#include "halfspace/model/text/srgb_color.h"

namespace halfspace::HS_LANES {

namespace {

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  glm::dvec3 center() const { return low + (high - low) * 0.5; }
};

Bounds bounds_of(const ObjText& obj) {
  Bounds bounds;
  for (const ObjCorner& corner : obj.corners) {
    bounds.low = glm::min(bounds.low, obj.positions[corner.position]);
    bounds.high = glm::max(bounds.high, obj.positions[corner.position]);
  }
  return bounds;
}

// Elements that form one mesh.
struct Group {
  MeshTopology topology;
  int material;
  bool has_normals;
  std::string name;
  std::vector<uint32_t> elements;
};

bool has_normals(const ObjText& obj, std::size_t element) {
  if (obj.states[obj.elements[element].state].topology != MeshTopology::triangles) return false;
  for (std::size_t i = obj.elements[element].first_corner; i < obj.end_corner(element); ++i) {
    const uint32_t normal = obj.corners[i].normal;
    if (normal >= obj.normals.size() || obj.normals[normal] == glm::vec3(0.0f)) return false;
  }
  return true;
}

std::vector<Group> groups_of(const ObjText& obj) {
  constexpr std::size_t kUnknown = std::numeric_limits<std::size_t>::max();
  std::vector<Group> groups;
  std::map<std::tuple<MeshTopology, int, bool>, std::size_t> numbers;
  std::vector<std::array<std::size_t, 2>> group_of_state(obj.states.size(), {kUnknown, kUnknown});
  for (std::size_t i = 0; i < obj.elements.size(); ++i) {
    const ObjState& state = obj.states[obj.elements[i].state];
    const bool normals = has_normals(obj, i);
    std::size_t& group = group_of_state[obj.elements[i].state][normals ? 1 : 0];
    if (group == kUnknown) {
      const auto [known, added] = numbers.try_emplace({state.topology, state.material, normals}, groups.size());
      if (added) groups.push_back({state.topology, state.material, normals, state.name, {}});
      group = known->second;
    }
    groups[group].elements.push_back(static_cast<uint32_t>(i));
  }
  return groups;
}

class MeshBuilder {
 public:
  MeshBuilder(const ObjText& obj, const glm::dvec3& origin, float crease_degrees)
      : obj_(obj), crease_degrees_(crease_degrees), origin_(origin), last_vertex_(obj.positions.size(), kNoIndex) {
    if (obj.colors.empty()) return;
    for (const ObjCorner& corner : obj.corners) {
      const glm::vec3& color = obj.colors[corner.position];
      if (std::max({color.x, color.y, color.z}) > 1.0f) color_scale_ = 1.0f / 255.0f;
    }
  }

  ModelMesh build(const Group& group) {
    corners_.clear();
    next_.clear();
    smoothing_.clear();
    has_unused_ = false;
    ModelMesh mesh;
    mesh.name = group.name;
    mesh.topology = group.topology;
    mesh.material = group.material;
    mesh.origin = origin_;
    for (const uint32_t element : group.elements) add_element(mesh, group.has_normals, element);
    fill_vertices(mesh, group.has_normals);
    if (has_unused_) remove_unused_vertices(mesh);
    first_vertex_ += static_cast<uint32_t>(corners_.size());
    if (mesh.topology == MeshTopology::triangles && !group.has_normals) {
      add_smooth_normals(mesh, crease_degrees_, smoothing_);
      mesh.computed_normals = true;
    }
    return mesh;
  }

 private:
  void add_element(ModelMesh& mesh, bool with_normals, uint32_t element) {
    polygon_.clear();
    for (std::size_t i = obj_.elements[element].first_corner; i < obj_.end_corner(element); ++i) {
      ObjCorner corner = obj_.corners[i];
      if (corner.uv >= obj_.uvs.size()) corner.uv = kNoIndex;
      if (!with_normals) corner.normal = kNoIndex;
      polygon_.push_back(vertex(corner));
    }
    switch (mesh.topology) {
      case MeshTopology::triangles: return add_polygon(mesh, obj_.states[obj_.elements[element].state].smoothing);
      case MeshTopology::lines:
        for (std::size_t i = 0; i + 1 < polygon_.size(); ++i) mesh.indices.insert(mesh.indices.end(), {polygon_[i], polygon_[i + 1]});
        return;
      case MeshTopology::points: mesh.indices.insert(mesh.indices.end(), polygon_.begin(), polygon_.end()); return;
    }
  }

  void add_polygon(ModelMesh& mesh, uint32_t smoothing) {
    if (polygon_.size() == 3) {
      mesh.indices.insert(mesh.indices.end(), polygon_.begin(), polygon_.end());
    } else {
      places_.clear();
      for (const uint32_t v : polygon_) places_.push_back(obj_.positions[corners_[v].position]);
      const std::span<const uint32_t> triangles = triangles_.of(places_);
      has_unused_ = has_unused_ || triangles.size() < 3 * (places_.size() - 2);
      for (const uint32_t corner : triangles) mesh.indices.push_back(polygon_[corner]);
    }
    if (obj_.has_smoothing) smoothing_.resize(mesh.indices.size() / 3, smoothing);
  }

  // Returns the vertex with these indices. Vertices with the same position form a list. At most kMaxSearched entries of the list are
  // searched before a new vertex is added, so that many vertices at one position do not take quadratic time.
  uint32_t vertex(const ObjCorner& corner) {
    constexpr int kMaxSearched = 64;
    uint32_t& last = last_vertex_[corner.position];  // counted over all meshes; below first_vertex_, it belongs to an earlier mesh
    const uint32_t newest = last == kNoIndex || last < first_vertex_ ? kNoIndex : last - first_vertex_;
    uint32_t v = newest;
    for (int i = 0; v != kNoIndex && i < kMaxSearched; v = next_[v], ++i) {
      if (corners_[v].uv == corner.uv && corners_[v].normal == corner.normal) return v;
    }
    const auto added = static_cast<uint32_t>(corners_.size());
    corners_.push_back(corner);
    next_.push_back(newest);
    last = first_vertex_ + added;
    return added;
  }

  void fill_vertices(ModelMesh& mesh, bool with_normals) {
    const std::size_t count = corners_.size();
    const bool with_uvs = std::ranges::any_of(corners_, [](const ObjCorner& c) { return c.uv != kNoIndex; });
    mesh.positions.reserve(count);
    if (with_normals) mesh.normals.reserve(count);
    if (with_uvs) mesh.uvs[0].reserve(count);
    if (!obj_.colors.empty()) mesh.colors.reserve(count);
    for (const ObjCorner& corner : corners_) {
      mesh.positions.emplace_back(obj_.positions[corner.position] - origin_);
      if (with_normals) mesh.normals.push_back(obj_.normals[corner.normal]);
      if (with_uvs) {
        const glm::vec2 uv = corner.uv == kNoIndex ? glm::vec2(0.0f) : obj_.uvs[corner.uv];
        mesh.uvs[0].emplace_back(uv.x, 1.0f - uv.y);
      }
      if (obj_.colors.empty()) continue;
      const glm::vec3& color = obj_.colors[corner.position];
      mesh.colors.emplace_back(color.x < 0.0f ? glm::vec3(1.0f) : linear_from_srgb(color * color_scale_), 1.0f);
    }
  }

  const ObjText& obj_;
  float crease_degrees_;
  glm::dvec3 origin_;
  float color_scale_ = 1.0f;
  uint32_t first_vertex_ = 0;
  std::vector<uint32_t> last_vertex_;  // per position
  // The current mesh: the indices of each vertex, the previous vertex at the same position, and the smoothing group of each triangle.
  std::vector<ObjCorner> corners_;
  std::vector<uint32_t> next_, smoothing_;
  // The current polygon.
  std::vector<uint32_t> polygon_;
  FaceTriangles triangles_;
  bool has_unused_ = false;  // not all corners of all polygons of the mesh are in triangles
  std::vector<glm::dvec3> places_;
};

}  // namespace

ObjMeshes obj_meshes(const ObjText& obj, float crease_degrees) {
  const Bounds bounds = bounds_of(obj);
  ObjMeshes result;
  result.diagonal = glm::length(bounds.high - bounds.low);
  MeshBuilder builder(obj, bounds.center(), crease_degrees);
  for (const Group& group : groups_of(obj)) result.meshes.push_back(builder.build(group));
  return result;
}

}  // namespace halfspace::HS_LANES
