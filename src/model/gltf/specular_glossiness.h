// SPDX-License-Identifier: Apache-2.0
//
// Conversion from specular-glossiness to metallic-roughness, as in the appendix of KHR_materials_pbrSpecularGlossiness.
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/namespace.h"
#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Reflectance at normal incidence of the dielectrics of the metallic-roughness model.
inline constexpr double kDielectricReflectance = 0.04;

/// A base color and how metallic it is.
struct MetallicColor {
  glm::dvec3 base;
  double metallic;
};

/// Converts linear colors from 0 to 1. The metallic factor is chosen so that the mixture of a metal with a dielectric of reflectance 0.04
/// has the same brightness as the specular color. The roughness is 1 minus the glossiness.
MetallicColor metallic_color(const glm::dvec3& diffuse, const glm::dvec3& specular);

/// Returns true if both images are results of the same conversion.
bool are_converted_together(const ModelImage& a, const ModelImage& b);

/// Returns true if the base color or the roughness of a material has a map whose image is converted.
bool has_converted_maps(const Model& model, const ModelMaterial& material);

/// Returns the material for meshes that cannot be textured: maps whose images are converted are replaced by the conversion of their
/// factors. These are part of the images, so the factors of the material itself are 1.
ModelMaterial without_converted_maps(const Model& model, ModelMaterial material);

}  // namespace halfspace::HS_LANES
