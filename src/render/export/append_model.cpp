// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/export/append_model.h"

namespace halfspace::HS_LANES {

namespace {

void shift(int& index, int by) {
  if (index >= 0) index += by;
}

class ModelAppender {
 public:
  ModelAppender(Model& to, const Model& from) : to_(to), from_(from) {}

  void add_contents(int variant) {
    const int images = count(to_.images), textures = count(to_.textures), materials = count(to_.materials);
    to_.files.insert(to_.files.end(), from_.files.begin(), from_.files.end());
    for (ModelImage image : from_.images) {
      if (image.converted) {
        shift(image.converted->diffuse_texture, textures);
        shift(image.converted->specular_texture, textures);
      }
      to_.images.push_back(std::move(image));
    }
    for (ModelTexture texture : from_.textures) {
      shift(texture.image, images);
      to_.textures.push_back(texture);
    }
    for (ModelMaterial material : from_.materials) {
      for (const auto use : kTextureUses) shift((material.*use).texture, textures);
      to_.materials.push_back(std::move(material));
    }
    for (ModelMesh mesh : from_.meshes) {
      if (variant >= 0 && static_cast<std::size_t>(variant) < mesh.variant_materials.size())
        mesh.material = mesh.variant_materials[static_cast<std::size_t>(variant)];
      mesh.variant_materials.clear();
      shift(mesh.material, materials);
      to_.meshes.push_back(std::move(mesh));
    }
    to_.cameras.insert(to_.cameras.end(), from_.cameras.begin(), from_.cameras.end());
  }

  // Adds all nodes and their skins, and returns the index of the first node.
  int add_nodes(bool first_copy) {
    const int nodes = count(to_.nodes), skins = count(to_.skins);
    for (ModelNode node : from_.nodes) {
      for (int& child : node.children) child += nodes;
      for (int& mesh : node.meshes) mesh += first_mesh_;
      shift(node.skin, skins);
      shift(node.camera, first_camera_);
      node.light = -1;
      if (!first_copy) node.camera = -1;
      to_.nodes.push_back(std::move(node));
    }
    for (ModelSkin skin : from_.skins) {
      for (int& joint : skin.joints) joint += nodes;
      to_.skins.push_back(std::move(skin));
    }
    return nodes;
  }

  void add_animations(int first_node) {
    for (ModelAnimation animation : from_.animations) {
      for (AnimationChannel& channel : animation.channels) shift(channel.node, first_node);
      to_.animations.push_back(std::move(animation));
    }
  }

 private:
  template <class T>
  static int count(const std::vector<T>& list) {
    return static_cast<int>(list.size());
  }

  Model& to_;
  const Model& from_;
  const int first_mesh_ = count(to_.meshes), first_camera_ = count(to_.cameras);
};

}  // namespace

std::vector<std::vector<int>> append_model(Model& to, const Model& from, int scene, int variant, std::size_t copies) {
  ModelAppender appender(to, from);
  appender.add_contents(variant);
  std::vector<std::vector<int>> roots(copies);
  for (std::size_t copy = 0; copy < copies; ++copy) {
    const int first_node = appender.add_nodes(copy == 0);
    if (copy == 0) appender.add_animations(first_node);
    for (const int root : from.scenes[static_cast<std::size_t>(scene)].roots) roots[copy].push_back(root + first_node);
  }
  return roots;
}

}  // namespace halfspace::HS_LANES
