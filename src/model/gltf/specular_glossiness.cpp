// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/specular_glossiness.h"

#include <algorithm>
#include <cmath>

namespace halfspace::HS_LANES {

namespace {

double brightness(const glm::dvec3& c) { return std::sqrt(0.299 * c.x * c.x + 0.587 * c.y * c.y + 0.114 * c.z * c.z); }

}  // namespace

MetallicColor metallic_color(const glm::dvec3& diffuse, const glm::dvec3& specular) {
  constexpr double kDielectric = kDielectricReflectance, kEpsilon = 1e-6;
  const double remaining = 1.0 - std::max({specular.x, specular.y, specular.z});
  const double s = brightness(specular);
  double metallic = 0.0;
  if (s >= kDielectric) {  // the positive solution of kDielectric·m² + b·m + c = 0
    const double b = brightness(diffuse) * remaining / (1.0 - kDielectric) + s - 2.0 * kDielectric, c = kDielectric - s;
    const double root = std::sqrt(std::max(b * b - 4.0 * kDielectric * c, 0.0));
    metallic = std::clamp((root - b) / (2.0 * kDielectric), 0.0, 1.0);
  }
  const glm::dvec3 from_diffuse = diffuse * (remaining / (1.0 - kDielectric) / std::max(1.0 - metallic, kEpsilon));
  const glm::dvec3 from_specular = (specular - kDielectric * (1.0 - metallic)) / std::max(metallic, kEpsilon);
  return {glm::clamp(glm::mix(from_diffuse, from_specular, metallic * metallic), 0.0, 1.0), metallic};
}

namespace {

// Returns the conversion that the image of a map results from, or null.
const SpecularGlossiness* conversion_of(const Model& model, const TextureUse& map) {
  if (map.texture < 0) return nullptr;
  const int image = model.textures[static_cast<std::size_t>(map.texture)].image;
  if (image < 0 || !model.images[static_cast<std::size_t>(image)].converted) return nullptr;
  return &*model.images[static_cast<std::size_t>(image)].converted;
}

}  // namespace

bool are_converted_together(const ModelImage& a, const ModelImage& b) {
  return a.converted && b.converted && a.converted->same_sources(*b.converted);
}

bool has_converted_maps(const Model& model, const ModelMaterial& material) {
  return conversion_of(model, material.base_color_map) != nullptr || conversion_of(model, material.roughness_map) != nullptr;
}

ModelMaterial without_converted_maps(const Model& model, ModelMaterial material) {
  const SpecularGlossiness* color = conversion_of(model, material.base_color_map);
  const SpecularGlossiness* roughness = conversion_of(model, material.roughness_map);
  if (color != nullptr) {
    const MetallicColor converted = metallic_color(glm::dvec3(color->diffuse), glm::dvec3(color->specular));
    material.base_color = glm::vec4(glm::vec3(converted.base), material.base_color.w);
    material.metallic = static_cast<float>(converted.metallic);
    material.base_color_map = material.metallic_map = {};
  }
  if (roughness != nullptr) {
    material.roughness = 1.0f - roughness->glossiness;
    material.roughness_map = {};
  }
  return material;
}

}  // namespace halfspace::HS_LANES
