// SPDX-License-Identifier: Apache-2.0
//
// Shadow maps by bias, filter and resolution on the four scenes of `halfspace validate --table`, held against rays.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "reference/shadow_table.h"
#include "study/study.h"

namespace halfspace {

namespace {

// The point moved by the rounding of floats; rays that then tell otherwise are in doubt.
double share_in_doubt(const PreparedScene& scene, int width, int height, const Workers& workers) {
  const RayScene rays(scene.meshes, scene.view.eye_ws), casters(scene.meshes, scene.view.eye_ws, true);
  const Image<std::optional<RayHit>> hits = primary_hits(rays, scene.view, width, height, workers);
  const RayLight light{scene.lights.front().light, 0.0, 1};
  int64_t doubtful = 0, all = 0;
  for (const std::optional<RayHit>& hit : hits.texels()) {
    if (!hit) continue;
    ++all;
    const double step = 0x1p-22 * glm::length(hit->position_ew);
    const auto lit = [&](const glm::dvec3& aside) {
      return light_truth(casters, light, hit->position_ew + aside * step, hit->face_normal_ws, 0).share > 0.5f;
    };
    const bool here = lit({0, 0, 0});
    doubtful += here != lit({1, 0, 0}) || here != lit({0, 1, 0}) || here != lit({0, 0, 1});
  }
  return static_cast<double>(doubtful) / static_cast<double>(std::max<int64_t>(all, 1));
}

// Means over the scenes.
struct Sum {
  std::string factor, bias, method;
  int resolution = 0, scenes = 0;
  double error = 0.0, false_shadow = 0.0, false_light = 0.0, edge_px = 0.0;
  Timing time;
};

void add(Sum& sum, const ShadowCase& c, const ShadowScore& score, const Timing& time) {
  const auto beyond = [](const DistanceShares& s) { return s.from_1_to_3 + s.beyond_3; };
  sum.factor = c.factor;
  sum.bias = c.bias;
  sum.method = c.method;
  sum.resolution = c.resolution;
  ++sum.scenes;
  sum.error += score.error;
  sum.false_shadow += beyond(score.false_shadow);
  sum.false_light += beyond(score.false_light);
  sum.edge_px += score.edge_px.mean;
  sum.time = {sum.time.median_ms + time.median_ms, sum.time.low_ms + time.low_ms, sum.time.high_ms + time.high_ms, time.runs};
}

Variant to_variant(const std::string& name, const Sum& s) {
  const double n = s.scenes;
  return {.name = name,
          .group = s.factor == "bias"     ? "biases of pcf3, 2048"
                   : s.factor == "filter" ? "filters, bias auto, 2048"
                                          : "pcf3, bias auto, by texels a side",
          .parameters = {{"resolution", static_cast<double>(s.resolution)}},
          .error = s.error / n,
          .measures = {{"false_shadow_beyond_1_texel", s.false_shadow / n},
                       {"false_light_beyond_1_texel", s.false_light / n},
                       {"edge_px", s.edge_px / n}},
          .time = {s.time.median_ms / n, s.time.low_ms / n, s.time.high_ms / n, s.time.runs}};
}

}  // namespace

Study study_shadows(const StudyOptions& options, const Workers& workers) {
  const int width = options.quick ? 96 : 480, height = options.quick ? 54 : 270;
  Study study{
      .name = "shadows",
      .title = "Shadow maps: biases, filters, resolutions",
      .setting = fmt::format("Means over shadow-plane, moon (terminator), shadow-contact and shadow-knot, {}x{}", width, height),
      .error_name = "mean error of the light's share over pixels that can see it",
      .time_name = "maps and look-ups, mean of a scene's frame without colours",
      .truth = {"a ray a pixel from the surface to the light", 0.0, "rays that tell otherwise 2^-22 of the distance aside"},
  };
  SceneAssets assets(workers);
  std::vector<std::string> order;
  std::map<std::string, Sum> sums;
  std::map<std::string, double> doubts;
  for_each_shadow_case(false, [&](const ShadowCase& c) {
    if (c.factor == "angle") return;
    const std::string& varied = c.factor == "bias" ? c.bias : c.method;
    if (options.quick && c.factor != "resolution") return;
    const std::string name = c.factor == "resolution" ? std::to_string(c.resolution) : varied;
    if (name == "auto" || name == "pcf3") return;  // the point 2048 of the resolutions
    const ShadowScore score = validate(c.scene, c.description, {width, height, 1}, assets, workers).lights.front().score;
    PreparedScene scene = assets.prepare(c.description, width, height);
    if (!doubts.contains(c.scene)) doubts[c.scene] = share_in_doubt(scene, width, height, workers);
    const Timing time = time_of(
        [&] {
          scene = assets.prepare(c.description, width, height);  // meshes are kept, shadow maps are made
          draw_shadow_picture({&scene, 0}, scene.view, width, height, true, workers);
        },
        options);
    if (!sums.contains(name)) order.push_back(name);
    add(sums[name], c, score, time);
  });
  for (const auto& [scene, doubt] : doubts) study.truth.error += doubt / static_cast<double>(doubts.size());
  study.truth.error = std::max(study.truth.error, 0.1 / (width * height));
  for (const std::string& name : order) study.variants.push_back(to_variant(name, sums[name]));
  return study;
}

}  // namespace halfspace
