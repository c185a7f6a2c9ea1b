// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "halfspace/core/check.h"
#include "halfspace/core/text.h"
#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int kMaxDepth = 256;
// An upper bound on the memory of a JSON value: a map node with key and value, and the unused capacity of arrays.
constexpr std::size_t kBytesPerValue = 128;
constexpr int kMaxPlacedWarnings = 50;

const GltfValue& empty_object() {
  static const GltfValue empty = GltfValue::object();
  return empty;
}
const GltfValue& empty_array() {
  static const GltfValue empty = GltfValue::array();
  return empty;
}

/// Properties of a JSON text that are found without parsing it.
struct TextSize {
  int depth = 0;           ///< maximum number of open brackets
  std::size_t values = 1;  ///< upper bound on the number of values
};

TextSize size_of(std::string_view text) {
  TextSize size;
  int open = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    switch (text[i]) {
      case '"':
        for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\' ? 1 : 0;
        break;
      case '[':
      case '{':
        size.depth = std::max(size.depth, ++open);
        ++size.values;
        break;
      case ']':
      case '}': --open; break;
      case ',': ++size.values; break;
      default: break;
    }
  }
  return size;
}

// Appends the path from one value to a value inside it. Returns false if it is not inside. Recursive; the depth of documents is limited.
bool append_path(const GltfValue& from, const GltfValue& to, std::string& path) {
  if (&from == &to) return true;
  const std::size_t length = path.size();
  if (from.is_array()) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      path += fmt::format("[{}]", i);
      if (append_path(from[i], to, path)) return true;
      path.resize(length);
    }
  } else if (from.is_object()) {
    for (auto member = from.begin(); member != from.end(); ++member) {
      const std::string quoted = gltf_quoted(member.key());
      path += fmt::format("{}{}", length == 0 ? "" : ".", std::string_view(quoted).substr(1, quoted.size() - 2));
      if (append_path(member.value(), to, path)) return true;
      path.resize(length);
    }
  }
  return false;
}

std::string shown_number(double x) { return fmt::format("{:.6g}", x); }

}  // namespace

std::string gltf_quoted(std::string_view text) {
  constexpr std::size_t kMaxLength = 80;
  const bool cut = text.size() > kMaxLength;
  const std::string shown = GltfValue(text.substr(0, kMaxLength)).dump(-1, ' ', true, GltfValue::error_handler_t::replace);
  return fmt::format("'{}{}'", std::string_view(shown).substr(1, shown.size() - 2), cut ? "..." : "");
}

GltfDocument::GltfDocument(const std::filesystem::path& file, std::string_view text, std::size_t offset, const ReadModelOptions& options,
                           std::vector<std::string>& warnings)
    : file_(file.string()), max_memory_(options.max_memory), memory_in_use_(options.memory_in_use), warnings_(warnings) {
  const TextSize size = size_of(text);
  if (size.depth > kMaxDepth) throw InputError(fmt::format("{}: JSON is nested too deeply; expected at most {} levels", file_, kMaxDepth));
  take_memory(empty_object(), size.values, kBytesPerValue);
  take_memory(empty_object(), text.size(), 1);
  const auto place_at = [&](std::size_t byte) {  // 1-based, in the text
    if (offset == 0) return file_ + ":" + line_and_column(text, byte);
    return fmt::format("{}: byte {}", file_, offset + std::max<std::size_t>(byte, 1) - 1);
  };
  try {
    root_ = std::make_unique<const GltfValue>(GltfValue::parse(text.begin(), text.end()));
  } catch (const GltfValue::parse_error& e) {
    const std::string problem = json_problem(e);  // it may already say what was expected
    throw InputError(place_at(e.byte) + ": invalid JSON: " + problem +
                     (problem.find("expected ") == std::string::npos ? "; expected a glTF file" : ""));
  } catch (const GltfValue::out_of_range& e) {
    const std::string problem = json_problem(e);
    throw InputError(place_at(position_of_quoted(text, problem)) + ": " + problem + "; expected a finite number");
  }
  if (!root_->is_object()) throw InputError(file_ + ": the JSON text is not an object; expected a glTF file");
}

