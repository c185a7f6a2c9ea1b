// SPDX-License-Identifier: Apache-2.0
//
// The visible fragment of the example pixel, and the transparent layers of a pixel.
#include <algorithm>
#include <utility>

#include "explain/fragment_values.h"
#include "explain/page_data.h"
#include "halfspace/raster/inspect/inspection.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace {

namespace {

PageJson json_of_color(const glm::vec3& v) { return json_of(glm::dvec3(v)); }
PageJson json_of_color(const glm::vec4& v) { return json_of(glm::dvec4(v)); }

PageJson lighting_json(const LightingDetail& d) {
  if (d.model.empty()) return nullptr;
  PageJson lights = PageJson::array();
  for (const LightFactors& l : d.lights) {
    lights.push_back({{"name", l.name},
                      {"diffuse_color", json_of_color(l.diffuse_color)},
                      {"specular_color", json_of_color(l.specular_color)},
                      {"n_l", l.n_l},
                      {"highlight", l.highlight},
                      {"shadow", l.shadow},
                      {"diffuse", json_of_color(l.diffuse)},
                      {"specular", json_of_color(l.specular)}});
  }
  return {{"model", d.model},
          {"albedo", json_of_color(d.albedo)},
          {"diffuse", json_of_color(d.diffuse)},
          {"specular", json_of_color(d.specular)},
          {"shininess", d.shininess},
          {"lights", lights}};
}

// Adds the values of the visible fragment that its shader computes.
void add_shading(const PageInput& in, PageJson& json) {
  const TracedFragment& f = *in.visible;
  const TriangleInspector triangles(in.context);
  InspectedTriangle triangle;
  triangles.find(f.id, triangle);
  const SamplePosition at = triangle.draw->shades_samples ? sample_position(in.trace.samples, f.sample) : kPixelCenter;
  const FragmentPlace place{triangle, {in.pixel.x, in.trace.height - 1 - in.pixel.y}, at, f.depth};
  std::vector<std::string> names;
  for (const PreparedLight& l : in.scene.lights) names.push_back(l.name);
  const SceneShader& shader = in.scene.draws[f.draw].shader;
  const FragmentValues values = fragment_values(shader, place, names);
  json["shader"] = values.shader;
  json["shaded_at"] = {at.x, at.y};
  json["barycentrics"] = json_of_color(values.barycentrics);
  for (const NamedValue& v : values.varyings) json["varyings"].push_back({v.name, v.values});
  json["lighting"] = lighting_json(lighting_detail(shader, place, names));
}

bool is_layer(const TracedFragment& f) { return f.outcome == FragmentOutcome::layered || f.outcome == FragmentOutcome::layer_merged; }

// The layers of a sample.
struct SampleLayers {
  int count = 0;
  float alpha = 0.0f;  // sum
  uint8_t sample = 0;
  auto operator<=>(const SampleLayers& o) const { return std::pair(count, alpha) <=> std::pair(o.count, o.alpha); }
};

// Returns the sample of a pixel with the most layers. Layers that are completely transparent are not counted.
SampleLayers most_layers(const FrameTrace& trace, glm::ivec2 pixel) {
  std::array<SampleLayers, kMaxSamples> samples;
  for (const TracedFragment& f : trace.at(pixel)) {
    if (!is_layer(f) || !(f.color.w > 0.0f)) continue;
    samples[f.sample] = {samples[f.sample].count + 1, samples[f.sample].alpha + f.color.w, f.sample};
  }
  return *std::ranges::max_element(samples, [](const SampleLayers& a, const SampleLayers& b) { return (a <=> b) < 0; });
}

}  // namespace

PageJson visible_json(const PageInput& in) {
  if (in.visible == nullptr) return {{"sample", 0}};
  const TracedFragment& f = *in.visible;
  PageJson json{{"sample", f.sample}, {"depth", f.depth}, {"is_tested", f.is_tested}, {"stored_depth", f.stored_depth}};
  // The depth of a fragment that failed, for comparison.
  for (const TracedFragment& other : in.trace.at(in.pixel)) {
    if (other.sample != f.sample || !other.is_tested || other.outcome > FragmentOutcome::depth_failed) continue;
    json["failed"] = {{"tested", other.tested_depth}, {"stored", other.stored_depth}, {"outcome", outcome_text(other.outcome)}};
    break;
  }
  if (in.values.object.at(in.pixel.x, in.pixel.y) != 0xffffffffu)
    json["normal"] = json_of_color(in.values.normal.at(in.pixel.x, in.pixel.y));
  if (f.round == 0) add_shading(in, json);  // the context is that of the first round
  return json;
}

PageJson layers_json(const PageInput& in) {
  glm::ivec2 pixel = in.pixel;  // or the first pixel with the most layers
  SampleLayers most = most_layers(in.trace, pixel);
  const bool has_layers = most.count > 0;
  for (int y = 0; y < in.trace.height && !has_layers; ++y) {
    for (int x = 0; x < in.trace.width; ++x) {
      const SampleLayers here = most_layers(in.trace, {x, y});
      if ((here <=> most) <= 0) continue;
      most = here;
      pixel = {x, y};
    }
  }
  if (most.count == 0) return nullptr;
  const uint8_t sample = most.sample;
  std::vector<TracedFragment> layers;
  glm::vec4 under = in.scene.clear_color;
  for (const TracedFragment& f : in.trace.at(pixel)) {
    if (f.sample != sample) continue;
    if (is_layer(f)) layers.push_back(f);
    if (f.outcome == FragmentOutcome::shaded || f.outcome == FragmentOutcome::blended) under = f.value;
  }
  std::ranges::stable_sort(layers, {}, &TracedFragment::depth);
  PageJson list = PageJson::array();
  for (const TracedFragment& f : layers) {
    list.push_back({{"object", object_name(in.description, in.scene.draws[f.draw].source.object)},
                    {"depth", f.depth},
                    {"color", json_of_color(f.color)}});
  }
  const auto first = (static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(in.trace.width) + static_cast<std::size_t>(pixel.x)) *
                     static_cast<std::size_t>(in.trace.samples);
  return {{"pixel", {pixel.x, pixel.y}},
          {"sample", sample},
          {"under", json_of_color(under)},
          {"list", list},
          {"result", json_of_color(in.trace.values[first + sample])}};
}

}  // namespace halfspace
