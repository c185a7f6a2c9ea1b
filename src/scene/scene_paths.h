// SPDX-License-Identifier: Apache-2.0
//
// Dotted paths: the way from "moon.radius" to the value it names.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/scene/description.h"

namespace halfspace {

/// The key of an object's list of places.
inline constexpr std::string_view kInstances = "instances";

/// A value for people: as in JSON, but a text without quotation marks, and "none" for an empty one.
std::string value_text(const Field& field);

/// A section of a scene with its dotted path ("objects.moon", "" for the head) and its help.
struct NamedSection {
  std::string path;
  std::string help;
  Section section;
  std::map<std::string, std::string> defaults;  ///< of all keys of its kinds, as value_text
};

/// All sections, in the order of a scene file.
std::vector<NamedSection> sections_of(SceneDescription& scene);

/// A key, and the words from the top of the file to it.
struct FoundKey {
  Field field;
  std::vector<std::string> words;
};

/// Finds a key by its dotted path, the collection included or, where one thing alone has the name, not. Throws InputError
/// that begins with `source`.
FoundKey find_key(SceneDescription& scene, std::string_view path, const std::string& source);

/// The section that the words name, or empty where there is none.
Section section_at(SceneDescription& scene, std::span<const std::string> words);

/// The words that stand at the top of a scene file.
std::vector<std::string_view> top_words(SceneDescription& scene);

/// The thing of that name, or null.
template <class T>
T* find_named(std::vector<std::pair<std::string, T>>& list, std::string_view name) {
  for (auto& [thing, value] : list) {
    if (thing == name) return &value;
  }
  return nullptr;
}

template <class T>
std::vector<std::string_view> names_of(const Named<T>& list) {
  std::vector<std::string_view> names;
  for (const auto& entry : list) names.push_back(entry.first);
  return names;
}

}  // namespace halfspace