GltfDocument::~GltfDocument() = default;

std::string GltfDocument::place_of(const GltfValue& value) const {
  std::string path;
  if (root_ && !append_path(*root_, value, path)) return "";
  return path;
}

void GltfDocument::fail(const GltfValue& value, std::string_view problem) const {
  const std::string place = place_of(value);
  throw InputError(fmt::format("{}: {}{}{}", file_, place, place.empty() ? "" : ": ", problem));
}

void GltfDocument::fail(const GltfValue& object, std::string_view key, std::string_view problem) const {
  const std::string place = place_of(object);
  throw InputError(fmt::format("{}: {}{}{}: {}", file_, place, place.empty() ? "" : ".", key, problem));
}

void GltfDocument::warn(const std::string& text) {
  if (known_warnings_.insert(text).second) warnings_.push_back(text);
}

void GltfDocument::warn_at(const GltfValue& object, std::string_view key, std::string_view problem) {
  if (++placed_warnings_ > kMaxPlacedWarnings) return;
  const std::string place = place_of(object);
  warn(fmt::format("{}{}{}: {}", place, place.empty() || key.empty() ? "" : ".", key, problem));
}

void GltfDocument::take_memory(const GltfValue& value, uint64_t count, uint64_t bytes_each) {
  const uint64_t needed = count > UINT64_MAX / bytes_each ? UINT64_MAX : count * bytes_each;
  if (needed > memory_left()) fail(value, memory_problem(needed, memory_in_use_, max_memory_));
  memory_in_use_ += needed;
}

const GltfValue* GltfDocument::find(const GltfValue& object, const char* key) const {
  const auto member = object.find(key);
  return member == object.end() ? nullptr : &*member;
}

const GltfValue& GltfDocument::required(const GltfValue& object, const char* key) const {
  const GltfValue* value = find(object, key);
  if (value == nullptr) fail(object, key, "is missing; expected a value");
  return *value;
}

const GltfValue& GltfDocument::object(const GltfValue& object, const char* key) const {
  const GltfValue* value = find(object, key);
  if (value == nullptr) return empty_object();
  if (!value->is_object()) fail(*value, "wrong type; expected an object");
  return *value;
}

const GltfValue& GltfDocument::array(const GltfValue& object, const char* key) const {
  const GltfValue* value = find(object, key);
  if (value == nullptr) return empty_array();
  if (!value->is_array()) fail(*value, "wrong type; expected an array");
  return *value;
}

const GltfValue& GltfDocument::objects(const GltfValue& object, const char* key) const {
  const GltfValue& list = array(object, key);
  for (const GltfValue& item : list) {
    if (!item.is_object()) fail(item, "wrong type; expected an object");
  }
  if (list.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) fail(list, "has too many items; expected fewer than 2^31");
  return list;
}

const GltfValue& GltfDocument::list(const char* name) const { return objects(root(), name); }

const GltfValue* GltfDocument::extension(const GltfValue& object, const char* name) const {
  const GltfValue& extensions = this->object(object, "extensions");
  const GltfValue* value = find(extensions, name);
  if (value != nullptr && !value->is_object()) fail(*value, "wrong type; expected an object");
  return value;
}

bool GltfDocument::boolean(const GltfValue& object, const char* key) const {
  const GltfValue* value = find(object, key);
  if (value == nullptr) return false;
  if (!value->is_boolean()) fail(*value, "wrong type; expected true or false");
  return value->get<bool>();
}

std::string GltfDocument::string(const GltfValue& object, const char* key) const {
  const GltfValue* value = find(object, key);
  if (value == nullptr) return {};
  if (!value->is_string()) fail(*value, "wrong type; expected a string");
  return value->get<std::string>();
}

