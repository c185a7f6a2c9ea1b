// SPDX-License-Identifier: Apache-2.0
//
// Objects of shape `file`: model files with their own meshes and materials.
#include <algorithm>
#include <optional>
#include <set>

#include "halfspace/core/text.h"
#include "halfspace/image/image_io.h"
#include "halfspace/model/pose.h"
#include "halfspace/model/tangents.h"
#include "halfspace/render/model_asset.h"
#include "halfspace/render/preparation.h"

namespace halfspace {

namespace {

bool has_normal_map(const ModelMaterial& m) { return m.normal_map.texture >= 0 || m.clearcoat_normal_map.texture >= 0; }

// Returns the texture uses of a material, in the order of MetallicMap.
std::array<const TextureUse*, kMetallicMaps> uses_of(const ModelMaterial& m) {
  return {&m.base_color_map, &m.opacity_map,          &m.metallic_map,  &m.roughness_map,
          &m.specular_map,   &m.specular_color_map,   &m.clearcoat_map, &m.clearcoat_roughness_map,
          &m.normal_map,     &m.clearcoat_normal_map, &m.occlusion_map, &m.emissive_map};
}

bool is_color(std::size_t map) { return map == kBaseColorMap || map == kSpecularColorMap || map == kEmissiveMap; }

glm::vec4 weights_of(Channel channel) {
  switch (channel) {
    case Channel::red: return {1, 0, 0, 0};
    case Channel::green: return {0, 1, 0, 0};
    case Channel::blue: return {0, 0, 1, 0};
    case Channel::alpha: return {0, 0, 0, 1};
    case Channel::luminance: break;
  }
  return {0.2126f, 0.7152f, 0.0722f, 0};  // ITU-R BT.709
}

// The vertex streams of a mesh, including streams that the file does not have but a shader variant needs.
struct Streams {
  std::span<const glm::vec3> positions, normals;
  std::span<const glm::vec4> tangents, colors;
  std::span<const glm::vec2> uvs, second_uvs;
};

// Streams with neutral values for a mesh that lacks them.
struct NeutralStreams {
  std::vector<glm::vec4> tangents, colors;
  std::vector<glm::vec2> uvs;
  explicit NeutralStreams(std::size_t vertices)
      : tangents(vertices, glm::vec4(1, 0, 0, 1)), colors(vertices, glm::vec4(1.0f)), uvs(vertices, glm::vec2(0.0f)) {}
};

Streams streams_of(const ModelMesh& m) { return {m.positions, m.normals, m.tangents, m.colors, m.uvs[0], m.uvs[1]}; }

bool has_all(const Streams& s) { return !s.tangents.empty() && !s.colors.empty() && !s.uvs.empty() && !s.second_uvs.empty(); }

void fill(Streams& s, const NeutralStreams& neutral) {
  if (s.tangents.empty()) s.tangents = neutral.tangents;
  if (s.colors.empty()) s.colors = neutral.colors;
  if (s.uvs.empty()) s.uvs = neutral.uvs;
  if (s.second_uvs.empty()) s.second_uvs = s.uvs;
}

// Selects the variant with the fewest streams that the material can use on the mesh.
MetallicStreams variant_of(const MetallicMaterial& m, const Streams& s) {
  bool mapped = false, second = false, tangents = false;
  for (std::size_t i = 0; i < kMetallicMaps; ++i) {
    if (m.maps[i].map == nullptr) continue;
    mapped = true;
    second |= m.maps[i].uv_set == 1;
    tangents |= i == kNormalMap || i == kClearcoatNormalMap;
  }
  const bool colors = !s.colors.empty();
  if (!mapped) return colors ? MetallicStreams::colored : MetallicStreams::plain;
  if (colors || second) return MetallicStreams::full;
  return tangents ? MetallicStreams::detailed : MetallicStreams::mapped;
}

template <MetallicStreams variant, bool masked>
PreparedDraw draw_of(const MetallicMaterial& m, const Streams& s, const std::shared_ptr<const Indices>& indices, const DrawState& state) {
  const MetallicSurface<variant, masked> shader{m};
  if constexpr (variant == MetallicStreams::plain)
    return {shader, make_vertex_view(stream(s.positions), stream(s.normals)), indices, state};
  else if constexpr (variant == MetallicStreams::colored)
    return {shader, make_vertex_view(stream(s.positions), stream(s.normals), stream(s.colors)), indices, state};
  else if constexpr (variant == MetallicStreams::mapped)
    return {shader, make_vertex_view(stream(s.positions), stream(s.normals), stream(s.uvs)), indices, state};
  else if constexpr (variant == MetallicStreams::detailed)
    return {shader, make_vertex_view(stream(s.positions), stream(s.normals), stream(s.tangents), stream(s.uvs)), indices, state};
  else
    return {
        shader,
        make_vertex_view(stream(s.positions), stream(s.normals), stream(s.tangents), stream(s.uvs), stream(s.second_uvs), stream(s.colors)),
        indices, state};
}

PreparedDraw draw_of(const MetallicMaterial& m, MetallicStreams variant, bool masked, const Streams& s,
                     const std::shared_ptr<const Indices>& indices, const DrawState& state) {
  switch (variant) {
    case MetallicStreams::plain: return draw_of<MetallicStreams::plain, false>(m, s, indices, state);
    case MetallicStreams::colored: return draw_of<MetallicStreams::colored, false>(m, s, indices, state);
    case MetallicStreams::mapped:
      return (masked ? draw_of<MetallicStreams::mapped, true> : draw_of<MetallicStreams::mapped, false>)(m, s, indices, state);
    case MetallicStreams::detailed:
      return (masked ? draw_of<MetallicStreams::detailed, true> : draw_of<MetallicStreams::detailed, false>)(m, s, indices, state);
    case MetallicStreams::full: break;
  }
  return (masked ? draw_of<MetallicStreams::full, true> : draw_of<MetallicStreams::full, false>)(m, s, indices, state);
}

// Returns the index of the item with that name, or −1 if the name is empty.
template <class T, class Name>
int index_of(const std::vector<T>& list, const std::string& name, const Name& name_of, const std::string& where) {
  if (name.empty()) return -1;
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (name_of(list[i]) == name) return static_cast<int>(i);
    names.push_back(name_of(list[i]));
  }
  throw InputError(where + ": the file has no '" + name + "'" + suggestion(name, names));
}

// Returns the rotation to y up that the object asks for, in addition to what pose() does.
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

PoseOptions pose_options(const Model& model, const ObjectDescription& o, const std::string& path) {
  const auto own_name = [](const auto& item) -> const std::string& { return item.name; };
  PoseOptions options;
  options.scene = index_of(model.scenes, o.model_scene, own_name, path + ".model_scene");
  options.animation = index_of(model.animations, o.model_animation, own_name, path + ".model_animation");
  options.variant = index_of(
      model.variants, o.model_variant, [](const std::string& name) -> const std::string& { return name; }, path + ".model_variant");
  options.time = o.model_time;
  return options;
}

ModelAsset::ModelAsset(Model m) : model(std::move(m)) {
  for (ModelMesh& mesh : model.meshes) {
    if (mesh.material >= 0 && mesh.tangents.empty() && mesh.topology == MeshTopology::triangles) {
      const ModelMaterial& material = model.materials[static_cast<std::size_t>(mesh.material)];
      const int set = material.normal_map.texture >= 0 ? material.normal_map.uv_set : material.clearcoat_normal_map.uv_set;
      if (has_normal_map(material) && !mesh.uvs[static_cast<std::size_t>(set)].empty()) add_tangents(mesh, set);
    }
    if (mesh.indices.empty()) {
      indices.push_back(Indices::sequential(mesh.positions.size()));
    } else {
      indices.emplace_back(mesh.indices, mesh.positions.size());
    }
  }
}

std::shared_ptr<const ModelAsset> ScenePreparation::model_asset(const ObjectDescription& o, const std::string& where) {
  return asset<ModelAsset>(model_recipe(o.file.path), [&] {
    ModelAsset model = read_for(where + ".file", [&] { return ModelAsset(read_model(o.file.path)); });
    assets_.warn_of(o.file.path, model);
    return model;
  });
}

namespace {

std::string image_recipe(const std::filesystem::path& file, int image, bool color) {
  return recipe("model image", file.string(), image, color ? "color" : "data");
}

// Decodes an image of a model. An image that cannot be read is replaced by a white texel, with a message in `problem`.
Texture2D decoded(const std::filesystem::path& file, const ModelImage& source, bool color, std::string& problem) {
  Image<glm::u8vec4> picture;
  try {
    picture = source.bytes != nullptr ? read_image(*source.bytes, file.string() + ": " + source.name) : read_image(source.file);
  } catch (const InputError& e) {
    problem = e.what();
    picture = Image<glm::u8vec4>(1, 1);
    picture.at(0, 0) = glm::u8vec4(255);
  }
  return Texture2D(picture, color ? TexelFormat::srgb8a8 : TexelFormat::rgba8);
}

}  // namespace

// Decodes all images that the materials of a posed model use, in parallel.
void ScenePreparation::load_images(const ObjectDescription& o, const Model& model, const PosedModel& posed) {
  std::set<std::pair<int, bool>> wanted;  // image, and whether it is a color map
  for (const PosedMesh& part : posed.meshes) {
    if (part.material < 0) continue;
    const auto uses = uses_of(model.materials[static_cast<std::size_t>(part.material)]);
    for (std::size_t i = 0; i < uses.size(); ++i) {
      if (uses[i]->texture < 0) continue;
      const int image = model.textures[static_cast<std::size_t>(uses[i]->texture)].image;
      if (image >= 0 && !assets_.entries_.contains(image_recipe(o.file.path, image, is_color(i)))) wanted.emplace(image, is_color(i));
    }
  }
  const std::vector<std::pair<int, bool>> list(wanted.begin(), wanted.end());
  std::vector<std::optional<Texture2D>> textures(list.size());
  std::vector<std::string> problems(list.size());
  assets_.workers_.for_each(static_cast<int>(list.size()), [&](int i) {
    const auto [image, color] = list[static_cast<std::size_t>(i)];
    const ModelImage& source = model.images[static_cast<std::size_t>(image)];
    if (source.file.empty() && source.bytes == nullptr) return;  // the reader has warned
    textures[static_cast<std::size_t>(i)].emplace(decoded(o.file.path, source, color, problems[static_cast<std::size_t>(i)]));
  });
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!problems[i].empty()) assets_.warn_once(problems[i]);
    if (textures[i]) asset<Texture2D>(image_recipe(o.file.path, list[i].first, list[i].second), [&] { return std::move(*textures[i]); });
  }
}

