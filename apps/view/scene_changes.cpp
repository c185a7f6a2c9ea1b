// SPDX-License-Identifier: Apache-2.0
#include "view/scene_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "halfspace/core/check.h"
#include "halfspace/scene/object_keys.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace {

namespace {

// Sets a key of all objects for which value_of returns a value. Returns the number of objects that accepted it.
template <class F>
int set_for_objects(SceneFile& scene, const char* key, const F& value_of) {
  int accepted = 0;
  const Named<ObjectDescription> objects = scene.description().objects;
  for (const auto& [name, object] : objects) {
    const std::string value = value_of(object);
    if (!value.empty() && try_set(scene, fmt::format("objects.{}.{}={}", name, key, value)).empty()) ++accepted;
  }
  return accepted;
}

std::string objects_text(int count) { return count == 1 ? "1 object" : fmt::format("{} objects", count); }

bool has_model(const SceneFile& scene) {
  return std::ranges::any_of(scene.description().objects, [](const auto& entry) { return has_own_materials(entry.second); });
}

enum class Relief { none, map, bump };

bool has_detail(const ObjectDescription& o) { return is_map(o.surface.normal_map) || is_map(o.surface.bump_map); }
// Returns true if the object has a key for the normals of its displacement.
bool is_displaced(ObjectDescription o) { return is_map(o.height) && find_field(section_of(o), "normals").key != nullptr; }

// Returns true if a material of the model has a map with a texture. Returns true if the model is unknown, because it may have one.
bool may_have(const Model* model, std::initializer_list<TextureUse ModelMaterial::*> maps) {
  if (model == nullptr) return true;
  return std::ranges::any_of(model->materials, [&](const ModelMaterial& m) {
    return std::ranges::any_of(maps, [&](TextureUse ModelMaterial::*map) { return (m.*map).texture >= 0; });
  });
}

bool has_relief(const ObjectDescription& o, const Model* model) {
  if (has_own_materials(o))
    return may_have(model, {&ModelMaterial::normal_map, &ModelMaterial::clearcoat_normal_map, &ModelMaterial::bump_map});
  return o.shape != Shape::file && (has_detail(o) || is_displaced(o));
}

Relief relief_of(const ObjectDescription& o) {
  if (has_own_materials(o)) return o.surface.normal == DetailChoice::none ? Relief::none : Relief::map;
  if (!has_detail(o))
    return o.normals == NormalSource::undisplaced ? Relief::none : o.normals == NormalSource::pixel ? Relief::map : Relief::bump;
  switch (o.surface.normal) {
    case DetailChoice::none: return Relief::none;
    case DetailChoice::map: return Relief::map;
    case DetailChoice::bump: return Relief::bump;
    case DetailChoice::automatic: break;
  }
  return is_map(o.surface.normal_map) ? Relief::map : Relief::bump;
}

bool offers(const ObjectDescription& o, Relief relief) {
  if (has_own_materials(o)) return relief != Relief::bump;
  if (relief == Relief::none || !has_detail(o)) return true;
  return is_map(relief == Relief::map ? o.surface.normal_map : o.surface.bump_map);
}

// Returns the setting that gives an object a relief, or no relief if the object does not have the map.
std::string relief_setting(const std::string& name, const ObjectDescription& o, Relief relief) {
  static constexpr const char* kDetail[] = {"none", "map", "bump"};
  static constexpr const char* kNormals[] = {"undisplaced", "pixel", "vertex"};
  const auto i = static_cast<std::size_t>(relief);
  if (has_own_materials(o)) return fmt::format("objects.{}.normal={}", name, relief == Relief::none ? "none" : "auto");
  if (!has_detail(o)) return fmt::format("objects.{}.normals={}", name, kNormals[i]);
  return fmt::format("objects.{}.normal={}", name, offers(o, relief) ? kDetail[i] : "none");
}

}  // namespace

std::string try_set(SceneFile& scene, const std::string& setting) {
  try {
    scene.set(setting);
    return {};
  } catch (const InputError& e) {
    return e.what();
  }
}

std::string set_shading_rate(SceneFile& scene, const std::string& rate) {
  const int accepted = set_for_objects(scene, "shading", [&](const ObjectDescription& o) { return o.shadow_only ? "" : rate; });
  if (accepted == 0 && has_model(scene)) return fmt::format("shading {} is not available for model files; press 0 or 3", rate);
  if (accepted == 0) return "no object of this scene has a `shading` key";
  return fmt::format("shading {}: {}", rate, objects_text(accepted));
}

