// SPDX-License-Identifier: Apache-2.0
//
// Dotted paths, such as "moon.radius", and the values they name.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/scene/description.h"

namespace halfspace::HS_LANES {

/// Key of an object's list of placements.
inline constexpr std::string_view kInstances = "instances";

/// Formats a value for display: as JSON, but strings have no quotation marks and empty strings are "none".
std::string value_text(const Field& field);

/// A section of a scene with its dotted path ("objects.moon", or "" for the top level) and its help text.
struct NamedSection {
  std::string path;
  std::string help;
  Section section;
  std::map<std::string, std::string> defaults;  ///< default of every key of every kind, formatted by value_text
};

/// Returns all sections, in the order of a scene file.
std::vector<NamedSection> sections_of(SceneDescription& scene);

/// A key and the words of its full path.
struct FoundKey {
  Field field;
  std::vector<std::string> words;
};

/// Finds a key by its dotted path. The collection can be omitted if the name of the item is unique. Names may contain dots. Throws
/// InputError with a message that begins with `source`.
FoundKey find_key(SceneDescription& scene, std::string_view path, const std::string& source);

/// Returns the section with a dotted path, or an empty section if that path is a key. The collection can be omitted as for find_key().
/// Throws InputError with a message that begins with `source`.
Section find_section(SceneDescription& scene, std::string_view path, const std::string& source);

/// Returns the section named by the words, or an empty section if there is none.
Section section_at(SceneDescription& scene, std::span<const std::string> words);

/// Returns the reserved words at the top level of a scene file.
std::vector<std::string_view> top_words(SceneDescription& scene);

/// Returns the name of the object or particle system with the given index in FrameImages::object (render/frame/frame.h): "particles" for
/// the first particle system, and "background" for −1.
std::string object_name(const SceneDescription& scene, int object);
/// Like object_name, but returns the path, for example "objects.moon".
std::string object_path(const SceneDescription& scene, int object);

/// Returns the item with that name, or null.
template <class List>
auto* find_named(List& list, std::string_view name) {
  for (auto& [thing, value] : list) {
    if (thing == name) return &value;
  }
  return static_cast<decltype(&list.front().second)>(nullptr);
}

template <class T>
std::vector<std::string_view> names_of(const Named<T>& list) {
  std::vector<std::string_view> names;
  for (const auto& entry : list) names.push_back(entry.first);
  return names;
}

}  // namespace halfspace::HS_LANES
