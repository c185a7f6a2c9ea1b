// SPDX-License-Identifier: Apache-2.0
#include "explain/stage_shadow.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "halfspace/shading/light/lighting.h"
#include "halfspace/shading/shadow/shadow_bias.h"
#include "halfspace/shading/shadow/shadow_filter.h"
#include "halfspace/shading/shadow/shadow_view.h"
#include "halfspace/shading/shadow/terminator.h"

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

// Returns whether a filter is a weighted sum of the results of lit_by_texel, all of which a lookup shows.
bool is_weighted_sum(const ShadowSettings& s) {
  const bool compares = s.filter != ShadowFilter::pcss && s.filter != ShadowFilter::vsm && s.filter != ShadowFilter::moments;
  return compares && filter_reach(s) <= kShadowReach + 0.5f;
}

// Returns the weights of the texels around (i, j). The weight of a texel is what the renderer's filter returns if only this texel is lit.
// The filter therefore looks p up in small maps, in which one texel is empty and all others are nearer to the light than any point.
std::vector<float> filter_weights(const ShadowView& view, const ShadowSettings& s, ShadowCoordinates<float> p,
                                  const ShadowReceiver<float>& at, int i, int j) {
  std::vector<float> depth(kShadowSide * kShadowSide, std::numeric_limits<float>::infinity()), weights;
  ShadowView map = view;
  map.size = kShadowSide;
  map.depth = depth.data();
  map.block_depths = nullptr;
  p.x -= static_cast<float>(i - kShadowReach);  // exact, except near the left and lower borders of the map, where p grows and is rounded
  p.y -= static_cast<float>(j - kShadowReach);
  for (int row = kShadowSide - 1; row >= 0; --row) {  // rows are stored from the top
    for (int column = 0; column < kShadowSide; ++column) {
      float& texel = depth[static_cast<std::size_t>(row * kShadowSide + column)];
      texel = 0.0f;
      weights.push_back(filtered_shadow(map, s, p, at));
      texel = std::numeric_limits<float>::infinity();
    }
  }
  return weights;
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
  out.terminator = terminator_fraction(dot(smooth_normal(at), l_ws), dot(at.shading_normal_ws, l_ws));
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
    out.filtered = filtered_shadow(view, shadow.settings, p, at);
    if (is_weighted_sum(shadow.settings)) out.weights = filter_weights(view, shadow.settings, p, at, out.i, out.j);
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
