// SPDX-License-Identifier: Apache-2.0
#include "command_line/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "command_line/command_line.h"

namespace halfspace {

namespace {

// Returns the name of a command as it is typed: "halfspace render".
std::string typed_name(const CLI::App* command) {
  const CLI::App* parent = command->get_parent();
  return (parent == nullptr ? "" : parent->get_name() + " ") + command->get_name();
}

}  // namespace

CLI::Validator not_empty() {
  return {[](const std::string& name) { return std::string(name.empty() ? "the name is empty; expected a name or a file" : ""); }, ""};
}

void print_group(const CLI::App* command, const char* group, const std::string& title) {
  std::cout << title << '\n';
  for (const CLI::Option* option : command->get_options()) {
    if (option->get_group() != group) continue;
    const std::string name = "--" + option->get_lnames().front() + (option->get_type_name().empty() ? "" : " " + option->get_type_name());
    std::cout << fmt::format("  {:<26}{}\n", name, option->get_description());
  }
  throw CLI::Success();
}

void add_set_option(CLI::App* command, std::vector<std::string>& settings) {
  command->add_option("--set", settings, "Set a key (see 'halfspace list SCENE')")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_view_options(CLI::App* command, std::string& camera, std::string& shading, std::string& time) {
  command->add_option("--camera", camera, "Name of one of the scene's cameras")->type_name("NAME")->check(not_empty());
  command->add_option("--shading", shading, "Shading: none, flat, provoking, gouraud or phong")->type_name("RATE");
  command->add_option("--time", time, "Seconds into the animation (default 0)")->type_name("S");
}

void add_limit_options(CLI::App* command, LimitArguments& args, bool is_listed) {
  const char* group = is_listed ? "Options" : kUnlistedGroup;
  command->add_option("--max-memory", args.memory, "Maximum memory for files and images, e.g. 4G")->type_name("SIZE")->group(group);
  command->add_option("--max-pixels", args.pixels, "Maximum pixels of an image (default 268435456)")->type_name("N")->group(group);
}

void add_primitive_limit_option(CLI::App* command, LimitArguments& args, bool is_listed) {
  const char* group = is_listed ? "Options" : kUnlistedGroup;
  command->add_option("--max-primitives", args.primitives, "Maximum primitives of a model (default 50000000)")
      ->type_name("N")
      ->group(group);
}

void add_model_options(CLI::App* command, ModelArguments& args, bool with_turntable) {
  const auto add = [&](const char* name, std::string& value, const char* help, const char* type) {
    command->add_option(name, value, help)->type_name(type)->group(kUnlistedGroup);
  };
  const auto add_flag = [&](const char* name, bool& value, const char* help) {
    command->add_flag(name, value, help)->group(kUnlistedGroup);
  };
  add("--yaw", args.yaw, "Angle around the model, in degrees (default 35)", "A");
  add("--pitch", args.pitch, "Angle above the horizon, in degrees (default 18)", "A");
  add("--zoom", args.zoom, "Divide the camera distance by F (default 1)", "F");
  add("--fov", args.fov, "Vertical field of view, in degrees (default 35)", "DEGREES");
  add("--eye", args.eye, "Position of the camera", "X,Y,Z");
  add("--look-at", args.look_at, "Point at the center of the image", "X,Y,Z");
  add("--up", args.up, "Direction that points up (default 0,1,0)", "X,Y,Z");
  add_flag("--inside", args.inside, "Place the camera inside the model");
  if (with_turntable) add("--turntable", args.turntable, "Render N frames around the model", "N");
  add("--environment", args.environment, "Panorama that lights the model", "FILE");
  add("--background", args.background, "Background: #rrggbb, environment or transparent", "COLOR");
  add_flag("--floor", args.floor, "Draw the shadow below the model (default)");
  add_flag("--no-floor", args.no_floor, "Draw no shadow below the model");
  add("--up-axis", args.up_axis, "Axis that points up: y or z (default: z for STL)", "AXIS");
  add("--scene", args.model_scene, "Scene of the file to render, or its index", "NAME");
  add("--animation", args.animation, "Animation of the file to play, or its index", "NAME");
  add("--variant", args.variant, "Material variant of the file, or its index", "NAME");
  add_flag("--allow-outside", args.allow_outside, "Read files outside the folder of the model");
  command
      ->add_flag_callback(
          "--help-model",
          [command] {
            print_group(
                command, kUnlistedGroup,
                "More options of '" + typed_name(command) + "'. Most of them apply only to model files (.obj .gltf .glb .ply .stl).");
          },
          "Print these options and exit")
      ->group(kUnlistedGroup);
}

}  // namespace halfspace
