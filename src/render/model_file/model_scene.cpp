// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/model_file/model_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/text.h"
#include "halfspace/core/units.h"
#include "halfspace/core/vec.h"
#include "halfspace/model/pose/pose.h"
#include "halfspace/model/up_axis_hint.h"
#include "halfspace/render/model_file/frame_model.h"
#include "halfspace/scene/path_text.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace::HS_LANES {

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr double kPi = std::numbers::pi;

OrderedJson json_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// How the scene places the model. A model that is far from the origin compared with its size is moved to the origin. A very small or large
// model is scaled by a power of ten, because the keys of scene files have limits. Otherwise, the scene has the units of the file.
struct Frame {
  glm::dvec3 origin{0.0};
  double scale = 1.0;

  glm::dvec3 point(const glm::dvec3& p) const { return (p - origin) * scale; }
};

Frame frame_of(const ModelBounds& b, const std::filesystem::path& file) {
  constexpr double kFar = 100.0, kSmall = 1e-2, kLarge = 1e4, kSmallest = 0.5 / kMaxCount, kLargest = 1e15;
  if (b.radius < kSmallest) {
    throw InputError(fmt::format("{}: the model is too small to be scaled: the radius of its bounds is {:.3g}; expected at least {:g}",
                                 file.string(), b.radius, kSmallest));
  }
  if (b.radius > kLargest) {
    throw InputError(fmt::format("{}: the model is too large to be scaled: the radius of its bounds is {:.3g}; expected at most {:g}",
                                 file.string(), b.radius, kLargest));
  }
  Frame frame;
  if (glm::length(b.center) > kFar * b.radius) frame.origin = b.center;
  if (b.radius < kSmall || b.radius > kLarge) {
    double radius = b.radius;
    for (; radius < 0.5; radius *= 10.0) frame.scale *= 10.0;
    for (; radius >= 5.0; radius /= 10.0) frame.scale /= 10.0;
  }
  return frame;
}

// Throws InputError if the camera has no horizontal axis (see the check of cameras in scene_check.cpp).
void check_up(const glm::dvec3& up, const glm::dvec3& eye, const glm::dvec3& target) {
  if (up == glm::dvec3(0.0)) throw InputError("--up: is zero; expected a direction, for example 0,1,0");
  const glm::dvec3 ahead = unit_or_zero(target - eye), side = glm::cross(ahead, unit_or_zero(up));
  if (glm::dot(side, side) > 1e-24) return;
  throw InputError(
      fmt::format("--up: {:g},{:g},{:g} is parallel to the line from the eye to the target; expected another direction, for example {}",
                  up.x, up.y, up.z, std::abs(ahead.z) < 0.5 ? "0,0,-1" : "0,1,0"));
}

// Throws InputError if the eye is so far away that the range of the camera exceeds the limit of scene files.
void check_distance(double far, const ModelBounds& b, const Frame& frame) {
  if (far <= kMaxCount) return;
  throw InputError(
      fmt::format("--eye: is too far from the model; expected a distance of at most {:.3g}", kMaxCount / frame.scale - 20.0 * b.radius));
}

// Returns the distance of the near plane in the units of the scene, or 0 if it must not cut off anything (near_plane() in view.h). A camera
// that is outside of the bounding sphere and looks at the model needs no such plane.
double near_of(const ModelView& view, double distance, double radius) {
  if (view.eye || view.look_at || view.inside) return 0.0;
  const double in_front = 0.5 * (distance - 1.5 * radius), close = 1e-3 * radius;
  // A camera that is not moved by a zoom or a turntable keeps more than this distance from all vertices (see frame_model).
  if (in_front < close && (view.zoom > 1.0 || view.turn_seconds > 0.0)) return 0.0;
  return std::max(close, in_front);
}

