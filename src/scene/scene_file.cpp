// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/scene_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "halfspace/core/check.h"
#include "halfspace/core/float_mode.h"
#include "halfspace/core/text.h"
#include "halfspace/scene/animation.h"
#include "halfspace/scene/material_overrides.h"
#include "halfspace/scene/object_keys.h"
#include "halfspace/scene/scene_check.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace::HS_LANES {

namespace {

constexpr std::size_t kMaxBytes = std::size_t{4} << 20;
constexpr std::size_t kMaxNames = 4096;  // limit on names in one object and on elements in one list
constexpr int kMaxLevels = 32;

[[noreturn]] void fail(const std::string& source, const std::string& what) { throw InputError(source + ": " + what); }

// ---- text → JSON -----------------------------------------------------------------------------------------------

// Iterator over a text that keeps track of how much of it the parser has read.
class TrackedText {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  TrackedText(const char* at, const char*& read) : at_(at), read_(&read) {}
  reference operator*() const { return *at_; }
  TrackedText& operator++() {
    *read_ = ++at_;
    return *this;
  }
  bool operator==(const TrackedText& other) const { return at_ == other.at_; }

 private:
  const char* at_;
  const char** read_;
};

// Parser callback that rejects duplicate names in an object, which JSON libraries silently drop, and deep nesting, which could exhaust the
// stack. read: end of the part of the text that has been read, which is behind the name when the parser reports a name.
class OnceOnly {
 public:
  OnceOnly(std::string_view text, const char* const& read, const std::string& source) : text_(text), read_(read), source_(source) {}
  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > kMaxLevels) fail_at(read_ - 1, fmt::format("is nested deeper than {} levels; expected fewer", kMaxLevels));
    if (event == Json::parse_event_t::object_start) names_.emplace_back();
    if (event == Json::parse_event_t::object_end) names_.pop_back();
    if (event == Json::parse_event_t::key && !names_.back().insert(parsed.get<std::string>()).second) {
      fail_at(start_of_name(), "'" + parsed.get<std::string>() + "' occurs twice in one object; expected each name once");
    }
    if (!names_.empty() && names_.back().size() > kMaxNames)
      fail_at(read_ - 1, fmt::format("an object has more than {} names; expected fewer", kMaxNames));
    return true;
  }

 private:
  [[noreturn]] void fail_at(const char* place, const std::string& what) const {
    fail(source_ + ":" + line_and_column(text_, static_cast<std::size_t>(place - text_.data()) + 1), what);
  }

  // Returns the quote at the start of the name that was read last. Quotes within the name follow an odd number of backslashes.
  const char* start_of_name() const {
    for (const char* quote = read_ - 2;; --quote) {
      if (*quote != '"') continue;
      const char* other = quote;
      while (other[-1] == '\\') --other;
      if ((quote - other) % 2 == 0) return quote;
    }
  }

  std::string_view text_;
  const char* const& read_;
  const std::string& source_;
  std::vector<std::set<std::string>> names_;
};

Json parse_json(std::string_view text, const std::string& source) {
  try {
    const char* read = text.data();
    return Json::parse(TrackedText(text.data(), read), TrackedText(text.data() + text.size(), read), OnceOnly(text, read, source), true,
                       true);
  } catch (const Json::parse_error& e) {
    fail(source + ":" + line_and_column(text, e.byte), "invalid JSON: " + json_problem(e));
  } catch (const Json::out_of_range& e) {
    const std::string problem = json_problem(e);
    fail(source + ":" + line_and_column(text, position_of_quoted(text, problem)), problem + "; expected a finite number");
  }
}

std::string read_text(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) fail(path.string(), "no such scene file");
  if (!std::filesystem::is_regular_file(path, error)) fail(path.string(), "is not a regular file; expected a scene file");
  if (std::filesystem::file_size(path, error) > kMaxBytes) fail(path.string(), "is larger than 4 MiB; expected a scene file");
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path.string(), std::string("cannot be read (") + std::strerror(errno) + ")");
  return {std::istreambuf_iterator<char>(file), {}};
}

