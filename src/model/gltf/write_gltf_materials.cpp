// SPDX-License-Identifier: Apache-2.0
//
// Textures and materials of glTF files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "halfspace/core/trig_double.h"
#include "halfspace/model/gltf/gltf_output.h"
#include "halfspace/model/used_images.h"
#include "halfspace/model/written_model.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int kGlNearest = 9728, kGlLinear = 9729;
constexpr int kGlRepeat = 10497, kGlClampToEdge = 33071, kGlMirroredRepeat = 33648;

int gl_wrap(Wrap wrap, GltfOutput& out) {
  switch (wrap) {
    case Wrap::repeat: return kGlRepeat;
    case Wrap::mirrored: return kGlMirroredRepeat;
    case Wrap::clamp: return kGlClampToEdge;
    case Wrap::border:
    case Wrap::mirrored_clamp: break;
  }
  out.warn("glTF cannot store border colors and mirroring at one edge; such textures are clamped to their edges");
  return kGlClampToEdge;
}

int gl_filter(Filter filter) {
  switch (filter) {
    case Filter::nearest: return kGlNearest;
    case Filter::bilinear: return kGlLinear;
    case Filter::nearest_mipmap_nearest: return 9984;
    case Filter::bilinear_mipmap_nearest: return 9985;
    case Filter::nearest_mipmap_linear: return 9986;
    case Filter::trilinear: break;
  }
  return 9987;
}

OutputJson sampler_json(const Sampler& s, GltfOutput& out) {
  return {{"magFilter", reads_nearest_texel(s.mag) ? kGlNearest : kGlLinear},
          {"minFilter", gl_filter(s.min)},
          {"wrapS", gl_wrap(s.wrap_s, out)},
          {"wrapT", gl_wrap(s.wrap_t, out)}};
}

// Returns the index of a sampler in the document, and adds it if it is missing.
int sampler_index(const Sampler& sampler, GltfOutput& out) {
  OutputJson item = sampler_json(sampler, out);
  const int count = out.count("samplers");
  for (int i = 0; i < count; ++i) {
    if (out.json["samplers"][static_cast<std::size_t>(i)] == item) return i;
  }
  return out.add("samplers", std::move(item));
}

// Returns the angle with this cosine and sine. Newton's method starts from the nearest multiple of 90 degrees; each step cubes the error.
double angle_of(double cosine, double sine) {
  constexpr double kQuarter = std::numbers::pi / 2.0;
  double angle = std::fabs(cosine) >= std::fabs(sine) ? (cosine > 0.0 ? 0.0 : 2.0 * kQuarter) : (sine > 0.0 ? kQuarter : -kQuarter);
  for (int i = 0; i < 6; ++i) {
    const auto [s, c] = sincos_radians(angle);
    angle += sine * c - cosine * s;
  }
  return angle;
}

class MaterialWriter {
 public:
  MaterialWriter(const std::vector<int>& textures, GltfOutput& out) : textures_(textures), out_(out) {}

  void write(const ModelMaterial& m) {
    material_ = &m;
    OutputJson json;
    if (!m.name.empty()) json["name"] = m.name;
    json["pbrMetallicRoughness"] = metallic_roughness();
    add_texture(json, "normalTexture", m.normal_map);
    if (json.contains("normalTexture") && m.normal_scale != 1.0f) json["normalTexture"]["scale"] = m.normal_scale;
    add_texture(json, "occlusionTexture", m.occlusion_map, Channel::red);
    if (json.contains("occlusionTexture") && m.occlusion_strength != 1.0f) json["occlusionTexture"]["strength"] = m.occlusion_strength;
    add_emissive(json);
    if (m.alpha_mode != AlphaMode::opaque) json["alphaMode"] = m.alpha_mode == AlphaMode::mask ? "MASK" : "BLEND";
    if (m.alpha_mode == AlphaMode::mask && m.alpha_cutoff != 0.5f) json["alphaCutoff"] = m.alpha_cutoff;
    if (m.double_sided) json["doubleSided"] = true;
    add_specular(json);
    add_clearcoat(json);
    add_sheen(json);
    if (m.ior != 1.5f) out_.extend(json, "KHR_materials_ior", {{"ior", m.ior}});
    if (m.unlit) out_.extend(json, "KHR_materials_unlit", OutputJson::object());
    if (m.opacity_map.texture >= 0) omit("opacity map", "glTF stores opacity in the alpha channel of the base color");
    if (m.bump_map.texture >= 0 && m.normal_map.texture < 0) omit("bump map", "glTF supports only normal maps");
    out_.add("materials", std::move(json));
  }

