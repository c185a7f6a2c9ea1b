// SPDX-License-Identifier: Apache-2.0
//
// Scene files: JSON with comments, strictly checked. A SceneFile is opened by the name of a shipped scene or a file name. Single
// keys can be overridden. It provides the description of the scene at any time of its animations.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

/// A scene that is built into the program.
struct ShippedScene {
  std::string_view name;
  std::string_view text;  ///< contents of the scene file
};

/// Returns all shipped scenes, sorted by name.
std::span<const ShippedScene> shipped_scenes();

class SceneFile {
 public:
  static constexpr int kVersion = 1;

  /// Opens a shipped scene by name, or else a file. Throws InputError ("FILE: PATH: problem; expected ...").
  static SceneFile open(const std::string& name_or_file);
  /// Parses a text. `source` is the start of error messages; `directory` is the base directory of relative paths.
  static SceneFile parse(std::string_view text, const std::string& source, const std::filesystem::path& directory);

  /// Sets keys, for example "moon.radius=2". The collection can be omitted (moon.radius for objects.moon.radius) if the name is unique.
  /// Relative paths are relative to the working directory. Each value is checked when it is set, and the scene once after all of them.
  /// The order of the settings therefore matters only if one of them selects the kind of a section. Throws InputError and leaves the
  /// scene unchanged on errors.
  void set(std::span<const std::string> settings);
  void set(const std::string& setting) { set(std::span(&setting, 1)); }

  /// Applies a JSON merge patch (RFC 7386) to the contents of the scene file, for example to add or remove objects. `source` is the start
  /// of error messages about the patch itself. Throws InputError and leaves the scene unchanged on errors.
  void merge(std::string_view patch, const std::string& source);

  /// Returns the whole scene, without animations applied.
  const SceneDescription& description() const { return description_; }
  /// Returns the scene at a time in seconds, with animated keys set to their values. Throws InputError if a value is outside its
  /// range.
  SceneDescription at(double seconds) const;

  /// Returns the start of error messages about the scene: its file, or "scene NAME".
  const std::string& source() const { return source_; }

  /// Returns the scene as a scene file with every key and absolute paths. Keys of an object that have the same values as in its
  /// material are omitted.
  std::string print() const;

 private:
  SceneDescription with_materials_at(double time) const;

  std::string source_;
  std::filesystem::path directory_;
  std::shared_ptr<const Json> json_;  ///< contents of the file with later settings applied; never null
  SceneDescription description_;
};

/// Returns the JSON Schema of scene files.
std::string scene_schema();

}  // namespace halfspace::HS_LANES
