// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/model_materials.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "halfspace/core/resource_limits.h"
#include "halfspace/core/srgb.h"
#include "halfspace/image/image_limits.h"
#include "halfspace/model/gltf/specular_glossiness.h"
#include "halfspace/render/assets/converted_images.h"
#include "halfspace/render/prepare/model_bumps.h"
#include "halfspace/render/prepare/soft_mask.h"

namespace halfspace::HS_LANES {

namespace {

// The maps of a material, in the order of MetallicMap.
constexpr std::array<TextureUse ModelMaterial::*, kMetallicMaps> kMaps{
    &ModelMaterial::base_color_map,     &ModelMaterial::opacity_map,
    &ModelMaterial::metallic_map,       &ModelMaterial::roughness_map,
    &ModelMaterial::specular_map,       &ModelMaterial::specular_color_map,
    &ModelMaterial::clearcoat_map,      &ModelMaterial::clearcoat_roughness_map,
    &ModelMaterial::normal_map,         &ModelMaterial::clearcoat_normal_map,
    &ModelMaterial::occlusion_map,      &ModelMaterial::emissive_map,
    &ModelMaterial::sheen_map,          &ModelMaterial::sheen_color_map,
    &ModelMaterial::sheen_roughness_map};

// Returns whether a map affects the picture. Maps of a coat or sheen that the material does not have are not sampled.
bool has_effect(std::size_t map, const ObjectDescription& o, const ModelMaterial& m) {
  const bool lit = is_lit(o, m);
  switch (map) {
    case kBaseColorMap:
    case kOpacityMap: return true;
    case kEmissiveMap: return lit || (!m.unlit && m.emissive != glm::vec3(0.0f));
    case kClearcoatMap:
    case kClearcoatRoughnessMap:
    case kClearcoatNormalMap: return lit && m.clearcoat > 0.0f;
    case kSheenMap:
    case kSheenColorMap:
    case kSheenRoughnessMap: return lit && m.sheen > 0.0f;
    default: return lit;
  }
}

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

std::string image_recipe(const std::filesystem::path& file, int image, TextureRole role) {
  return recipe("model image", file.string(), image, static_cast<int>(role));
}

uint64_t texture_memory_of(const Image<glm::u8vec4>& picture) {
  return texture_memory(static_cast<uint64_t>(picture.width()), static_cast<uint64_t>(picture.height()), sizeof(glm::u8vec4));
}

// Estimates the work of decoding an image by the size of its file. The result of a conversion needs two images.
std::uintmax_t decoding_work(const ModelImage& image) {
  if (image.converted) return std::numeric_limits<std::uintmax_t>::max();
  if (image.bytes != nullptr) return image.bytes->size();
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(image.file, error);
  return error ? 0 : bytes;
}

// Returns the images that the materials of a posed model use and that are not yet loaded, with their roles.
std::vector<std::pair<int, TextureRole>> wanted_images(const ObjectDescription& o, const Model& model, const PosedModel& posed,
                                                       const UsedAssets& used) {
  std::set<std::pair<int, TextureRole>> wanted;
  for (const PosedMesh& part : posed.meshes) {
    if (part.material < 0) continue;
    const ModelMaterial& material = model.materials[static_cast<std::size_t>(part.material)];
    for (std::size_t i = 0; i < kMaps.size(); ++i) {
      const int texture = (material.*kMaps[i]).texture;
      if (texture < 0 || !has_effect(i, o, material)) continue;
      const int image = model.textures[static_cast<std::size_t>(texture)].image;
      const TextureRole role = role_of(kMaps[i]);
      if (image >= 0 && !used.contains(image_recipe(o.file.path, image, role))) wanted.emplace(image, role);
    }
  }
  return {wanted.begin(), wanted.end()};
}

// Returns a texel of level 0. Numbers are rounded to 8-bit values.
glm::u8vec4 codes_at(const Texture2D& map, int x, int y) {
  if (has_codes(map.format())) return map.texel(0, x, y);
  const glm::vec4 v = map.value(0, x, y);
  return {linear_to_unorm8(v.x), linear_to_unorm8(v.y), linear_to_unorm8(v.z), linear_to_unorm8(v.w)};
}

}  // namespace

// If `lit`, filters the environment at the same time, because a few images do not keep all threads busy.
void ModelMaterials::load_images(const ObjectDescription& o, const Model& model, const PosedModel& posed, bool lit) {
  const std::vector<std::pair<int, TextureRole>> list = wanted_images(o, model, posed, used_);
  if (list.empty()) return;
  const auto start = std::chrono::steady_clock::now();
  std::vector<std::optional<Texture2D>> textures(list.size());
  std::vector<std::vector<std::string>> problems(list.size());
  const auto image_at = [&](std::size_t i) -> const ModelImage& { return model.images[static_cast<std::size_t>(list[i].first)]; };
  // Converts all consecutive images that are results of the same conversion.
  const auto convert = [&](std::size_t first) {
    if (first > 0 && are_converted_together(image_at(first - 1), image_at(first))) return;
    const std::string file = o.file.path.string();
    ConvertedImages images = converted_images(model, *image_at(first).converted, file, workers_);
    for (std::size_t i = first; i < list.size() && are_converted_together(image_at(first), image_at(i)); ++i) {
      const Image<glm::u8vec4>& result = images.result(image_at(i));
      const MemoryClaim claim(texture_memory_of(result), file + ": " + image_at(i).name);
      textures[i].emplace(result, list[i].second == TextureRole::colors ? TexelFormat::srgb8a8 : TexelFormat::rgba8, &workers_);
    }
    problems[first] = std::move(images.problems);
  };
  const auto load = [&](std::size_t i) {
    const ModelImage& source = image_at(i);
    if (source.converted) return convert(i);
    if (!source.has_content()) return;  // the reader has already warned
    try {
      const std::string file = o.file.path.string();
      textures[i].emplace(texture_of(texels_of(source, list[i].second, file), list[i].second, file + ": " + source.name, &workers_));
    } catch (const LimitError&) {
      throw;
    } catch (const InputError& e) {  // the material is drawn without it
      problems[i] = {e.what()};
    }
  };
  // The largest image is first, because one thread decodes it. The environment is last, because all threads can share its work.
  std::vector<std::uintmax_t> work(list.size());
  std::vector<std::size_t> order(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) work[i] = decoding_work(image_at(i));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return work[i]; });
  std::atomic<std::size_t> next = 0;
  workers_.for_each(workers_.threads(), [&](int) {
    for (std::size_t i = next++; i <= order.size(); i = next++) {
      if (i < order.size()) {
        load(order[i]);
      } else if (lit) {
        environments_.light();
      }
    }
  });
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (const std::string& problem : problems[i]) warnings_.warn_once(problem);
    if (textures[i])
      used_.asset<Texture2D>(image_recipe(o.file.path, list[i].first, list[i].second), [&] { return std::move(*textures[i]); });
  }
  images_ms_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Returns a texture that load_images has loaded, or null if there is no such image.