OrderedJson fitted_camera(const ModelPoses& poses, const ModelBounds& b, const Frame& frame, const ModelView& view) {
  glm::dvec3 target = view.look_at.value_or(b.center), eye = target;
  if (view.eye) {
    eye = *view.eye;
  } else if (view.inside) {
    const glm::dvec3 along = b.half.x >= b.half.z ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
    eye = b.center - along * (0.6 * glm::dot(along, b.half)) - glm::dvec3(0, 0.35 * b.half.y, 0);
    target = view.look_at.value_or(eye + along * b.radius);
  } else {
    const FramedView framed = frame_model(poses, b, view);
    target = view.look_at.value_or(framed.target);
    eye = framed.eye + (target - framed.target);
  }
  if (view.look_at && eye == target) throw InputError("--look-at: is the position of the eye; expected another point");
  if (eye == target) target = eye + glm::dvec3(0, 0, -1) * b.radius;
  const double distance = glm::distance(eye, b.center) * frame.scale, radius = b.radius * frame.scale, far = distance + 20.0 * radius;
  check_up(view.up, eye, target);
  if (view.eye) check_distance(far, b, frame);
  return {{"position", json_of(frame.point(eye))},
          {"target", json_of(frame.point(target))},
          {"up", json_of(view.up)},
          {"fov", view.fov},
          {"near", near_of(view, distance, radius)},
          {"far", far}};
}

// Returns a name for a scene file that is similar to a name in the model: a letter a to z followed by letters a to z, digits and '_', not
// reserved and not used before.
std::string scene_name(const std::string& name, const char* fallback, std::set<std::string>& used) {
  static const std::vector<std::string_view> reserved = [] {
    static SceneDescription empty;
    return top_words(empty);
  }();
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_lower = [](char c) { return c >= 'a' && c <= 'z'; };
  std::string word = name;
  for (char& c : word) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (!is_digit(c) && !is_lower(c)) c = '_';
  }
  if (word.empty()) word = fallback;
  if (!is_lower(word[0])) word.insert(0, std::string(fallback) + "_");
  std::string unique = word;
  for (int i = 1; used.contains(unique) || std::ranges::find(reserved, unique) != reserved.end(); ++i)
    unique = fmt::format("{}_{}", word, i);
  used.insert(unique);
  return unique;
}

OrderedJson cameras_of(const ModelPoses& poses, const ModelBounds& b, const Frame& frame, const ModelView& view,
                       std::map<std::string, std::string>& names) {
  OrderedJson cameras = {{kFittedCamera, fitted_camera(poses, b, frame, view)}};
  std::set<std::string> used{kFittedCamera};
  std::map<std::string, std::string> names_of_nodes;
  for (const PosedCamera& placed : poses.first().cameras) {
    const ModelCamera& c = poses.model().cameras[static_cast<std::size_t>(placed.camera)];
    const glm::dvec3 eye(placed.world_from_camera[3]), ahead(-placed.world_from_camera[2]);
    const double far = std::isfinite(c.far) ? c.far : glm::distance(eye, b.center) + 100.0 * b.radius;
    const double near = std::clamp(c.near * frame.scale, 1e-6, 0.25 * kMaxCount);
    OrderedJson camera = {{"type", c.perspective ? "perspective" : "orthographic"},
                          {"position", json_of(frame.point(eye))},
                          {"target", json_of(frame.point(eye + glm::normalize(ahead) * b.radius))},
                          {"up", json_of(glm::dvec3(placed.world_from_camera[1]))},
                          {"near", near},
                          {"far", std::clamp(far * frame.scale, 2.0 * near, kMaxCount)}};
    if (c.perspective) {
      camera["fov"] = std::clamp(c.fovy / kRadiansPerDegree, 0.01, 179.0);
    } else {
      camera["height"] = std::clamp(c.height * frame.scale, 1e-6, kMaxCount);
    }
    const std::string name = scene_name(c.name, "camera", used);
    if (!c.name.empty()) names.try_emplace(c.name, name);
    if (const std::string& node = poses.model().nodes[static_cast<std::size_t>(placed.node)].name; !node.empty())
      names_of_nodes.try_emplace(node, name);
    cameras[name] = std::move(camera);
  }
  names.merge(names_of_nodes);  // names of cameras take precedence
  return cameras;
}