constexpr const char* kExpectedFormats = "expected a scene file (JSON), or a model file ending in .obj, .gltf, .glb, .ply or .stl";

// Throws if the file does not begin like a scene file. Files that are not scenes at all, such as a model whose name has no extension, get a
// message that lists the formats instead of one about JSON.
void check_format(const std::filesystem::path& path) {
  std::error_code error;
  if (path.extension() == ".json" || !std::filesystem::is_regular_file(path, error)) return;
  std::string start(4096, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  const std::size_t mark = start.starts_with("\xef\xbb\xbf") ? 3 : 0, first = start.find_first_not_of(" \t\r\n", mark);
  if (first != std::string::npos && (start[first] == '{' || start[first] == '/')) return;
  fail(path.string(), std::string("the format is not recognized; ") + kExpectedFormats);
}

// ---- JSON → description ----------------------------------------------------------------------------------------

// Names do not contain characters that have another meaning where names are used: '=' and ',' in settings and lists, '#' before colors, and
// blanks at the ends.
bool is_name(std::string_view s) {
  const auto allowed = [](char c) { return static_cast<unsigned char>(c) >= 32 && c != 127 && c != '=' && c != ','; };
  return !s.empty() && s.front() != '#' && s.front() != ' ' && s.back() != ' ' && std::ranges::all_of(s, allowed);
}

class Reader {
 public:
  Reader(const Json& json, const ReadContext& context) : json_(json), context_(context) {}

  SceneDescription read() {
    if (!json_.is_object()) fail(context_.source, "expected an object { … }");
    check_version();
    std::vector<std::string_view> sections = top_words(scene_);
    top_words_ = sections;
    std::erase_if(sections, [&](std::string_view name) { return find_field(section_of(scene_.head), name).key != nullptr; });
    read_section(section_of(scene_.head), json_, "", context_, sections);
    for_each_single(scene_, [&](const char* name, const char*, auto& value) {
      if (json_.contains(name)) read_section(section_of(value), json_[name], name, context_);
    });
    for (const auto& [name, texture] : collection("textures").items()) texture_names_.push_back(name);
    context_.textures = texture_names_;
    for_each_collection(scene_, [&](const char* name, const char*, auto& list) { read_collection(name, list); });
    if (scene_.cameras.empty()) scene_.cameras.emplace_back("main", CameraDescription{});
    check_scene(scene_, context_.source);
    return std::move(scene_);
  }

 private:
  void check_version() const {
    if (!json_.contains("version")) fail(context_.source, fmt::format("version: missing; expected \"version\": {}", SceneFile::kVersion));
    if (json_["version"] != SceneFile::kVersion)
      fail(context_.source, fmt::format("version: expected {}, got {}", SceneFile::kVersion, shown(json_["version"])));
  }

  const Json& collection(const char* name) const {
    static const Json none = Json::object();
    if (!json_.contains(name)) return none;
    if (!json_[name].is_object())
      fail(context_.source, std::string(name) + ": expected an object that maps names to objects: { \"name\": { … }, … }");
    return json_[name];
  }

  template <class T>
  void read_collection(const char* collection_name, Named<T>& list) {
    for (const auto& [name, value] : collection(collection_name).items()) {
      const std::string path = std::string(collection_name) + "." + name;
      if (std::ranges::find(top_words_, name) != top_words_.end())
        fail(context_.source, path + ": is a reserved word; expected another name");
      if (!is_name(name))
        fail(context_.source,
             printable(path) +
                 ": invalid name; expected text without '=' and ',' that neither begins with '#' nor begins or ends with a space");
      T thing;
      if constexpr (std::is_same_v<T, ObjectDescription>) {
        read_object(thing, value, path);
      } else {
        read_section(section_of(thing), value, path, context_);
      }
      list.emplace_back(name, std::move(thing));
    }
  }

  // Applies the material first, then the object's own keys, which override it.
  void read_object(ObjectDescription& object, const Json& json, const std::string& path) {
    if (json.is_object() && json.contains("material") && json["material"].is_string() && json["material"] != "") {
      const auto& name = json["material"].get_ref<const std::string&>();
      SurfaceDescription* material = find_named(scene_.materials, name);
      if (material == nullptr) {
        fail(context_.source, path + ".material: " + no_material(scene_, name));
      }
      object.surface = *material;
    }
    read_section(section_of(object), json, path, context_, std::span(&kInstances, 1));
    if (!json.contains(kInstances)) return;
    const Json& list = json[kInstances];
    if (!list.is_array() || list.size() > kMaxNames)
      fail(context_.source, fmt::format("{}.instances: expected a list of at most {} objects", path, kMaxNames));
    for (std::size_t i = 0; i < list.size(); ++i) {
      Placement p;
      read_section(section_of(p), list[i], fmt::format("{}.instances.{}", path, i), context_);
      object.instances.push_back(p);
    }
  }

  const Json& json_;
  ReadContext context_;
  SceneDescription scene_;
  std::vector<std::string> texture_names_;
  std::vector<std::string_view> top_words_;
};

SceneDescription read_scene(const Json& json, const std::string& source, const std::filesystem::path& directory) {
  return Reader(json, {source, directory, {}}).read();
}

// Removes keys of an object that have the same values as in its material, so that later changes of the material still apply to the object.
void drop_keys_of_material(Json& json, SurfaceDescription& surface, SurfaceDescription& material) {
  const Section own = section_of(surface), shared = section_of(material);
  for (const Field& field : fields_of(own)) {
    if (value_of(field) == value_of(find_field(shared, field.key->name))) json.erase(field.key->name);
  }
}

// Returns the whole scene as JSON, with every key.
Json json_of(SceneDescription scene) {
  Json json = {{"version", SceneFile::kVersion}};
  json.update(json_of(section_of(scene.head)));
  for_each_collection(scene, [&](const char* name, const char*, auto& list) {
    if (list.empty()) return;
    Json& collection = json[name] = Json::object();
    for (auto& [thing, value] : list) {
      collection[thing] = json_of(section_of(value));
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, ObjectDescription>) {
        if (SurfaceDescription* material = find_named(scene.materials, value.material); material != nullptr)
          drop_keys_of_material(collection[thing], value.surface, *material);
        for (Placement& p : value.instances) collection[thing][kInstances].push_back(json_of(section_of(p)));
      }
    }
  });
  for_each_single(scene, [&](const char* name, const char*, auto& value) { json[name] = json_of(section_of(value)); });
  return json;
}

