// SPDX-License-Identifier: Apache-2.0
//
// `halfspace list [SCENE]`: lists the built-in scenes, or every key of one scene.
#include <algorithm>
#include <iostream>

#include "cli/commands.h"
#include "halfspace/core/check.h"
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

void list_keys(const std::string& name) {
  SceneDescription scene = SceneFile::open(name).description();
  std::cout << name << ": " << scene.head.title
            << "\nUse --set PATH.KEY=VALUE to set a key. The collection (cameras, lights, ...) can be omitted from the path.\n";
  for (const NamedSection& s : sections_of(scene)) {
    std::cout << '\n' << (s.path.empty() ? "(top)" : s.path) << "  -- " << s.help << '\n';
    for (const Field& field : fields_of(s.section)) {
      const std::string key = field.key->name;
      std::cout << "  " << key << std::string(key.size() < 18 ? 18 - key.size() : 1, ' ') << value_text(field) << " (default "
                << s.defaults.at(key) << ")\n"
                << std::string(20, ' ') << field.key->help << ": " << expectation(*field.key) << '\n';
    }
  }
}

// Prints the paths that --set accepts, without the collection unless the short path is ambiguous.
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

}  // namespace

void list_command(const ListArguments& args) {
  if (args.schema) {
    std::cout << scene_schema();
  } else if (args.scene.empty()) {
    list_scenes(args.names);
  } else {
    args.names ? list_paths(args.scene) : list_keys(args.scene);
  }
}

}  // namespace halfspace
