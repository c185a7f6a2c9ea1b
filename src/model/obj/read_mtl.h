// SPDX-License-Identifier: Apache-2.0
//
// Parses Wavefront MTL files, the material libraries of OBJ files, including the PBR extension of Exocortex (Pr, Pm, Pc, norm, ...).
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// The textures of a material, named after their statements. `bump` is a height map and `norm` a normal map.
enum class MtlMap : uint8_t { Kd, Ks, Ns, Ke, d, bump, norm, Pr, Pm, Ps, Pc, Pcr };
inline constexpr std::size_t kMtlMaps = 12;

/// The arguments of a texture statement.
struct MtlTexture {
  std::string file;                     ///< file name as written, without quotation marks; empty if there is no texture
  glm::vec2 scale{1.0f}, offset{0.0f};  ///< options -s and -o: uv' = scale · uv + offset, where v = 0 is the bottom of the image
  bool clamp = false;                   ///< option -clamp
  float bump_multiplier = 1.0f;         ///< option -bm
  char channel = 0;                     ///< option -imfchan: r, g, b, m (matte), l (luminance) or z; 0: not given
};

/// A material as written. Numbers that the file does not give are empty.
struct MtlMaterial {
  std::string name;
  std::string folder;  ///< folder of the library, relative to the folder of the model; empty if they are the same. Set by the caller.
  std::optional<glm::vec3> Kd, Ks, Ke;
  std::optional<float> Ns, d, Tr, Ni, Pr, Pm, Ps, Pc, Pcr;
  std::optional<int> illum;
  std::array<MtlTexture, kMtlMaps> maps;

  const MtlTexture& map(MtlMap which) const { return maps[static_cast<std::size_t>(which)]; }
};

/// Parses a material library. `name` is only used in warnings. Never fails: a statement that cannot be used is skipped, with one warning
/// per kind. Keywords are not case-sensitive. At most kMaxMtlMaterials materials are read.
std::vector<MtlMaterial> parse_mtl(std::string_view name, std::string_view text, std::vector<std::string>& warnings);
inline constexpr std::size_t kMaxMtlMaterials = 65536;

}  // namespace halfspace::HS_LANES
