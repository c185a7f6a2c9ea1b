// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/scene_paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "halfspace/core/check.h"
#include "halfspace/core/text.h"

namespace halfspace::HS_LANES {

namespace {

std::vector<std::string> split(std::string_view path) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    words.emplace_back(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

std::string joined(std::span<const std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ".") + word;
  return text;
}

bool contains(const std::vector<std::string_view>& names, std::string_view name) { return std::ranges::find(names, name) != names.end(); }

// Returns whether the words are the full path of a section or of a key.
bool exists(SceneDescription& scene, std::span<const std::string> words) {
  if (!section_at(scene, words).empty()) return true;
  return words.size() > 1 && find_field(section_at(scene, words.first(words.size() - 1)), words.back()).key != nullptr;
}

// Like exists(), but the path may omit the collection.
bool exists_anywhere(SceneDescription& scene, const std::vector<std::string>& words) {
  bool found = exists(scene, words);
  for_each_collection(scene, [&](const char* collection, const char*, auto&) {
    if (found) return;
    std::vector<std::string> whole = words;
    whole.insert(whole.begin(), collection);
    found = exists(scene, whole);
  });
  return found;
}

// Joins the words of a name that contains dots, such as "Cube.001". Returns the split that names something or, if none does, the one with
// the longest name.
std::vector<std::string> with_joined_name(SceneDescription& scene, const std::vector<std::string>& words) {
  std::vector<std::string> best = words;
  bool found = false;
  for_each_collection(scene, [&](const char* collection, const char*, auto& list) {
    const std::size_t first = words[0] == collection ? 1 : 0;
    for (std::size_t end = first + 2; end <= words.size() && !found; ++end) {
      const std::string name = joined(std::span(words).subspan(first, end - first));
      if (find_named(list, name) == nullptr) continue;
      best = {collection, name};
      best.insert(best.end(), words.begin() + static_cast<std::ptrdiff_t>(end), words.end());
      found = exists(scene, best);
    }
  });
  return best;
}

// Prepends the collection to a path that omits it.
void complete(std::vector<std::string>& words, SceneDescription& scene, const std::string& where) {
  std::vector<std::string_view> names = top_words(scene);
  if (contains(names, words[0])) return;
  std::vector<std::string> homes;
  for_each_collection(scene, [&](const char* name, const char*, auto& list) {
    if (find_named(list, words[0]) != nullptr) homes.emplace_back(name);
    const std::vector<std::string_view> things = names_of(list);
    names.insert(names.end(), things.begin(), things.end());
  });
  if (homes.empty()) throw InputError(where + "no '" + words[0] + "' in this scene" + suggestion(words[0], names));
  if (homes.size() > 1) {
    throw InputError(where + "'" + words[0] + "' is in " + homes[0] + " and in " + homes[1] +
                     "; expected a path that begins with one of them");
  }
  words.insert(words.begin(), homes[0]);
}

// Returns the words of the full path. where: the start of error messages.
std::vector<std::string> words_of(SceneDescription& scene, std::string_view path, const std::string& where) {
  std::vector<std::string> words = split(path);
  if (!exists_anywhere(scene, words)) words = with_joined_name(scene, words);
  if (words.size() > 1 || !contains(top_words(scene), words[0])) complete(words, scene, where);
  return words;
}

// Returns the names that may follow words[0], for suggestions if words[1] is unknown.
std::vector<std::string_view> member_names(SceneDescription& scene, std::string_view collection) {
  std::vector<std::string_view> names;
  for_each_collection(scene, [&](const char* name, const char*, auto& list) {
    if (name == collection) names = names_of(list);
  });
  return names;
}

template <class T>
std::map<std::string, std::string> defaults_of() {
  T fresh;
  std::map<std::string, std::string> texts;
  for (const Fields& part : section_of(fresh)) {
    for (const Key& key : part.keys) texts[key.name] = value_text({&key, key.member(part.data)});
  }
  return texts;
}

}  // namespace

std::string value_text(const Field& field) {
  const Json value = value_of(field);
  if (!value.is_string()) return value.dump();
  const std::string text = value.get<std::string>();
  return text.empty() ? "none" : text;
}

std::vector<std::string_view> top_words(SceneDescription& scene) {
  std::vector<std::string_view> words{"version", "$schema"};
  for (const Field& f : fields_of(section_of(scene.head))) words.emplace_back(f.key->name);
  for_each_single(scene, [&](const char* name, const char*, auto&) { words.emplace_back(name); });
  for_each_collection(scene, [&](const char* name, const char*, auto&) { words.emplace_back(name); });
  return words;
}

Section section_at(SceneDescription& scene, std::span<const std::string> words) {
  if (words.empty()) return section_of(scene.head);
  Section section;
  for_each_single(scene, [&](const char* name, const char*, auto& value) {
    if (words.size() == 1 && words[0] == name) section = section_of(value);
  });
  for_each_collection(scene, [&](const char* name, const char*, auto& list) {
    if (words.size() < 2 || words[0] != name) return;
    auto* thing = find_named(list, words[1]);
    if (thing == nullptr) return;
    if (words.size() == 2) section = section_of(*thing);
    if constexpr (std::is_same_v<std::decay_t<decltype(*thing)>, ObjectDescription>) {
      if (words.size() != 4 || words[2] != kInstances) return;
      std::size_t i = 0;
      const auto [end, error] = std::from_chars(words[3].data(), words[3].data() + words[3].size(), i);
      const bool is_number = error == std::errc() && end == words[3].data() + words[3].size();
      if (is_number && i < thing->instances.size()) section = section_of(thing->instances[i]);
    }
  });
  return section;
}

std::vector<NamedSection> sections_of(SceneDescription& scene) {
  std::vector<NamedSection> sections{{"", "General settings", section_of(scene.head), defaults_of<SceneHead>()}};
  for_each_collection(scene, [&](const char* name, const char* help, auto& list) {
    using T = typename std::decay_t<decltype(list)>::value_type::second_type;
    for (auto& [thing, value] : list) {
      const std::string path = std::string(name) + "." + thing;
      sections.push_back({path, help, section_of(value), defaults_of<T>()});
      if constexpr (std::is_same_v<T, ObjectDescription>) {
        for (std::size_t i = 0; i < value.instances.size(); ++i) {
          sections.push_back({fmt::format("{}.{}.{}", path, kInstances, i), "A copy of the object, placed relative to it",
                              section_of(value.instances[i]), defaults_of<Placement>()});
        }
      }
    }
  });
  for_each_single(scene, [&](const char* name, const char* help, auto& value) {
    sections.push_back({name, help, section_of(value), defaults_of<std::decay_t<decltype(value)>>()});
  });
  return sections;
}

Section find_section(SceneDescription& scene, std::string_view path, const std::string& source) {
  return section_at(scene, words_of(scene, path, source + ": " + std::string(path) + ": "));
}

FoundKey find_key(SceneDescription& scene, std::string_view path, const std::string& source) {
  const std::string where = source + ": " + std::string(path) + ": ";
  const std::vector<std::string> words = words_of(scene, path, where);
  if (!section_at(scene, words).empty()) throw InputError(where + "is a section; expected " + joined(words) + ".KEY");
  const Section section = section_at(scene, std::span(words).first(words.size() - 1));
  if (section.empty()) {
    const std::vector<std::string_view> things = member_names(scene, words[0]);
    if (words.size() > 2 && contains(things, words[1]))
      throw InputError(where + "no such key; expected " + words[0] + "." + words[1] + ".KEY");
    const std::string_view thing = words.size() > 1 ? std::string_view(words[1]) : std::string_view(words[0]);
    throw InputError(where + "no '" + std::string(thing) + "' in " + words[0] + suggestion(thing, things));
  }
  const Field field = find_field(section, words.back());
  if (field.key != nullptr) return {field, words};
  std::vector<std::string_view> names;
  for (const Field& f : fields_of(section)) names.emplace_back(f.key->name);
  throw InputError(where + "unknown key '" + words.back() + "'" + suggestion(words.back(), names));
}

std::string object_name(const SceneDescription& scene, int object) {
  if (object < 0) return "background";
  const auto i = static_cast<std::size_t>(object), objects = scene.objects.size();
  if (i < objects) return scene.objects[i].first;
  return i == objects ? "particles" : scene.particle_systems.at(i - objects - 1).first;
}

std::string object_path(const SceneDescription& scene, int object) {
  const auto objects = static_cast<int>(scene.objects.size());
  const std::string name = object_name(scene, object);
  if (object < 0 || object == objects) return name;
  return (object < objects ? "objects." : "particle_systems.") + name;
}

}  // namespace halfspace::HS_LANES
