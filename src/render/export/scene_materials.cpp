// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/export/scene_materials.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>

#include "halfspace/image/png.h"

namespace halfspace::HS_LANES {

namespace {

void flip_green(Image<glm::u8vec4>& image) {
  for (glm::u8vec4& t : std::span(image.data(), image.texels().size())) t.y = static_cast<uint8_t>(255 - t.y);
}
void flip_green(Image<glm::vec4>& image) {
  for (glm::vec4& t : std::span(image.data(), image.texels().size())) t.y = 1.0f - t.y;
}

void convert_highlight(const LitSurface& s, ModelMaterial& m) {
  m.roughness = 1.0f;
  m.specular = 0.0f;
  if (s.model == LightModel::lambert || m.unlit) return;
  constexpr float kDielectric = 0.04f;  // reflectance for an index of refraction of 1.5
  const float r2 = std::min(std::sqrt(2.0f / (std::max(s.factors[kShininess].constant.x, 0.0f) + 2.0f)), 1.0f);
  m.roughness = std::sqrt(r2);
  m.specular = 1.0f;
  m.specular_color = glm::min(4.0f * r2 * r2 * s.factors[kSpecular].constant, 1.0f) / kDielectric;
}

}  // namespace

void warn_once(Model& model, const std::string& text) {
  if (std::ranges::find(model.warnings, text) == model.warnings.end()) model.warnings.push_back(text);
}

void warn_if_clamped(Model& model, const TextureImage& image) {
  const auto* numbers = std::get_if<Image<glm::vec4>>(&image);
  if (numbers != nullptr && std::ranges::any_of(numbers->texels(), [](const glm::vec4& t) { return t != glm::clamp(t, 0.0f, 1.0f); }))
    warn_once(model, "texels below 0 or above 1 are clamped");
}

int SceneMaterials::add(const std::string& name, const DrawnMesh& drawn) {
  const LitSurface& s = *drawn.surface;
  ModelMaterial m;
  m.name = name;
  m.double_sided = s.two_sided;
  m.unlit = drawn.unlit;
  const glm::vec3 color = s.factors[kColor].constant * (drawn.unlit ? glm::vec3(1.0f) : s.factors[kDiffuse].constant);
  m.base_color = glm::vec4(glm::min(color, 1.0f), s.opacity);
  if (s.opacity < 1.0f) m.alpha_mode = AlphaMode::blend;
  if (color != glm::vec3(m.base_color)) warn_once(model_, "colors above 1 are clamped to 1");
  m.base_color_map = texture_use(s.factors[kColor].map, s.factors[kColor].sampler, TextureRole::colors, false);
  m.emissive = s.factors[kEmissive].constant;
  if (m.emissive != glm::vec3(0.0f))
    m.emissive_map = texture_use(s.factors[kEmissive].map, s.factors[kEmissive].sampler, TextureRole::colors, false);
  convert_highlight(s, m);
  if (drawn.has_normal_map) {
    m.normal_map = texture_use(s.detail.map, s.detail.sampler, TextureRole::normals, s.detail.flip_green);
    m.normal_scale = s.detail.strength;
  }
  if (drawn.has_other_detail) warn_once(model_, "bump maps and per-pixel slopes of displaced spheres are omitted");
  for (const MaterialFactor factor : {kAmbient, kDiffuse, kSpecular, kShininess}) {
    if (s.factors[factor].map != nullptr && s.factors[factor].map != s.factors[kColor].map)
      warn_once(model_, "ambient, diffuse, specular and shininess maps are omitted");
  }
  if (s.reflected_environment != nullptr) warn_once(model_, "environment reflections are omitted");
  model_.materials.push_back(std::move(m));
  return static_cast<int>(model_.materials.size()) - 1;
}

// Returns a use of the texture, which is added to the model if it is new.
TextureUse SceneMaterials::texture_use(const Texture2D* texture, const Sampler& sampler, TextureRole role, bool flips_green) {
  TextureUse use;
  if (texture == nullptr) return use;
  const auto [known, added] = images_.try_emplace({texture, flips_green}, static_cast<int>(model_.images.size()));
  if (added) {
    TextureImage image = image_of(*texture);
    if (flips_green) std::visit([](auto& texels) { flip_green(texels); }, image);
    warn_if_clamped(model_, image);
    auto png = encode_png(image, image_use(role));
    model_.images.push_back({"map" + std::to_string(known->second), {}, std::make_shared<const std::vector<std::byte>>(std::move(png))});
  }
  use.texture = static_cast<int>(model_.textures.size());
  model_.textures.push_back({known->second, sampler});
  return use;
}

}  // namespace halfspace::HS_LANES
