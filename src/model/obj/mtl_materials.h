// SPDX-License-Identifier: Apache-2.0
//
// Converts MTL materials to metallic-roughness materials.
//
// * Kd is the base color and Ke the emissive color. Both are sRGB-encoded, because most programs display these numbers without conversion.
//   If Ke exceeds 1, its largest component is a linear intensity, and Ke divided by it is the color.
// * A color or factor of 0 that has a texture counts as 1, and as 0.8 gray for Kd if the texture is missing.
// * Opacity is d or, without d, 1 − Tr. Tr = 1 without d is treated as opaque, because programs disagree about its meaning. Opacity below 1
//   selects AlphaMode::blend. A map_d selects AlphaMode::mask and mask_unless_soft if the opacity is 1. If map_d is the image of map_Kd,
//   its alpha channel is used.
// * Ns is the exponent of a Blinn-Phong highlight: roughness² = sqrt(2/(Ns + 2)) gives the GGX distribution the same width. Without Ns,
//   roughness is 0.6. map_Ns is a roughness map, as Blender writes it.
// * Ks scales the reflectance at normal incidence: F0 = 0.08 Ks for Ni = 1.5 or no Ni, so that the usual 0.5 gives the 4% of common
//   dielectrics, and 1 does not give a mirror. This is also Blender's rule. Without Ks it is 0.5. Ni outside [1.1, 4] is ignored, because
//   many programs always write 1. The luminance of map_Ks scales F0.
// * illum 0 is unlit and illum 1 has no specular reflection. With illum 3, 5 or 8 (mirrors), a Ks brighter than Kd makes a metal of color
//   Ks.
// * Pr, Pm, Pc and Pcr are used directly. Ps scales white sheen of roughness 0.5. Pr overrides Ns. With Pr or Pm, F0 is computed from Ni,
//   and Ks and illum are ignored.
// * bump and map_bump: the value 1 is a height of 1% of the diagonal of the model's bounds, multiplied by the option -bm.
// * Materials are double-sided, because the winding of OBJ files is unreliable.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "halfspace/model/obj/read_mtl.h"
#include "halfspace/model/text/references.h"

namespace halfspace::HS_LANES {

struct Model;
struct ModelMaterial;
struct ReadModelOptions;
struct TextureUse;

/// Height of the value 1 in a bump map without the option -bm, as a fraction of the diagonal of the model's bounds.
inline constexpr double kMtlBumpHeight = 0.01;

/// Roughness of sheen, for which MTL has no statement.
inline constexpr float kMtlSheenRoughness = 0.5f;

/// Converts materials and adds their images and textures to a model. Adds one warning for each missing image.
class MtlConverter {
 public:
  /// diagonal: length of the diagonal of the model's bounds. `model` must outlive this object.
  MtlConverter(Model& model, const std::filesystem::path& file, const ReadModelOptions& options, double diagonal);

  ModelMaterial convert(const MtlMaterial& mtl);

 private:
  int image(const MtlMaterial& mtl, MtlMap which);
  TextureUse texture(const MtlMaterial& mtl, MtlMap which);
  void convert_opacity(const MtlMaterial& mtl, ModelMaterial& material);
  void convert_reflection(const MtlMaterial& mtl, ModelMaterial& material);
  void convert_relief(const MtlMaterial& mtl, ModelMaterial& material);

  Model& model_;
  References references_;
  std::vector<std::string> quiet_warnings_;
  References quiet_;  // writes to quiet_warnings_, which nothing reads
  double diagonal_;
  std::map<std::string, int> images_;  // key: folder and name; -1 if missing
};

}  // namespace halfspace::HS_LANES