// Returns the lights of the file. Candela and lux are divided by π, because a white surface that faces a light of intensity 1 has a
// radiance of 1.
OrderedJson lights_of(const Model& model, const PosedModel& posed, const Frame& frame) {
  OrderedJson lights = OrderedJson::object();
  std::set<std::string> used;
  for (const PosedLight& placed : posed.lights) {
    const ModelLight& l = model.lights[static_cast<std::size_t>(placed.light)];
    const glm::dvec3 back(glm::normalize(glm::dvec3(placed.world_from_light[2])));
    OrderedJson light = {{"color", json_of(glm::dvec3(l.color))}, {"intensity", std::min(l.intensity / kPi, kMaxCount)}};
    if (l.type == ModelLightType::directional) {
      light["type"] = "directional";
      light["direction"] = json_of(back);
    } else {
      light["type"] = l.type == ModelLightType::spot ? "spot" : "point";
      light["position"] = json_of(frame.point(glm::dvec3(placed.world_from_light[3])));
      light["intensity"] = std::min(l.intensity / kPi * frame.scale * frame.scale, kMaxCount);
      light["falloff"] = "physical";
      if (l.range > 0.0 && l.range * frame.scale < kMaxCount) light["range"] = l.range * frame.scale;
    }
    if (l.type == ModelLightType::spot) {
      light["direction"] = json_of(back);
      light["inner"] = l.inner / kRadiansPerDegree;
      light["outer"] = std::max(l.outer / kRadiansPerDegree, 0.01);
    }
    lights[scene_name(l.name, "light", used)] = std::move(light);
  }
  return lights;
}

// Returns the width of shadow maps. Together, the maps of many lights have at most as many texels as those of eight lights, down to the
// smallest width of a map.
int shadow_map_width(std::size_t lights) {
  int width = 1024;
  for (std::size_t full = 8; lights > full && width > kMinShadowTexels; full *= 4) width /= 2;
  return width;
}

// A soft light from above, to the left of the eye.
OrderedJson key_light(const ModelView& view) {
  ModelView from = view;
  from.yaw -= 50.0;
  from.pitch = 52.0;
  return {{"key", {{"type", "directional"}, {"direction", json_of(eye_direction(from))}, {"intensity", 1.2}}}};
}

}  // namespace

bool is_model_file(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension == ".obj" || extension == ".gltf" || extension == ".glb" || extension == ".ply" || extension == ".stl";
}

namespace {

// A camera that goes around its target once in `seconds`.
OrderedJson turntable(const OrderedJson& camera, double seconds) {
  const auto vector = [&](const char* key) {
    return glm::dvec3(camera.at(key)[0].get<double>(), camera.at(key)[1].get<double>(), camera.at(key)[2].get<double>());
  };
  const glm::dvec3 target = vector("target"), arm = vector("position") - target;
  return {{"type", "orbit"},
          {"target", "cameras.view.position"},
          {"center", json_of(target + glm::dvec3(0, arm.y, 0))},
          {"a", json_of({arm.x, 0, arm.z})},
          {"b", json_of({arm.z, 0, -arm.x})},
          {"period", seconds}};
}

// Returns the animation that plays: that of the view or, if the view has times, the first of the file. Adds a warning if that is a choice.
std::string animation_of(Model& model, const ModelView& view) {
  const std::vector<ModelAnimation>& all = model.animations;
  if (!view.animation.empty() || view.times.empty() || all.empty()) return view.animation;
  const auto label = [&](std::size_t i) { return all[i].name.empty() ? std::to_string(i) : all[i].name; };
  if (all.size() > 1) {
    constexpr std::size_t kMaxNames = 20;
    std::string others;
    for (std::size_t i = 1; i < std::min(all.size(), kMaxNames); ++i) others += (i == 1 ? "" : ", ") + label(i);
    if (all.size() > kMaxNames) others += ", ...";
    model.warnings.push_back(
        fmt::format("the animation '{}' plays, the first of {}; use --animation to select another: {}", label(0), all.size(), others));
  }
  return label(0);
}

UpAxis up_axis_of(const Model& model, const std::string& name) { return name == "y" ? UpAxis::y : name == "z" ? UpAxis::z : model.up; }

}  // namespace

