// SPDX-License-Identifier: Apache-2.0
//
// Splits the color of a fragment into the terms of its shader. Each term is the shader's result with the uniforms of all other terms set to
// zero. Shaders are linear in these uniforms, so the terms add up to the color.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "explain/fragment_evaluator.h"

namespace halfspace {

/// Collects the terms of a fragment.
template <class S>
class LightTerms {
 public:
  LightTerms(const S& shader, const FragmentEvaluator<S>& fragment, std::span<const std::string> light_names, FragmentValues& out)
      : shader_(shader), fragment_(fragment), light_names_(light_names), out_(out) {}

  void find() {
    if constexpr (requires { shader_.factors; }) {
      find_surface();
    } else if constexpr (requires { shader_.metallic; }) {
      find_metallic();
    } else if constexpr (requires { shader_.point_scale; }) {
      find_sphere();
    } else if constexpr (std::same_as<S, StarSky> || std::same_as<S, EnvironmentSky>) {
      find_sky();
    } else if constexpr (std::same_as<S, ColoredPrimitives>) {
      add("color of the vertices", glm::vec3(out_.color));
    } else if constexpr (std::same_as<S, NormalLines>) {
      add("color of the normal", glm::vec3(out_.color));
    } else {
      out_.factors.push_back({"opacity of the shadow", {out_.color.w}});
    }
  }

 private:
  static bool is_black(const glm::vec3& c) { return c == glm::vec3(0.0f); }

  void add(const std::string& name, const glm::vec3& value) { out_.terms.push_back({name, {value.x, value.y, value.z}}); }

  // Adds the result of a changed copy of the shader, unless it is black.
  template <class F>
  void add_seen(const std::string& name, const S& dark, const F& change) {
    S changed = dark;
    change(changed);
    const glm::vec3 value(fragment_.color_with(changed));
    if (!is_black(value)) add(name, value);
  }

  std::string light_name(std::size_t i) const { return i < light_names_.size() ? light_names_[i] : fmt::format("{}", i); }

  // Adds the terms of each light. dark: the shader without any term.
  void add_lights(const S& dark) {
    for (std::size_t i = 0; i < shader_.lights.size(); ++i) {
      const Light& light = shader_.lights[i];
      S changed = dark;
      const auto lit_by = [&](const Light& only) {
        changed.lights = std::span(&only, 1);
        return glm::vec3(fragment_.color_with(changed));
      };
      Light diffuse = light, specular = light;
      diffuse.specular = specular.diffuse = glm::vec3(0.0f);
      add(fmt::format("diffuse, light {}", light_name(i)), lit_by(diffuse));
      if (const glm::vec3 value = lit_by(specular); !is_black(value)) add(fmt::format("specular, light {}", light_name(i)), value);
      if (light.shadow != nullptr) add_shadow(i, lit_by);
    }
  }

  // A shadow scales all light of its source, so the factor is the ratio of the colors with and without the shadow.
  template <class F>
  void add_shadow(std::size_t i, const F& lit_by) {
    Light white = shader_.lights[i];
    white.diffuse = white.specular = glm::vec3(1.0f);
    const glm::vec3 shadowed = lit_by(white);
    white.shadow = nullptr;
    const glm::vec3 free = lit_by(white);
    const int k = free.x >= free.y && free.x >= free.z ? 0 : free.y >= free.z ? 1 : 2;
    if (free[k] > 0.0f)
      out_.factors.push_back({fmt::format("shadow, light {}", light_name(i)), {std::clamp(shadowed[k] / free[k], 0.0f, 1.0f)}});
  }

  void find_surface() {
    S dark = shader_;
    if constexpr (!S::kByVertex && !S::kByPixel && !HasPrimitive<S>) {  // unlit
      add_seen("color", dark, [](S& s) { s.factors[kEmissive].constant = glm::vec3(0.0f); });
      add_seen("emission", dark, [](S& s) { s.factors[kColor].constant = glm::vec3(0.0f); });
    } else {
      dark.lights = {};
      dark.factors[kAmbient].constant = dark.factors[kEmissive].constant = glm::vec3(0.0f);
      dark.reflected_environment = nullptr;
      add_seen("ambient", dark, [&](S& s) { s.factors[kAmbient] = shader_.factors[kAmbient]; });
      add_lights(dark);
      add_seen("emission", dark, [&](S& s) { s.factors[kEmissive] = shader_.factors[kEmissive]; });
      add_seen("reflection", dark, [&](S& s) { s.reflected_environment = shader_.reflected_environment; });
    }
  }

  void find_metallic() {
    S dark = shader_;
    if (shader_.unlit) {
      add_seen("base color", dark, [](S& s) { s.emissive = glm::vec3(0.0f); });
      return add_seen("emission", dark, [](S& s) { s.base_color = glm::vec4(0.0f, 0.0f, 0.0f, s.base_color.w); });
    }
    dark.lights = {};
    dark.ambient = dark.emissive = glm::vec3(0.0f);
    dark.environment = nullptr;
    add_seen("ambient", dark, [&](S& s) { s.ambient = shader_.ambient; });
    add_lights(dark);
    add_seen("environment", dark, [&](S& s) { s.environment = shader_.environment; });
    add_seen("emission", dark, [&](S& s) { s.emissive = shader_.emissive; });
  }

  void find_sphere() {
    S dark = shader_;
    dark.lights = {};
    dark.ambient = dark.emissive = glm::vec3(0.0f);
    add_seen("ambient", dark, [&](S& s) { s.ambient = shader_.ambient; });
    add_lights(dark);
    add_seen("emission", dark, [&](S& s) { s.emissive = shader_.emissive; });
  }

  void find_sky() {
    S plain = shader_;
    if constexpr (std::same_as<S, StarSky>) {
      plain.brightness = 0.0f;
    } else {
      plain.first_stars.density = plain.second_stars.density = 0.0f;
    }
    const glm::vec3 sky(fragment_.color_with(plain)), stars = glm::vec3(out_.color) - sky;
    add("sky", sky);
    if (!is_black(stars)) add("stars", stars);
  }

  const S& shader_;
  const FragmentEvaluator<S>& fragment_;
  std::span<const std::string> light_names_;
  FragmentValues& out_;
};

}  // namespace halfspace
