// SPDX-License-Identifier: Apache-2.0
#include "halfspace/reference/validation.h"
#include "halfspace/render/scene_assets.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace halfspace::HS_LANES {

namespace {

Json to_json(const DistanceShares& s) { return {{"within_1", s.within_1}, {"from_1_to_3", s.from_1_to_3}, {"beyond_3", s.beyond_3}}; }

glm::u8vec4 gray(float value) {
  const auto code = static_cast<uint8_t>(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
  return {code, code, code, 255};
}

}  // namespace

Validation validate(const std::string& name, const SceneDescription& description, const ValidationOptions& options, SceneAssets& assets,
                    const Workers& workers) {
  assets.forget_shadow_maps();  // so that the scores contain the time to draw them
  const PreparedScene scene = assets.prepare(description, options.width, options.height);
  const RayScene rays(scene.meshes, scene.view.eye_ws), casters(scene.meshes, scene.view.eye_ws, true, scene.spheres);
  SceneDescription shown = description;
  const Json shadow = json_of(section_of(shown.shadow));
  Validation out;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const LightChoice light{&scene, i};
    if (i == 0) {
      const ShadowPicture picture = draw_shadow_picture(light, scene.view, options.width, options.height, false, workers);
      out.visibility =
          compare_visibility(picture, primary_hits(rays, scene.view, options.width, options.height, workers), rays, scene.view, workers);
    }
    if (!scene.lights[i].description.shadow) continue;
    ShadowComparison& c =
        out.lights.emplace_back(compare_shadow(light, rays, casters, options.width, options.height, options.rays, workers));
    c.score.scene = name;
    c.score.method = shadow.at("method").get<std::string>();
    c.score.bias = shadow.at("bias").get<std::string>();
    const Shadow* maps = scene.lights[i].light.shadow;
    c.score.resolution = maps == nullptr || maps->views.empty() ? 0 : maps->views.front().size;
  }
  return out;
}

std::string json_report(const Validation& validation) {
  Json rows = Json::array();
  for (const ShadowComparison& c : validation.lights) {
    const ShadowScore& s = c.score;
    rows.push_back({{"scene", s.scene},
                    {"light", s.light},
                    {"method", s.method},
                    {"bias", s.bias},
                    {"resolution", s.resolution},
                    {"lit_pixels", s.lit},
                    {"shadowed_pixels", s.shadowed},
                    {"sides_differ", s.sides_differ},
                    {"sides",
                     {{"lit_pixels", s.sides.lit},
                      {"shadowed_pixels", s.sides.shadowed},
                      {"false_shadow", s.sides.false_shadow},
                      {"false_light", s.sides.false_light},
                      {"error", s.sides.error}}},
                    {"false_shadow", to_json(s.false_shadow)},
                    {"false_light", to_json(s.false_light)},
                    {"edge_px", {{"mean", s.edge_px.mean}, {"p95", s.edge_px.p95}, {"max", s.edge_px.max}}},
                    {"edge_texels", s.edge_texels},
                    {"penumbra_error", s.penumbra_error},
                    {"error", s.error},
                    {"truth_standard_error", s.truth_error},
                    {"map_ms", s.map_ms},
                    {"lookup_ms", s.lookup_ms},
                    {"visibility",
                     {{"pixels", validation.visibility.pixels},
                      {"same", validation.visibility.same},
                      {"near_edge", validation.visibility.near_edge},
                      {"depth_tie", validation.visibility.depth_tie},
                      {"unexplained", validation.visibility.unexplained}}}});
  }
  return rows.dump(2) + "\n";
}

namespace {

// The header of the table of lights.
std::string table_header() {
  std::string text =
      fmt::format("{:<14} {:<10} {:<9} {:<14} {:>5}  {:^29}  {:^29}  {:>18} {:>7} {:>7}\n", "scene", "light", "method", "bias", "size",
                  "false shadow, % of lit px", "false light, % of shadowed px", "edge, px", "map ms", "lookup");
  text += fmt::format("{:<14} {:<10} {:<9} {:<14} {:>5}  {:>9}{:>10}{:>10}  {:>9}{:>10}{:>10}  {:>5} {:>5} {:>6}\n", "", "", "", "", "",
                      "<=1 texel", "1 to 3", "beyond", "<=1 texel", "1 to 3", "beyond", "mean", "p95", "max");
  return text;
}

}  // namespace

std::string text_report(const Validation& validation) {
  std::string text = validation.lights.empty() ? "the scene has no lights with shadows, so no shadows are compared\n" : table_header();
  for (const ShadowComparison& c : validation.lights) {
    const ShadowScore& s = c.score;
    text += fmt::format(
        "{:<14} {:<10} {:<9} {:<14} {:>5}  {:>9.4f}{:>10.4f}{:>10.4f}  {:>9.4f}{:>10.4f}{:>10.4f}  {:>5.2f} {:>5.2f} {:>6.1f} "
        "{:>7.1f} {:>7.1f}\n",
        s.scene, s.light, s.method, s.bias, s.resolution, 100 * s.false_shadow.within_1, 100 * s.false_shadow.from_1_to_3,
        100 * s.false_shadow.beyond_3, 100 * s.false_light.within_1, 100 * s.false_light.from_1_to_3, 100 * s.false_light.beyond_3,
        s.edge_px.mean, s.edge_px.p95, s.edge_px.max, s.map_ms, s.lookup_ms);
    if (s.truth_error > 0.0)
      text += fmt::format("    soft: mean error {:.4f} in penumbrae, {:.4f} overall; standard error of the rays at most {:.4f}\n",
                          s.penumbra_error, s.error, s.truth_error);
    if (s.sides_differ > 0.0)
      text += fmt::format(
          "    not included: {:.3f} % of pixels, where only the face normal or only the shading normal faces the light\n"
          "    of those where only the shading normal does: {:.4f} % of {} lit px in false shadow, {:.4f} % of {} shadowed px in false "
          "light, "
          "mean error {:.5f}\n",
          100 * s.sides_differ, 100 * s.sides.false_shadow, s.sides.lit, 100 * s.sides.false_light, s.sides.shadowed, s.sides.error);
  }
  const VisibilityScore& v = validation.visibility;
  if (validation.lights.empty() && v.pixels == 0) return text;  // without lights, visibility is not compared either
  return text +
         fmt::format("visible triangles: {} pixels, {} match the rays, {} within 1/256 px of an edge, {} depth ties, {} unexplained\n",
                     v.pixels, v.same, v.near_edge, v.depth_tie, v.unexplained);
}

Image<glm::u8vec4> light_picture(const Image<float>& light) {
  Image<glm::u8vec4> out(light.width(), light.height());
  std::ranges::transform(light.texels(), out.data(), [](float value) { return value < 0.0f ? glm::u8vec4(40, 40, 60, 255) : gray(value); });
  return out;
}

Image<glm::u8vec4> difference_picture(const ShadowComparison& c) {
  Image<glm::u8vec4> out = light_picture(c.truth);
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) {
      const float truth = c.truth.at(x, y), error = c.map.at(x, y) - truth;
      if (truth < 0.0f || error == 0.0f) continue;
      const glm::vec3 base(0.35f + 0.5f * truth), wrong = error < 0.0f ? glm::vec3(0.9f, 0.1f, 0.1f) : glm::vec3(0.1f, 0.3f, 1.0f);
      const glm::vec3 mixed = glm::mix(base, wrong, std::min(1.0f, 2.0f * std::abs(error)));
      out.at(x, y) = glm::u8vec4(glm::round(mixed * 255.0f), 255);
    }
  }
  return out;
}

}  // namespace halfspace::HS_LANES