// Returns an empty path if the directory no longer exists; relative paths are then rejected.
std::filesystem::path working_directory() {
  std::error_code error;
  return std::filesystem::current_path(error);
}

Json& at_words(Json& json, std::span<const std::string> words) {
  Json* place = &json;
  for (const std::string& word : words) place = place->is_array() ? &(*place)[std::stoul(word)] : &(*place)[word];
  return *place;
}

bool animates_material(SceneDescription& scene, const AnimationDescription& animation) {
  return find_key(scene, animation.target, "animation").words.front() == "materials";
}

// object: the object to which the section belongs, or null.
void drop_foreign_keys(const Section& fields, const ObjectDescription* object, Json& section) {
  Json kept = Json::object();
  for (const auto& [name, value] : section.items()) {
    const bool applies = find_field(fields, name).key != nullptr && (object == nullptr || lack_of_effect(*object, name).empty());
    if (name == kInstances || applies) kept[name] = value;
  }
  section = kept;
}

}  // namespace

SceneFile SceneFile::parse(std::string_view text, const std::string& source, const std::filesystem::path& directory) {
  const FloatMode float_mode;
  SceneFile file;
  file.source_ = source;
  file.directory_ = directory;
  file.json_ = std::make_shared<const Json>(parse_json(text, source));
  file.description_ = read_scene(*file.json_, source, directory);
  return file;
}