// Returns a texture that load_images has loaded, or null if there is no such image.
const Texture2D* ScenePreparation::model_texture(const std::filesystem::path& file, int image, bool color) {
  return existing<Texture2D>(image_recipe(file, image, color)).get();
}

MetallicMaterial ScenePreparation::metallic_material(const ObjectDescription& o, const Model& model, const ModelMaterial& m, bool has_uvs) {
  MetallicMaterial out;
  out.to_eye_ws = glm::vec3(view_.to_eye_ws);
  out.lights = o.receives_shadow ? lights_ : shadowless_lights_;
  out.shadowed = o.receives_shadow && std::ranges::any_of(lights_, [](const Light& l) { return l.shadow != nullptr; });
  out.two_sided = m.double_sided;
  out.base_color = m.base_color;
  out.metallic = m.metallic;
  out.roughness = m.roughness;
  out.specular = m.specular;
  out.specular_color = m.specular_color;
  const float reflection = (m.ior - 1.0f) / (m.ior + 1.0f);
  out.normal_reflectance = reflection * reflection;
  out.clearcoat = m.clearcoat;
  out.clearcoat_roughness = m.clearcoat_roughness;
  out.normal_scale = m.normal_scale;
  out.occlusion_strength = m.occlusion_strength;
  out.emissive = m.emissive;
  out.ambient = glm::vec3(ambient_);
  out.alpha_cutoff = m.alpha_cutoff;
  out.unlit = m.unlit;
  out.blends = m.alpha_mode == AlphaMode::blend;
  out.environment = m.unlit ? nullptr : environment_light();
  if (!has_uvs) return out;
  const auto uses = uses_of(m);
  const TextureUse* previous = nullptr;
  for (std::size_t i = 0; i < kMetallicMaps; ++i) {
    const TextureUse& use = *uses[i];
    if (use.texture < 0 || (m.unlit && i != kBaseColorMap && i != kOpacityMap)) continue;
    const ModelTexture& texture = model.textures[static_cast<std::size_t>(use.texture)];
    if (texture.image < 0) continue;
    PlacedMap& map = out.maps[i];
    map.map = model_texture(o.file.path, texture.image, is_color(i));
    map.sampler = texture.sampler;
    map.uv_set = use.uv_set;
    map.uv_transform = use.uv_transform;
    map.channel = weights_of(use.channel);
    map.repeats = previous != nullptr &&
                  map.map == out.maps[static_cast<std::size_t>(std::ranges::find(uses, previous) - uses.begin())].map &&
                  previous->texture == use.texture && previous->uv_set == use.uv_set && previous->uv_transform == use.uv_transform;
    if (map.map != nullptr) previous = &use;
  }
  return out;
}

