// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "halfspace/model/geometry/mesh_vertices.h"
#include "halfspace/model/geometry/normals.h"
#include "halfspace/model/geometry/single_mesh.h"
#include "halfspace/model/geometry/tangents.h"
#include "halfspace/model/gltf/gltf_draco.h"
#include "halfspace/model/gltf/gltf_indices.h"
#include "halfspace/model/gltf/gltf_materials.h"
#include "halfspace/model/gltf/gltf_vertices.h"

namespace halfspace::HS_LANES {

namespace {

// Upper bounds on the additional memory per vertex for computing normals and tangents.
constexpr uint64_t kNormalBytes = 64, kTangentBytes = 128;

std::size_t bytes_per_vertex(const ModelMesh& mesh) {
  std::size_t bytes = sizeof(glm::vec3) * 2 + sizeof(glm::vec4) * 3 + sizeof(glm::vec2) * 2;
  for (const MorphTarget& target : mesh.targets) {
    bytes += sizeof(glm::vec3) * static_cast<std::size_t>(!target.positions.empty() + !target.normals.empty() + !target.tangents.empty());
  }
  if (!mesh.joints.empty()) bytes += sizeof mesh.joints[0];
  if (!mesh.more_joints.empty()) bytes += sizeof mesh.more_joints[0] + sizeof mesh.more_weights[0];
  return bytes;
}

class MeshReader {
 public:
  MeshReader(GltfAccessors& accessors, Model& model) : accessors_(accessors), document_(accessors.document()), model_(model) {}

  GltfMesh read(const GltfValue& json) {
    GltfMesh mesh;
    const GltfValue& primitives = document_.objects(json, "primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const std::size_t targets = document_.objects(primitives[i], "targets").size();
      if (i > 0 && targets != mesh.targets) {
        document_.fail(primitives[i], "targets", fmt::format("has {} items; expected {} as in the first primitive", targets, mesh.targets));
      }
      mesh.targets = targets;
      read_primitive(primitives[i], document_.string(json, "name"), mesh);
    }
    mesh.weights = document_.number_list(json, "weights");
    if (!mesh.weights.empty() && mesh.weights.size() != mesh.targets) {
      document_.fail(json, "weights", fmt::format("has {} items; expected one for each of {} targets", mesh.weights.size(), mesh.targets));
    }
    return mesh;
  }

 private:
  void read_primitive(const GltfValue& json, const std::string& name, GltfMesh& owner) {
    const GltfValue& attributes = document_.object(json, "attributes");
    if (document_.find(attributes, "POSITION") == nullptr) return document_.warn_at(json, "", "has no positions; it is skipped");
    document_.take_memory(json, 1, sizeof(ModelMesh));
    const bool compressed = draco_.decode(json);
    const std::size_t count = accessors_.find(attributes, "POSITION").count;
    const auto mode = compressed ? GltfMode::triangles : static_cast<GltfMode>(document_.integer(json, "mode", 4, 6));
    ModelMesh mesh;
    mesh.name = name;
    mesh.topology = topology_of(mode);
    mesh.indices = indices(json, mode, count);
    if (count == 0 || (mesh.indices.empty() && mesh.topology != MeshTopology::points)) {
      return document_.warn_at(json, "", "has no vertices or no indices; it is skipped");
    }
    std::vector<uint32_t> subset;
    if (!mesh.indices.empty()) subset = compact_indices(mesh.indices, count);
    read_material(json, mesh);
    read_vertices(accessors_, json, count, subset, model_.materials[static_cast<std::size_t>(mesh.material)].uv_sets, mesh);
    skip_infinite_primitives(json, mesh);
    if (mesh.positions.empty()) return document_.warn_at(json, "", "has no finite positions; it is skipped");
    complete(json, mesh);
    if (!mesh.targets.empty() || !mesh.joints.empty()) owner.deformed_vertices += mesh.positions.size();
    owner.parts.push_back(static_cast<int>(model_.meshes.size()));
    model_.meshes.push_back(std::move(mesh));
  }

  // Returns an index list of points, lines or triangles; empty for points without indices.
  std::vector<uint32_t> indices(const GltfValue& json, GltfMode mode, std::size_t count) {
    std::vector<uint32_t> list;
    if (document_.find(json, "indices") != nullptr) {
      const GltfAccessor accessor = accessors_.find(json, "indices");
      list = accessors_.read_integers(accessor, 1);
      const auto bad = std::ranges::find_if(list, [&](uint32_t i) { return i >= count; });
      if (bad != list.end()) {
        document_.fail(*accessor.json, fmt::format("index {} at {} is out of range; expected less than {}, the number of vertices", *bad,
                                                   bad - list.begin(), count));
      }
    } else if (mode != GltfMode::points) {
      document_.take_memory(json, count, sizeof(uint32_t));
      list.resize(count);
      std::iota(list.begin(), list.end(), 0u);
    }
    const std::size_t remainder = mode == GltfMode::triangles ? list.size() % 3 : mode == GltfMode::lines ? list.size() % 2 : 0;
    if (remainder != 0) document_.warn_at(json, "", "ends with an incomplete line or triangle, which is skipped");
    // A strip of n vertices has fewer than n triangles, and a growing vector needs up to twice its size.
    document_.take_memory(json, list.size(), 6 * sizeof(uint32_t));
    return list_of_primitives(mode, std::move(list));
  }

