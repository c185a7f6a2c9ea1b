// SPDX-License-Identifier: Apache-2.0
//
// Cameras and lights.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "halfspace/model/gltf/gltf_nodes.h"

namespace halfspace::HS_LANES {

namespace {

double positive(const GltfDocument& document, const GltfValue& json, const char* key) {
  const double x = document.number(json, key);
  if (!(x > 0.0)) document.fail(json, key, "is not positive; expected a number greater than 0");
  return x;
}

void read_perspective(const GltfDocument& document, const GltfValue& json, ModelCamera& camera) {
  camera.fovy = positive(document, json, "yfov");
  if (!(camera.fovy < std::numbers::pi)) document.fail(json, "yfov", "is too large; expected an angle below pi");
  camera.near = positive(document, json, "znear");
  camera.far = std::numeric_limits<double>::infinity();
  if (document.find(json, "zfar") != nullptr) camera.far = positive(document, json, "zfar");
}

void read_orthographic(const GltfDocument& document, const GltfValue& json, ModelCamera& camera) {
  camera.perspective = false;
  camera.height = 2.0 * std::abs(document.number(json, "ymag"));
  if (camera.height == 0.0) document.fail(json, "ymag", "is 0; expected a nonzero number");
  camera.near = document.number(json, "znear");
  camera.far = document.number(json, "zfar");
}

ModelCamera camera_of(const GltfDocument& document, const GltfValue& json) {
  ModelCamera camera;
  camera.name = document.string(json, "name");
  const std::string type = document.string(json, "type");
  if (type == "perspective") {
    read_perspective(document, document.object(json, "perspective"), camera);
  } else if (type == "orthographic") {
    read_orthographic(document, document.object(json, "orthographic"), camera);
  } else {
    document.fail(json, "type", gltf_quoted(type) + " is unknown; expected perspective or orthographic");
  }
  if (!(camera.far > camera.near)) document.fail(json, "the far plane is not behind the near plane; expected zfar > znear");
  return camera;
}

// Returns 0 for a light without a limit.
double range_of(GltfDocument& document, const GltfValue& json) {
  const double range = document.number(json, "range", 0.0, 0.0);
  if (range == 0.0 && document.find(json, "range") != nullptr) document.warn_at(json, "range", "0 is out of range; the light has no limit");
  return range;
}

ModelLight light_of(GltfDocument& document, const GltfValue& json) {
  ModelLight light;
  light.name = document.string(json, "name");
  const std::string type = document.string(json, "type");
  if (type == "directional") {
    light.type = ModelLightType::directional;
  } else if (type == "point") {
    light.type = ModelLightType::point;
  } else if (type == "spot") {
    light.type = ModelLightType::spot;
  } else {
    document.fail(json, "type", gltf_quoted(type) + " is unknown; expected directional, point or spot");
  }
  const auto color = document.numbers<3>(json, "color", {1.0, 1.0, 1.0});
  for (int i = 0; i < 3; ++i) light.color[i] = std::max(static_cast<float>(color[static_cast<std::size_t>(i)]), 0.0f);
  light.intensity = document.number(json, "intensity", 1.0, 0.0);
  light.range = range_of(document, json);
  const GltfValue& spot = document.object(json, "spot");
  light.outer = document.number(spot, "outerConeAngle", light.outer, 0.0, std::numbers::pi / 2.0 + 1e-6);
  light.inner = document.number(spot, "innerConeAngle", light.inner, 0.0, std::numbers::pi / 2.0 + 1e-6);
  if (light.inner > light.outer) document.fail(spot, "innerConeAngle", "is larger than outerConeAngle; expected a smaller angle");
  return light;
}

}  // namespace

void read_gltf_cameras_and_lights(GltfDocument& document, Model& model) {
  for (const GltfValue& json : document.list("cameras")) model.cameras.push_back(camera_of(document, json));
  const GltfValue* lights = document.extension(document.root(), "KHR_lights_punctual");
  if (lights == nullptr) return;
  for (const GltfValue& json : document.objects(*lights, "lights")) model.lights.push_back(light_of(document, json));
}

}  // namespace halfspace::HS_LANES
