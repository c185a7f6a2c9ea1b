// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "halfspace/shading/contract.h"
#include "halfspace/shading/texture/map_row.h"
#include "halfspace/shading/texture/tiles_on_demand.h"
#include "workloads/workload_shading.h"

namespace halfspace {

/// Width and height of the shadow maps of the workloads.
inline constexpr int kShadowMapSize = 2048;

/// A shadow map of kShadowMapSize² window depths, top row first.
struct WorkloadShadowMap {
  const float* depths;
  const TilesOnDemand* tiles;  ///< null if all tiles are drawn
};

/// Returns the fraction of the 3 x 3 shadow-map texels around a point that do not occlude it.
template <class R>
HS_INLINE R unoccluded_fraction(const WorkloadShadowMap& map, const glm::mat4& light_from_world, float bias, const vec3<R>& position_ws) {
  constexpr float kHalf = 0.5f * kShadowMapSize;
  const vec4<R> q = light_from_world * vec4<R>(position_ws, R(1));
  const R scale(kHalf), inverse = R(1) / q.w;
  // Lanes without a pixel can have any coordinates. Beyond the map, all texels are those of its edge.
  const auto texel = [&](R ndc) {
    return min(max(truncate_to_int(floor(ndc * inverse * scale + scale)), IntOf<R>(-2)), IntOf<R>(kShadowMapSize + 1));
  };
  const IntOf<R> i = texel(q.x), j = texel(q.y);
  const R depth = R(0.5f) * (q.z * inverse) + R(0.5f - bias);
  const IntOf<R> first(0), last(kShadowMapSize - 1);
  if (map.tiles != nullptr) map.tiles->require(IntOf<R>(i - 1), IntOf<R>(j - 1), IntOf<R>(i + 2), IntOf<R>(j + 1));  // map_row reads four
  R sum(0);
  for (int dj = -1; dj <= 1; ++dj) {
    const IntOf<R> row = last - min(max(IntOf<R>(j + dj), first), last);
    for (const R& nearest : map_row<3, R>(map.depths, kShadowMapSize, i - 1, row)) sum += select(depth <= nearest, R(1), R(0));
  }
  return sum * R(1.0f / 9.0f);
}

/// Blinn-Phong lighting from one direction, shadowed by the mean of 3 x 3 comparisons with a depth map. The workload prescribes this filter
/// and bias, so this code reads the map itself instead of using shading/shadow/shadow.h, whose filters do more.
struct ShadowedShader {
  glm::mat4 clip_from_world, light_from_world;
  WorkloadShadowMap map;
  glm::vec3 eye_ws, to_light_ws;
  glm::vec3 base;

  static constexpr float kBias = 0.004f;

  template <class R>
  struct Attributes {
    vec3<R> position_ws, normal_ws;
  };
  template <class R>
  struct Varyings {
    vec3<R> position_ws, normal_ws;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.position_ws = in.position_ws;
    out.normal_ws = in.normal_ws;
    return clip_from_world * vec4<R>(in.position_ws, R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    const WorkloadLight<R> light = blinn_phong(in.normal_ws, vec3<R>(to_light_ws), unit(eye_ws - in.position_ws));
    const R seen = unoccluded_fraction(map, light_from_world, kBias, in.position_ws), ambient(0.08f);
    return {lit(vec3<R>(base), WorkloadLight<R>{ambient + seen * (light.diffuse - ambient), seen * light.specular})};
  }
};

}  // namespace halfspace