 private:
  void omit(const char* map, const char* reason) {
    out_.warn(fmt::format("the {} of material '{}' is omitted: {}", map, material_->name, reason));
  }

  // Returns the index of a texture in the document, or -1.
  int index_of(const TextureUse& use) const { return use.texture < 0 ? -1 : textures_[static_cast<std::size_t>(use.texture)]; }
  bool has_image(const TextureUse& use) const { return index_of(use) >= 0; }

  // uv' = T · R · S · uv, with the rotation direction that the reader uses (gltf_textures.cpp).
  OutputJson transform_json(const glm::mat3x2& m) const {
    const glm::dvec2 u(m[0]), v(m[1]);
    const double length = std::sqrt(glm::dot(u, u));
    const double side = u.x * v.y - u.y * v.x, height = length > 0.0 ? side / length : std::sqrt(glm::dot(v, v));
    OutputJson json = OutputJson::object();
    if (m[2] != glm::vec2(0.0f)) json["offset"] = json_array(m[2]);
    const bool turned = m[0].y != 0.0f || m[0].x < 0.0f;
    if (turned) json["rotation"] = angle_of(u.x / length, -u.y / length);
    const glm::dvec2 scale = turned ? glm::dvec2(length, height) : glm::dvec2(u.x, v.y);
    if (scale != glm::dvec2(1.0)) json["scale"] = json_array(scale);
    return json;
  }

  void add_texture(OutputJson& object, const char* key, const TextureUse& use, std::optional<Channel> channel = std::nullopt) {
    if (!has_image(use)) return;
    if (channel && use.channel != *channel) return omit(key, "glTF does not permit its channel");
    OutputJson json = {{"index", index_of(use)}};
    if (use.uv_set != 0) json["texCoord"] = use.uv_set;
    if (use.uv_transform != glm::mat3x2(1.0f)) out_.extend(json, "KHR_texture_transform", transform_json(use.uv_transform));
    object[key] = std::move(json);
  }

  static bool same_place(const TextureUse& a, const TextureUse& b) {
    return a.texture == b.texture && a.uv_set == b.uv_set && a.uv_transform == b.uv_transform;
  }

  OutputJson metallic_roughness() {
    const ModelMaterial& m = *material_;
    OutputJson json = OutputJson::object();
    if (m.base_color != glm::vec4(1.0f)) json["baseColorFactor"] = json_array(m.base_color);
    add_texture(json, "baseColorTexture", m.base_color_map);
    if (m.metallic != 1.0f) json["metallicFactor"] = m.metallic;
    if (m.roughness != 1.0f) json["roughnessFactor"] = m.roughness;
    const bool metallic = has_image(m.metallic_map), roughness = has_image(m.roughness_map);
    const bool fits = metallic && roughness ? same_place(m.metallic_map, m.roughness_map) && m.metallic_map.channel == Channel::blue
                                            : !metallic && m.metallic == 0.0f;
    if (roughness && fits) {
      add_texture(json, "metallicRoughnessTexture", m.roughness_map, Channel::green);
    } else if (metallic || roughness) {
      omit("metallic or roughness map", "glTF stores both in the blue and green channels of one image");
    }
    return json;
  }

  // Emission above 1 requires an extension. The strength is a power of two, which keeps the product exact.
  void add_emissive(OutputJson& json) {
    const glm::vec3 e = material_->emissive;
    add_texture(json, "emissiveTexture", material_->emissive_map);
    const float largest = std::max({e.x, e.y, e.z});
    if (largest <= 0.0f) return;
    int exponent = 0;
    std::frexp(largest, &exponent);
    const float strength = largest > 1.0f ? std::ldexp(1.0f, exponent) : 1.0f;
    json["emissiveFactor"] = json_array(e / strength);
    if (strength != 1.0f) out_.extend(json, "KHR_materials_emissive_strength", {{"emissiveStrength", strength}});
  }

