// SPDX-License-Identifier: Apache-2.0
//
// Meshes and nodes of glTF files.
#include <algorithm>
#include <map>

#include "halfspace/model/gltf/gltf_output.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int kGlPoints = 0, kGlLines = 1, kGlTriangles = 4;

template <class V>
std::span<const float> floats_of(const std::vector<V>& values) {
  return {reinterpret_cast<const float*>(values.data()), values.size() * static_cast<std::size_t>(V::length())};
}

class NodeWriter {
 public:
  NodeWriter(const Model& model, GltfOutput& out) : model_(model), out_(out) {}

  void write() {
    write_meshes();
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) out_.add("nodes", node_json(static_cast<int>(i)));
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) add_moved_meshes(i);
    for (const ModelScene& scene : model_.scenes) write_scene(scene);
    out_.json["scene"] = model_.scene;
  }

 private:
  using Use = GltfOutput::Use;

  // A glTF mesh is a list of primitives that a node draws together.
  void write_meshes() {
    std::vector<std::vector<int>> lists;
    std::vector<bool> used(model_.meshes.size());
    for (const ModelNode& node : model_.nodes) {
      for (std::vector<int>& list : lists_of(node)) {
        for (const int mesh : list) used[static_cast<std::size_t>(mesh)] = true;
        lists.push_back(std::move(list));
      }
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (!used[i] && !is_empty(static_cast<int>(i))) lists.push_back({static_cast<int>(i)});
    }
    std::ranges::sort(lists);
    for (const std::vector<int>& list : lists) {
      if (mesh_of_list_.contains(list)) continue;
      OutputJson json;
      const std::string& name = mesh(list[0]).name;
      if (!name.empty()) json["name"] = name;
      for (const int part : list) json["primitives"].push_back(primitive(part));
      mesh_of_list_[list] = out_.add("meshes", std::move(json));
    }
  }

  const ModelMesh& mesh(int index) const { return model_.meshes[static_cast<std::size_t>(index)]; }

  // glTF has no meshes without vertices; they are omitted.
  bool is_empty(int index) const { return mesh(index).positions.empty(); }

  // Returns the meshes of a node, grouped by their origin.
  std::vector<std::vector<int>> lists_of(const ModelNode& node) const {
    std::vector<std::vector<int>> lists;
    for (const int part : node.meshes) {
      if (is_empty(part)) continue;
      const auto same = std::ranges::find_if(lists, [&](const auto& list) { return mesh(list[0]).origin == mesh(part).origin; });
      if (same == lists.end()) {
        lists.push_back({part});
      } else {
        same->push_back(part);
      }
    }
    return lists;
  }

  OutputJson primitive(int index) {
    OutputJson& known = primitives_[index];
    if (!known.is_null()) return known;
    const ModelMesh& m = mesh(index);
    OutputJson& attributes = known["attributes"];
    attributes["POSITION"] = out_.accessor(m.positions, Use::vertices);
    out_.set_bounds(attributes["POSITION"].get<int>(), floats_of(m.positions), 3);
    if (!m.normals.empty()) attributes["NORMAL"] = out_.accessor(m.normals, Use::vertices);
    if (!m.tangents.empty()) attributes["TANGENT"] = out_.accessor(m.tangents, Use::vertices);
    if (!m.uvs[0].empty()) attributes["TEXCOORD_0"] = out_.accessor(m.uvs[0], Use::vertices);
    if (!m.uvs[1].empty()) attributes["TEXCOORD_1"] = out_.accessor(m.uvs[1], Use::vertices);
    if (!m.colors.empty()) attributes["COLOR_0"] = out_.accessor(m.colors, Use::vertices);
    if (!m.joints.empty()) {
      attributes["JOINTS_0"] = out_.joint_accessor(m.joints);
      attributes["WEIGHTS_0"] = out_.accessor(m.weights, Use::vertices);
    }
    if (!m.more_joints.empty()) {
      attributes["JOINTS_1"] = out_.joint_accessor(m.more_joints);
      attributes["WEIGHTS_1"] = out_.accessor(m.more_weights, Use::vertices);
    }
    if (!m.indices.empty()) known["indices"] = out_.index_accessor(m.indices, m.positions.size());
    // Points and lines without a material are drawn in a color that contrasts with the background, and not in that of the default material.
    const bool has_material =
        m.material >= 0 && (m.topology == MeshTopology::triangles || !model_.materials[static_cast<std::size_t>(m.material)].is_default);
    if (has_material) known["material"] = m.material;
    known["mode"] = m.topology == MeshTopology::points ? kGlPoints : m.topology == MeshTopology::lines ? kGlLines : kGlTriangles;
    for (const MorphTarget& target : m.targets) known["targets"].push_back(target_json(target));
    add_variants(known, m);
    return known;
  }

  OutputJson target_json(const MorphTarget& target) {
    OutputJson json = OutputJson::object();
    if (!target.positions.empty()) {
      json["POSITION"] = out_.accessor(target.positions, Use::vertices);
      out_.set_bounds(json["POSITION"].get<int>(), floats_of(target.positions), 3);
    }
    if (!target.normals.empty()) json["NORMAL"] = out_.accessor(target.normals, Use::vertices);
    if (!target.tangents.empty()) json["TANGENT"] = out_.accessor(target.tangents, Use::vertices);
    return json;
  }

  void add_variants(OutputJson& json, const ModelMesh& m) {
    std::map<int, std::vector<int>> variants;  // by material
    for (std::size_t i = 0; i < m.variant_materials.size(); ++i) {
      if (m.variant_materials[i] != m.material) variants[m.variant_materials[i]].push_back(static_cast<int>(i));
    }
    OutputJson mappings = OutputJson::array();
    for (const auto& [material, list] : variants) mappings.push_back({{"material", material}, {"variants", list}});
    if (!mappings.empty()) out_.extend(json, "KHR_materials_variants", {{"mappings", mappings}});
  }

  static void add_transform(OutputJson& json, const ModelNode& node) {
    if (node.matrix) {
      for (glm::length_t column = 0; column < 4; ++column) {
        for (glm::length_t row = 0; row < 4; ++row) json["matrix"].push_back((*node.matrix)[column][row]);
      }
      return;
    }
    const NodeTransform& t = node.transform;
    if (t.translation != glm::dvec3(0.0)) json["translation"] = json_array(t.translation);
    if (t.rotation != glm::dquat(1.0, 0.0, 0.0, 0.0)) json["rotation"] = {t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w};
    if (t.scale != glm::dvec3(1.0)) json["scale"] = json_array(t.scale);
  }

  // An animation can only refer to a property that exists.
  bool has_animated_visibility(int node) const {
    return std::ranges::any_of(model_.animations, [&](const ModelAnimation& animation) {
      return std::ranges::any_of(animation.channels, [&](const AnimationChannel& channel) {
        return channel.property == AnimatedProperty::visibility && channel.node == node;
      });
    });
  }

  OutputJson node_json(int index) {
    const ModelNode& node = model_.nodes[static_cast<std::size_t>(index)];
    OutputJson json = OutputJson::object();
    if (!node.name.empty()) json["name"] = node.name;
    add_transform(json, node);
    if (!node.children.empty()) json["children"] = node.children;
    if (node.camera >= 0) json["camera"] = node.camera;
    if (node.light >= 0) out_.extend(json, "KHR_lights_punctual", {{"light", node.light}});
    if (!node.visible || has_animated_visibility(index)) out_.extend(json, "KHR_node_visibility", {{"visible", node.visible}});
    const std::vector<std::vector<int>> lists = lists_of(node);
    for (const std::vector<int>& list : lists) {
      if (draws_itself(node, list)) add_mesh(json, node, list);
    }
    return json;
  }

  // Meshes that are not at the origin of the node need their own node. Skinned meshes are placed by their joints.
  bool draws_itself(const ModelNode& node, const std::vector<int>& list) const {
    return node.skin >= 0 || mesh(list[0]).origin == glm::dvec3(0.0);
  }

  void add_mesh(OutputJson& json, const ModelNode& node, const std::vector<int>& list) {
    json["mesh"] = mesh_of_list_.at(list);
    if (node.skin >= 0) json["skin"] = node.skin;
    if (!node.morph_weights.empty()) json["weights"] = node.morph_weights;
    if (node.instances.empty()) return;
    std::vector<glm::vec3> translations, scales;
    std::vector<glm::vec4> rotations;
    for (const NodeTransform& t : node.instances) {
      const glm::dvec3 moved = t.translation + t.rotation * (t.scale * mesh(list[0]).origin);
      translations.emplace_back(moved);
      rotations.emplace_back(t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w);
      scales.emplace_back(t.scale);
    }
    const OutputJson attributes = {{"TRANSLATION", out_.accessor(translations, Use::other)},
                                   {"ROTATION", out_.accessor(rotations, Use::other)},
                                   {"SCALE", out_.accessor(scales, Use::other)}};
    out_.extend(json, "EXT_mesh_gpu_instancing", {{"attributes", attributes}});
  }

  void add_moved_meshes(std::size_t index) {
    const ModelNode& node = model_.nodes[index];
    for (const std::vector<int>& list : lists_of(node)) {
      if (draws_itself(node, list)) continue;
      OutputJson json = OutputJson::object();
      if (node.instances.empty()) json["translation"] = json_array(mesh(list[0]).origin);
      add_mesh(json, node, list);
      const int child = out_.add("nodes", std::move(json));
      out_.json["nodes"][index]["children"].push_back(child);
    }
  }

  void write_scene(const ModelScene& scene) {
    OutputJson json = OutputJson::object();
    if (!scene.name.empty()) json["name"] = scene.name;
    std::vector<int> roots = scene.roots;
    if (model_.up == UpAxis::z && !roots.empty()) {
      if (turning_node_ < 0) {
        constexpr double kHalf = 0.70710678118654752440;  // −90° around x
        turning_node_ = out_.add("nodes", {{"name", "y-up"}, {"rotation", {-kHalf, 0.0, 0.0, kHalf}}, {"children", roots}});
      }
      roots = {turning_node_};
    }
    if (!roots.empty()) json["nodes"] = roots;
    out_.add("scenes", std::move(json));
  }

  const Model& model_;
  GltfOutput& out_;
  std::map<std::vector<int>, int> mesh_of_list_;
  std::map<int, OutputJson> primitives_;
  int turning_node_ = -1;
};

}  // namespace

void write_gltf_meshes_and_nodes(const Model& model, GltfOutput& out) { NodeWriter(model, out).write(); }

}  // namespace halfspace::HS_LANES
