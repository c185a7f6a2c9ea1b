// SPDX-License-Identifier: Apache-2.0
//
// `halfspace list [SCENE]`: lists the built-in scenes, or every key of one scene.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iostream>

#include "cli/commands.h"
#include "halfspace/core/check.h"
#include "halfspace/render/model_file/model_scene.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace {

namespace {

void list_scenes(bool names) {
  std::size_t width = 0;
  for (const ShippedScene& scene : shipped_scenes()) width = std::max(width, scene.name.size());
  for (const ShippedScene& scene : shipped_scenes()) {
    std::cout << scene.name;
    if (!names) {
      std::cout << std::string(width + 2 - scene.name.size(), ' ') << SceneFile::open(std::string(scene.name)).description().head.title;
    }
    std::cout << '\n';
  }
}

// Prints the value of a key and, if it is different, the default. A second line contains the meaning of the key and the accepted values.
void print_key(const Field& field, const std::string& fallback) {
  const std::string key = field.key->name, value = value_text(field);
  std::string accepts = expectation(*field.key);
  accepts[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(accepts[0])));
  std::cout << fmt::format("  {:<17} {}{}\n{:20}{}. {}.\n", key, value, value == fallback ? "" : " (default " + fallback + ")", "",
                           field.key->help, accepts);
}

void list_keys(const std::string& name) {
  SceneDescription scene = SceneFile::open(name).description();
  const std::string camera = scene.cameras.empty() ? "main" : scene.cameras.front().first;
  std::cout << fmt::format(
      "{}: {}\nTo change a key, use --set PATH.KEY=VALUE, for example --set cameras.{}.fov=30. If the name of an item is unique,\n"
      "the first part of its path can be omitted: --set {}.fov=30. Top-level keys have no path.\n",
      name, scene.head.title, camera, camera);
  for (const NamedSection& s : sections_of(scene)) {
    std::cout << '\n' << (s.path.empty() ? "Top level" : s.path) << ": " << s.help << '\n';
    for (const Field& field : fields_of(s.section)) print_key(field, s.defaults.at(field.key->name));
  }
}

// Prints the paths that --set accepts. They omit the collection unless the short path would be ambiguous.
void list_paths(const std::string& name) {
  SceneDescription scene = SceneFile::open(name).description();
  for (const NamedSection& s : sections_of(scene)) {
    const std::string start = s.path.empty() ? "" : s.path + ".";
    const std::string short_start = start.substr(s.path.find('.') + 1);  // all of it if there is no dot
    for (const Field& field : fields_of(s.section)) {
      const std::string key = field.key->name;
      bool is_short = true;
      try {
        find_key(scene, short_start + key, "");
      } catch (const InputError&) {
        is_short = false;  // the name exists in two collections
      }
      std::cout << (is_short ? short_start : start) << key << '\n';
    }
  }
}

// Throws InputError for a model file, which other commands accept in place of a scene.
void reject_model(const std::string& name) {
  if (!is_model_file(name)) return;
  throw InputError(name + ": is a model file, which has no keys; expected a scene or a scene file (use 'halfspace render " + name +
                   " --print' to print the scene that shows a model)");
}

}  // namespace

void list_command(const ListArguments& args) {
  if (args.schema) {
    std::cout << scene_schema();
  } else if (args.scene.empty()) {
    list_scenes(args.names);
  } else {
    reject_model(args.scene);
    args.names ? list_paths(args.scene) : list_keys(args.scene);
  }
}

}  // namespace halfspace
