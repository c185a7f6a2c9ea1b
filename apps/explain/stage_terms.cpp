// SPDX-License-Identifier: Apache-2.0
#include "explain/stage_terms.h"

#include <fmt/format.h>

#include "halfspace/render/frame/frame.h"

namespace halfspace {

namespace {

template <class S>
inline constexpr bool kIsUnlitSurface = false;
template <bool mapped, NormalDetail detail, bool highlight>
inline constexpr bool kIsUnlitSurface<SurfaceShader<ShadingRate::none, mapped, detail, highlight>> = true;

// Sets the uniforms of all other terms to zero.
struct TermFilter {
  const LightTerm& term;
  std::span<const Light> lights;  // the light of the term, or none

  bool is(TermKind kind) const { return term.kind == kind; }

  template <class S>
  requires std::derived_from<S, LitSurface>
  void operator()(S& s) const {
    const Factor none{glm::vec3(0.0f), nullptr, {}};
    s.lights = lights;
    if (!is(TermKind::ambient)) s.factors[kAmbient] = none;
    if (!is(TermKind::emitted)) s.factors[kEmissive] = none;
    if (!is(TermKind::reflected)) s.reflected_environment = nullptr;
    if (kIsUnlitSurface<S> && !is(TermKind::emitted)) s.factors[kColor] = none;
  }
  template <class S>
  requires std::derived_from<S, MetallicMaterial>
  void operator()(S& s) const {
    s.lights = lights;
    if (s.unlit) black_unless(TermKind::emitted, s.base_color);
    if (!is(TermKind::ambient)) s.ambient = glm::vec3(0.0f);
    if (!is(TermKind::emitted)) s.emissive = glm::vec3(0.0f);
    if (!is(TermKind::reflected)) s.environment = nullptr;
  }
  template <bool exact>
  void operator()(SphereImpostor<exact>& s) const {
    s.lights = lights;
    if (!is(TermKind::ambient)) s.ambient = glm::vec3(0.0f);
    if (!is(TermKind::emitted)) s.emissive = glm::vec3(0.0f);
  }
  void operator()(ColoredPrimitives& s) const { black_unless(TermKind::emitted, s.color); }
  void operator()(NormalLines& s) const { black_unless(TermKind::emitted, s.color); }
  void operator()(ShadowCatcher&) const {}  // only darkens what is behind it
  void operator()(StarSky&) const {}
  void operator()(EnvironmentSky&) const {}

  void black_unless(TermKind kind, glm::vec4& color) const {
    if (!is(kind)) color = glm::vec4(0.0f, 0.0f, 0.0f, color.w);
  }
};

bool is_background(const PreparedDraw& draw) { return draw.source.object < 0; }

struct TermsOfShader {
  bool ambient = false, emitted = false, reflected = false, specular = false;

  template <class S>
  requires std::derived_from<S, LitSurface>
  void operator()(const S& s) {
    ambient |= s.factors[kAmbient].constant != glm::vec3(0.0f) && !kIsUnlitSurface<S>;
    emitted |= s.factors[kEmissive].constant != glm::vec3(0.0f) || kIsUnlitSurface<S>;
    reflected |= s.reflected_environment != nullptr;
    specular |= s.factors[kSpecular].constant != glm::vec3(0.0f) && s.model != LightModel::lambert && !kIsUnlitSurface<S>;
  }
  template <class S>
  requires std::derived_from<S, MetallicMaterial>
  void operator()(const S& s) {
    ambient |= s.ambient != glm::vec3(0.0f);
    emitted |= s.emissive != glm::vec3(0.0f) || s.unlit;
    reflected |= s.environment != nullptr;
    specular |= !s.unlit;
  }
  template <bool exact>
  void operator()(const SphereImpostor<exact>& s) {
    ambient |= s.ambient != glm::vec3(0.0f);
    emitted |= s.emissive != glm::vec3(0.0f);
    specular |= s.specular != glm::vec3(0.0f) && s.model != LightModel::lambert;
  }
  void operator()(const ColoredPrimitives&) { emitted = true; }
  void operator()(const NormalLines&) { emitted = true; }
  void operator()(const ShadowCatcher&) {}
  void operator()(const StarSky&) {}
  void operator()(const EnvironmentSky&) {}
};

}  // namespace

std::vector<LightTerm> light_terms(const PreparedScene& scene) {
  TermsOfShader has;
  for (const PreparedDraw& draw : scene.draws) std::visit(has, draw.shader);
  std::vector<LightTerm> terms;
  if (has.ambient) terms.push_back({TermKind::ambient, -1, "ambient"});
  for (int i = 0; i < static_cast<int>(scene.lights.size()); ++i) {
    const std::string& name = scene.lights[static_cast<std::size_t>(i)].name;
    terms.push_back({TermKind::diffuse, i, fmt::format("diffuse, {}", name)});
    if (has.specular) terms.push_back({TermKind::specular, i, fmt::format("specular, {}", name)});
  }
  if (has.reflected) terms.push_back({TermKind::reflected, -1, "environment"});
  if (has.emitted) terms.push_back({TermKind::emitted, -1, "emitted"});
  terms.push_back({TermKind::background, -1, "background"});
  return terms;
}

Image<glm::vec4> render_term(const PreparedScene& scene, const LightTerm& term, TermShadow shadow, const Workers& workers) {
  std::vector<Light> lights;
  if (term.light >= 0) {
    Light& light = lights.emplace_back(scene.lights[static_cast<std::size_t>(term.light)].light);
    if (term.kind != TermKind::diffuse) light.diffuse = glm::vec3(0.0f);
    if (term.kind != TermKind::specular) light.specular = glm::vec3(0.0f);
    if (shadow == TermShadow::without) light.shadow = nullptr;
  }
  PreparedScene part = scene;
  const TermFilter filter{term, lights};
  for (PreparedDraw& draw : part.draws) std::visit(filter, draw.shader);
  if (term.kind != TermKind::background) {
    part.clear_color = glm::vec4(0.0f, 0.0f, 0.0f, part.clear_color.w);
    std::erase_if(part.draws, is_background);
  }
  Image<glm::vec4> light(scene.view.width_px, scene.view.height_px);
  render(part, light, workers);
  return light;
}

}  // namespace halfspace