SceneFile SceneFile::open(const std::string& name_or_file) {
  const FloatMode float_mode;
  std::vector<std::string_view> names;
  for (const ShippedScene& scene : shipped_scenes()) {
    if (scene.name == name_or_file) return parse(scene.text, "scene " + name_or_file, {});
    names.push_back(scene.name);
  }
  const std::filesystem::path path = name_or_file;
  std::error_code error;
  if (!std::filesystem::exists(path, error) && !name_or_file.ends_with(".json")) {
    if (path.has_extension()) fail(name_or_file, std::string("does not exist; ") + kExpectedFormats);
    throw InputError("unknown scene '" + name_or_file + "'" + suggestion(name_or_file, names));
  }
  const std::filesystem::path directory = path.is_absolute() ? path.parent_path() : working_directory() / path.parent_path();
  check_format(path);
  return parse(read_text(path), name_or_file, directory);
}

void SceneFile::set(std::span<const std::string> settings) {
  const FloatMode float_mode;
  SceneFile next = *this;
  Json json = *json_;
  for (const std::string& setting : settings) {
    const std::string source = "--set";
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      fail(source, "'" + setting + "' is not of the form KEY=VALUE; expected, for example, camera=main");
    const std::string path = setting.substr(0, equals);
    const FoundKey found = find_key(next.description_, path, source);
    std::vector<std::string> textures;
    for (const auto& [name, texture] : next.description_.textures) textures.push_back(name);
    const ReadContext context{source, working_directory(), textures};
    // Reading checks the value; writing it back makes paths absolute.
    read_value(found.field, parse_text(*found.field.key, std::string_view(setting).substr(equals + 1), path, context), path, context);
    Json& section = at_words(json, std::span(found.words).first(found.words.size() - 1));
    section[found.words.back()] = value_of(found.field);
    // A different kind of section can have different keys: remove those that the new kind lacks.
    const Section fields = section_at(next.description_, std::span(found.words).first(found.words.size() - 1));
    if (found.field.key != &fields.front().keys.front() || found.field.key->type != KeyType::choice) continue;
    const bool is_object = found.words.front() == "objects";
    drop_foreign_keys(fields, is_object ? find_named(next.description_.objects, found.words[1]) : nullptr, section);
  }
  next.description_ = read_scene(json, source_, directory_);
  next.json_ = std::make_shared<const Json>(std::move(json));
  *this = std::move(next);
}

void SceneFile::merge(std::string_view patch, const std::string& source) {
  const FloatMode float_mode;
  Json json = *json_;
  json.merge_patch(parse_json(patch, source));
  description_ = read_scene(json, source_, directory_);
  json_ = std::make_shared<const Json>(std::move(json));
}

SceneDescription SceneFile::at(double seconds) const {
  const FloatMode float_mode;
  const double time = description_.time.hours / 24.0 * description_.time.day + seconds * description_.animation.speed;
  SceneDescription scene = with_materials_at(time);
  for (const auto& [name, animation] : description_.animations) {
    if (!animates_material(scene, animation)) animate(scene, animation, "animations." + name, source_, time);
  }
  check_scene(scene, fmt::format("{} at {:f} s", source_, seconds));
  return scene;
}

// Objects copy those keys of their material that they do not override. To apply an animated material, its keys are therefore written to the
// JSON, which is then read again.
SceneDescription SceneFile::with_materials_at(double time) const {
  SceneDescription scene = description_;
  Json json;
  for (const auto& [name, animation] : description_.animations) {
    if (!animates_material(scene, animation)) continue;
    if (json.is_null()) json = *json_;
    animate(scene, animation, "animations." + name, source_, time);
    const FoundKey found = find_key(scene, animation.target, source_);
    at_words(json, found.words) = value_of(found.field);
  }
  return json.is_null() ? scene : read_scene(json, source_, directory_);
}

std::string SceneFile::print() const { return json_of(description_).dump(2) + "\n"; }

}  // namespace halfspace::HS_LANES
