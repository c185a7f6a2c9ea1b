// SPDX-License-Identifier: Apache-2.0
#include "explain/stage_shadow.h"

#include <algorithm>
#include <cmath>

#include "halfspace/shading/light/lighting.h"
#include "halfspace/shading/shadow/shadow_bias.h"
#include "halfspace/shading/shadow/shadow_view.h"

namespace halfspace {

namespace {

void look_around(const ShadowView& view, const ShadowCoordinates<float>& p, ShadowLookup& out) {
  std::size_t n = 0;
  for (int dj = -kShadowReach; dj <= kShadowReach; ++dj) {
    for (int di = -kShadowReach; di <= kShadowReach; ++di, ++n) {
      out.texels[n] = map_depth<float>(view, out.i + di, out.j + dj);
      out.lit[n] = lit_by_texel<float>(view, p, out.i + di, out.j + dj);
    }
  }
}

}  // namespace

ShadowLookup shadow_lookup(const Light& light, const glm::vec3& position_rws, const glm::vec3& face_ws, const glm::vec3& normal_ws,
                           const glm::vec2& window, const SmoothSurface& smooth) {
  const Shadow& shadow = *light.shadow;
  ShadowLookup out;
  const vec3<float> l_ws = light_at<float>(light, vec3<float>(position_rws)).l_ws;
  out.position_rws = position_rws;
  out.normal_ws = normal_ws;
  out.to_light_ws = {l_ws.x, l_ws.y, l_ws.z};
  const ShadowReceiver<float> at{vec3<float>(position_rws),     vec3<float>(face_ws), vec3<float>(normal_ws), l_ws, window.x, window.y,
                                 vec3<float>(smooth.normal_ws), smooth.height};
  out.factor = shadow_factor(shadow, at);
  for (std::size_t v = 0; v < shadow.views.size(); ++v) {
    const ShadowView& view = shadow.views[v];
    const ShadowCoordinates<float> p = biased_coordinates(view, shadow.settings, at);
    if (!holds(view, p, filter_reach(shadow.settings))) continue;
    out.view = static_cast<int>(v);
    out.x = p.x;
    out.y = p.y;
    out.biased = p.depth;
    out.depth = shadow_coordinates(view, at.position_rws).depth;
    out.depth_dx = p.depth_dx;
    out.depth_dy = p.depth_dy;
    out.i = static_cast<int>(std::floor(p.x));
    out.j = static_cast<int>(std::floor(p.y));
    look_around(view, p, out);
    break;
  }
  return out;
}

Image<glm::u8vec4> shadow_map_picture(const ShadowView& view, int size) {
  const int step = std::max(1, view.size / size), side = view.size / step;
  float low = 1.0f, high = 0.0f;
  const auto depth_at = [&](int x, int y) {
    return view.depth[static_cast<std::size_t>(y * step) * static_cast<std::size_t>(view.size) + static_cast<std::size_t>(x * step)];
  };
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (const float d = depth_at(x, y); d > 0.0f) {
        low = std::min(low, d);
        high = std::max(high, d);
      }
    }
  }
  Image<glm::u8vec4> picture(side, side);
  const float scale = high > low ? 215.0f / (high - low) : 0.0f;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const float d = depth_at(x, y);
      const auto code = static_cast<uint8_t>(d > 0.0f ? 40.0f + (d - low) * scale : 0.0f);
      picture.at(x, y) = {code, code, code, 255};
    }
  }
  return picture;
}

}  // namespace halfspace
