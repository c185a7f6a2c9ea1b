// SPDX-License-Identifier: Apache-2.0
#include "command_line/model_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "command_line/arguments.h"
#include "command_line/errors.h"

namespace halfspace {

namespace {

constexpr double kFar = 1e9;
constexpr const char* kExpectedVector = "three numbers from -1e9 to 1e9, for example 1,0.5,-2";

// Returns the first option that applies only to model files, or an empty string. (--allow-outside also applies to scenes with models.)
std::string first_given(const ModelArguments& a) {
  const std::pair<const char*, bool> options[] = {
      {"--eye", !a.eye.empty()},
      {"--look-at", !a.look_at.empty()},
      {"--up", !a.up.empty()},
      {"--fov", !a.fov.empty()},
      {"--yaw", !a.yaw.empty()},
      {"--pitch", !a.pitch.empty()},
      {"--zoom", !a.zoom.empty()},
      {"--environment", !a.environment.empty()},
      {"--background", !a.background.empty()},
      {"--up-axis", !a.up_axis.empty()},
      {"--scene", !a.model_scene.empty()},
      {"--animation", !a.animation.empty()},
      {"--variant", !a.variant.empty()},
      {"--turntable", !a.turntable.empty()},
      {"--inside", a.inside},
      {"--floor", a.floor},
      {"--no-floor", a.no_floor},
  };
  for (const auto& [name, given] : options) {
    if (given) return name;
  }
  return {};
}

// Parses a vector such as "1,0.5,-2".
glm::dvec3 parse_vector(const char* option, const std::string& text) {
  glm::dvec3 v{};
  std::string_view rest = text;
  for (int k = 0; k < 3; ++k) {
    const std::size_t comma = rest.find(',');
    if ((comma == std::string_view::npos) != (k == 2))
      throw UsageError(fmt::format("{} is '{}'; expected {}", option, text, kExpectedVector));
    v[k] = parse_real(option, rest.substr(0, comma), -kFar, kFar, kExpectedVector);
    if (k < 2) rest.remove_prefix(comma + 1);
  }
  return v;
}

void set_real(double& value, const char* option, const std::string& text, double low, double high, const char* example) {
  if (!text.empty()) value = parse_real(option, text, low, high, example);
}

// Refuses options that would have no effect.
void check_view_options(const ModelArguments& a, const std::string& camera) {
  const std::pair<const char*, bool> orbit[] = {{"--yaw", !a.yaw.empty()}, {"--pitch", !a.pitch.empty()}, {"--zoom", !a.zoom.empty()}};
  for (const auto& [name, given] : orbit) {
    if (given && a.inside) throw UsageError(fmt::format("{} does not apply to --inside; expected --eye and --look-at", name));
    if (given && !a.eye.empty()) throw UsageError(fmt::format("{} does not apply to --eye; expected --look-at", name));
  }
  if (camera.empty() || camera == kFittedCamera) return;
  const std::pair<const char*, bool> fitted[] = {{"--eye", !a.eye.empty()}, {"--look-at", !a.look_at.empty()},     {"--up", !a.up.empty()},
                                                 {"--fov", !a.fov.empty()}, {"--turntable", !a.turntable.empty()}, {"--inside", a.inside}};
  const auto refuse = [&camera](std::span<const std::pair<const char*, bool>> options) {
    for (const auto& [name, given] : options) {
      if (given) throw UsageError(fmt::format("{} changes the fitted camera; expected it without --camera {}", name, camera));
    }
  };
  refuse(orbit);
  refuse(fitted);
}

bool is_background(const std::string& text) {
  const auto is_hex = [](char c) { return std::string_view("0123456789abcdefABCDEF").find(c) != std::string_view::npos; };
  if (text.size() == 7 && text[0] == '#') return std::ranges::all_of(text.substr(1), is_hex);
  return text == "environment" || text == "transparent";
}

ModelView view_of(const ModelArguments& a, double aspect) {
  ModelView v;
  v.aspect = aspect;
  if (!a.eye.empty()) v.eye = parse_vector("--eye", a.eye);
  if (!a.look_at.empty()) v.look_at = parse_vector("--look-at", a.look_at);
  if (!a.up.empty()) v.up = parse_vector("--up", a.up);
  set_real(v.fov, "--fov", a.fov, 1.0, 170.0, "1 to 170 degrees, for example 35");
  set_real(v.yaw, "--yaw", a.yaw, -360.0, 360.0, "-360 to 360 degrees, for example 35");
  set_real(v.pitch, "--pitch", a.pitch, -89.0, 89.0, "-89 to 89 degrees, for example 18");
  set_real(v.zoom, "--zoom", a.zoom, 1e-3, 1e3, "a factor from 0.001 to 1000, for example 1.5");
  v.inside = a.inside;
  if (a.floor && a.no_floor) throw UsageError("--floor and --no-floor cannot be combined; expected at most one of them");
  v.floor = !a.no_floor;
  v.allow_outside = a.allow_outside;
  v.environment = a.environment;
  if (!a.background.empty() && !is_background(a.background))
    throw UsageError("--background is '" + a.background + "'; expected #rrggbb, environment or transparent");
  v.background = a.background;
  v.scene = a.model_scene;
  v.animation = a.animation;
  v.variant = a.variant;
  if (!a.up_axis.empty() && a.up_axis != "y" && a.up_axis != "z") throw UsageError("--up-axis is '" + a.up_axis + "'; expected y or z");
  if (!a.up_axis.empty()) v.up_axis = a.up_axis;
  return v;
}

}  // namespace

std::optional<int> turntable_frames(const ModelArguments& args) {
  if (args.turntable.empty()) return std::nullopt;
  const int frames = parse_number(args.turntable);
  if (frames < 2 || frames > 10000)
    throw UsageError("--turntable is '" + args.turntable + "'; expected a number of frames from 2 to 10000");
  return frames;
}

OpenedScene open_scene_or_model(const std::string& scene, const ModelArguments& args, const std::string& camera, double aspect, double fps,
                                const std::vector<double>& times) {
  if (!is_model_file(scene)) {
    if (const std::string option = first_given(args); !option.empty())
      throw UsageError(option + " applies only to model files; expected a file ending in .obj, .gltf, .glb, .ply or .stl");
    OpenedScene opened = open_scene_or_model(scene, ModelView{});
    if (args.allow_outside) allow_outside(opened.scene);
    return opened;
  }
  check_view_options(args, camera);
  ModelView view = view_of(args, aspect);
  view.times = times;
  if (const std::optional<int> frames = turntable_frames(args)) view.turn_seconds = *frames / fps;
  return open_scene_or_model(scene, view);
}

void allow_outside(SceneFile& scene) {
  std::vector<std::string> settings;
  for (const auto& [name, object] : scene.description().objects) {
    if (object.shape == Shape::file) settings.push_back("objects." + name + ".allow_outside=true");
  }
  scene.set(settings);
}

}  // namespace halfspace
