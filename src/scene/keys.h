// SPDX-License-Identifier: Apache-2.0
//
// Keys of scene files. A table of keys is bound to the members of a struct. Reading, printing, help, the JSON Schema and --set all
// use the same table. Default values come from a default-constructed struct.
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

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

using Json = nlohmann::ordered_json;

// ---- values ----------------------------------------------------------------------------------------------------

/// A linear color. In JSON: "#rrggbb" (sRGB), [r, g, b] (linear) or one number (gray).
struct Color {
  glm::dvec3 linear{0.0};
};

/// A file; empty means none. Relative paths are made absolute when they are read.
struct FilePath {
  std::filesystem::path path;
};

/// Name of a texture of the scene.
struct TextureName {
  std::string name;
};

/// The value of a map key: a single color, a texture of the scene, or an image file.
using MapValue = std::variant<Color, TextureName, FilePath>;
inline bool is_map(const MapValue& value) { return !std::holds_alternative<Color>(value); }

/// A single number, or the three components of a vector.
using Numbers = std::vector<double>;

/// Pairs of a time in seconds and the value at that time.
using Keyframes = std::vector<std::pair<double, Numbers>>;

enum class KeyType : uint8_t { boolean, integer, number, vector, color, choice, text, file, map, numbers, keyframes };

/// Names of the values of an enumeration, in order. Must be specialized for every enumeration used as the type of a key.
template <class E>
struct ChoiceNames;

// ---- keys ------------------------------------------------------------------------------------------------------

/// Largest number that a key accepts.
inline constexpr double kMaxCount = 1e9;

/// Constraints on the value of a key in addition to its type.
struct Limits {
  const char* unit = "";                      ///< displayed unit: "units", "degrees", "s"
  double low = -kMaxCount, high = kMaxCount;  ///< inclusive range of a number, or of each component of a vector
  const char* only = "";  ///< kinds of section that have this key, as choices of the first key separated by spaces; "": all
};

struct Key {
  const char* name;
  KeyType type;
  const char* help;  ///< one line
  Limits limits;
  std::span<const std::string_view> choices;
  void* (*member)(void* section);  ///< returns the struct member that the key is bound to
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
    static_assert(std::is_enum_v<M> && sizeof(M) == 1, "the member of a key must be a value type of keys.h or a one-byte enumeration");
    return KeyType::choice;
  }
}

template <class T, class M>
M member_type(M T::*);
template <class T, class M>
T section_type(M T::*);

}  // namespace detail

/// Returns the key of a struct member: key<&Camera::fov>("fov", "Full vertical angle of view", {.unit = "degrees"}).
template <auto pointer>
Key key(const char* name, const char* help, Limits limits = {}) {
  using M = decltype(detail::member_type(pointer));
  using T = decltype(detail::section_type(pointer));
  Key k{name, detail::key_type<M>(), help, limits, {}, [](void* section) -> void* { return &(static_cast<T*>(section)->*pointer); }};
  if constexpr (detail::key_type<M>() == KeyType::choice) k.choices = ChoiceNames<M>::names;
  return k;
}

/// A struct and the key table bound to it. A scene section consists of one or more of these.
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

/// Returns the field with that name. `key` is nullptr if there is none, or if this kind of section does not have it.
Field find_field(const Section& section, std::string_view name);

/// Returns all fields of the section that exist for its kind.
std::vector<Field> fields_of(const Section& section);

/// Context for reading a value.
struct ReadContext {
  std::string source;                     ///< file or "--set …", the start of error messages
  std::filesystem::path directory;        ///< base directory of relative paths
  std::span<const std::string> textures;  ///< names that a map may refer to
};

/// Reads one value. `path` is the key's dotted path. Throws InputError.
void read_value(const Field& field, const Json& json, const std::string& path, const ReadContext& context);

/// Reads a section from an object. Every member must be a key or be listed in `skip`, which is left to the caller. Absent keys keep
/// their value. Throws InputError.
void read_section(const Section& section, const Json& json, const std::string& path, const ReadContext& context,
                  std::span<const std::string_view> skip = {});

/// Returns the value as JSON that read_value reads back unchanged.
Json value_of(const Field& field);

/// Returns an object with all keys of the section.
Json json_of(const Section& section);

/// Converts command line text to a JSON value for read_value. Throws InputError.
Json parse_text(const Key& key, std::string_view text, const std::string& path, const ReadContext& context);

/// Returns the shortest decimal that reads back as x.
std::string number_text(double x);

/// Formats a value for a message: short, on one line.
std::string shown(const Json& json);

/// Describes the expected value in words: "a number from 1 to 180 (degrees)".
std::string expectation(const Key& key);

/// Returns the JSON Schema (draft 2020-12) of the key's value.
Json schema_of(const Key& key);

}  // namespace halfspace::HS_LANES
