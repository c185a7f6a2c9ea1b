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

constexpr double kLeastScale = 1e-6, kLeastTerm = 1e-6;
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
  if (l.attenuation.x + l.attenuation.y + l.attenuation.z < kLeastTerm) {
    fail(where + ".attenuation", "is zero; expected one term of at least " + number_text(kLeastTerm));
  }
  if (l.type == LightType::spot && l.inner > l.outer)
    fail(where + ".inner", number_text(l.inner) + " is more than outer; expected at most " + number_text(l.outer));
}

void check(const TextureDescription& t, const std::string& where) {
  if (t.width % 2 != 0) fail(where + ".width", "expected 0 or an even number, got " + std::to_string(t.width));
}

void check(const SurfaceDescription&, const std::string&) {}

// Of an object: a material alone may leave it to the object to name the map.
void check_detail(const SurfaceDescription& s, const std::string& where) {
  if (s.normal == DetailChoice::map && !is_map(s.normal_map))
    fail(where + ".normal", "is map, and normal_map is none; expected a texture or an image file as normal_map");
  if (s.normal == DetailChoice::bump && !is_map(s.bump_map))
    fail(where + ".normal", "is bump, and bump_map is none; expected a texture or an image file as bump_map");
}

void check(const Placement& p, const std::string& where) {
  const glm::dvec3 s = glm::abs(p.scale);
  if (std::min({s.x, s.y, s.z}) < kLeastScale)
    fail(where + ".scale", "has a zero; expected at least " + number_text(kLeastScale) + " either way");
}

void check(const ObjectDescription& o, const std::string& where) {
  check_detail(o.surface, where);
  check(o.placement, where);
  for (std::size_t i = 0; i < o.instances.size(); ++i)
    check(o.instances[i], where + "." + std::string(kInstances) + "." + std::to_string(i));
  if (o.shape == Shape::uv_sphere && o.longitudes > kMostVertices / o.latitudes) {
    fail(where + ".longitudes", "more than 2^23 vertices; expected fewer latitudes or longitudes");
  }
  const bool displaced = o.shape == Shape::uv_sphere && is_map(o.height);
  if (displaced && std::fabs(o.height_scale) * std::max(o.height_zero, 1.0 - o.height_zero) >= o.radius) {
    fail(where + ".height_scale",
         number_text(o.height_scale) + " can turn the sphere inside out; expected less than its radius, " + number_text(o.radius));
  }
}

}  // namespace

void check_scene(SceneDescription& scene, const std::string& source) {
  if (!scene.head.camera.empty() && find_named(scene.cameras, scene.head.camera) == nullptr) {
    fail(source, "camera: no camera '" + scene.head.camera + "'" + suggestion(scene.head.camera, names_of(scene.cameras)));
  }
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
