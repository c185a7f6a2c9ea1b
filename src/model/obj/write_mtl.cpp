// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/obj/write_mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "halfspace/core/srgb.h"
#include "halfspace/model/obj/mtl_materials.h"

namespace halfspace::HS_LANES {

namespace {

std::string numbers_text(const glm::vec3& v) { return fmt::format("{} {} {}", v.x, v.y, v.z); }

glm::vec3 encoded_color(const glm::vec3& c) { return {srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z)}; }

// Returns the Blinn-Phong exponent for a roughness: the inverse of the formula in mtl_materials.h.
float exponent_of(float roughness) {
  constexpr float kMaxExponent = 1e6f;
  const float r2 = roughness * roughness;
  return r2 * r2 > 2.0f / kMaxExponent ? std::max(2.0f / (r2 * r2) - 2.0f, 0.0f) : kMaxExponent;
}

class MtlWriter {
 public:
  MtlWriter(const Model& model, const std::vector<std::string>& image_names, double diagonal, std::vector<std::string>& warnings)
      : model_(model), image_names_(image_names), diagonal_(diagonal), warnings_(warnings) {}

  std::string text(const ModelMaterial& m, const std::string& name) {
    text_ = "newmtl " + name + "\n";
    add("Kd", numbers_text(encoded_color(glm::vec3(m.base_color))));
    add_map("map_Kd", m.base_color_map);
    if (m.base_color.w != 1.0f) add("d", fmt::format("{}", m.base_color.w));
    add_opacity_map(m);
    add_emissive(m);
    add_reflection(m);
    add_map("norm", m.normal_map);
    add_bump_map(m);
    warn_about_omissions(m);
    if (m.ior != 1.5f) add("Ni", fmt::format("{}", m.ior));
    add_sheen(m);
    if (m.clearcoat > 0.0f) {
      add("Pc", fmt::format("{}", m.clearcoat));
      add("Pcr", fmt::format("{}", m.clearcoat_roughness));
    }
    return text_ + "\n";
  }

 private:
  void add(const char* key, const std::string& value) { text_ += fmt::format("{} {}\n", key, value); }

  bool has_image(const TextureUse& use) const { return !image_name(use).empty(); }

  const std::string& image_name(const TextureUse& use) const {
    static const std::string kNone;
    if (use.texture < 0) return kNone;
    const int image = model_.textures[static_cast<std::size_t>(use.texture)].image;
    return image < 0 ? kNone : image_names_[static_cast<std::size_t>(image)];
  }

  void warn(const std::string& text) {
    if (std::ranges::find(warnings_, text) == warnings_.end()) warnings_.push_back(text);
  }

  void add_map(const char* key, const TextureUse& use, bool with_channel = false, std::string options = "") {
    if (!has_image(use)) return;
    const glm::mat3x2& t = use.uv_transform;
    if (t[0].y != 0.0f || t[1].x != 0.0f) warn("OBJ cannot store texture rotation");
    if (use.uv_set != 0) warn("OBJ stores only one set of texture coordinates; maps that use the second set are written with the first");
    if (t[0].x != 1.0f || t[1].y != 1.0f) options += fmt::format("-s {} {} 1 ", t[0].x, t[1].y);
    const float y = 1.0f - t[1].y - t[2].y;  // v points up
    if (t[2].x != 0.0f || y != 0.0f) options += fmt::format("-o {} {} 0 ", t[2].x, y);
    constexpr std::array<const char*, 5> kLetters = {"r", "g", "b", "m", "l"};
    if (with_channel) options += fmt::format("-imfchan {} ", kLetters[static_cast<std::size_t>(use.channel)]);
    if (model_.textures[static_cast<std::size_t>(use.texture)].sampler.wrap_s == Wrap::clamp) options += "-clamp on ";
    add(key, options + image_name(use));
  }

  void add_bump_map(const ModelMaterial& m) {
    if (diagonal_ <= 0.0) return;
    add_map("map_bump", m.bump_map, false, fmt::format("-bm {} ", static_cast<float>(m.bump_scale / (kMtlBumpHeight * diagonal_))));
  }

