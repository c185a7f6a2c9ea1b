// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/keys.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "halfspace/core/check.h"
#include "halfspace/core/srgb.h"
#include "halfspace/core/text.h"
#include "halfspace/scene/path_text.h"

namespace halfspace::HS_LANES {

namespace {

constexpr double kMinPause = 1e-6;  // minimum time between keyframes, in seconds

[[noreturn]] void fail(const ReadContext& c, const std::string& path, const std::string& what) {
  throw InputError(c.source + ": " + path + ": " + what);
}

// Returns an integer without an exponent, and other numbers like number_text.
std::string integer_text(double x) {
  constexpr double kMaxExact = 1e15;
  return std::floor(x) == x && std::fabs(x) <= kMaxExact ? std::to_string(static_cast<int64_t>(x)) : number_text(x);
}

// Returns " from LOW to HIGH".
std::string range_text(const Key& key) {
  constexpr double kMaxPlain = 999999.0;  // larger real numbers are easier to read with an exponent
  const auto bound = [&](double x) { return key.type == KeyType::integer || std::fabs(x) <= kMaxPlain ? integer_text(x) : number_text(x); };
  return " from " + bound(key.limits.low) + " to " + bound(key.limits.high);
}

[[noreturn]] void fail_expected(const Key& key, const Json& got, const ReadContext& c, const std::string& path) {
  if (key.type == KeyType::choice && got.is_string()) {
    fail(c, path, shown(got) + " is not a valid choice" + suggestion(got.get_ref<const std::string&>(), key.choices));
  }
  const std::string text = got.is_number() && key.type == KeyType::integer ? integer_text(got.get<double>()) : shown(got);
  fail(c, path, "expected " + expectation(key) + ", got " + text);
}

bool in_range(const Key& key, double x) { return x >= key.limits.low && x <= key.limits.high; }

bool is_number_in_range(const Key& key, const Json& json) { return json.is_number() && in_range(key, json.get<double>()); }

bool is_vector_in_range(const Key& key, const Json& json) {
  return json.is_array() && json.size() == 3 && std::ranges::all_of(json, [&](const Json& x) { return is_number_in_range(key, x); });
}

glm::dvec3 vector_of(const Json& json) { return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()}; }

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::optional<Color> color_from_codes(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return std::nullopt;
  Color c;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(1 + 2 * i);
    const int high = hex_digit(text[at]), low = hex_digit(text[at + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    c.linear[i] = static_cast<double>(kSrgbToLinear[static_cast<std::size_t>(16 * high + low)]);
  }
  return c;
}

std::optional<Color> color_from(const Key& key, const Json& json) {
  if (is_number_in_range(key, json)) return Color{glm::dvec3(json.get<double>())};
  if (is_vector_in_range(key, json)) return Color{vector_of(json)};
  if (json.is_string()) return color_from_codes(json.get_ref<const std::string&>());
  return std::nullopt;
}

// Returns true for UTF-8 without control characters. Such text can be displayed, printed and read back.
bool is_plain_text(const std::string& text) {
  if (std::ranges::any_of(text, [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; })) return false;
  try {
    (void)Json(text).dump();
    return true;
  } catch (const Json::type_error&) {
    return false;
  }
}

void check_plain_text(const std::string& text, const std::string& path, const ReadContext& c) {
  if (!is_plain_text(text)) fail(c, path, "contains a control character or invalid UTF-8; expected plain text");
}

// Empty text means no file.
FilePath file_from(const std::string& text, const std::string& path, const ReadContext& c) {
  const std::optional<std::string> bytes = path_of_scene_text(text);
  if (!bytes) fail(c, path, "contains a control character; expected the path of a file");
  const std::string& file = *bytes;
  if (file.empty()) return {};
  if (std::filesystem::path(file).is_relative() && c.directory.empty()) {
    fail(c, path, "'" + file + "' is relative, but its base directory does not exist; expected an absolute path");
  }
  return {(c.directory / file).lexically_normal()};
}

// Rejects a word that is not the name of a texture and does not look like a file: it is probably a misspelled texture name.
void check_texture_name(const std::string& text, const FilePath& file, const std::string& path, const ReadContext& c) {
  std::error_code error;
  if (c.textures.empty() || text.find_first_of("/.") != std::string::npos || std::filesystem::exists(file.path, error)) return;
  const std::vector<std::string_view> names(c.textures.begin(), c.textures.end());
  fail(c, path, "no texture or file '" + text + "'" + suggestion(text, names));
}

std::optional<MapValue> map_from(const Key& key, const Json& json, const std::string& path, const ReadContext& c) {
  if (!json.is_string() || json.get_ref<const std::string&>().starts_with('#')) {
    const std::optional<Color> color = color_from(key, json);
    return color ? std::optional<MapValue>(*color) : std::nullopt;
  }
  const auto& text = json.get_ref<const std::string&>();
  if (text.empty()) return std::nullopt;
  if (std::ranges::find(c.textures, text) != c.textures.end()) return TextureName{text};
  const FilePath file = file_from(text, path, c);
  check_texture_name(text, file, path, c);
  return file;
}

std::optional<Numbers> numbers_from(const Key& key, const Json& json) {
  if (is_number_in_range(key, json)) return Numbers{json.get<double>()};
  if (is_vector_in_range(key, json)) return json.get<Numbers>();
  return std::nullopt;
}

std::optional<Keyframes> keyframes_from(const Key& key, const Json& json) {
  if (!json.is_array()) return std::nullopt;
  Keyframes frames;
  for (const Json& row : json) {
    if (!row.is_array() || row.size() != 2 || !row[0].is_number()) return std::nullopt;
    const std::optional<Numbers> value = numbers_from(key, row[1]);
    const auto time = row[0].get<double>();
    const bool later = frames.empty() || (time - frames.back().first >= kMinPause && value && value->size() == frames.back().second.size());
    if (!value || !later || !(std::fabs(time) <= kMaxCount)) return std::nullopt;
    frames.emplace_back(time, *value);
  }
  return frames;
}

Json json_of_vector(const glm::dvec3& v) { return Json::array({v.x, v.y, v.z}); }

template <class T>
T& as(void* value) {
  return *static_cast<T*>(value);
}

// Returns true if this kind of section has the key.
bool applies(const Key& key, const Section& section) {
  if (key.limits.only[0] == '\0') return true;
  const Key& first = section.front().keys.front();
  const std::string_view kind = first.choices[as<uint8_t>(first.member(section.front().data))];
  return has_word(key.limits.only, kind);
}

// Parses numbers separated by commas, with or without brackets.
std::optional<Json> parse_numbers(std::string_view text) {
  if (text.starts_with('[') && text.ends_with(']')) text = text.substr(1, text.size() - 2);
  Json list = Json::array();
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    std::string_view word = text.substr(begin, end - begin);
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    double x = 0;
    const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), x);
    if (error != std::errc() || last != word.data() + word.size() || !std::isfinite(x)) return std::nullopt;
    list.push_back(x);
    begin = end + 1;
  }
  return list.size() == 1 ? list[0] : list;
}

}  // namespace

