// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_materials.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "halfspace/model/gltf/specular_glossiness.h"

namespace halfspace::HS_LANES {

namespace {

// KHR_materials_transmission is approximated by blending. Fully transmissive surfaces keep this opacity, so that they stay visible.
constexpr float kMinGlassOpacity = 0.1f;

glm::vec3 color_of(const std::array<double, 3>& c) {
  return {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
}

glm::vec3 color(const GltfDocument& document, const GltfValue& json, const char* key, double fallback) {
  return glm::max(color_of(document.numbers<3>(json, key, {fallback, fallback, fallback})), glm::vec3(0.0f));
}

glm::vec4 color_and_opacity(const GltfDocument& document, const GltfValue& json, const char* key) {
  const auto c = document.numbers<4>(json, key, {1.0, 1.0, 1.0, 1.0});
  return {glm::max(color_of({c[0], c[1], c[2]}), glm::vec3(0.0f)), static_cast<float>(std::clamp(c[3], 0.0, 1.0))};
}

// Returns a color, with or without opacity, whose elements must be from 0 to 1. Others are clamped, with a warning. fallback: all elements
// if the key is missing.
template <std::size_t n>
glm::vec<int{n}, float> unit_color(GltfDocument& document, const GltfValue& json, const char* key, double fallback = 1.0) {
  std::array<double, n> missing;
  missing.fill(fallback);
  const std::array<double, n> read = document.numbers<n>(json, key, missing);
  std::array<double, n> clamped = read;
  for (double& x : clamped) x = std::clamp(x, 0.0, 1.0);
  if (clamped != read)
    document.warn_at(json, key, fmt::format("({:.6g}) is out of range; using ({:.6g})", fmt::join(read, ", "), fmt::join(clamped, ", ")));
  glm::vec<int{n}, float> color;
  for (int k = 0; k < int{n}; ++k) color[k] = static_cast<float>(clamped[static_cast<std::size_t>(k)]);
  return color;
}

void read_alpha(GltfDocument& document, const GltfValue& json, ModelMaterial& material) {
  const std::string mode = document.string(json, "alphaMode");
  if (mode == "MASK") {
    material.alpha_mode = AlphaMode::mask;
  } else if (mode == "BLEND") {
    material.alpha_mode = AlphaMode::blend;
  } else if (!mode.empty() && mode != "OPAQUE") {
    document.fail(json, "alphaMode", gltf_quoted(mode) + " is unknown; expected OPAQUE, MASK or BLEND");
  }
  material.alpha_cutoff = document.factor(json, "alphaCutoff", 0.5f, 0.0, 1e6);
}

void read_metallic_roughness(GltfDocument& document, GltfTextures& textures, const GltfValue& json, ModelMaterial& material) {
  material.base_color = color_and_opacity(document, json, "baseColorFactor");
  material.base_color_map = textures.use(json, "baseColorTexture");
  material.metallic = document.factor(json, "metallicFactor", 1.0f);
  material.roughness = document.factor(json, "roughnessFactor", 1.0f);
  material.metallic_map = textures.use(json, "metallicRoughnessTexture", Channel::blue);
  material.roughness_map = textures.use(json, "metallicRoughnessTexture", Channel::green);
}

void read_surface_maps(GltfDocument& document, GltfTextures& textures, const GltfValue& json, ModelMaterial& material) {
  material.normal_map = textures.use(json, "normalTexture");
  material.normal_scale = document.factor(document.object(json, "normalTexture"), "scale", 1.0f, -1e6, 1e6);
  material.occlusion_map = textures.use(json, "occlusionTexture", Channel::red);
  material.occlusion_strength = document.factor(document.object(json, "occlusionTexture"), "strength", 1.0f);
  material.emissive = color(document, json, "emissiveFactor", 0.0);
  material.emissive_map = textures.use(json, "emissiveTexture");
  material.double_sided = document.boolean(json, "doubleSided");
}

void read_specular(GltfDocument& document, GltfTextures& textures, const GltfValue& json, ModelMaterial& material) {
  material.specular = document.factor(json, "specularFactor", 1.0f);
  material.specular_map = textures.use(json, "specularTexture", Channel::alpha);
  material.specular_color = color(document, json, "specularColorFactor", 1.0);
  material.specular_color_map = textures.use(json, "specularColorTexture");
}

void read_clearcoat(GltfDocument& document, GltfTextures& textures, const GltfValue& json, ModelMaterial& material) {
  material.clearcoat = document.factor(json, "clearcoatFactor", 0.0f);
  material.clearcoat_map = textures.use(json, "clearcoatTexture", Channel::red);
  material.clearcoat_roughness = document.factor(json, "clearcoatRoughnessFactor", 0.0f);
  material.clearcoat_roughness_map = textures.use(json, "clearcoatRoughnessTexture", Channel::green);
  material.clearcoat_normal_map = textures.use(json, "clearcoatNormalTexture");
  material.clearcoat_normal_scale = document.factor(document.object(json, "clearcoatNormalTexture"), "scale", 1.0f, -1e6, 1e6);
}

void read_sheen(GltfDocument& document, GltfTextures& textures, const GltfValue& json, ModelMaterial& material) {
  material.sheen_color = unit_color<3>(document, json, "sheenColorFactor", 0.0);
  material.sheen_color_map = textures.use(json, "sheenColorTexture");
  material.sheen = material.sheen_color == glm::vec3(0.0f) ? 0.0f : 1.0f;
  material.sheen_roughness = document.factor(json, "sheenRoughnessFactor", 0.0f);
  material.sheen_roughness_map = textures.use(json, "sheenRoughnessTexture", Channel::alpha);
}

void read_transmission(GltfDocument& document, const GltfValue& json, ModelMaterial& material) {
  const float transmission = document.factor(json, "transmissionFactor", 0.0f);
  if (transmission == 0.0f) return;
  document.warn("KHR_materials_transmission is approximated by blending; refraction and transmission textures are ignored");
  material.alpha_mode = AlphaMode::blend;
  material.base_color.w *= std::max(1.0f - transmission, kMinGlassOpacity);
}

bool same_place(const TextureUse& a, const TextureUse& b) { return a.uv_set == b.uv_set && a.uv_transform == b.uv_transform; }

// Converts a material whose maps, of which there is at least one, can be read with the same texture coordinates.
void convert_maps(GltfTextures& textures, const TextureUse& diffuse_map, const TextureUse& specular_map, SpecularGlossiness source,
                  ModelMaterial& material) {
  source.diffuse_texture = diffuse_map.texture;
  source.specular_texture = specular_map.texture;
  const int texture = textures.add_converted(source, material.name);
  TextureUse use = diffuse_map.texture >= 0 ? diffuse_map : specular_map;
  use.texture = texture;
  material.base_color_map = use;
  material.base_color = glm::vec4(1.0f);
  use.texture = texture + 1;
  material.roughness_map = material.metallic_map = use;
  material.roughness_map.channel = Channel::green;
  material.metallic_map.channel = Channel::blue;
  material.metallic = material.roughness = 1.0f;
}

void read_specular_glossiness(GltfDocument& document, GltfTextures& textures, const GltfValue& json, ModelMaterial& material) {
  const glm::vec4 diffuse = unit_color<4>(document, json, "diffuseFactor");
  SpecularGlossiness source;
  source.diffuse = glm::vec3(diffuse);
  source.specular = unit_color<3>(document, json, "specularFactor");
  source.glossiness = document.factor(json, "glossinessFactor", 1.0f);
  const TextureUse diffuse_map = textures.use(json, "diffuseTexture"), specular_map = textures.use(json, "specularGlossinessTexture");
  const MetallicColor converted = metallic_color(glm::dvec3(source.diffuse), glm::dvec3(source.specular));
  material.metallic_map = material.roughness_map = {};
  if (specular_map.texture < 0 && (diffuse_map.texture < 0 || converted.metallic == 0.0)) {
    // The base color of a dielectric is proportional to the diffuse color.
    material.base_color_map = diffuse_map;
    material.base_color = glm::vec4(glm::vec3(converted.base), 1.0f);
    material.metallic = static_cast<float>(converted.metallic);
    material.roughness = 1.0f - source.glossiness;
  } else if (diffuse_map.texture < 0 || specular_map.texture < 0 || same_place(diffuse_map, specular_map)) {
    convert_maps(textures, diffuse_map, specular_map, source, material);
  } else {
    document.warn_at(json, "specularGlossinessTexture",
                     "has other texture coordinates than diffuseTexture; the material is approximated by a non-metal");
    convert_maps(textures, {}, specular_map, source, material);
    material.base_color_map = diffuse_map;
    material.base_color = diffuse;
    material.metallic = 0.0f;
    material.metallic_map = {};
    material.specular_color_map = specular_map;
    material.specular_color = source.specular / static_cast<float>(kDielectricReflectance);
  }
  material.base_color.w = diffuse.w;
}

void read_extensions(GltfDocument& document, GltfTextures& textures, const GltfValue& json, ModelMaterial& material) {
  if (const GltfValue* e = document.extension(json, "KHR_materials_pbrSpecularGlossiness")) {
    read_specular_glossiness(document, textures, *e, material);
  }
  if (const GltfValue* e = document.extension(json, "KHR_materials_specular")) read_specular(document, textures, *e, material);
  if (const GltfValue* e = document.extension(json, "KHR_materials_clearcoat")) read_clearcoat(document, textures, *e, material);
  if (const GltfValue* e = document.extension(json, "KHR_materials_sheen")) read_sheen(document, textures, *e, material);
  if (const GltfValue* e = document.extension(json, "KHR_materials_ior")) {
    // The extension defines 0 as infinity, for materials converted from specular-glossiness.
    const float ior = document.factor(*e, "ior", 1.5f, 0.0, 1e6);
    material.ior = ior == 0.0f ? 1e6f : std::max(ior, 1.0f);
  }
  if (const GltfValue* e = document.extension(json, "KHR_materials_emissive_strength")) {
    material.emissive *= document.factor(*e, "emissiveStrength", 1.0f, 0.0, 1e6);
  }
  if (const GltfValue* e = document.extension(json, "KHR_materials_transmission")) read_transmission(document, *e, material);
  material.unlit = document.extension(json, "KHR_materials_unlit") != nullptr;
}

}  // namespace

ModelMaterial gltf_default_material() {
  ModelMaterial material;
  material.name = "default";
  material.is_default = true;
  material.metallic = 1.0f;
  return material;
}

namespace {

// Meshes store two sets of texture coordinates. Chooses the two of the file's sets that a material uses, and makes each of its maps refer
// to one of them. If a material uses more than two sets, those with the two lowest numbers are chosen.
void choose_uv_sets(GltfDocument& document, const GltfValue& json, ModelMaterial& m) {
  std::set<int> used;
  for (const auto map : kTextureUses) {
    if ((m.*map).texture >= 0) used.insert((m.*map).uv_set);
  }
  if (used.empty() || *used.rbegin() <= 1) return;
  m.uv_sets = {*used.begin(), used.size() > 1 ? *std::next(used.begin()) : -1};
  if (used.size() > 2) {
    document.warn_at(json, "",
                     fmt::format("uses {} sets of texture coordinates; all but {} and {} are replaced by {}", used.size(), m.uv_sets[0],
                                 m.uv_sets[1], m.uv_sets[0]));
  }
  for (const auto map : kTextureUses) (m.*map).uv_set = (m.*map).uv_set == m.uv_sets[1] ? 1 : 0;
}

}  // namespace

std::vector<ModelMaterial> gltf_materials(GltfDocument& document, GltfTextures& textures) {
  std::vector<ModelMaterial> materials;
  for (const GltfValue& json : document.list("materials")) {
    ModelMaterial material;
    material.name = document.string(json, "name");
    read_metallic_roughness(document, textures, document.object(json, "pbrMetallicRoughness"), material);
    read_surface_maps(document, textures, json, material);
    read_alpha(document, json, material);
    read_extensions(document, textures, json, material);
    choose_uv_sets(document, json, material);
    materials.push_back(std::move(material));
  }
  return materials;
}

}  // namespace halfspace::HS_LANES
