// SPDX-License-Identifier: Apache-2.0
//
// The properties of each light type, as a table with one row per type. light_at() in shading/light/lighting.h computes the light.
#pragma once

#include <array>
#include <string_view>

#include "halfspace/scene/keys.h"
#include "halfspace/shading/values/light_types.h"

namespace halfspace::HS_LANES {

inline constexpr std::size_t kLightTypes = 3;

/// The names of the types, in the order of the table.
template <>
struct ChoiceNames<LightType> {
  static const std::array<std::string_view, kLightTypes> names;
};

/// One row of the table.
struct LightKind {
  LightType type;
  std::string_view name;
  std::string_view keys;  ///< keys of LightDescription that only some types have, separated by spaces
  bool is_distant;        ///< infinitely far away, so it has no position, and its size is an angle
  bool has_cone;          ///< shines only in the directions between LightDescription::inner and outer
};

/// Returns the table entry of a light type.
const LightKind& kind_of(LightType type);

/// Returns the names of the light types that support the given key, separated by spaces, as Limits::only requires. The string lives until
/// the program ends.
const char* lights_with(std::string_view key);

}  // namespace halfspace::HS_LANES