GeneratedScene model_scene(const std::filesystem::path& file, const ModelView& view) {
  const FloatMode float_mode;
  Model contents = read_model(file, {.allow_outside = view.allow_outside});
  if (view.up_axis == "auto") {
    if (const std::string hint = up_axis_hint(contents); !hint.empty()) contents.warnings.push_back(hint);
  }
  contents.up = up_axis_of(contents, view.up_axis);
  const std::string animation = animation_of(contents, view);
  const auto asset = std::make_shared<const ModelAsset>(std::move(contents), view.allow_outside);
  const Model& model = asset->model;
  ObjectDescription shown;
  shown.model_scene = view.scene;
  shown.model_animation = animation;
  shown.model_variant = view.variant;
  const ModelPoses poses(model, pose_options(model, shown, {"--scene", "--animation", "--variant", file.string()}),
                         view.times.empty() ? std::vector{0.0} : view.times);
  const PosedModel& posed = poses.first();
  const ModelBounds b = bounds_of(poses, file);
  const Frame frame = frame_of(b, file);
  const bool own_lights = !posed.lights.empty();
  OrderedJson scene = {{"version", 1}, {"title", printable(file.filename().string())}, {"samples", 4}, {"camera", kFittedCamera}};
  std::map<std::string, std::string> camera_names;
  scene["cameras"] = cameras_of(poses, b, frame, view, camera_names);
  scene["lights"] = own_lights ? lights_of(model, posed, frame) : key_light(view);
  OrderedJson environment = {{"type", "studio"}, {"size", 256}, {"brightness", 0.75}};
  if (!view.environment.empty()) environment = {{"type", "equirect"}, {"map", scene_text(view.environment)}};
  scene["environments"] = {{"around", environment}};
  scene["reflections"] = {{"environment", "around"}};
  if (view.background == "environment") {
    scene["background"] = {{"type", "environment"}, {"environment", "around"}};
  } else if (view.background == "transparent") {
    scene["background"] = {{"type", "transparent"}};
  } else if (!view.background.empty()) {
    scene["background"] = {{"color", view.background}};
  } else {
    scene["background"] = {{"color", {0.62, 0.63, 0.65}}};
  }
  scene["post"] = {{"hdr", true}, {"tone", "aces"}, {"exposure", 0.62}};
  scene["shadow"] = {{"method", "pcf7"}, {"resolution", shadow_map_width(posed.lights.size())}, {"faces", "both"}};
  OrderedJson object = {{"shape", "file"}, {"file", scene_text(std::filesystem::absolute(file).lexically_normal())}};
  if (frame.origin != glm::dvec3(0.0)) object["position"] = json_of(-frame.origin * frame.scale);
  if (frame.scale != 1.0) object["scale"] = json_of(glm::dvec3(frame.scale));
  if (view.up_axis != "auto") object["up_axis"] = view.up_axis;
  if (!view.scene.empty()) object["model_scene"] = view.scene;
  if (view.allow_outside) object["allow_outside"] = true;
  if (!animation.empty()) object["model_animation"] = animation;
  if (!view.variant.empty()) object["model_variant"] = view.variant;
  scene["objects"] = {{"model", object}};
  OrderedJson animations = OrderedJson::object();
  if (!animation.empty()) animations["clock"] = {{"type", "rate"}, {"target", "objects.model.model_time"}, {"rate", 1}};
  if (view.turn_seconds > 0.0) animations["turntable"] = turntable(scene["cameras"][kFittedCamera], view.turn_seconds);
  if (!animations.empty()) scene["animations"] = animations;
  if (view.floor && !view.inside) {
    const glm::dvec3 below = b.center - glm::dvec3(0, b.half.y + 1e-4 * b.radius, 0);
    scene["objects"]["floor"] = {
        {"shape", "plane"}, {"shadow_only", true}, {"size", 6.0 * b.radius * frame.scale}, {"position", json_of(frame.point(below))}};
  }
  try {
    return {scene.dump(1), asset, std::move(camera_names), b.radius * frame.scale};
  } catch (const OrderedJson::type_error&) {
    throw InputError(file.string() + ": a name or option is not valid UTF-8; expected text that a scene file can contain");
  }
}

}  // namespace halfspace::HS_LANES
