// SPDX-License-Identifier: Apache-2.0
#include "halfspace/reference/shadow_table.h"

#include <fmt/format.h>
#include <cmath>
#include <numbers>

#include "halfspace/core/trig_double.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"

namespace halfspace::HS_LANES {

namespace {

// A scene and the camera to render it from.
struct TableScene {
  const char* name;
  const char* camera;
  double angle;  // between the scene's light and the vertical, in degrees
};
constexpr TableScene kScenes[] = {
    {"shadow-plane", "main", 45.0}, {"moon", "terminator", 80.0}, {"shadow-contact", "main", 40.0}, {"shadow-knot", "main", 45.0}};

constexpr const char* kBiases[] = {"none", "constant", "slope", "angle", "normal_offset", "receiver_plane", "adaptive", "auto", "original"};
constexpr const char* kFilters[] = {"hard", "bilinear", "pcf3", "pcf5", "pcf7", "vogel", "pcss", "vsm", "moments"};
constexpr int kResolutions[] = {512, 1024, 2048, 4096};
constexpr double kAngles[] = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 80.0, 85.0};

struct Variant {
  const char* factor;
  const char* bias = "auto";
  const char* filter = "pcf3";
  int resolution = 2048;
  double angle;  // negative: keep the angle of the scene's light
};

std::vector<Variant> variants(bool full) {
  std::vector<Variant> list;
  if (full) {
    for (const char* bias : kBiases)
      for (const char* filter : kFilters)
        for (const int resolution : kResolutions)
          for (const double angle : kAngles) list.push_back({"all", bias, filter, resolution, angle});
    return list;
  }
  for (const char* bias : kBiases) list.push_back({.factor = "bias", .bias = bias, .angle = -1.0});
  for (const char* filter : kFilters) list.push_back({.factor = "filter", .filter = filter, .angle = -1.0});
  for (const int resolution : kResolutions) list.push_back({.factor = "resolution", .resolution = resolution, .angle = -1.0});
  for (const double angle : kAngles) list.push_back({.factor = "angle", .angle = angle});
  return list;
}

// Tilts a light to an angle from the vertical and keeps its azimuth. A point light keeps its distance from the origin.
void lean(LightDescription& light, double degrees) {
  glm::dvec3& towards = light.type == LightType::point ? light.position : light.direction;
  const double length = glm::length(towards), across = std::sqrt(towards.x * towards.x + towards.z * towards.z);
  const glm::dvec3 azimuth = across > 0.0 ? glm::dvec3(towards.x, 0.0, towards.z) / across : glm::dvec3(1, 0, 0);
  const SinCosDouble a = sincos_turns(degrees / 360.0);
  towards = length * (a.sin * azimuth + a.cos * glm::dvec3(0, 1, 0));
}

}  // namespace

void for_each_shadow_case(bool full, const std::function<void(const ShadowCase&)>& visit) {
  for (const TableScene& place : kScenes) {
    SceneFile file = SceneFile::open(place.name);
    file.set("camera=" + std::string(place.camera));
    for (const Variant& v : variants(full)) {
      SceneFile varied = file;
      varied.set(std::vector<std::string>{"shadow.bias=" + std::string(v.bias), "shadow.method=" + std::string(v.filter),
                                          fmt::format("shadow.resolution={}", v.resolution)});
      ShadowCase c{v.factor, place.name, v.bias, v.filter, v.resolution, v.angle >= 0.0 ? v.angle : place.angle, varied.at(0.0)};
      LightDescription& light = c.description.lights.front().second;
      light.size = 0.0;
      if (v.angle >= 0.0) lean(light, v.angle);
      visit(c);
    }
  }
}

std::vector<TableRow> shadow_table(bool full, const ValidationOptions& options, const Workers& workers,
                                   const std::function<void(const TableRow&)>& done) {
  std::vector<TableRow> rows;
  SceneAssets assets(workers);
  for_each_shadow_case(full, [&](const ShadowCase& c) {
    Validation result = validate(c.scene, c.description, options, assets, workers);
    rows.push_back({c.factor, c.angle, std::move(result.lights.front().score)});
    done(rows.back());
  });
  return rows;
}

std::string csv_header() {
  return "factor,scene,light,method,bias,resolution,angle,false_shadow_within_1,false_shadow_1_to_3,false_shadow_beyond_3,"
         "false_light_within_1,false_light_1_to_3,false_light_beyond_3,edge_px_mean,edge_px_p95,edge_px_max,error,map_ms,lookup_ms\n";
}

std::string csv_line(const TableRow& row) {
  const ShadowScore& s = row.score;
  return fmt::format("{},{},{},{},{},{},{:g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.4g},{:.4g},{:.4g},{:.6g},{:.4g},{:.4g}\n",
                     row.factor, s.scene, s.light, s.method, s.bias, s.resolution, row.angle, s.false_shadow.within_1,
                     s.false_shadow.from_1_to_3, s.false_shadow.beyond_3, s.false_light.within_1, s.false_light.from_1_to_3,
                     s.false_light.beyond_3, s.edge_px.mean, s.edge_px.p95, s.edge_px.max, s.error, s.map_ms, s.lookup_ms);
}

}  // namespace halfspace::HS_LANES
