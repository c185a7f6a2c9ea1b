// SPDX-License-Identifier: Apache-2.0
//
// Instantiates all scene shaders in float. They are slow to compile, so they have their own translation unit.
#include "explain/fragment_values.h"
#include "explain/light_factors.h"
#include "explain/light_terms.h"
#include "explain/varying_names.h"

namespace halfspace {

namespace {

// Returns the number of components of each member of the varyings V.
template <class V>
constexpr auto varying_sizes() {
  return []<class... F>(std::type_identity<std::tuple<F&...>>) {
    return std::array<std::size_t, sizeof...(F)>{detail::FieldTraits<std::remove_const_t<F>>::components...};
  }(std::type_identity<detail::FieldsOf<V>>());
}

template <class S>
std::vector<NamedValue> named_varyings(const FragmentEvaluator<S>& fragment) {
  constexpr auto sizes = varying_sizes<typename S::template Varyings<float>>();
  static_assert(sizes.size() == kVaryingNames<S>.size(), "every member of the varyings needs a name in varying_names.h");
  std::vector<NamedValue> out;
  auto next = fragment.varyings().begin();
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const auto end = next + static_cast<std::ptrdiff_t>(sizes[i]);
    if (sizes[i] != 0) out.push_back({std::string(kVaryingNames<S>[i]), {next, end}});
    next = end;
  }
  return out;
}

template <class S>
struct ShaderName;
template <ShadingRate rate, bool mapped, NormalDetail detail, bool highlight>
struct ShaderName<SurfaceShader<rate, mapped, detail, highlight>> {
  static constexpr const char* text = rate == ShadingRate::none        ? "unlit surface"
                                      : rate == ShadingRate::flat      ? "surface lit per triangle (flat)"
                                      : rate == ShadingRate::provoking ? "surface lit at the provoking vertex"
                                      : rate == ShadingRate::gouraud   ? "surface lit per vertex (gouraud)"
                                                                       : "surface lit per pixel (phong)";
};
template <MetallicStreams streams, bool masked>
struct ShaderName<MetallicSurface<streams, masked>> {
  static constexpr const char* text = masked ? "metallic-roughness surface with a mask" : "metallic-roughness surface";
};
template <bool exact>
struct ShaderName<SphereImpostor<exact>> {
  static constexpr const char* text = exact ? "exact sphere" : "classic sphere sprite";
};
template <>
struct ShaderName<StarSky> {
  static constexpr const char* text = "sky with stars";
};
template <>
struct ShaderName<EnvironmentSky> {
  static constexpr const char* text = "environment as background";
};
template <>
struct ShaderName<ColoredPrimitives> {
  static constexpr const char* text = "colored points or lines";
};
template <>
struct ShaderName<NormalLines> {
  static constexpr const char* text = "lines of normals";
};
template <>
struct ShaderName<ShadowCatcher> {
  static constexpr const char* text = "floor that only shows shadows";
};

template <class S>
FragmentValues values_of(const S& shader, const FragmentPlace& place, std::span<const std::string> light_names) {
  const FragmentEvaluator<S> fragment(shader, place);
  FragmentValues out;
  out.shader = ShaderName<S>::text;
  out.barycentrics = fragment.barycentrics();
  out.inv_w = fragment.inv_w();
  out.varyings = named_varyings(fragment);
  out.color = fragment.color(shader);
  LightTerms<S>(shader, fragment, light_names, out).find();
  return out;
}

}  // namespace

FragmentValues fragment_values(const SceneShader& shader, const FragmentPlace& place, std::span<const std::string> light_names) {
  return std::visit([&](const auto& s) { return values_of(s, place, light_names); }, shader);
}

LightingDetail lighting_detail(const SceneShader& shader, const FragmentPlace& place, std::span<const std::string> light_names) {
  return std::visit(
      [&]<class S>(const S& s) {
        const FragmentEvaluator<S> fragment(s, place);
        return LightFactorFinder<S>(s, fragment, light_names).find();
      },
      shader);
}

}  // namespace halfspace