  void warn_about_omissions(const ModelMaterial& m) {
    if (has_image(m.normal_map) && m.normal_scale != 1.0f) warn("OBJ cannot store the strength of normal maps");
    for (const TextureUse* use : {&m.occlusion_map, &m.specular_map, &m.specular_color_map, &m.clearcoat_map, &m.clearcoat_roughness_map,
                                  &m.clearcoat_normal_map, &m.sheen_color_map, &m.sheen_roughness_map}) {
      if (has_image(*use)) warn("occlusion, specular, clearcoat, sheen color and sheen roughness maps are omitted");
    }
  }

  // Opaque materials ignore the alpha channel of their base color.
  void add_opacity_map(const ModelMaterial& m) {
    if (m.alpha_mode == AlphaMode::opaque) return;
    if (has_image(m.opacity_map)) return add_map("map_d", m.opacity_map, true);
    TextureUse alpha = m.base_color_map;
    alpha.channel = Channel::alpha;
    add_map("map_d", alpha, true);
  }

  void add_emissive(const ModelMaterial& m) {
    const float largest = std::max({m.emissive.x, m.emissive.y, m.emissive.z});
    if (largest <= 0.0f) return;
    const float intensity = std::max(largest, 1.0f);
    add("Ke", numbers_text(encoded_color(m.emissive / intensity) * intensity));
    add_map("map_Ke", m.emissive_map);
  }

  // Metals and roughness maps require the PBR statements, which replace Ns and Ks.
  void add_reflection(const ModelMaterial& m) {
    const bool pbr = m.metallic > 0.0f || has_image(m.metallic_map) || has_image(m.roughness_map);
    if (pbr) {
      add("Pm", fmt::format("{}", m.metallic));
      add_map("map_Pm", m.metallic_map, true);
      add("Pr", fmt::format("{}", m.roughness));
      add_map("map_Pr", m.roughness_map, true);
      return;
    }
    add("Ns", fmt::format("{}", exponent_of(m.roughness)));
    add("Ks", numbers_text(0.5f * m.specular * m.specular_color));
    add("illum", m.unlit ? "0" : m.specular > 0.0f ? "2" : "1");
  }

  void add_sheen(const ModelMaterial& m) {
    const float sheen = m.sheen * std::max({m.sheen_color.x, m.sheen_color.y, m.sheen_color.z});
    if (sheen <= 0.0f) return;
    if (m.sheen_color != glm::vec3(m.sheen_color.x) || m.sheen_roughness != kMtlSheenRoughness)
      warn(fmt::format("OBJ stores sheen as one number; it is written as white sheen of roughness {}", kMtlSheenRoughness));
    add("Ps", fmt::format("{}", sheen));
    add_map("map_Ps", m.sheen_map, true);
  }

  const Model& model_;
  const std::vector<std::string>& image_names_;
  double diagonal_;
  std::vector<std::string>& warnings_;
  std::string text_;
};

}  // namespace

float srgb_from_linear(float value) {
  const float linear = std::clamp(value, 0.0f, 1.0f);
  const auto above = std::upper_bound(kSrgbToLinear.begin(), kSrgbToLinear.end(), linear);
  const std::size_t low = std::min<std::size_t>(static_cast<std::size_t>(above - kSrgbToLinear.begin()) - 1, 254);
  const float fraction = (linear - kSrgbToLinear[low]) / (kSrgbToLinear[low + 1] - kSrgbToLinear[low]);
  return (static_cast<float>(low) + fraction) / 255.0f;
}

std::string mtl_text(const Model& model, const std::vector<std::string>& material_names, const std::vector<std::string>& image_names,
                     double diagonal, std::vector<std::string>& warnings) {
  MtlWriter writer(model, image_names, diagonal, warnings);
  std::string text;
  for (std::size_t i = 0; i < model.materials.size(); ++i) text += writer.text(model.materials[i], material_names[i]);
  if (material_names.size() > model.materials.size()) text += writer.text({}, material_names.back());
  return text;
}

}  // namespace halfspace::HS_LANES
