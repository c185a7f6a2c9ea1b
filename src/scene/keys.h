// SPDX-License-Identifier: Apache-2.0
//
// Keys: what can be said in a scene file, told once. A table of keys is bound to a struct; reading, printing, help, the
// JSON Schema and --set all go by the same table, and the defaults are those of a default-constructed struct.
#pragma once

#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

namespace halfspace {

using Json = nlohmann::ordered_json;

// ---- values ----------------------------------------------------------------------------------------------------

/// A linear colour. In JSON "#rrggbb" (sRGB codes), [r, g, b] (linear) or one number (grey).
struct Color {
  glm::dvec3 linear{0.0};
};

/// A file; empty for none. Relative paths are made absolute when read.
struct FilePath {
  std::filesystem::path path;
};

/// The name of one of the scene's textures.
struct TextureName {
  std::string name;
};

/// What covers a surface: one colour, a texture of the scene by its name, or an image file.
using MapValue = std::variant<Color, TextureName, FilePath>;
inline bool is_map(const MapValue& value) { return !std::holds_alternative<Color>(value); }

/// One number, or the three of a vector.
using Numbers = std::vector<double>;

/// Rows of a time in seconds and the value at that time.
using Keyframes = std::vector<std::pair<double, Numbers>>;

enum class KeyType : uint8_t { boolean, integer, number, vector, color, choice, text, file, map, numbers, keyframes };

/// The names of an enumeration's values, in order. Specialized for each enumeration that is a key's type.
template <class E>
struct ChoiceNames;

// ---- keys ------------------------------------------------------------------------------------------------------

/// The largest number that any key takes.
inline constexpr double kMaxCount = 1e9;

/// What a key allows besides its type.
struct Limits {
  const char* unit = "";                      ///< for people: "units", "degrees", "s"
  double low = -kMaxCount, high = kMaxCount;  ///< of a number, or of each component of a vector; inclusive
  const char* only = "";  ///< kinds of section (choices of its first key, separated by spaces) that have this key; "": all
};

struct Key {
  const char* name;
  KeyType type;
  const char* help;  ///< one line
  Limits limits;
  std::span<const std::string_view> choices;
  void* (*member)(void* section);  ///< the struct's member that the key is bound to
};

namespace detail {

template <class M>
constexpr KeyType key_type() {
  if constexpr (std::is_same_v<M, bool>)
    return KeyType::boolean;
  else if constexpr (std::is_same_v<M, int>)
    return KeyType::integer;
  else if constexpr (std::is_same_v<M, double>)
    return KeyType::number;
  else if constexpr (std::is_same_v<M, glm::dvec3>)
    return KeyType::vector;
  else if constexpr (std::is_same_v<M, Color>)
    return KeyType::color;
  else if constexpr (std::is_same_v<M, std::string>)
    return KeyType::text;
  else if constexpr (std::is_same_v<M, FilePath>)
    return KeyType::file;
  else if constexpr (std::is_same_v<M, MapValue>)
    return KeyType::map;
  else if constexpr (std::is_same_v<M, Numbers>)
    return KeyType::numbers;
  else if constexpr (std::is_same_v<M, Keyframes>)
    return KeyType::keyframes;
  else {
    static_assert(std::is_enum_v<M> && sizeof(M) == 1, "a key's member is a value type of keys.h or an enumeration of one byte");
    return KeyType::choice;
  }
}

template <class T, class M>
M member_type(M T::*);
template <class T, class M>
T section_type(M T::*);

}  // namespace detail

/// The key of a struct's member: key<&Camera::fov>("fov", "Full vertical angle of view", {.unit = "degrees"}).
template <auto pointer>
Key key(const char* name, const char* help, Limits limits = {}) {
  using M = decltype(detail::member_type(pointer));
  using T = decltype(detail::section_type(pointer));
  Key k{name, detail::key_type<M>(), help, limits, {}, [](void* section) -> void* { return &(static_cast<T*>(section)->*pointer); }};
  if constexpr (detail::key_type<M>() == KeyType::choice) k.choices = ChoiceNames<M>::names;
  return k;
}

/// A struct and the table bound to it. A section of a scene is one of these or several.
struct Fields {
  std::span<const Key> keys;
  void* data;
};
using Section = std::vector<Fields>;

/// A key of a section, and the value it is bound to.
struct Field {
  const Key* key = nullptr;
  void* value = nullptr;
};

/// The field of that name, or key = nullptr where there is none or it is not for this kind of section.
Field find_field(const Section& section, std::string_view name);

/// All fields that the section, being of its kind, has.
std::vector<Field> fields_of(const Section& section);

/// Where a value was read, for messages and for what depends on it.
struct ReadContext {
  std::string source;                     ///< file or "--set …": what a message begins with
  std::filesystem::path directory;        ///< what relative paths are relative to
  std::span<const std::string> textures;  ///< names that a map may refer to
};

/// Reads one value. `path` is the key's dotted path. Throws InputError.
void read_value(const Field& field, const Json& json, const std::string& path, const ReadContext& context);

/// Reads a section's object: every member must be a key, absent keys keep their value. Members in `skip` are left to the
/// caller. Throws InputError.
void read_section(const Section& section, const Json& json, const std::string& path, const ReadContext& context,
                  std::span<const std::string_view> skip = {});

/// What read_value reads back as the same value.
Json value_of(const Field& field);

/// The object of all the section's keys.
Json json_of(const Section& section);

/// The value that a text on the command line stands for. Throws InputError.
Json parse_text(const Key& key, std::string_view text, const std::string& path, const ReadContext& context);

/// The shortest decimal that reads back as x.
std::string number_text(double x);

/// In words: "a number from 1 to 180 (degrees)".
std::string expectation(const Key& key);

/// JSON Schema (draft 2020-12) of the key's value.
Json schema_of(const Key& key);

}  // namespace halfspace
