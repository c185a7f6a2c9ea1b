// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/pose/pose.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/model/pose/animation.h"
#include "halfspace/model/pose/deform.h"
#include "halfspace/model/pose/node_transform.h"

namespace halfspace::HS_LANES {

namespace {

// Bounds are exact up to this total number of placed vertices. For larger models, they are computed from the transformed bounding boxes of
// the meshes and are only conservative.
constexpr std::size_t kMaxBoundedVertices = std::size_t{1} << 27;

glm::dmat4 translation_matrix(const glm::dvec3& t) {
  glm::dmat4 m(1.0);
  m[3] = glm::dvec4(t, 1.0);
  return m;
}

// Converts z-up to y-up: (x, y, z) → (x, z, −y).
glm::dmat4 world_from_model(UpAxis up) {
  if (up == UpAxis::y) return glm::dmat4(1.0);
  return {glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 0, -1, 0), glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 0, 1)};
}

// Returns a rigid transform without mirroring that has the same origin and −z direction.
glm::dmat4 without_scale(const glm::dmat4& m) {
  const auto unit_or = [](const glm::dvec3& v, const glm::dvec3& fallback) {
    const double length = std::sqrt(glm::dot(v, v));
    return length > 0.0 ? v / length : fallback;
  };
  const glm::dvec3 z = unit_or(glm::dvec3(m[2]), {0, 0, 1});
  const glm::dvec3 y = glm::dvec3(m[1]);
  const glm::dvec3 side = glm::cross(y, z);
  const glm::dvec3 x = unit_or(side, unit_or(glm::cross(glm::dvec3(0, 1, 0), z), {1, 0, 0}));
  return {glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0), m[3]};
}

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};
  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

class Poser {
 public:
  Poser(const Model& model, const PoseOptions& options) : model_(model), options_(options), nodes_(model.nodes) {
    if (options.animation >= 0) {
      apply_animation(model.animations[static_cast<std::size_t>(options.animation)], options.time, nodes_);
    }
    resolve_hierarchy();
  }

  PosedModel pose() {
    const auto scene = static_cast<std::size_t>(options_.scene >= 0 ? options_.scene : model_.scene);
    const std::vector<int>& roots = model_.scenes[scene].roots;
    std::vector<int> stack(roots.rbegin(), roots.rend());
    while (!stack.empty()) {
      const auto i = static_cast<std::size_t>(stack.back());
      stack.pop_back();
      if (!valid_[i]) continue;
      add_node(i);
      stack.insert(stack.end(), nodes_[i].children.rbegin(), nodes_[i].children.rend());
    }
    if (options_.bounds) add_bounds();
    return std::move(result_);
  }