std::string shown(const Json& json) {
  if (json.is_number()) return number_text(json.get<double>());  // 1, not 1.0: numbers from the command line are doubles
  std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  return text;
}

std::string number_text(double x) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), x).ptr};
}

std::vector<Field> fields_of(const Section& section) {
  std::vector<Field> fields;
  for (const Fields& part : section) {
    for (const Key& key : part.keys) {
      if (applies(key, section)) fields.push_back({&key, key.member(part.data)});
    }
  }
  return fields;
}

Field find_field(const Section& section, std::string_view name) {
  for (const Field& field : fields_of(section)) {
    if (field.key->name == name) return field;
  }
  return {};
}

std::string expectation(const Key& key) {
  const Limits& l = key.limits;
  const std::string range = range_text(key);
  const std::string unit = l.unit[0] == '\0' ? "" : " (" + std::string(l.unit) + ")";
  switch (key.type) {
    case KeyType::boolean: return "true or false";
    case KeyType::integer: return "an integer" + range + unit;
    case KeyType::number: return "a number" + range + unit;
    case KeyType::vector: return "three numbers [x, y, z]" + range + unit;
    case KeyType::color: return "a color: \"#rrggbb\", [r, g, b] or one number" + range;
    case KeyType::text: return "a string";
    case KeyType::file: return "a file name";
    case KeyType::map: return "a color (#rrggbb, r,g,b or a number" + range + "), the name of a texture or an image file";
    case KeyType::numbers: return "a number or [x, y, z]" + range + unit;
    case KeyType::keyframes: return "rows [seconds, value] in order of time, with values all numbers or all [x, y, z]" + range;
    case KeyType::choice: break;
  }
  std::string text = "one of ";
  for (std::size_t i = 0; i < key.choices.size(); ++i) text += (i == 0 ? "" : ", ") + std::string(key.choices[i]);
  return text;
}