double GltfDocument::number_value(const GltfValue& value) const {
  if (!value.is_number()) fail(value, "wrong type; expected a number");
  const auto x = value.get<double>();
  if (!(std::abs(x) <= kMaxNumber)) fail(value, "is too large; expected a number that is at most 3.4e38");
  return x;
}

double GltfDocument::number(const GltfValue& object, const char* key) const { return number_value(required(object, key)); }

double GltfDocument::number(const GltfValue& object, const char* key, double fallback, double low, double high) const {
  const GltfValue* value = find(object, key);
  if (value == nullptr) return fallback;
  const double x = number_value(*value);
  if (x < low || x > high) {
    fail(*value,
         fmt::format("{} is out of range; expected a number from {} to {}", shown_number(x), shown_number(low), shown_number(high)));
  }
  return x;
}

float GltfDocument::factor(const GltfValue& object, const char* key, float fallback, double low, double high) {
  const double x = number(object, key, static_cast<double>(fallback));
  const double clamped = std::clamp(x, low, high);
  if (x != clamped) warn_at(object, key, fmt::format("{} is out of range; using {}", shown_number(x), shown_number(clamped)));
  return static_cast<float>(clamped);
}

void GltfDocument::numbers(const GltfValue& object, const char* key, double* values, std::size_t n) const {
  if (find(object, key) == nullptr) return;
  const GltfValue& list = array(object, key);
  if (list.size() != n) fail(list, fmt::format("has {} items; expected {}", list.size(), n));
  for (std::size_t i = 0; i < n; ++i) values[i] = number_value(list[i]);
}

std::vector<float> GltfDocument::number_list(const GltfValue& object, const char* key) const {
  std::vector<float> values;
  for (const GltfValue& item : array(object, key)) values.push_back(static_cast<float>(number_value(item)));
  return values;
}

uint64_t GltfDocument::integer(const GltfValue& object, const char* key) const {
  const GltfValue& value = required(object, key);
  const double x = value.is_number() ? value.get<double>() : -1.0;
  if (!(x >= 0.0 && x <= static_cast<double>(kMaxInteger) && x == std::floor(x)))
    fail(value, "wrong value; expected an integer of at least 0");
  return static_cast<uint64_t>(x);
}

uint64_t GltfDocument::integer(const GltfValue& object, const char* key, uint64_t fallback, uint64_t high) const {
  const GltfValue* value = find(object, key);
  if (value == nullptr) return fallback;
  const uint64_t x = integer(object, key);
  if (x > high) fail(*value, fmt::format("{} is too large; expected at most {}", x, high));
  return x;
}

int GltfDocument::index_value(const GltfValue& value, std::size_t size) const {
  const double x = value.is_number() ? value.get<double>() : -1.0;
  if (!(x >= 0.0 && x == std::floor(x))) fail(value, "wrong value; expected an index");
  if (!(x < static_cast<double>(size))) {
    fail(value, size == 0 ? "is out of range because the list is empty; expected an index into a list with items"
                          : fmt::format("{} is out of range; expected an index from 0 to {}", shown_number(x), size - 1));
  }
  return static_cast<int>(x);
}

int GltfDocument::required_index(const GltfValue& object, const char* key, std::size_t size) const {
  return index_value(required(object, key), size);
}

int GltfDocument::index(const GltfValue& object, const char* key, std::size_t size) const {
  const GltfValue* value = find(object, key);
  return value == nullptr ? -1 : index_value(*value, size);
}

std::vector<int> GltfDocument::indices(const GltfValue& object, const char* key, std::size_t size) const {
  std::vector<int> list;
  std::set<int> known;
  for (const GltfValue& item : array(object, key)) {
    list.push_back(index_value(item, size));
    if (!known.insert(list.back()).second) fail(item, fmt::format("{} occurs twice; expected different indices", list.back()));
  }
  return list;
}

}  // namespace halfspace::HS_LANES
