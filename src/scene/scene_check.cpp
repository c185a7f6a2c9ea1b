// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/scene_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/core/text.h"
#include "halfspace/core/vec.h"
#include "halfspace/scene/animation.h"
#include "halfspace/scene/lights.h"
#include "halfspace/scene/material_overrides.h"
#include "halfspace/scene/object_keys.h"
#include "halfspace/scene/scene_paths.h"
#include "halfspace/scene/shapes.h"

namespace halfspace::HS_LANES {

namespace {

constexpr double kMinScale = 1e-6, kMinTerm = 1e-6;
constexpr double kMinModelScale = 1e-15;            // the coordinates of model files can be large
constexpr int64_t kMaxVertices = int64_t{1} << 23;  // per mesh; this many take 0.6 GB
constexpr int kMaxPatternWidth = 4096;              // 14 bytes per texel; patterns are square
constexpr int64_t kMaxCopies = 65536;
constexpr int64_t kMaxDrawnVertices = int64_t{1} << 25;  // over all visible copies; this many take 2 GB while a frame is rendered

[[noreturn]] void reject(const std::string& where, const std::string& what) { throw InputError(where + ": " + what); }

void check(const CameraDescription& c, const std::string& where) {
  if (c.far != 0.0 && c.near >= c.far) reject(where + ".far", "expected a value greater than near");
  if (c.target == c.position) reject(where + ".target", "equals position; expected another point");
  if (c.up == glm::dvec3(0.0)) reject(where + ".up", "is zero; expected a direction");
  const glm::dvec3 side = glm::cross(unit_or_zero(c.target - c.position), unit_or_zero(c.up));
  if (glm::dot(side, side) <= 1e-24) {
    reject(where + ".up", "up is parallel to the line from position to target; expected another direction");
  }
}

void check(const LightDescription& l, const std::string& where) {
  if (l.direction == glm::dvec3(0.0)) reject(where + ".direction", "is zero; expected a direction");
  if (l.attenuation.x + l.attenuation.y + l.attenuation.z < kMinTerm) {
    reject(where + ".attenuation", "is zero; expected a sum of at least " + number_text(kMinTerm));
  }
  if (kind_of(l.type).has_cone && l.inner > l.outer)
    reject(where + ".inner", number_text(l.inner) + " is greater than outer; expected at most " + number_text(l.outer));
  if (kind_of(l.type).is_distant && l.size > 45.0)
    reject(where + ".size",
           number_text(l.size) + " degrees is too large for a " + std::string(kind_of(l.type).name) + " light; expected at most 45");
}

void check(const ShadowDescription& s, const std::string& where) {
  if (s.resolution != 0 && s.resolution < kMinShadowTexels) {
    reject(where + ".resolution", fmt::format("expected 0 or at least {} (room for the filters), got {}", kMinShadowTexels, s.resolution));
  }
}

void check(const TextureDescription& t, const std::string& where) {
  if (t.width % 2 != 0) reject(where + ".width", fmt::format("expected 0 or an even number, got {}", t.width));
  if (is_pattern(t.source) && t.width > kMaxPatternWidth)
    reject(where + ".width", fmt::format("expected at most {} for a map that tiles, got {}", kMaxPatternWidth, t.width));
}

void check(const EnvironmentDescription& e, const std::string& where) {
  if (e.sun == glm::dvec3(0.0)) reject(where + ".sun", "is zero; expected a direction");
}

void check(const SurfaceDescription&, const std::string&) {}
void check(const ParticlesDescription&, const std::string&) {}

void check(const Placement& p, const std::string& where, double min_scale = kMinScale) {
  const glm::dvec3 s = glm::abs(p.scale);
  if (std::min({s.x, s.y, s.z}) < min_scale)
    reject(where + ".scale", "has a component near zero; expected at least " + number_text(min_scale) + " in magnitude");
}

void check(const ObjectDescription& o, const std::string& where) {
  const ShapeKind& kind = kind_of(o);
  check(o.placement, where, o.shape == Shape::file ? kMinModelScale : kMinScale);
  if (o.shape == Shape::file && o.file.path.empty()) reject(where + ".file", "is missing; expected a model file");
  for (std::size_t i = 0; i < o.instances.size(); ++i) check(o.instances[i], fmt::format("{}.{}.{}", where, kInstances, i));
  if (kind.vertices(o) > kMaxVertices) reject(where + ".longitudes", "more than 2^23 vertices; expected fewer latitudes or longitudes");
  if (kind.is_ring && o.tube >= o.radius)
    reject(where + ".tube", number_text(o.tube) + " closes the hole of the ring; expected less than the radius, " + number_text(o.radius));
  if (kind.is_ring && o.latitudes < 3) reject(where + ".latitudes", "2 bands do not form a tube; expected at least 3");
  if (const std::string_view key = mesh_only_key(o); o.shape == Shape::sphere && !key.empty()) {
    reject(where + "." + std::string(key),
           std::string("is not supported by the shape sphere, which cannot have maps, a reflection, transparency, two visible sides, ") +
               "lines of normals, shading other than phong or a non-uniform scale; expected the shape uv_sphere or icosphere");
  }
  const double thickness = kind.thickness(o);
  if (thickness > 0.0 && is_map(o.height) && std::fabs(o.height_scale) * std::max(o.height_zero, 1.0 - o.height_zero) >= thickness) {
    reject(where + ".height_scale", number_text(o.height_scale) + " can turn the " + (o.shape == Shape::uv_sphere ? "sphere" : "surface") +
                                        " inside out; expected less than " + (o.shape == Shape::uv_sphere ? "its radius, " : "") +
                                        number_text(thickness));
  }
}

template <class T>
bool are_equal(const void* a, const void* b) {
  return *static_cast<const T*>(a) == *static_cast<const T*>(b);
}

// Compares a value with the default of its key. Scenes are checked in every frame, so this does not convert the values to JSON.
bool is_default(KeyType type, const void* value, const void* standard) {
  switch (type) {
    case KeyType::boolean: return are_equal<bool>(value, standard);
    case KeyType::integer: return are_equal<int>(value, standard);
    case KeyType::number: return are_equal<double>(value, standard);
    case KeyType::vector: return are_equal<glm::dvec3>(value, standard);
    case KeyType::choice: return are_equal<uint8_t>(value, standard);
    case KeyType::text: return are_equal<std::string>(value, standard);
    case KeyType::numbers: return are_equal<Numbers>(value, standard);
    case KeyType::keyframes: return are_equal<Keyframes>(value, standard);
    case KeyType::file: return static_cast<const FilePath*>(value)->path == static_cast<const FilePath*>(standard)->path;
    case KeyType::color: return static_cast<const Color*>(value)->linear == static_cast<const Color*>(standard)->linear;
    case KeyType::map: break;
  }
  const auto* color = std::get_if<Color>(static_cast<const MapValue*>(value));  // all defaults are colors
  return color != nullptr && color->linear == std::get<Color>(*static_cast<const MapValue*>(standard)).linear;
}

// Rejects keys that have no effect unless they have their default values, which printed scenes contain.
void check_effect(ObjectDescription& o, const std::string& where) {
  if (o.shape != Shape::file) return;
  if (!offers_shading(o, o.surface.shading))
    reject(where + ".shading", "a model with its own materials is lit per pixel; expected phong or none, or the key material as well");
  if (has_own_materials(o) && o.surface.normal != DetailChoice::automatic && o.surface.normal != DetailChoice::none)
    reject(where + ".normal", "a model with its own materials selects its maps itself; expected auto or none, or the key material as well");
  static ObjectDescription standard;
  const Section parts = section_of(o), defaults = section_of(standard);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const Key& key : parts[i].keys) {
      if (is_default(key.type, key.member(parts[i].data), key.member(defaults[i].data))) continue;
      if (const std::string problem = lack_of_effect(o, key.name); !problem.empty()) reject(where + "." + key.name, problem);
    }
  }
}

