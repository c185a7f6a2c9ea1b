// SPDX-License-Identifier: Apache-2.0
//
// Scene files: JSON with comments, read strictly. In: a shipped scene's name or a file, and settings of single keys.
// Out: the description of the scene at a time.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "halfspace/scene/description.h"

namespace halfspace {

/// A scene that is built into the program.
struct ShippedScene {
  std::string_view name;
  std::string_view text;  ///< the scene file
};

/// All scenes that ship, by name.
std::span<const ShippedScene> shipped_scenes();

class SceneFile {
 public:
  static constexpr int kVersion = 1;

  /// A shipped scene's name, or else a file. Throws InputError ("FILE: PATH: what is wrong; what would be right").
  static SceneFile open(const std::string& name_or_file);
  /// From a text; `source` begins messages, `directory` is what its relative paths are relative to.
  static SceneFile parse(std::string_view text, const std::string& source, const std::filesystem::path& directory);

  /// Sets keys: "moon.radius=2". The collection may be left out (objects.moon.radius is moon.radius) where the name is that
  /// of one thing alone. Relative paths are relative to the working directory. Each value is checked against its key, the
  /// scene when all are set, so that their order matters only where one says of what kind a thing is. Throws InputError, and
  /// then has changed nothing.
  void set(std::span<const std::string> settings);
  void set(const std::string& setting) { set(std::span(&setting, 1)); }

  /// The whole scene, at the start of time.
  const SceneDescription& description() const { return description_; }
  /// The scene at a time in seconds: animated keys have their values then. Throws InputError where one leaves its range.
  SceneDescription at(double seconds) const;

  /// What messages about the scene begin with: its file, or "scene NAME".
  const std::string& source() const { return source_; }

  /// The scene with every key, absolute paths, ready to be read again. An object's keys that say what its material says are
  /// left out.
  std::string print() const;

 private:
  std::string source_;
  std::filesystem::path directory_;
  std::shared_ptr<const Json> json_;  ///< as read, and set since; never null
  SceneDescription description_;
};

/// The JSON Schema of scene files.
std::string scene_schema();

}  // namespace halfspace
