// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "halfspace/model/pose/node_transform.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

// Estimated memory of a pose per placed mesh, and per vertex of a deformed mesh.
constexpr uint64_t kBytesPerPlace = 192, kBytesPerDeformedVertex = 160;

class NodeReader {
 public:
  NodeReader(GltfAccessors& accessors, const std::vector<GltfMesh>& meshes, Model& model)
      : accessors_(accessors), document_(accessors.document()), json_(document_.list("nodes")), meshes_(meshes), model_(model) {}

  void read() {
    for (const GltfValue& json : json_) {
      model_.nodes.emplace_back();
      read_node(json, model_.nodes.back());
    }
    check_forest();
    check_transforms();
    read_scenes();
  }

 private:
  void read_node(const GltfValue& json, ModelNode& node) {
    node.name = document_.string(json, "name");
    read_transform(json, node);
    node.children = document_.indices(json, "children", json_.size());
    node.camera = document_.index(json, "camera", model_.cameras.size());
    if (const GltfValue* light = document_.extension(json, "KHR_lights_punctual")) {
      node.light = document_.required_index(*light, "light", model_.lights.size());
    }
    if (const GltfValue* visibility = document_.extension(json, "KHR_node_visibility")) {
      node.visible = document_.find(*visibility, "visible") == nullptr || document_.boolean(*visibility, "visible");
    }
    if (const GltfValue* instancing = document_.extension(json, "EXT_mesh_gpu_instancing")) read_instances(*instancing, node);
    read_mesh(json, node);
  }

  void read_transform(const GltfValue& json, ModelNode& node) {
    if (document_.find(json, "matrix") != nullptr) {
      const auto values = document_.numbers<16>(json, "matrix", {});
      glm::dmat4 m(1.0);
      for (glm::length_t i = 0; i < 16; ++i) {
        if (i % 4 < 3) m[i / 4][i % 4] = values[static_cast<std::size_t>(i)];
      }
      node.matrix = m;
    }
    const auto t = document_.numbers<3>(json, "translation", {0.0, 0.0, 0.0}), s = document_.numbers<3>(json, "scale", {1.0, 1.0, 1.0});
    const auto r = document_.numbers<4>(json, "rotation", {0.0, 0.0, 0.0, 1.0});
    node.transform = {{t[0], t[1], t[2]}, unit_rotation({r[3], r[0], r[1], r[2]}), {s[0], s[1], s[2]}};
  }

  void read_mesh(const GltfValue& json, ModelNode& node) {
    const int index = document_.index(json, "mesh", meshes_.size());
    const int skin = document_.index(json, "skin", model_.skins.size());
    if (index < 0) return;
    const GltfMesh& mesh = meshes_[static_cast<std::size_t>(index)];
    node.meshes = mesh.parts;
    node.skin = skin;
    node.morph_weights = document_.number_list(json, "weights");
    if (node.morph_weights.empty()) node.morph_weights = mesh.weights;
    if (!node.morph_weights.empty() && node.morph_weights.size() != mesh.targets) {
      document_.fail(json, "weights",
                     fmt::format("has {} items; expected one for each of {} targets", node.morph_weights.size(), mesh.targets));
    }
    document_.take_memory(json, mesh.parts.size() * std::max<std::size_t>(node.instances.size(), 1), kBytesPerPlace);
    document_.take_memory(json, mesh.deformed_vertices, kBytesPerDeformedVertex);
    if (skin >= 0) check_joints(json, mesh, model_.skins[static_cast<std::size_t>(skin)]);
  }

  // The result is the same for every node with this mesh and skin. The memory limit checked above also bounds the number of compared
  // vertices.
  void check_joints(const GltfValue& json, const GltfMesh& mesh, const ModelSkin& skin) {
    for (const int part : mesh.parts) {
      const ModelMesh& m = model_.meshes[static_cast<std::size_t>(part)];
      check_joints(json, m.joints, skin);
      check_joints(json, m.more_joints, skin);
    }
  }

  void check_joints(const GltfValue& json, const std::vector<std::array<uint16_t, 4>>& list, const ModelSkin& skin) {
    for (const auto& joints : list) {
      const uint16_t joint = *std::ranges::max_element(joints);
      if (joint >= skin.joints.size()) {
        document_.fail(json, "skin",
                       fmt::format("a vertex of the mesh has joint {}, but the skin has {} joints; expected a smaller number", joint,
                                   skin.joints.size()));
      }
    }
  }

