// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/frame/unlit_layer.h"

#include <algorithm>
#include <concepts>
#include <iterator>
#include <type_traits>

namespace halfspace::HS_LANES {

namespace {

template <class S>
inline constexpr bool kIsUnlitSurface =
    std::is_same_v<S, SurfaceShader<ShadingRate::none, false>> || std::is_same_v<S, SurfaceShader<ShadingRate::none, true>>;

bool is_unlit(const PreparedDraw& draw) {
  return std::visit(
      []<class S>(const S& shader) {
        if constexpr (std::derived_from<S, MetallicMaterial>) return shader.unlit;
        return kIsUnlitSurface<S> || std::is_same_v<S, ColoredPrimitives>;
      },
      draw.shader);
}

bool is_sky(const PreparedDraw& draw) {
  return std::holds_alternative<StarSky>(draw.shader) || std::holds_alternative<EnvironmentSky>(draw.shader);
}

// Draws that multiply what is behind them by 1 minus their alpha, or by 0.
constexpr BlendState kAttenuate{.source_color = BlendFactor::zero, .source_alpha = BlendFactor::zero};
constexpr BlendState kErase{.source_color = BlendFactor::zero,
                            .destination_color = BlendFactor::zero,
                            .source_alpha = BlendFactor::zero,
                            .destination_alpha = BlendFactor::zero};

// Removes everything that only affects the color. Opacity remains.
void make_black(MetallicMaterial& m) {
  m.unlit = true;
  m.emissive = glm::vec3(0.0f);
  m.base_color = glm::vec4(0, 0, 0, m.base_color.w);
  for (std::size_t i = 0; i < kMetallicMaps; ++i) {
    if (i != kBaseColorMap && i != kOpacityMap) m.maps[i].map = nullptr;
  }
}
void make_black(LitSurface& s) {
  s.factors.fill({.constant = glm::vec3(0.0f)});
  s.reflected_environment = nullptr;
  s.lights = {};
}
void make_black(SphereImpostors& s) { s.lights = {}; }
void make_black(ShadowCatcher&) {}  // its alpha depends on the lights

// Returns the draw of a lit surface that only hides what is behind it.
PreparedDraw hiding(PreparedDraw draw) {
  std::visit(
      [](auto& shader) {
        if constexpr (requires { make_black(shader); }) make_black(shader);
      },
      draw.shader);
  draw.state.blend = draw.state.order_independent ? kAttenuate : kErase;
  draw.state.order_independent = false;
  return draw;
}

bool converts_light(const PostDescription& post) {
  return post.hdr && (post.tone != ToneCurve::none || post.auto_exposure || post.exposure != 1.0);
}

}  // namespace

bool separates_unlit(const PreparedScene& scene) {
  return converts_light(scene.post) && !scene.post.tone_unlit && std::ranges::any_of(scene.draws, is_unlit);
}

std::vector<PreparedDraw> unlit_layer(const PreparedScene& scene) {
  std::vector<PreparedDraw> opaque, blended, attenuating;
  for (const PreparedDraw& draw : scene.draws) {
    if (is_sky(draw)) continue;  // it is behind everything else
    if (!draw.state.order_independent) {
      opaque.push_back(is_unlit(draw) ? draw : hiding(draw));
    } else {
      is_unlit(draw) ? blended.push_back(draw) : attenuating.push_back(hiding(draw));
    }
  }
  std::ranges::move(blended, std::back_inserter(opaque));
  std::ranges::move(attenuating, std::back_inserter(opaque));
  return opaque;
}

}  // namespace halfspace::HS_LANES