  // Removes the primitives with positions that are not finite, and the vertices that only they use.
  void skip_infinite_primitives(const GltfValue& json, ModelMesh& mesh) {
    const auto finite = [&](uint32_t vertex) { return is_finite(glm::dvec3(mesh.positions[vertex])); };
    if (std::ranges::all_of(mesh.positions, [](const glm::vec3& p) { return is_finite(glm::dvec3(p)); })) return;
    if (mesh.indices.empty()) {
      document_.take_memory(json, mesh.positions.size(), sizeof(uint32_t));
      mesh.indices.resize(mesh.positions.size());
      std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    }
    const std::size_t skipped = remove_primitives(mesh.topology, mesh.indices, finite);
    if (mesh.indices.empty()) return mesh.positions.clear();
    document_.take_memory(json, mesh.positions.size(), bytes_per_vertex(mesh));
    document_.warn_at(json, "", fmt::format("{} points, lines or triangles with positions that are not finite; skipped", skipped));
    remove_unused_vertices(mesh);
  }

  void read_material(const GltfValue& json, ModelMesh& mesh) {
    const std::size_t materials = document_.list("materials").size();
    mesh.material = document_.index(json, "material", materials);
    if (mesh.material < 0) mesh.material = default_material();
    const GltfValue* variants = document_.extension(json, "KHR_materials_variants");
    if (variants == nullptr || model_.variants.empty()) return;
    document_.take_memory(json, model_.variants.size(), sizeof(int));
    mesh.variant_materials.assign(model_.variants.size(), mesh.material);
    for (const GltfValue& mapping : document_.objects(*variants, "mappings")) {
      const int material = document_.required_index(mapping, "material", materials);
      for (const int variant : document_.indices(mapping, "variants", model_.variants.size())) {
        mesh.variant_materials[static_cast<std::size_t>(variant)] = material;
      }
    }
    const auto uv_sets = [&](int material) { return model_.materials[static_cast<std::size_t>(material)].uv_sets; };
    if (std::ranges::any_of(mesh.variant_materials, [&](int material) { return uv_sets(material) != uv_sets(mesh.material); })) {
      document_.warn_at(json, "",
                        "the material variants use different sets of texture coordinates from the material; this is not supported");
    }
  }

  int default_material() {
    if (default_material_ < 0) {
      default_material_ = static_cast<int>(model_.materials.size());
      model_.materials.push_back(gltf_default_material());
    }
    return default_material_;
  }

  // Computes normals and tangents that are needed but missing.
  void complete(const GltfValue& json, ModelMesh& mesh) {
    if (mesh.topology != MeshTopology::triangles) return;
    if (mesh.normals.empty()) {
      document_.take_memory(json, mesh.indices.size(), bytes_per_vertex(mesh) + kNormalBytes);
      add_flat_normals(mesh);
      mesh.computed_normals = true;
    } else if (const std::size_t replaced = replace_missing_normals(mesh); replaced > 0) {
      document_.warn_at(json, "attributes.NORMAL",
                        fmt::format("{} normals that are zero or not finite are computed from the triangles", replaced));
    }
    const int uv_set = tangent_set(mesh);
    if (!mesh.tangents.empty() || uv_set < 0) return;
    document_.take_memory(json, mesh.indices.size(), bytes_per_vertex(mesh) + kTangentBytes);
    add_tangents(mesh, uv_set);
  }

  // Returns the texture coordinate set of the normal maps of the mesh's materials, or −1 if they have none.
  int tangent_set(const ModelMesh& mesh) const {
    const auto set_of = [&](int material) {
      const ModelMaterial& m = model_.materials[static_cast<std::size_t>(material)];
      for (const TextureUse* use : {&m.normal_map, &m.clearcoat_normal_map}) {
        if (use->texture >= 0 && !mesh.uvs[static_cast<std::size_t>(use->uv_set)].empty()) return use->uv_set;
      }
      return -1;
    };
    int set = set_of(mesh.material);
    for (std::size_t i = 0; i < mesh.variant_materials.size() && set < 0; ++i) set = set_of(mesh.variant_materials[i]);
    return set;
  }

  GltfAccessors& accessors_;
  GltfDocument& document_;
  Model& model_;
  GltfDraco draco_{accessors_};
  int default_material_ = -1;
};

}  // namespace

std::vector<GltfMesh> gltf_meshes(GltfAccessors& accessors, Model& model) {
  MeshReader reader(accessors, model);
  std::vector<GltfMesh> meshes;
  for (const GltfValue& json : accessors.document().list("meshes")) meshes.push_back(reader.read(json));
  return meshes;
}

}  // namespace halfspace::HS_LANES
