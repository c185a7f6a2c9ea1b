// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/model_preparation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "halfspace/core/resource_limits.h"
#include "halfspace/model/gltf/specular_glossiness.h"
#include "halfspace/render/prepare/normal_lines.h"
#include "halfspace/render/prepare/scene_background.h"
#include "halfspace/render/prepare/scene_places.h"
#include "halfspace/render/prepare/wireframe.h"
#include "halfspace/scene/material_overrides.h"

namespace halfspace::HS_LANES {

namespace {

MeshStreams streams_of(const ModelMesh& m) { return {m.positions, m.normals, m.tangents, m.colors, m.uvs[0], m.uvs[1]}; }

// Selects the variant with the fewest streams that the material can use on the mesh.
MetallicStreams variant_of(const MetallicMaterial& m, const MeshStreams& s) {
  bool mapped = false, second = false, tangents = false;
  for (std::size_t i = 0; i < kMetallicMaps; ++i) {
    if (m.maps[i].map == nullptr) continue;
    mapped = true;
    second |= m.maps[i].uv_set == 1;
    tangents |= i == kNormalMap || i == kClearcoatNormalMap;
  }
  const bool colors = !s.colors.empty();
  if (!mapped) return colors ? MetallicStreams::colored : MetallicStreams::basic;
  if (colors || second) return MetallicStreams::full;
  return tangents ? MetallicStreams::detailed : MetallicStreams::mapped;
}

template <MetallicStreams variant, bool masked>
PreparedDraw draw_of(const MetallicMaterial& m, const MeshStreams& s, const std::shared_ptr<const Indices>& indices,
                     const DrawState& state) {
  const auto view = [&s] {
    const auto positions = s.position_stream(), normals = s.normal_stream();
    if constexpr (variant == MetallicStreams::basic) return make_vertex_view(positions, normals);
    if constexpr (variant == MetallicStreams::colored) return make_vertex_view(positions, normals, s.color_stream());
    if constexpr (variant == MetallicStreams::mapped) return make_vertex_view(positions, normals, s.uv_stream());
    if constexpr (variant == MetallicStreams::detailed) return make_vertex_view(positions, normals, s.tangent_stream(), s.uv_stream());
    if constexpr (variant == MetallicStreams::full)
      return make_vertex_view(positions, normals, s.tangent_stream(), s.uv_stream(), s.second_uv_stream(), s.color_stream());
  };
  return {MetallicSurface<variant, masked>{m}, view(), indices, state};
}

PreparedDraw draw_of(const MetallicMaterial& m, MetallicStreams variant, bool masked, const MeshStreams& s,
                     const std::shared_ptr<const Indices>& indices, const DrawState& state) {
  switch (variant) {
    case MetallicStreams::basic: return draw_of<MetallicStreams::basic, false>(m, s, indices, state);
    case MetallicStreams::colored: return draw_of<MetallicStreams::colored, false>(m, s, indices, state);
    case MetallicStreams::mapped:
      return (masked ? draw_of<MetallicStreams::mapped, true> : draw_of<MetallicStreams::mapped, false>)(m, s, indices, state);
    case MetallicStreams::detailed:
      return (masked ? draw_of<MetallicStreams::detailed, true> : draw_of<MetallicStreams::detailed, false>)(m, s, indices, state);
    case MetallicStreams::full: break;
  }
  return (masked ? draw_of<MetallicStreams::full, true> : draw_of<MetallicStreams::full, false>)(m, s, indices, state);
}

// Returns the additional rotation for an object whose up_axis differs from the up axis of the model, which pose() already applies.
glm::dmat4 turn_of(const ObjectDescription& o, const Model& model) {
  glm::dmat4 turn(1.0);
  const bool z_up = o.up_axis == ModelUp::automatic ? model.up == UpAxis::z : o.up_axis == ModelUp::z;
  if (z_up == (model.up == UpAxis::z)) return turn;
  const double side = z_up ? 1.0 : -1.0;
  turn[1] = {0, 0, -side, 0};
  turn[2] = {0, side, 0, 0};
  return turn;
}

}  // namespace

std::string model_recipe(const std::filesystem::path& file, bool allow_outside) {
  return recipe("model", file.string(), allow_outside ? "with outside files" : "");
}

void warn_of(const std::filesystem::path& file, const Model& model, const Warnings& warnings) {
  for (const std::string& warning : model.warnings) warnings.warn(file.string() + ": " + warning);
}

std::shared_ptr<const ModelAsset> ModelPreparation::model_asset(const ObjectDescription& o, const std::string& where) {
  return used_.asset<ModelAsset>(model_recipe(o.file.path, o.allow_outside), [&] {
    ModelAsset model =
        read_for(where + ".file", [&] { return ModelAsset(read_model(o.file.path, {.allow_outside = o.allow_outside}), o.allow_outside); });
    warn_of(o.file.path, model.model, warnings_);
    return model;
  });
}

namespace {

const ModelMaterial& material_of(const Model& model, const PosedMesh& part) {
  static const ModelMaterial kDefault{};
  return part.material < 0 ? kDefault : model.materials[static_cast<std::size_t>(part.material)];
}

// Returns the point size of a point cloud in pixels. If the points evenly covered a square as high as the image, it would be a quarter of
// their distance. In a 720-pixel-high image, it is limited to 2 to 12 px.
float point_size(std::size_t count, int height_px) {
  const auto height = static_cast<float>(height_px);
  return std::max(1.0f, std::clamp(0.25f * height / std::sqrt(static_cast<float>(count)), height / 360.0f, height / 60.0f));
}

// Returns true if the part is drawn with a metallic-roughness material that is not unlit.
bool is_lit(const SceneDescription& scene, const ObjectDescription& o, const Model& model, const PosedMesh& part) {
  const ModelMesh& mesh = part.deformed != nullptr ? *part.deformed : model.meshes[static_cast<std::size_t>(part.mesh)];
  const ModelMaterial& material = material_of(model, part);
  return mesh.topology == MeshTopology::triangles && is_lit(o, material) && override_of(scene, o, material.name) == nullptr;
}

// Returns the number of triangles, lines and points of a posed model.
uint64_t primitive_count(const ModelAsset& asset, const PosedModel& posed) {
  uint64_t count = 0;
  for (const PosedMesh& part : posed.meshes) {
    const auto mesh = static_cast<std::size_t>(part.mesh);
    const MeshTopology topology = asset.model.meshes[mesh].topology;
    count += asset.indices[mesh].size() / (topology == MeshTopology::triangles ? 3 : topology == MeshTopology::lines ? 2 : 1);
  }
  return count;
}

// Returns true if a part may be simplified: only its outline matters then, and its vertices are those of the file. The outline of a surface
// with holes depends on its texture coordinates, and facets and lines of normals are meant to be seen.
bool is_simplifiable(const SceneDescription& scene, const ObjectDescription& o, const Model& model, const PosedMesh& part) {
  if (o.model_error == 0.0 || o.normal_lines > 0.0 || part.deformed != nullptr) return false;
  if (model.meshes[static_cast<std::size_t>(part.mesh)].topology != MeshTopology::triangles) return false;
  const ModelMaterial& material = material_of(model, part);
  if (const SurfaceDescription* surface = override_of(scene, o, material.name))
    return surface->shading == ShadingRate::phong || surface->shading == ShadingRate::none;
  return material.alpha_mode == AlphaMode::opaque;
}

}  // namespace

void ModelPreparation::add(int object, const std::string& path, const ObjectDescription& o) {
  const std::shared_ptr<const ModelAsset> model = model_asset(o, path);
  PoseOptions options = pose_options(model->model, o, pose_places(path));
  options.bounds = false;
  const auto posed = std::make_shared<const PosedModel>(pose(model->model, options));
  used_.keep(posed);
  const auto places = places_of(scene_, o);
  const uint64_t lines = o.normal_lines > 0.0 ? 3 : 0;  // per primitive
  check_primitive_limit(primitive_count(*model, *posed) * (1 + lines) * std::size(places), o.file.path.string());
  const glm::dmat4 turn = turn_of(o, model->model);
  const bool lit = std::ranges::any_of(posed->meshes, [&](const PosedMesh& part) { return is_lit(scene_, o, model->model, part); });
  materials_.load_images(o, model->model, *posed, lit);
  SimplifiedObject simplified{.object = object};
  int instance = 0;
  for (const glm::dmat4& place : places) {
    for (const PosedMesh& part : posed->meshes) {
      const std::array counts{draws_.opaque.size(), draws_.blended.size(), draws_.normals.size()};
      const glm::dmat4 world = place * turn * part.world_from_mesh;
      const bool simplifiable = is_simplifiable(scene_, o, model->model, part);
      add_part(object, o, path, model, part,
               simplifiable ? detail_.indices_of(model, part.mesh, world, o.model_error, simplified) : all_indices(model, part.mesh),
               world);
      const auto number = [instance](std::vector<PreparedDraw>& draws, std::size_t first) {
        for (PreparedDraw& draw : std::span(draws).subspan(first)) draw.source.instance = instance;
      };
      number(draws_.opaque, counts[0]);
      number(draws_.blended, counts[1]);
      number(draws_.normals, counts[2]);
      ++instance;
    }
  }
  if (simplified.triangles > 0) draws_.simplified.push_back(simplified);
}

void ModelPreparation::add_part(int object, const ObjectDescription& o, const std::string& path,
                                const std::shared_ptr<const ModelAsset>& model, const PosedMesh& part,
                                const std::shared_ptr<const Indices>& indices, const glm::dmat4& world) {
  const auto mesh_index = static_cast<std::size_t>(part.mesh);
  const ModelMesh& mesh = part.deformed != nullptr ? *part.deformed : model->model.meshes[mesh_index];
  if (mesh.positions.empty() || model->indices[mesh_index].size() == 0 || glm::determinant(glm::dmat3(world)) == 0.0) return;
  const ModelMaterial& material = material_of(model->model, part);
  const MeshStreams streams = streams_of(mesh);
  if (mesh.topology != MeshTopology::triangles) {
    const bool colored = !streams.colors.empty() || !material.is_default;
    const glm::vec4 color =
        colored ? without_converted_maps(model->model, material).base_color : line_color(background_color(scene_.background));
    const ColoredPrimitives shader{glm::mat4(view_.clip_from_world * world), color};
    DrawState state = opaque_state(CullMode::none, false);
    state.point_size = point_size(model->indices[mesh_index].size(), view_.height_px);
    state.topology = mesh.topology == MeshTopology::points ? Topology::points : Topology::lines;
    draws_.opaque.push_back({shader, make_vertex_view(streams.position_stream(), streams.color_stream()), indices, state});
    draws_.opaque.back().source = {object, 0, streams, world};
    return;
  }
  if (o.normal_lines > 0.0) draws_.normals.push_back(normal_lines({object, 0, streams, world}, indices, view_, o.normal_lines));
  const Clusters* const clusters = part.deformed == nullptr ? clusters_.of(indices, streams.positions) : nullptr;
  if (const SurfaceDescription* replacement = override_of(scene_, o, material.name); replacement != nullptr) {
    ObjectDescription replaced = o;
    replaced.surface = *replacement;
    // Surface shaders have no vertex colors, so the values of the frame must not contain them either.
    const MeshStreams without_colors{streams.positions, streams.normals, streams.tangents, {}, streams.uvs, {}};
    add_replaced_part(object, replaced, path, without_colors, indices, clusters, world);
    draws_.meshes.back().deformed = part.deformed != nullptr;
    return;
  }
  MetallicMaterial surface = materials_.surface_of(o, model->model, part.mesh, material, !streams.uvs.empty());
  place_surface(surface, view_, world);
  draws_.needs_light = draws_.needs_light || (!surface.unlit && surface.emissive == glm::vec3(0.0f));
  const bool masked = material.alpha_mode == AlphaMode::mask && !surface.blends;
  MetallicStreams variant = variant_of(surface, streams);
  if (masked && !(variant >= MetallicStreams::mapped)) variant = MetallicStreams::full;
  if (variant == MetallicStreams::detailed && streams.tangents.empty()) variant = MetallicStreams::full;
  DrawState state = opaque_state(material.double_sided ? CullMode::none : CullMode::back, surface.handedness < 0.0f);
  if (clusters != nullptr) state.clusters = ClusterCulling{clusters, surface.clip_from_object};
  if (surface.blends) {
    state.order_independent = true;
    state.depth.write = false;
    draws_.blended.push_back(draw_of(surface, variant, false, streams, indices, state));
    draws_.blended.back().source = {object, 0, streams, world};
  } else {
    draws_.opaque.push_back(draw_of(surface, variant, masked, streams, indices, state));
    draws_.opaque.back().source = {object, 0, streams, world};
  }
  PlacedMesh placed{streams.positions, streams.normals, indices, world, material.double_sided, o.casts_shadow, o.receives_shadow, object};
  placed.clusters = clusters;
  placed.deformed = part.deformed != nullptr;
  if (masked || surface.blends) {
    MaterialMap alpha = surface.maps[kBaseColorMap];
    alpha.channel = {0, 0, 0, 1};
    placed.opacity = OpacityTest{{alpha, surface.maps[kOpacityMap]}, material.base_color.w, material.alpha_cutoff, surface.blends};
    const bool second = alpha.map != nullptr ? alpha.uv_set == 1 : surface.maps[kOpacityMap].uv_set == 1;
    placed.uvs = second && !streams.second_uvs.empty() ? streams.second_uvs : streams.uvs;
    placed.colors = mesh.colors;
  }
  draws_.meshes.push_back(placed);
}

// Draws a part of a model with the surface of a material of the scene.
void ModelPreparation::add_replaced_part(int object, const ObjectDescription& o, const std::string& path, const MeshStreams& streams,
                                         const std::shared_ptr<const Indices>& indices, const Clusters* clusters, const glm::dmat4& world) {
  draws_.needs_light = draws_.needs_light || (o.surface.shading != ShadingRate::none && o.surface.emissive.linear == glm::dvec3(0.0));
  LitSurface surface = surfaces_.surface_of(o, path);
  NormalDetail detail = details_.add_detail(surface, o, {}, path);
  if (detail == NormalDetail::map && streams.tangents.empty()) {
    warnings_.warn_once(path + ": the model has no tangents, so its replaced materials are drawn without normal maps");
    detail = NormalDetail::none;
  }
  place_surface(surface, view_, world);
  PreparedDraw draw = surface_draw(surface, o.surface.shading, detail, streams, indices);
  draw.source = {object, 0, streams, world};
  if (clusters != nullptr) draw.state.clusters = ClusterCulling{clusters, surface.clip_from_object};
  draws_.add(std::move(draw));
  draws_.meshes.push_back({streams.positions, streams.normals, indices, world, surface.two_sided, o.casts_shadow, o.receives_shadow, object,
                           shadow_opacity(surface)});
  draws_.meshes.back().clusters = clusters;
}

}  // namespace halfspace::HS_LANES