void read_value(const Field& field, const Json& json, const std::string& path, const ReadContext& context) {
  const Key& key = *field.key;
  const auto store = [&]<class T>(const std::optional<T>& value) {
    if (!value) fail_expected(key, json, context, path);
    as<T>(field.value) = *value;
  };
  const auto when = [](bool right, auto make) { return right ? std::optional(make()) : std::nullopt; };
  switch (key.type) {
    case KeyType::boolean: return store(when(json.is_boolean(), [&] { return json.get<bool>(); }));
    case KeyType::integer:
      return store(when(is_number_in_range(key, json) && std::floor(json.get<double>()) == json.get<double>(),
                        [&] { return static_cast<int>(json.get<double>()); }));
    case KeyType::number: return store(when(is_number_in_range(key, json), [&] { return json.get<double>(); }));
    case KeyType::vector: return store(when(is_vector_in_range(key, json), [&] { return vector_of(json); }));
    case KeyType::color: return store(color_from(key, json));
    case KeyType::text:
      return store(when(json.is_string(), [&] {
        check_plain_text(json.get<std::string>(), path, context);
        return json.get<std::string>();
      }));
    case KeyType::file: return store(when(json.is_string(), [&] { return file_from(json.get<std::string>(), path, context); }));
    case KeyType::map: return store(map_from(key, json, path, context));
    case KeyType::numbers: return store(numbers_from(key, json));
    case KeyType::keyframes: return store(keyframes_from(key, json));
    case KeyType::choice: break;
  }
  const auto found = json.is_string() ? std::ranges::find(key.choices, json.get_ref<const std::string&>()) : key.choices.end();
  if (found == key.choices.end()) fail_expected(key, json, context, path);
  as<uint8_t>(field.value) = static_cast<uint8_t>(found - key.choices.begin());
}

void read_section(const Section& section, const Json& json, const std::string& path, const ReadContext& context,
                  std::span<const std::string_view> skip) {
  if (!json.is_object()) fail(context, path, "expected an object { … }, got " + shown(json));
  const auto at = [&](const std::string& name) { return path.empty() ? name : path + "." + name; };
  // Read the kind first, because it determines which keys exist.
  const Key& kind = section.front().keys.front();
  if (kind.type == KeyType::choice && json.contains(kind.name)) {
    read_value({&kind, kind.member(section.front().data)}, json[kind.name], at(kind.name), context);
  }
  for (const auto& [name, value] : json.items()) {
    if (std::ranges::find(skip, name) != skip.end()) continue;
    const Field field = find_field(section, name);
    if (field.key == nullptr) {
      std::vector<std::string_view> names(skip.begin(), skip.end());
      for (const Field& f : fields_of(section)) names.emplace_back(f.key->name);
      fail(context, at(name), "unknown key" + suggestion(name, names));
    }
    read_value(field, value, at(name), context);
  }
}

