// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/lights.h"

#include "halfspace/scene/kind_table.h"

namespace halfspace::HS_LANES {

namespace {

constexpr LightKind kKinds[]{
    {.type = LightType::directional, .name = "directional", .keys = "direction", .is_distant = true, .has_cone = false},
    {.type = LightType::point, .name = "point", .keys = "position falloff attenuation range", .is_distant = false, .has_cone = false},
    {.type = LightType::spot,
     .name = "spot",
     .keys = "direction position falloff attenuation range inner outer",
     .is_distant = false,
     .has_cone = true},
};
static_assert(std::size(kKinds) == kLightTypes && is_in_order(kKinds, &LightKind::type));

}  // namespace

constinit const std::array<std::string_view, kLightTypes> ChoiceNames<LightType>::names = names_of(kKinds);

const LightKind& kind_of(LightType type) { return kKinds[static_cast<std::size_t>(type)]; }

const char* lights_with(std::string_view key) { return names_with(kKinds, key); }

}  // namespace halfspace::HS_LANES