 private:
  // Computes world_ for all nodes, because joints may be in another scene, and whether the nodes and all their ancestors are visible. If
  // the transform of a node overflows, the node and its descendants are invalid.
  void resolve_hierarchy() {
    const std::size_t n = nodes_.size();
    std::vector<bool> is_child(n);
    for (const ModelNode& node : nodes_) {
      for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = true;
    }
    world_.assign(n, world_from_model(model_.up));
    valid_.assign(n, true);
    visible_.assign(n, true);
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < n; ++i) {
      if (!is_child[i]) order.push_back(i);
    }
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::size_t i = order[k];
      world_[i] = world_[i] * matrix_of(nodes_[i]);
      valid_[i] = valid_[i] && is_bounded_transform(world_[i]);
      visible_[i] = visible_[i] && nodes_[i].visible;
      for (const int child : nodes_[i].children) {
        const auto c = static_cast<std::size_t>(child);
        world_[c] = world_[i];
        valid_[c] = valid_[i];
        visible_[c] = visible_[i];
        order.push_back(c);
      }
    }
  }

  void add_node(std::size_t i) {
    const ModelNode& node = nodes_[i];
    if (node.camera >= 0) result_.cameras.push_back({node.camera, static_cast<int>(i), without_scale(world_[i])});
    if (!visible_[i]) return;
    if (node.light >= 0) result_.lights.push_back({node.light, without_scale(world_[i])});
    for (const int mesh : node.meshes) add_mesh(mesh, node, world_[i]);
  }

  void add_mesh(int index, const ModelNode& node, const glm::dmat4& world) {
    const ModelMesh& mesh = model_.meshes[static_cast<std::size_t>(index)];
    const bool skinned = node.skin >= 0 && !mesh.joints.empty();
    PosedMesh posed;
    posed.mesh = index;
    posed.material = material_of(mesh);
    posed.deformed = deformed(index, skinned ? node.skin : -1, node.morph_weights);
    if (skinned) {
      posed.world_from_mesh = translation_matrix(skin_origin(node.skin));
      result_.meshes.push_back(std::move(posed));
      return;
    }
    static const std::vector<NodeTransform> kOne(1);
    for (const NodeTransform& instance : node.instances.empty() ? kOne : node.instances) {
      posed.world_from_mesh = world * matrix_of(instance) * translation_matrix(mesh.origin);
      if (is_bounded_transform(posed.world_from_mesh)) result_.meshes.push_back(posed);
    }
  }

  int material_of(const ModelMesh& mesh) const {
    const auto variant = static_cast<std::size_t>(options_.variant);
    return options_.variant >= 0 && variant < mesh.variant_materials.size() ? mesh.variant_materials[variant] : mesh.material;
  }

  // Positions of skinned meshes are stored relative to their first joint, to keep float precision far from the origin.
  glm::dvec3 skin_origin(int skin) const {
    const auto joint = static_cast<std::size_t>(model_.skins[static_cast<std::size_t>(skin)].joints[0]);
    return valid_[joint] ? glm::dvec3(world_[joint][3]) : glm::dvec3(0.0);
  }

  std::vector<glm::dmat4> joint_matrices(int index) const {
    const ModelSkin& skin = model_.skins[static_cast<std::size_t>(index)];
    const glm::dmat4 from_world = translation_matrix(-skin_origin(index));
    std::vector<glm::dmat4> matrices;
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
      const auto joint = static_cast<std::size_t>(skin.joints[j]);
      matrices.push_back(from_world * (valid_[joint] ? world_[joint] : glm::dmat4(1.0)) * skin.joint_from_mesh[j]);
    }
    return matrices;
  }

  // Returns null if nothing deforms the mesh. Nodes with the same skin and weights share the result.
  std::shared_ptr<const ModelMesh> deformed(int index, int skin, const std::vector<float>& weights) {
    const ModelMesh& mesh = model_.meshes[static_cast<std::size_t>(index)];
    const bool morphs = !mesh.targets.empty() && std::ranges::any_of(weights, [](float w) { return w != 0.0f; });
    if (!morphs && skin < 0) return nullptr;
    std::shared_ptr<const ModelMesh>& known = deformed_[{index, skin, morphs ? weights : std::vector<float>()}];
    if (known) return known;
    const auto copy = std::make_shared<ModelMesh>(mesh);
    if (morphs) apply_morph_targets(*copy, weights);
    if (skin >= 0) apply_skin(*copy, joint_matrices(skin));
    copy->targets.clear();
    known = copy;
    return known;
  }

  const ModelMesh& mesh_of(const PosedMesh& posed) const {
    return posed.deformed ? *posed.deformed : model_.meshes[static_cast<std::size_t>(posed.mesh)];
  }

  void add_bounds() {
    std::size_t vertices = 0;
    for (const PosedMesh& posed : result_.meshes) vertices += mesh_of(posed).positions.size();
    Box box;
    for (const PosedMesh& posed : result_.meshes) {
      if (vertices <= kMaxBoundedVertices) {
        for (const glm::vec3& p : mesh_of(posed).positions) box.add(glm::dvec3(posed.world_from_mesh * glm::dvec4(p, 1.0)));
      } else {
        add_box(posed, box);
      }
    }
    result_.low = box.low;
    result_.high = box.high;
  }

  void add_box(const PosedMesh& posed, Box& box) {
    const ModelMesh& mesh = mesh_of(posed);
    const auto [known, is_new] = boxes_.try_emplace(&mesh);
    if (is_new) {
      for (const glm::vec3& p : mesh.positions) known->second.add(glm::dvec3(p));
    }
    const Box& local = known->second;
    if (mesh.positions.empty()) return;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p(corner & 1 ? local.high.x : local.low.x, corner & 2 ? local.high.y : local.low.y,
                         corner & 4 ? local.high.z : local.low.z);
      box.add(glm::dvec3(posed.world_from_mesh * glm::dvec4(p, 1.0)));
    }
  }

  const Model& model_;
  const PoseOptions& options_;
  std::vector<ModelNode> nodes_;
  std::vector<glm::dmat4> world_;
  std::vector<bool> valid_, visible_;
  std::map<std::tuple<int, int, std::vector<float>>, std::shared_ptr<const ModelMesh>> deformed_;
  std::map<const ModelMesh*, Box> boxes_;
  PosedModel result_;
};

}  // namespace

PosedModel pose(const Model& model, const PoseOptions& options) {
  const FloatMode float_mode;
  HS_CHECK(options.scene < static_cast<int>(model.scenes.size()),
           "pose: the model has no scene with this index; expected an index in Model::scenes, or -1");
  HS_CHECK(options.animation < static_cast<int>(model.animations.size()),
           "pose: the model has no animation with this index; expected an index in Model::animations, or -1");
  HS_CHECK(options.variant < static_cast<int>(model.variants.size()) || options.variant < 0,
           "pose: the model has no variant with this index; expected an index in Model::variants, or -1");
  return Poser(model, options).pose();
}

}  // namespace halfspace::HS_LANES