  void read_instances(const GltfValue& json, ModelNode& node) {
    const GltfValue& attributes = document_.object(json, "attributes");
    const auto find = [&](const char* key) {
      return document_.find(attributes, key) == nullptr ? GltfAccessor{} : accessors_.find(attributes, key);
    };
    const GltfAccessor t = find("TRANSLATION"), r = find("ROTATION"), s = find("SCALE");
    const std::size_t count = std::max({t.count, r.count, s.count});
    if (count == 0) return document_.warn_at(json, "attributes", "has no instances; the mesh is drawn once");
    for (const GltfAccessor* a : {&t, &r, &s}) {
      if (a->json != nullptr && a->count != count)
        document_.fail(*a->json, "count", fmt::format("{}; expected {}, the number of instances", a->count, count));
    }
    document_.take_memory(json, count, sizeof(NodeTransform));
    node.instances.resize(count);
    if (t.json != nullptr) {
      const std::vector<glm::vec3> values = finite<glm::vec3>(t);
      for (std::size_t i = 0; i < count; ++i) node.instances[i].translation = glm::dvec3(values[i]);
    }
    if (r.json != nullptr) {
      const std::vector<glm::vec4> values = finite<glm::vec4>(r);
      for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec4 q(values[i]);
        node.instances[i].rotation = unit_rotation({q.w, q.x, q.y, q.z});
      }
    }
    if (s.json != nullptr) {
      const std::vector<glm::vec3> values = finite<glm::vec3>(s);
      for (std::size_t i = 0; i < count; ++i) node.instances[i].scale = glm::dvec3(values[i]);
    }
  }

  template <class V>
  std::vector<V> finite(const GltfAccessor& accessor) {
    std::vector<V> values = accessors_.read<V>(accessor);
    for (const V& v : values) {
      for (glm::length_t k = 0; k < V::length(); ++k) {
        if (!(std::abs(static_cast<double>(v[k])) <= kMaxModelNumber)) {
          document_.fail(*accessor.json, "has values that are not finite or exceed 1e18; expected smaller finite values");
        }
      }
    }
    return values;
  }

  // Fills parents_ and order_. In order_, each node comes after its parent.
  void check_forest() {
    parents_.assign(json_.size(), -1);
    for (std::size_t i = 0; i < json_.size(); ++i) {
      for (std::size_t k = 0; k < model_.nodes[i].children.size(); ++k) {
        int& parent = parents_[static_cast<std::size_t>(model_.nodes[i].children[k])];
        if (parent >= 0) document_.fail(json_[i]["children"][k], "the node has another parent; expected one parent per node");
        parent = static_cast<int>(i);
      }
    }
    for (std::size_t i = 0; i < json_.size(); ++i) {
      if (parents_[i] < 0) order_.push_back(static_cast<int>(i));
    }
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const std::vector<int>& children = model_.nodes[static_cast<std::size_t>(order_[i])].children;
      order_.insert(order_.end(), children.begin(), children.end());
    }
    if (order_.size() == json_.size()) return;
    std::vector<bool> reached(json_.size());
    for (const int node : order_) reached[static_cast<std::size_t>(node)] = true;
    const auto node = static_cast<std::size_t>(std::ranges::find(reached, false) - reached.begin());
    document_.fail(json_[node], "children", "the nodes form a cycle; expected a hierarchy");
  }

  // A node whose scale is 0 along all axes is hidden, which is a common idiom.
  static bool is_flattened(const glm::dmat4& world) {
    const glm::dmat3 m(world);
    return glm::determinant(m) == 0.0 && m != glm::dmat3(0.0);
  }

  void check_transforms() {
    std::vector<glm::dmat4> world(json_.size());
    for (const int n : order_) {
      const auto i = static_cast<std::size_t>(n);
      world[i] = matrix_of(model_.nodes[i]);
      if (parents_[i] >= 0) world[i] = world[static_cast<std::size_t>(parents_[i])] * world[i];
      if (!is_bounded_transform(world[i])) document_.fail(json_[i], "the transform has elements above 1e18; expected smaller elements");
      if (!model_.nodes[i].meshes.empty() && is_flattened(world[i]))
        document_.warn_at(json_[i], "", "the scale along an axis is 0; the mesh is not drawn");
    }
  }

  void read_scenes() {
    for (const GltfValue& json : document_.list("scenes")) {
      ModelScene scene{document_.string(json, "name"), document_.indices(json, "nodes", json_.size())};
      for (std::size_t k = 0; k < scene.roots.size(); ++k) {
        if (parents_[static_cast<std::size_t>(scene.roots[k])] >= 0)
          document_.fail(json["nodes"][k], "the node has a parent; expected a root of the hierarchy");
      }
      model_.scenes.push_back(std::move(scene));
    }
    model_.scene = std::max(document_.index(document_.root(), "scene", model_.scenes.size()), 0);
    if (!model_.scenes.empty()) return;
    model_.scenes.emplace_back();
    for (std::size_t i = 0; i < json_.size(); ++i) {
      if (parents_[i] < 0) model_.scenes[0].roots.push_back(static_cast<int>(i));
    }
  }

  GltfAccessors& accessors_;
  GltfDocument& document_;
  const GltfValue& json_;
  const std::vector<GltfMesh>& meshes_;
  Model& model_;
  std::vector<int> parents_, order_;
};

}  // namespace

void read_gltf_nodes(GltfAccessors& accessors, const std::vector<GltfMesh>& meshes, Model& model) {
  NodeReader(accessors, meshes, model).read();
}

}  // namespace halfspace::HS_LANES