std::string cycle_relief(SceneFile& scene, const Model* model) {
  const Named<ObjectDescription> objects = scene.description().objects;
  const auto first = std::ranges::find_if(objects, [&](const auto& entry) { return has_relief(entry.second, model); });
  if (first == objects.end())
    return model == nullptr ? "no object of this scene has a normal, bump or height map"
                            : "no material of this model has a normal or bump map";
  Relief next = relief_of(first->second);
  do {
    next = static_cast<Relief>((static_cast<int>(next) + 1) % 3);
  } while (std::ranges::none_of(objects, [&](const auto& entry) { return has_relief(entry.second, model) && offers(entry.second, next); }));
  std::vector<std::string> settings;
  for (const auto& [name, object] : objects) {
    if (has_relief(object, model)) settings.push_back(relief_setting(name, object, next));
  }
  scene.set(settings);
  return settings.front();
}

std::string toggle_color_maps(SceneFile& scene, const Model* model) {
  const auto has_color_map = [&](const ObjectDescription& o) {
    return has_own_materials(o) ? may_have(model, {&ModelMaterial::base_color_map}) : !first_map(o.surface).empty();
  };
  const Named<ObjectDescription>& objects = scene.description().objects;
  const bool on = std::ranges::any_of(objects, [&](const auto& e) { return has_color_map(e.second) && e.second.surface.textured; });
  const char* value = on ? "false" : "true";
  const int accepted = set_for_objects(scene, "textured", [&](const ObjectDescription& o) { return has_color_map(o) ? value : ""; });
  if (accepted == 0) return model == nullptr ? "no object of this scene has a color map" : "no material of this model has a color map";
  return fmt::format("textures {}: {}", on ? "off" : "on", objects_text(accepted));
}

std::string VisibilityToggle::toggle(SceneFile& scene, const std::string& object) {
  const std::string name = hidden_object_.empty() ? object : std::exchange(hidden_object_, "");
  if (!name.empty()) {
    const ObjectDescription* o = find_named(scene.description().objects, name);
    if (o == nullptr) return "the picked object no longer exists";
    const bool visible = o->visible;
    scene.set(fmt::format("objects.{}.visible={}", name, !visible));
    if (visible) hidden_object_ = name;
    return fmt::format("{} {}", visible ? "hidden:" : "visible:", name);
  }
  const SceneDescription& d = scene.description();
  const bool on = std::ranges::any_of(d.objects, [](const auto& e) { return e.second.visible; });
  const char* value = on ? "false" : "true";
  const int objects = set_for_objects(scene, "visible", [&](const ObjectDescription&) { return value; });
  if (!hidden_particles_.empty()) {
    scene.set(hidden_particles_);
    hidden_particles_.clear();
    return "all particles are visible";
  }
  if (d.particles.count > 0 || !d.particles.file.path.empty()) {
    hidden_particles_ = {fmt::format("particles.count={}", d.particles.count), "particles.file=" + d.particles.file.path.string()};
    scene.set(std::vector<std::string>{"particles.count=0", "particles.file="});
    return "all particles are hidden";
  }
  return objects == 0 ? "this scene has no objects" : fmt::format("{}: {}", on ? "hidden" : "visible", objects_text(objects));
}

std::string ShadowToggle::toggle(SceneFile& scene) {
  SceneDescription d = scene.description();
  const std::string method = value_text(find_key(d, "shadow.method", "view").field);
  if (method != "none") method_ = method;
  const std::string next = method == "none" ? method_ : "none";
  const std::string problem = try_set(scene, "shadow.method=" + next);
  return problem.empty() ? "shadow.method=" + next : problem;
}

std::string change_exposure(SceneFile& scene, double factor) {
  const PostDescription& post = scene.description().post;
  const double exposure = post.hdr ? std::clamp(post.exposure * factor, 1e-6, 1e6) : factor;
  std::vector<std::string> settings{"post.exposure=" + number_text(exposure)};
  if (!post.hdr) settings.insert(settings.end(), {"post.hdr=true", "post.tone=none", "post.auto_exposure=false"});
  scene.set(settings);
  return fmt::format("post.exposure={:.4g}", exposure);
}

void set_camera_keys(SceneFile& scene, const std::string& name, CameraDescription camera) {
  std::vector<std::string> settings;
  const Section section = section_of(camera);
  for (const Field& field : fields_of(section))
    settings.push_back(fmt::format("cameras.{}.{}={}", name, field.key->name, value_text(field)));
  scene.set(settings);
}

bool is_animated_camera(const SceneFile& scene, const std::string& name) {
  SceneDescription d = scene.description();
  return std::ranges::any_of(scene.description().animations, [&](const auto& entry) {
    const std::vector<std::string> words = find_key(d, entry.second.target, "view").words;
    return words.size() == 3 && words[0] == "cameras" && words[1] == name;
  });
}

std::string add_camera(SceneFile& scene, CameraDescription camera) {
  SceneDescription d = scene.description();
  std::string name = "free";
  for (int i = 1; find_named(d.cameras, name) != nullptr; ++i) name = fmt::format("free_{}", i);
  const Json patch = {{"camera", name}, {"cameras", {{name, json_of(section_of(camera))}}}};
  scene.merge(patch.dump(), "view");
  return name;
}

}  // namespace halfspace
