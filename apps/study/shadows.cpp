// SPDX-License-Identifier: Apache-2.0
//
// Compares shadow map biases, filters and resolutions with ray-cast shadows, on the four scenes of `halfspace validate --table`.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "study/shadow_study.h"

namespace halfspace {

namespace {

// Estimates the error of the ray-cast reference: the fraction of pixels whose result changes when the surface point is moved by about a
// float rounding error.
double ambiguous_fraction(const PreparedScene& scene, int width, int height, const Workers& workers) {
  const RayScene rays(scene.meshes, scene.view.eye_ws), casters(scene.meshes, scene.view.eye_ws, true);
  const Image<std::optional<RayHit>> hits = primary_hits(rays, scene.view, width, height, workers);
  const RayLight light{scene.lights.front().light, 0.0, 1};
  int64_t ambiguous = 0, all = 0;
  for (const std::optional<RayHit>& hit : hits.texels()) {
    if (!hit) continue;
    ++all;
    const double step = 0x1p-22 * glm::length(hit->position_rws);
    const auto lit = [&](const glm::dvec3& aside) {
      return light_truth(casters, light, hit->position_rws + aside * step, hit->face_normal_ws, 0).share > 0.5f;
    };
    const bool here = lit({0, 0, 0});
    ambiguous += here != lit({1, 0, 0}) || here != lit({0, 1, 0}) || here != lit({0, 0, 1});
  }
  return static_cast<double>(ambiguous) / static_cast<double>(std::max<int64_t>(all, 1));
}

// Sums over the scenes for one variant.
struct Sum {
  std::string factor;
  int resolution = 0, rows = 0;
  double error = 0.0, false_shadow = 0.0, false_light = 0.0, edge_px = 0.0;
  Timing time;
};

class Sums {
 public:
  void add(const std::string& name, const std::string& factor, const ShadowScore& score, const Timing& time) {
    const auto beyond = [](const DistanceShares& s) { return s.from_1_to_3 + s.beyond_3; };
    if (!sums_.contains(name)) order_.push_back(name);
    Sum& sum = sums_[name];
    sum.factor = factor;
    sum.resolution = score.resolution;
    ++sum.rows;
    sum.error += score.error;
    sum.false_shadow += beyond(score.false_shadow);
    sum.false_light += beyond(score.false_light);
    sum.edge_px += score.edge_px.mean;
    sum.time = {sum.time.median_ms + time.median_ms, sum.time.low_ms + time.low_ms, sum.time.high_ms + time.high_ms, time.runs};
  }

  // Returns the means, in the order in which the variants were first added.
  std::vector<Variant> variants() const {
    std::vector<Variant> list;
    for (const std::string& name : order_) list.push_back(mean_of(name, sums_.at(name)));
    return list;
  }

 private:
  static std::string group_of(const std::string& factor) {
    if (factor == "bias") return "biases, pcf3, 2048";
    if (factor == "filter") return "filters, bias auto, 2048";
    if (factor == "resolution") return "resolutions, pcf3, bias auto";
    return "filter and bias, 2048, mean over angles";
  }
  static Variant mean_of(const std::string& name, const Sum& s) {
    const double n = s.rows;
    return {.name = name,
            .group = group_of(s.factor),
            .parameters = {{"resolution", static_cast<double>(s.resolution)}},
            .error = s.error / n,
            .measures = {{"false_shadow_beyond_1_texel", s.false_shadow / n},
                         {"false_light_beyond_1_texel", s.false_light / n},
                         {"edge_px", s.edge_px / n}},
            .time = {s.time.median_ms / n, s.time.low_ms / n, s.time.high_ms / n, s.time.runs}};
  }

  std::vector<std::string> order_;
  std::map<std::string, Sum> sums_;
};

// Returns the setting that differs from the defaults as the name of the variant, or an empty string for rows to leave out. The default
// settings appear only once, as resolution 2048. Rows that vary the angle are omitted: it belongs to the scene and is not a choice.
template <class Choice>  // a ShadowCase or a ShadowScore
std::string name_of(const std::string& factor, const Choice& choice) {
  if (factor == "resolution") return std::to_string(choice.resolution);
  if (factor == "angle") return "";
  if (factor == "all") return choice.resolution == 2048 ? choice.method + " " + choice.bias : "";
  const std::string& varied = factor == "bias" ? choice.bias : choice.method;
  return varied == "auto" || varied == "pcf3" ? "" : varied;
}

// Returns a study without variants.
Study study_on(const std::string& name, int width, int height) {
  return {
      .name = name,
      .title = "Shadow maps: biases, filters, resolutions",
      .setting = fmt::format("Averages over shadow-plane, moon (terminator), shadow-contact and shadow-knot, {}x{}", width, height),
      .error_name = "mean error of the fraction of light that reaches the surface",
      .time_name = "shadow maps and lookups of a frame, averaged over the scenes",
      .truth = {"one ray per pixel to the light", 0.0, "results that change if points move by 2^-22 of the distance"},
  };
}

// The error of the reference is at least a tenth of one wrong pixel.
void set_truth_error(Study& study, double error, int width, int height) { study.truth.error = std::max(error, 0.1 / (width * height)); }

}  // namespace

Study study_shadows(const StudyOptions& options, const Workers& workers) {
  const int width = options.quick ? 96 : 480, height = options.quick ? 54 : 270;
  Study study = study_on("shadows", width, height);
  SceneAssets assets(workers);
  Sums sums;
  std::map<std::string, double> errors;
  for_each_shadow_case(false, [&](const ShadowCase& c) {
    if (c.factor == "angle" || (options.quick && c.factor != "resolution")) return;
    const std::string name = name_of(c.factor, c);
    if (name.empty()) return;
    const ShadowScore score = validate(c.scene, c.description, {width, height, 1}, assets, workers).lights.front().score;
    PreparedScene scene = assets.prepare(c.description, width, height);
    if (!errors.contains(c.scene)) errors[c.scene] = ambiguous_fraction(scene, width, height, workers);
    const Timing time = time_of(
        [&] {
          assets.forget_shadow_maps();
          scene = assets.prepare(c.description, width, height);  // reuses the meshes and draws the shadow maps
          draw_shadow_picture({&scene, 0}, scene.view, width, height, true, workers);
        },
        options);
    sums.add(name, c.factor, score, time);
  });
  double error = 0.0;
  for (const auto& [scene, share] : errors) error += share / static_cast<double>(errors.size());
  set_truth_error(study, error, width, height);
  study.variants = sums.variants();
  return study;
}

Study shadow_table_study(const std::vector<TableRow>& rows, int width, int height) {
  Study study = study_on("shadow_table", width, height);
  Sums sums;
  for (const TableRow& row : rows) {
    const std::string name = name_of(row.factor, row.score);
    const double ms = row.score.map_ms + row.score.lookup_ms;
    if (!name.empty()) sums.add(name, row.factor, row.score, {ms, ms, ms, 1});
  }
  set_truth_error(study, 0.0, width, height);
  study.truth.error_method = "a tenth of one pixel, as a fraction of all pixels";
  study.variants = sums.variants();
  return study;
}

}  // namespace halfspace