const Texture2D* ModelMaterials::model_texture(const std::filesystem::path& file, int image, TextureRole role) {
  return used_.existing<Texture2D>(image_recipe(file, image, role)).get();
}

// Returns true if a mask is only a guess and its map has so many values between 0 and 1 that the surface must be blended.
bool ModelMaterials::is_soft_mask(const ObjectDescription& o, const Model& model, const ModelMaterial& m) {
  if (!m.mask_unless_soft || m.alpha_mode != AlphaMode::mask) return false;
  const bool separate = m.opacity_map.texture >= 0;
  const int texture = separate ? m.opacity_map.texture : m.base_color_map.texture;
  if (texture < 0) return false;
  const int image = model.textures[static_cast<std::size_t>(texture)].image;
  const Texture2D* map = image < 0 ? nullptr : model_texture(o.file.path, image, separate ? TextureRole::data : TextureRole::colors);
  if (map == nullptr) return false;
  const Channel channel = separate ? m.opacity_map.channel : Channel::alpha;
  return *used_.asset<bool>(recipe("soft mask", o.file.path.string(), image, static_cast<int>(channel)), [&] {
    return is_soft(
        map->width(), map->height(), [&](int x, int y) { return codes_at(*map, x, y); }, channel);
  });
}

namespace {

// Removes the maps that the keys `textured` and `normal` of the object switch off. The alpha of a color map remains if it is
// the only map of the opacity.
void drop_maps(MetallicMaterial& surface, const ObjectDescription& o, const ModelMaterial& m) {
  if (o.surface.textured && o.surface.normal != DetailChoice::none) return;
  if (!o.surface.textured) {
    MaterialMap& color = surface.maps[kBaseColorMap];
    MaterialMap& opacity = surface.maps[kOpacityMap];
    if (m.alpha_mode != AlphaMode::opaque && color.map != nullptr && opacity.map == nullptr) {
      opacity = color;
      opacity.channel = weights_of(Channel::alpha);
    }
    color.map = nullptr;
  }
  if (o.surface.normal == DetailChoice::none) surface.maps[kNormalMap].map = surface.maps[kClearcoatNormalMap].map = nullptr;
  for (MaterialMap& map : surface.maps) map.repeats = false;  // the map whose texel was used again may be gone
}

}  // namespace