// Checks that the ancestors of an object exist and form no cycle, and that exact spheres stay round.
void check_parents(SceneDescription& scene, const ObjectDescription& object, const std::string& where) {
  std::size_t generations = 0;
  for (const ObjectDescription* o = &object; !o->parent.empty();) {
    const ObjectDescription* parent = find_named(scene.objects, o->parent);
    if (parent == nullptr) reject(where + ".parent", "no object '" + o->parent + "'" + suggestion(o->parent, names_of(scene.objects)));
    if (++generations > scene.objects.size())
      reject(where + ".parent", "the chain of parents is a loop; expected it to end at an object without a parent");
    if (object.shape == Shape::sphere && !is_uniformly_scaled(parent->placement))
      reject(where + ".parent",
             "'" + o->parent + "' is not scaled uniformly, which the shape sphere requires; expected the shape uv_sphere");
    o = parent;
  }
}

void check_environments(SceneDescription& scene, const std::string& source) {
  const BackgroundDescription& b = scene.background;
  const auto check_name = [&](const char* key, const std::string& name) {
    if (name.empty() || find_named(scene.environments, name) != nullptr) return;
    reject(source, std::string(key) + ": no environment '" + name + "'" + suggestion(name, names_of(scene.environments)));
  };
  check_name("background.environment", b.environment);
  check_name("background.second", b.second);
  check_name("reflections.environment", scene.reflections.environment);
  if (b.type == BackgroundType::environment && scene.environments.empty())
    reject(source, "background.type: the scene has no environment; expected one in environments");
}

}  // namespace

void check_mesh_limits(const Named<ObjectDescription>& objects, const std::string& source) {
  int64_t vertices = 0, copies = 0;
  for (const auto& [name, o] : objects) {
    if (!o.visible) continue;
    const int64_t count = std::max<int64_t>(1, static_cast<int64_t>(o.instances.size()));
    copies += count;
    if (o.mesh_error == 0.0) vertices += kind_of(o).vertices(o) * count;
  }
  if (copies > kMaxCopies) reject(source, fmt::format("objects: {} objects including instances; expected at most {}", copies, kMaxCopies));
  if (vertices > kMaxDrawnVertices) {
    reject(source,
           fmt::format("objects: {} vertices including instances; expected at most 33554432 (2^25): fewer instances or coarser shapes",
                       vertices));
  }
}

void check_scene(SceneDescription& scene, const std::string& source) {
  if (!scene.head.camera.empty() && find_named(scene.cameras, scene.head.camera) == nullptr) {
    reject(source, "camera: no camera '" + scene.head.camera + "'" + suggestion(scene.head.camera, names_of(scene.cameras)));
  }
  if (!std::has_single_bit(static_cast<unsigned>(scene.head.samples)))
    reject(source, fmt::format("samples: expected 1, 2, 4 or 8, got {}", scene.head.samples));
  check_environments(scene, source);
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
  for (auto& [name, object] : scene.objects) {
    const std::string where = source + ": objects." + name;
    check_effect(object, where);
    check_parents(scene, object, where);
    check_material_overrides(scene, object, where);
  }
  check(scene.shadow, source + ": shadow");
  check_mesh_limits(scene.objects, source);
}

}  // namespace halfspace::HS_LANES