  void add_specular(OutputJson& json) {
    const ModelMaterial& m = *material_;
    OutputJson specular = OutputJson::object();
    if (m.specular != 1.0f) specular["specularFactor"] = m.specular;
    add_texture(specular, "specularTexture", m.specular_map, Channel::alpha);
    if (m.specular_color != glm::vec3(1.0f)) specular["specularColorFactor"] = json_array(m.specular_color);
    add_texture(specular, "specularColorTexture", m.specular_color_map);
    if (!specular.empty()) out_.extend(json, "KHR_materials_specular", std::move(specular));
  }

  void add_clearcoat(OutputJson& json) {
    const ModelMaterial& m = *material_;
    if (m.clearcoat == 0.0f || m.unlit) return;
    OutputJson coat = {{"clearcoatFactor", m.clearcoat}};
    add_texture(coat, "clearcoatTexture", m.clearcoat_map, Channel::red);
    if (m.clearcoat_roughness != 0.0f) coat["clearcoatRoughnessFactor"] = m.clearcoat_roughness;
    add_texture(coat, "clearcoatRoughnessTexture", m.clearcoat_roughness_map, Channel::green);
    add_texture(coat, "clearcoatNormalTexture", m.clearcoat_normal_map);
    if (coat.contains("clearcoatNormalTexture") && m.clearcoat_normal_scale != 1.0f)
      coat["clearcoatNormalTexture"]["scale"] = m.clearcoat_normal_scale;
    out_.extend(json, "KHR_materials_clearcoat", std::move(coat));
  }

  void add_sheen(OutputJson& json) {
    const ModelMaterial& m = *material_;
    if (m.sheen == 0.0f || m.unlit) return;
    OutputJson sheen = {{"sheenColorFactor", json_array(m.sheen * m.sheen_color)}};
    if (has_image(m.sheen_map)) omit("sheen map", "glTF stores sheen as a color");
    add_texture(sheen, "sheenColorTexture", m.sheen_color_map);
    if (m.sheen_roughness != 0.0f) sheen["sheenRoughnessFactor"] = m.sheen_roughness;
    add_texture(sheen, "sheenRoughnessTexture", m.sheen_roughness_map, Channel::alpha);
    out_.extend(json, "KHR_materials_sheen", std::move(sheen));
  }

  const std::vector<int>& textures_;
  GltfOutput& out_;
  const ModelMaterial* material_ = nullptr;
};

}  // namespace

GltfTextureOutput write_gltf_textures(const Model& model, const std::string& stem, bool embed, GltfOutput& out) {
  GltfTextureOutput written;
  std::vector<int> indices(model.images.size(), -1);  // in the document
  const std::vector<bool> used = used_images(model);
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    const ModelImage& image = model.images[i];
    const std::string extension = image.bytes ? image_extension(*image.bytes) : "";
    if (extension.empty()) {
      if (used[i]) out.warn(fmt::format("image '{}' is omitted; expected PNG or JPEG", image.name));
      continue;
    }
    OutputJson json;
    if (!image.name.empty()) json["name"] = image.name;
    if (embed) {
      json["mimeType"] = extension == ".png" ? "image/png" : "image/jpeg";
      json["bufferView"] = out.view(*image.bytes);
    } else {
      written.files.push_back({fmt::format("{}_image{}{}", stem, i, extension), static_cast<int>(i)});
      json["uri"] = percent_encoded(written.files.back().name);
    }
    indices[i] = out.add("images", std::move(json));
  }
  for (const ModelTexture& texture : model.textures) {
    const int image = texture.image < 0 ? -1 : indices[static_cast<std::size_t>(texture.image)];
    written.textures.push_back(image < 0 ? -1 : out.add("textures", {{"sampler", sampler_index(texture.sampler, out)}, {"source", image}}));
  }
  return written;
}

void write_gltf_materials(const Model& model, const std::vector<int>& textures, GltfOutput& out) {
  MaterialWriter writer(textures, out);
  for (const ModelMaterial& material : model.materials) writer.write(material);
}

}  // namespace halfspace::HS_LANES