MetallicMaterial ModelMaterials::metallic_material(const ObjectDescription& o, const Model& model, const ModelMaterial& m, bool has_uvs) {
  MetallicMaterial out;
  out.to_eye_ws = glm::vec3(view_.to_eye_ws);
  out.lights = lights_.of_surface(o.receives_shadow);
  out.shadowed = lights_.have_shadow(o.receives_shadow);
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
  out.sheen = m.sheen;
  out.sheen_color = m.sheen_color;
  out.sheen_roughness = m.sheen_roughness;
  out.normal_scale = m.normal_scale;
  out.clearcoat_normal_scale = m.clearcoat_normal_scale;
  out.occlusion_strength = m.occlusion_strength;
  out.emissive = m.unlit ? glm::vec3(0.0f) : m.emissive;
  out.ambient = glm::vec3(lights_.ambient());
  out.alpha_cutoff = m.alpha_cutoff;
  out.unlit = !is_lit(o, m);
  out.blends = m.alpha_mode == AlphaMode::blend || (has_uvs && is_soft_mask(o, model, m));
  out.environment = out.unlit ? nullptr : environments_.light();
  if (!has_uvs) return out;
  const MaterialMap* previous = nullptr;  // the last map that has a texture
  int previous_texture = -1;
  for (std::size_t i = 0; i < kMetallicMaps; ++i) {
    const TextureUse& use = m.*kMaps[i];
    if (use.texture < 0 || !has_effect(i, o, m)) continue;
    const ModelTexture& texture = model.textures[static_cast<std::size_t>(use.texture)];
    if (texture.image < 0) continue;
    MaterialMap& map = out.maps[i];
    map.map = model_texture(o.file.path, texture.image, role_of(kMaps[i]));
    map.sampler = texture.sampler;
    map.uv_set = use.uv_set;
    map.uv_transform = use.uv_transform;
    map.channel = weights_of(use.channel);
    map.repeats = previous != nullptr && map.map == previous->map && use.texture == previous_texture && map.uv_set == previous->uv_set &&
                  map.uv_transform == previous->uv_transform;
    if (map.map == nullptr) continue;
    previous = &map;
    previous_texture = use.texture;
  }
  drop_maps(out, o, m);
  return out;
}

MetallicMaterial ModelMaterials::surface_of(const ObjectDescription& o, const Model& model, int mesh, const ModelMaterial& m,
                                            bool has_uvs) {
  MetallicMaterial surface =
      has_uvs ? metallic_material(o, model, m, true) : metallic_material(o, model, without_converted_maps(model, m), false);
  const bool bumps = m.bump_map.texture >= 0 && m.normal_map.texture < 0 && is_lit(o, m) && o.surface.normal != DetailChoice::none;
  if (bumps) add_bumps(surface, o, model, mesh, m, used_, warnings_);
  return surface;
}

}  // namespace halfspace::HS_LANES
