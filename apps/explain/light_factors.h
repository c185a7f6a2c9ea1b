// SPDX-License-Identifier: Apache-2.0
//
// Splits the terms of a fragment's lights into factors, such as n·l and the surface color. Each factor is the shader's result with other
// factors set to 1 or 0, so it is computed by the shader's own code.
#pragma once

#include <fmt/format.h>

#include <algorithm>

#include "explain/fragment_evaluator.h"

namespace halfspace {

/// Finds the factors of a fragment.
template <class S>
class LightFactorFinder {
 public:
  LightFactorFinder(const S& shader, const FragmentEvaluator<S>& fragment, std::span<const std::string> light_names)
      : shader_(shader), fragment_(fragment), light_names_(light_names) {}

  LightingDetail find() const {
    if constexpr (requires { shader_.factors; }) {
      if constexpr (S::kByVertex || S::kByPixel || HasPrimitive<S>) return surface();
    } else if constexpr (requires { shader_.metallic; }) {
      if (!shader_.unlit) return metallic();
    } else if constexpr (requires { shader_.point_scale; }) {
      return sphere();
    }
    return {};
  }

 private:
  template <class F>
  glm::vec3 color(const S& from, const F& change) const {
    S changed = from;
    change(changed);
    return glm::vec3(fragment_.color_with(changed));
  }

  // Returns the color with one light.
  glm::vec3 lit(const S& from, const Light& light) const {
    return color(from, [&](S& s) { s.lights = std::span(&light, 1); });
  }

  // Returns a light without its shadow that gives the strength times n·l, or the strength of the highlight.
  static Light unit_light(const Light& light, float diffuse, float specular) {
    Light out = light;
    out.diffuse = glm::vec3(diffuse);
    out.specular = glm::vec3(specular);
    out.shadow = nullptr;
    return out;
  }

  static float largest(const glm::vec3& v) { return std::max(v.x, std::max(v.y, v.z)); }
  static float ratio(float a, float b) { return b > 0.0f ? a / b : 0.0f; }

  // black: the shader without any term. white: the same, with a white surface. shiny: the same, with a white highlight.
  void add_lights(LightingDetail& out, const S& black, const S& white, float white_color, const S& shiny) const {
    for (std::size_t i = 0; i < shader_.lights.size(); ++i) {
      const Light& light = shader_.lights[i];
      LightFactors f;
      f.name = i < light_names_.size() ? light_names_[i] : fmt::format("{}", i);
      f.diffuse_color = light.diffuse;
      f.specular_color = light.specular;
      f.n_l = ratio(largest(lit(white, unit_light(light, 1.0f, 0.0f))), white_color);
      f.highlight = largest(lit(shiny, unit_light(light, 0.0f, 1.0f)));
      Light both = light;
      both.diffuse = both.specular = glm::vec3(1.0f);
      if (light.shadow != nullptr)
        f.shadow = std::clamp(ratio(largest(lit(black, both)), largest(lit(black, unit_light(light, 1.0f, 1.0f)))), 0.0f, 1.0f);
      Light diffuse = light, specular = light;
      diffuse.specular = specular.diffuse = glm::vec3(0.0f);
      f.diffuse = lit(black, diffuse);
      f.specular = lit(black, specular);
      out.lights.push_back(f);
    }
  }

  LightingDetail surface() const {
    S black = shader_;
    black.lights = {};
    black.factors[kAmbient].constant = black.factors[kEmissive].constant = glm::vec3(0.0f);
    black.reflected_environment = nullptr;
    const auto factor = [&](MaterialFactor k) { return color(black, [&](S& s) { s.factors[kEmissive] = shader_.factors[k]; }); };
    const auto with_ambient = [&](const S& from) { return color(from, [](S& s) { s.factors[kAmbient] = Factor{}; }); };
    LightingDetail out;
    out.model = shader_.model == LightModel::lambert ? "lambert" : shader_.model == LightModel::phong ? "phong" : "blinn_phong";
    out.albedo = with_ambient(black);
    out.diffuse = factor(kDiffuse);
    out.specular = factor(kSpecular);
    out.shininess = factor(kShininess).x;
    S white = black, shiny = black;
    white.factors[kColor] = white.factors[kDiffuse] = Factor{};
    shiny.factors[kSpecular] = Factor{};
    add_lights(out, black, white, largest(with_ambient(white)), shiny);
    return out;
  }

  LightingDetail metallic() const {
    S black = shader_;
    black.lights = {};
    black.ambient = black.emissive = glm::vec3(0.0f);
    black.environment = nullptr;
    S matte = black;
    matte.metallic = matte.specular = matte.clearcoat = matte.sheen = 0.0f;
    const auto with_ambient = [&](const S& from) { return color(from, [](S& s) { s.ambient = glm::vec3(1.0f); }); };
    LightingDetail out;
    out.model = "metallic";
    out.albedo = with_ambient(matte);
    S white = matte;
    white.base_color = glm::vec4(1.0f);
    white.maps[kBaseColorMap].map = nullptr;
    add_lights(out, black, white, largest(with_ambient(white)), black);
    return out;
  }

  LightingDetail sphere() const {
    S black = shader_;
    black.lights = {};
    black.ambient = black.emissive = glm::vec3(0.0f);
    LightingDetail out;
    out.model = shader_.model == LightModel::lambert ? "lambert" : shader_.model == LightModel::phong ? "phong" : "blinn_phong";
    out.albedo = color(black, [](S& s) { s.ambient = glm::vec3(1.0f); });
    out.diffuse = shader_.diffuse;
    out.specular = shader_.specular;
    out.shininess = shader_.shininess;
    S white = black, shiny = black;
    white.diffuse = glm::vec3(1.0f);
    shiny.specular = glm::vec3(1.0f);
    add_lights(out, black, white, largest(out.albedo), shiny);
    return out;
  }

  const S& shader_;
  const FragmentEvaluator<S>& fragment_;
  std::span<const std::string> light_names_;
};

}  // namespace halfspace
