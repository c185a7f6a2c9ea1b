// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/obj/mtl_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "halfspace/model/geometry/single_mesh.h"
#include "halfspace/model/model.h"
#include "halfspace/model/text/srgb_color.h"
#include "halfspace/model/text/text_lines.h"

namespace halfspace::HS_LANES {

namespace {

constexpr float kMinIor = 1.1f, kMaxIor = 4.0f;

constexpr std::string_view kMapNames[kMtlMaps] = {"map_Kd",     "map_Ks", "map_Ns", "map_Ke", "map_d",  "bump map",
                                                  "normal map", "map_Pr", "map_Pm", "map_Ps", "map_Pc", "map_Pcr"};

float max_component(const glm::vec3& color) { return std::max({color.x, color.y, color.z}); }
float unit(float value) { return std::clamp(value, 0.0f, 1.0f); }

// Returns a factor. If there is a texture for it, a factor that is missing or 0 counts as 1.
float factor(const std::optional<float>& value, const TextureUse& map, float missing) {
  if (map.texture >= 0) return value.value_or(0.0f) == 0.0f ? 1.0f : unit(*value);
  return unit(value.value_or(missing));
}

glm::vec3 diffuse(const MtlMaterial& mtl, bool has_texture) {
  const glm::vec3 color = mtl.Kd.value_or(glm::vec3(0.0f));
  if (max_component(color) > 0.0f) return linear_from_srgb(color);
  if (has_texture) return glm::vec3(1.0f);
  return glm::vec3(mtl.Kd && mtl.map(MtlMap::Kd).file.empty() ? 0.0f : kDefaultModelGray);
}

glm::vec3 emission(const MtlMaterial& mtl, bool has_texture) {
  const glm::vec3 color = glm::max(mtl.Ke.value_or(glm::vec3(0.0f)), 0.0f);
  if (max_component(color) == 0.0f) return glm::vec3(has_texture ? 1.0f : 0.0f);
  const float intensity = std::max(max_component(color), 1.0f);
  return linear_from_srgb(color / intensity) * intensity;
}

Channel channel_of(char letter) {
  switch (letter) {
    case 'r': return Channel::red;
    case 'g': return Channel::green;
    case 'b': return Channel::blue;
    case 'm': return Channel::alpha;
    default: return Channel::luminance;
  }
}

bool is_relative(std::string_view name) {
  return !name.starts_with('/') && !name.starts_with('\\') && !(name.size() > 1 && name[1] == ':');
}

// uv' = scale · uv + offset with v = 0 at the bottom, as a transform for v = 0 at the top.
glm::mat3x2 uv_transform(const MtlTexture& texture) {
  const glm::vec2 s = texture.scale, o = texture.offset;
  return {glm::vec2(s.x, 0.0f), glm::vec2(0.0f, s.y), glm::vec2(o.x, 1.0f - s.y - o.y)};
}

}  // namespace

MtlConverter::MtlConverter(Model& model, const std::filesystem::path& file, const ReadModelOptions& options, double diagonal)
    : model_(model),
      references_(file, options.allow_outside, model.warnings),
      quiet_(file, options.allow_outside, quiet_warnings_),
      diagonal_(diagonal) {}

ModelMaterial MtlConverter::convert(const MtlMaterial& mtl) {
  ModelMaterial material;
  material.name = mtl.name;
  material.double_sided = true;
  material.base_color_map = texture(mtl, MtlMap::Kd);
  material.base_color = glm::vec4(diffuse(mtl, material.base_color_map.texture >= 0), 1.0f);
  material.emissive_map = texture(mtl, MtlMap::Ke);
  material.emissive = emission(mtl, material.emissive_map.texture >= 0);
  convert_opacity(mtl, material);
  convert_reflection(mtl, material);
  convert_relief(mtl, material);
  return material;
}

void MtlConverter::convert_opacity(const MtlMaterial& mtl, ModelMaterial& material) {
  float opacity = unit(mtl.d.value_or(1.0f));
  if (!mtl.d && mtl.Tr && *mtl.Tr < 1.0f) opacity = 1.0f - unit(*mtl.Tr);
  const MtlTexture& map = mtl.map(MtlMap::d);
  const bool same_image = !map.file.empty() && map.file == mtl.map(MtlMap::Kd).file;
  if (!same_image) material.opacity_map = texture(mtl, MtlMap::d);
  const bool mapped = material.opacity_map.texture >= 0 || (same_image && material.base_color_map.texture >= 0);
  if (mapped && opacity == 0.0f) opacity = 1.0f;
  material.base_color.w = opacity;
  if (opacity < 1.0f) {
    material.alpha_mode = AlphaMode::blend;
  } else if (mapped) {
    material.alpha_mode = AlphaMode::mask;
    material.mask_unless_soft = true;
  }
}

void MtlConverter::convert_reflection(const MtlMaterial& mtl, ModelMaterial& material) {
  material.metallic_map = texture(mtl, MtlMap::Pm);
  material.metallic = factor(mtl.Pm, material.metallic_map, 0.0f);
  material.roughness_map = texture(mtl, mtl.map(MtlMap::Pr).file.empty() ? MtlMap::Ns : MtlMap::Pr);
  const float ns = mtl.Ns ? std::sqrt(std::sqrt(2.0f / (std::max(*mtl.Ns, 0.0f) + 2.0f))) : kDefaultModelRoughness;
  material.roughness = mtl.Pr || material.roughness_map.texture >= 0 ? factor(mtl.Pr, material.roughness_map, ns) : ns;
  material.sheen_map = texture(mtl, MtlMap::Ps);
  material.sheen = factor(mtl.Ps, material.sheen_map, 0.0f);
  material.sheen_roughness = kMtlSheenRoughness;
  material.clearcoat_map = texture(mtl, MtlMap::Pc);
  material.clearcoat = factor(mtl.Pc, material.clearcoat_map, 0.0f);
  material.clearcoat_roughness_map = texture(mtl, MtlMap::Pcr);
  material.clearcoat_roughness = factor(mtl.Pcr, material.clearcoat_roughness_map, 0.0f);
  if (mtl.Ni && *mtl.Ni >= kMinIor && *mtl.Ni <= kMaxIor) material.ior = *mtl.Ni;
  if (mtl.Pr || mtl.Pm || material.metallic_map.texture >= 0 || !mtl.map(MtlMap::Pr).file.empty()) return;

  material.specular_map = texture(mtl, MtlMap::Ks);
  const glm::vec3 ks = glm::clamp(mtl.Ks.value_or(glm::vec3(0.5f)), 0.0f, 1.0f);
  const int illum = mtl.illum.value_or(2);
  material.unlit = illum == 0;
  if ((illum == 3 || illum == 5 || illum == 8) && max_component(ks) > max_component(mtl.Kd.value_or(glm::vec3(0.0f)))) {
    material.metallic = 1.0f;
    material.base_color = glm::vec4(linear_from_srgb(ks), material.base_color.w);
  } else if (illum == 1 || (max_component(ks) == 0.0f && material.specular_map.texture < 0)) {
    material.specular = 0.0f;
  } else if (max_component(ks) > 0.0f) {
    material.specular_color = 2.0f * ks;
  }
}

void MtlConverter::convert_relief(const MtlMaterial& mtl, ModelMaterial& material) {
  material.normal_map = texture(mtl, MtlMap::norm);
  material.bump_map = texture(mtl, MtlMap::bump);
  material.bump_scale = static_cast<float>(kMtlBumpHeight * diagonal_) * mtl.map(MtlMap::bump).bump_multiplier;
}

int MtlConverter::image(const MtlMaterial& mtl, MtlMap which) {
  const std::string& name = mtl.map(which).file;
  const auto [known, added] = images_.try_emplace(mtl.folder + '\n' + name, -1);
  if (!added) return known->second;
  std::optional<std::filesystem::path> path;
  if (!mtl.folder.empty() && is_relative(name)) path = quiet_.find(mtl.folder + '/' + name, "texture");
  if (!path)
    path = references_.find(name, fmt::format("{} of material {}", kMapNames[static_cast<std::size_t>(which)], in_quotes(mtl.name)));
  if (!path) return -1;
  const auto same = std::ranges::find(model_.images, *path, &ModelImage::file);
  known->second = static_cast<int>(same - model_.images.begin());
  if (same == model_.images.end()) model_.images.push_back({name, *path, nullptr});
  return known->second;
}

TextureUse MtlConverter::texture(const MtlMaterial& mtl, MtlMap which) {
  const MtlTexture& map = mtl.map(which);
  TextureUse use;
  if (map.file.empty()) return use;
  ModelTexture texture{image(mtl, which), {.anisotropy = kModelAnisotropy}};
  if (texture.image < 0) return use;
  if (map.clamp) texture.sampler.wrap_s = texture.sampler.wrap_t = Wrap::clamp;
  const auto same = std::ranges::find_if(model_.textures, [&](const ModelTexture& other) {
    return other.image == texture.image && other.sampler.wrap_s == texture.sampler.wrap_s;
  });
  use.texture = static_cast<int>(same - model_.textures.begin());
  if (same == model_.textures.end()) model_.textures.push_back(texture);
  use.uv_transform = uv_transform(map);
  use.channel = channel_of(map.channel);
  return use;
}

}  // namespace halfspace::HS_LANES
