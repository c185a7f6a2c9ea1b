// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/assets/model_asset.h"

#include <fmt/format.h>

#include <charconv>

#include "halfspace/core/check.h"
#include "halfspace/core/text.h"
#include "halfspace/model/geometry/tangents.h"

namespace halfspace::HS_LANES {

namespace {

// Returns a use of a map that needs tangents, or null.
const TextureUse* tangent_map(const ModelMaterial& m) {
  for (const TextureUse* use : {&m.normal_map, &m.bump_map, &m.clearcoat_normal_map}) {
    if (use->texture >= 0) return use;
  }
  return nullptr;
}

// Returns the index of the item with that name or, if none has it, at that index. Returns −1 if the name is empty. `what`: the plural of
// the item.
template <class T, class Name>
int index_of(const std::vector<T>& list, const std::string& name, const Name& name_of, const std::string& where, const std::string& file,
             const char* what) {
  if (name.empty()) return -1;
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (name_of(list[i]) == name) return static_cast<int>(i);
    if (!name_of(list[i]).empty()) names.push_back(name_of(list[i]));
  }
  if (list.empty()) throw InputError(fmt::format("{}: {} has no {}; expected no value, got '{}'", where, file, what, name));
  int index = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  if (error == std::errc() && end == name.data() + name.size() && index >= 0 && index < static_cast<int>(list.size())) return index;
  const std::string expected = names.empty()
                                   ? fmt::format("; expected an index from 0 to {}, because its {} have no names", list.size() - 1, what)
                                   : suggestion(name, names);
  throw InputError(fmt::format("{}: {} has no '{}'{}", where, file, name, expected));
}

}  // namespace

PosePlaces pose_places(const std::string& path) { return {path + ".model_scene", path + ".model_animation", path + ".model_variant"}; }

PoseOptions pose_options(const Model& model, const ObjectDescription& o, const PosePlaces& places) {
  const auto own_name = [](const auto& item) -> const std::string& { return item.name; };
  PoseOptions options;
  options.scene = index_of(model.scenes, o.model_scene, own_name, places.scene, places.file, "scenes");
  options.animation = index_of(model.animations, o.model_animation, own_name, places.animation, places.file, "animations");
  options.variant = index_of(
      model.variants, o.model_variant, [](const std::string& name) -> const std::string& { return name; }, places.variant, places.file,
      "variants");
  options.time = o.model_time;
  return options;
}

ModelAsset::ModelAsset(Model m, bool outside_allowed) : model(std::move(m)), allow_outside(outside_allowed) {
  for (ModelMesh& mesh : model.meshes) {
    if (mesh.material >= 0 && mesh.tangents.empty() && mesh.topology == MeshTopology::triangles) {
      const TextureUse* use = tangent_map(model.materials[static_cast<std::size_t>(mesh.material)]);
      if (use != nullptr && !mesh.uvs[static_cast<std::size_t>(use->uv_set)].empty()) add_tangents(mesh, use->uv_set);
    }
    if (mesh.indices.empty()) {
      indices.push_back(Indices::sequential(mesh.positions.size()));
    } else {
      indices.emplace_back(mesh.indices, mesh.positions.size());
    }
  }
}

}  // namespace halfspace::HS_LANES