void ScenePreparation::add_model(int object, const std::string& path, const ObjectDescription& o) {
  const std::shared_ptr<const ModelAsset> model = model_asset(o, path);
  const auto posed = std::make_shared<const PosedModel>(pose(model->model, pose_options(model->model, o, path)));
  out_.assets.push_back(posed);
  const glm::dmat4 turn = turn_of(o, model->model);
  load_images(o, model->model, *posed);
  for (const glm::dmat4& place : places_of(o)) {
    for (const PosedMesh& part : posed->meshes) add_part(object, o, model, part, place * turn * part.world_from_mesh);
  }
}

void ScenePreparation::add_part(int object, const ObjectDescription& o, const std::shared_ptr<const ModelAsset>& model,
                                const PosedMesh& part, const glm::dmat4& world) {
  static const ModelMaterial kDefault{};
  const auto mesh_index = static_cast<std::size_t>(part.mesh);
  const ModelMesh& mesh = part.deformed != nullptr ? *part.deformed : model->model.meshes[mesh_index];
  if (mesh.positions.empty() || model->indices[mesh_index].size() == 0 || glm::determinant(glm::dmat3(world)) == 0.0) return;
  const ModelMaterial& material = part.material < 0 ? kDefault : model->model.materials[static_cast<std::size_t>(part.material)];
  const std::shared_ptr<const Indices> indices(model, &model->indices[mesh_index]);
  Streams streams = streams_of(mesh);
  const auto neutral = [&] {
    const auto made = std::make_shared<const NeutralStreams>(mesh.positions.size());
    out_.assets.push_back(made);
    return made;
  };
  if (mesh.topology != MeshTopology::triangles) {
    if (streams.colors.empty()) streams.colors = neutral()->colors;
    const ColoredPrimitives shader{glm::mat4(view_.clip_from_world * world), material.base_color};
    DrawState state = opaque_state(CullMode::none, false);
    state.point_size = std::max(1.0f, static_cast<float>(view_.height_px) / 360.0f);
    state.topology = mesh.topology == MeshTopology::points ? Topology::points : Topology::lines;
    out_.draws.push_back({shader, make_vertex_view(stream(streams.positions), stream(streams.colors)), indices, state});
    return;
  }
  MetallicMaterial surface = metallic_material(o, model->model, material, !streams.uvs.empty());
  place(surface, world);
  const bool masked = material.alpha_mode == AlphaMode::mask;
  MetallicStreams variant = variant_of(surface, streams);
  if (masked && !(variant >= MetallicStreams::mapped)) variant = MetallicStreams::full;
  if (variant == MetallicStreams::detailed && streams.tangents.empty()) variant = MetallicStreams::full;
  if (variant == MetallicStreams::full && !has_all(streams)) fill(streams, *neutral());
  DrawState state = opaque_state(material.double_sided ? CullMode::none : CullMode::back, surface.handedness < 0.0f);
  if (surface.blends) {
    state.order_independent = true;
    state.depth.write = false;
    blended_.push_back(draw_of(surface, variant, false, streams, indices, state));
  } else {
    out_.draws.push_back(draw_of(surface, variant, masked, streams, indices, state));
  }
  PlacedMesh placed{streams.positions, streams.normals, indices, world, material.double_sided, o.casts_shadow, o.receives_shadow, object};
  if (masked || surface.blends) {
    placed.opacity = OpacityTest{surface.maps[kBaseColorMap], material.base_color.w, material.alpha_cutoff, surface.blends};
    placed.uvs = streams.uvs.empty() ? std::span<const glm::vec2>(neutral()->uvs) : streams.uvs;
  }
  out_.meshes.push_back(placed);
}

void ScenePreparation::add_shadow_catcher(const ObjectDescription& o, const MeshAsset& mesh, const std::shared_ptr<const Indices>& indices,
                                          int object) {
  ShadowCatcher catcher;
  catcher.to_eye_ws = glm::vec3(view_.to_eye_ws);
  catcher.lights = lights_;
  catcher.inverse_radius = static_cast<float>(2.0 / o.size);
  for (const glm::dmat4& world : places_of(o)) {
    place(catcher, world);
    DrawState state = opaque_state(CullMode::none, false);
    state.order_independent = true;
    state.depth.write = false;
    blended_.push_back({catcher, make_vertex_view(stream(mesh.mesh.positions)), indices, state});
    out_.meshes.push_back({mesh.mesh.positions, mesh.mesh.normals, indices, world, true, false, true, object});
  }
}

// Blended surfaces are drawn after everything opaque.
void ScenePreparation::add_blended() {
  for (PreparedDraw& draw : blended_) out_.draws.push_back(std::move(draw));
  blended_.clear();
}

}  // namespace halfspace
