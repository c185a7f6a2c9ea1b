// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_check.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "scene/animation.h"
#include "scene/camera.h"
#include "scene/nearest_name.h"
#include "scene/scene_paths.h"

namespace halfspace {

namespace {

constexpr double kLeastScale = 1e-6, kLeastAttenuation = 1e-6;
constexpr int kMostVertices = 1 << 23;  // of one mesh: 0.6 GB

[[noreturn]] void fail(const std::string& where, const std::string& what) { throw InputError(where + ": " + what); }

void check(const CameraDescription& c, const std::string& where) {
  if (c.near >= c.far) fail(where + ".far", "expected more than near");
  const glm::dvec3 side = glm::cross(unit_or_zero(c.target - c.position), unit_or_zero(c.up));
  if (glm::dot(side, side) <= 1e-24) {
    fail(where + ".up", "the camera's position, target and up lie on one line; expected them to differ");
  }
}

void check(const LightDescription& l, const std::string& where) {
  if (l.direction == glm::dvec3(0.0)) fail(where + ".direction", "is zero; expected a direction");
  if (l.attenuation.x + l.attenuation.y + l.attenuation.z < kLeastAttenuation) {
    fail(where + ".attenuation", "is zero; expected one term of at least " + number_text(kLeastAttenuation));
  }
}

void check(const TextureDescription& t, const std::string& where) {
  if (t.width % 2 != 0) fail(where + ".width", "expected 0 or an even number, got " + std::to_string(t.width));
}

void check(const EnvironmentDescription& e, const std::string& where) {
  if (e.sun == glm::dvec3(0.0)) fail(where + ".sun", "is zero; expected a direction");
}

void check(const SurfaceDescription&, const std::string&) {}

void check(const Placement& p, const std::string& where) {
  const glm::dvec3 s = glm::abs(p.scale);
  if (std::min({s.x, s.y, s.z}) < kLeastScale)
    fail(where + ".scale", "has a zero; expected at least " + number_text(kLeastScale) + " either way");
}

void check(const ObjectDescription& o, const std::string& where) {
  check(o.placement, where);
  for (std::size_t i = 0; i < o.instances.size(); ++i)
    check(o.instances[i], where + "." + std::string(kInstances) + "." + std::to_string(i));
  if (o.shape == Shape::uv_sphere && o.longitudes > kMostVertices / o.latitudes) {
    fail(where + ".longitudes", "more than 2^23 vertices; expected fewer latitudes or longitudes");
  }
  const bool displaced = o.shape == Shape::uv_sphere && !std::holds_alternative<Color>(o.height);
  if (displaced && std::fabs(o.height_scale) * std::max(o.height_zero, 1.0 - o.height_zero) >= o.radius) {
    fail(where + ".height_scale",
         number_text(o.height_scale) + " can turn the sphere inside out; expected less than its radius, " + number_text(o.radius));
  }
}

void check_background(SceneDescription& scene, const std::string& source) {
  const BackgroundDescription& b = scene.background;
  const auto check_name = [&](const char* key, const std::string& name) {
    if (name.empty() || find_named(scene.environments, name) != nullptr) return;
    fail(source, std::string("background.") + key + ": no environment '" + name + "'" + suggestion(name, names_of(scene.environments)));
  };
  check_name("environment", b.environment);
  check_name("second", b.second);
  if (b.type == BackgroundType::environment && scene.environments.empty())
    fail(source, "background.type: the scene has no environment; expected one in environments");
}

}  // namespace

void check_scene(SceneDescription& scene, const std::string& source) {
  if (!scene.head.camera.empty() && find_named(scene.cameras, scene.head.camera) == nullptr) {
    fail(source, "camera: no camera '" + scene.head.camera + "'" + suggestion(scene.head.camera, names_of(scene.cameras)));
  }
  check_background(scene, source);
  for_each_collection(scene, [&](const char* collection, const char*, auto& list) {
    for (auto& entry : list) {
      const std::string path = std::string(collection) + "." + entry.first;
      if constexpr (std::is_same_v<std::decay_t<decltype(entry.second)>, AnimationDescription>) {
        check_animation(scene, entry.second, path, source);
      } else {
        check(entry.second, source + ": " + path);
      }
    }
  });
}

}  // namespace halfspace