Json value_of(const Field& field) {
  const auto numbers = [](const Numbers& n) { return n.size() == 1 ? Json(n[0]) : Json(n); };
  switch (field.key->type) {
    case KeyType::boolean: return as<bool>(field.value);
    case KeyType::integer: return as<int>(field.value);
    case KeyType::number: return as<double>(field.value);
    case KeyType::vector: return json_of_vector(as<glm::dvec3>(field.value));
    case KeyType::color: return json_of_vector(as<Color>(field.value).linear);
    case KeyType::text: return as<std::string>(field.value);
    case KeyType::file: return scene_text(as<FilePath>(field.value).path);
    case KeyType::map: {
      const auto& map = as<MapValue>(field.value);
      if (const auto* color = std::get_if<Color>(&map)) return json_of_vector(color->linear);
      if (const auto* texture = std::get_if<TextureName>(&map)) return texture->name;
      return scene_text(std::get<FilePath>(map).path);
    }
    case KeyType::numbers: return numbers(as<Numbers>(field.value));
    case KeyType::keyframes: {
      Json rows = Json::array();
      for (const auto& [time, value] : as<Keyframes>(field.value)) rows.push_back(Json::array({time, numbers(value)}));
      return rows;
    }
    case KeyType::choice: break;
  }
  return std::string(field.key->choices[as<uint8_t>(field.value)]);
}

Json json_of(const Section& section) {
  Json json = Json::object();
  for (const Field& field : fields_of(section)) json[field.key->name] = value_of(field);
  return json;
}

Json parse_text(const Key& key, std::string_view text, const std::string& path, const ReadContext& context) {
  switch (key.type) {
    case KeyType::boolean:
      if (text == "true" || text == "false") return text == "true";
      break;
    case KeyType::text:
    case KeyType::choice:
    case KeyType::file: return std::string(text);
    case KeyType::keyframes: {
      Json json = Json::parse(text, nullptr, false);
      if (!json.is_discarded()) return json;
      break;
    }
    default: {
      const bool is_texture = key.type == KeyType::map && std::ranges::find(context.textures, text) != context.textures.end();
      if (is_texture) return std::string(text);  // even if its name is a number
      if (const std::optional<Json> numbers = parse_numbers(text)) return *numbers;
      if (key.type == KeyType::color || key.type == KeyType::map) return std::string(text);
      break;
    }
  }
  fail(context, path, "expected " + expectation(key) + ", got '" + std::string(text) + "'");
}

Json schema_of(const Key& key) {
  const auto number = [&](const char* type) { return Json{{"type", type}, {"minimum", key.limits.low}, {"maximum", key.limits.high}}; };
  const auto vector = [&] { return Json{{"type", "array"}, {"items", number("number")}, {"minItems", 3}, {"maxItems", 3}}; };
  const Json codes = {{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}};
  const auto any_of = [](std::vector<Json> list) { return Json{{"anyOf", std::move(list)}}; };
  Json schema;
  switch (key.type) {
    case KeyType::boolean: schema = {{"type", "boolean"}}; break;
    case KeyType::integer: schema = number("integer"); break;
    case KeyType::number: schema = number("number"); break;
    case KeyType::vector: schema = vector(); break;
    case KeyType::color: schema = any_of({codes, vector(), number("number")}); break;
    case KeyType::text:
    case KeyType::file: schema = {{"type", "string"}}; break;
    case KeyType::map: schema = any_of({{{"type", "string"}, {"minLength", 1}}, vector(), number("number")}); break;
    case KeyType::numbers: schema = any_of({number("number"), vector()}); break;
    case KeyType::keyframes: {
      Json row = {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}};
      row["prefixItems"] = Json::array({{{"type", "number"}}, any_of({number("number"), vector()})});
      schema = {{"type", "array"}, {"items", row}};
      break;
    }
    case KeyType::choice: schema = {{"enum", std::vector<std::string>(key.choices.begin(), key.choices.end())}}; break;
  }
  schema["description"] = key.limits.unit[0] == '\0' ? std::string(key.help) : std::string(key.help) + " (" + key.limits.unit + ")";
  return schema;
}

}  // namespace halfspace::HS_LANES
