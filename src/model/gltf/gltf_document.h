// SPDX-License-Identifier: Apache-2.0
//
// The JSON part of a glTF file, with checked access to its values. All functions throw InputError "FILE: PLACE: problem; expected ..."
// if a value does not have the expected type or range. The place is only determined for messages, by searching for the value.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

using GltfValue = nlohmann::json;
struct ReadModelOptions;

class GltfDocument {
 public:
  /// Parses the text. offset: position of the text in a binary file, for messages; 0 if the file contains only the text. warnings: receives
  /// one line for each problem that is not an error; must outlive this object.
  GltfDocument(const std::filesystem::path& file, std::string_view text, std::size_t offset, const ReadModelOptions& options,
               std::vector<std::string>& warnings);
  ~GltfDocument();
  GltfDocument(const GltfDocument&) = delete;
  GltfDocument& operator=(const GltfDocument&) = delete;

  const GltfValue& root() const { return *root_; }
  /// Returns the list of objects of this name in the root, for example "accessors"; empty if it is missing.
  const GltfValue& list(const char* name) const;

  // ---- members of objects. `object` must be a JSON object of this document. ----

  /// Returns a member, or null if it is missing.
  const GltfValue* find(const GltfValue& object, const char* key) const;
  /// Returns a member that must be an object; an empty one if it is missing.
  const GltfValue& object(const GltfValue& object, const char* key) const;
  /// Returns a member that must be an array; an empty one if it is missing.
  const GltfValue& array(const GltfValue& object, const char* key) const;
  /// Returns an array of objects; empty if it is missing.
  const GltfValue& objects(const GltfValue& object, const char* key) const;
  /// Returns object.extensions.name, or null if it is missing.
  const GltfValue* extension(const GltfValue& object, const char* name) const;

  bool boolean(const GltfValue& object, const char* key) const;
  /// Returns a string; empty if it is missing.
  std::string string(const GltfValue& object, const char* key) const;
  /// Returns a number. All numbers of a document are at most kMaxNumber.
  double number(const GltfValue& object, const char* key, double fallback, double low = -kMaxNumber, double high = kMaxNumber) const;
  double number(const GltfValue& object, const char* key) const;  ///< must not be missing
  /// Like number, but a number that is out of range is clamped, with a warning.
  float factor(const GltfValue& object, const char* key, float fallback, double low = 0.0, double high = 1.0);
  /// Returns an array of numbers. It must have the length of `fallback`.
  template <std::size_t n>
  std::array<double, n> numbers(const GltfValue& object, const char* key, std::array<double, n> fallback) const {
    numbers(object, key, fallback.data(), n);
    return fallback;
  }
  /// Returns a list of numbers of any length; empty if it is missing.
  std::vector<float> number_list(const GltfValue& object, const char* key) const;
  /// Returns an integer from 0 to `high`.
  uint64_t integer(const GltfValue& object, const char* key, uint64_t fallback, uint64_t high = kMaxInteger) const;
  uint64_t integer(const GltfValue& object, const char* key) const;  ///< must not be missing
  /// Returns an index in a list of `size` items; −1 if it is missing.
  int index(const GltfValue& object, const char* key, std::size_t size) const;
  int required_index(const GltfValue& object, const char* key, std::size_t size) const;
  /// Returns a list of indices, each of which may occur only once.
  std::vector<int> indices(const GltfValue& object, const char* key, std::size_t size) const;
  /// Returns the value of an array item that must be an index.
  int index_value(const GltfValue& value, std::size_t size) const;

  // ---- problems ----

  /// Throws InputError for a value.
  [[noreturn]] void fail(const GltfValue& value, std::string_view problem) const;
  /// Throws InputError for a member of an object, which may be missing.
  [[noreturn]] void fail(const GltfValue& object, std::string_view key, std::string_view problem) const;
  /// Adds a warning, unless there is an equal one.
  void warn(const std::string& text);
  /// Adds a warning about a member of an object. The number of such warnings is limited, because locating an object in the file takes time.
  void warn_at(const GltfValue& object, std::string_view key, std::string_view problem);
  /// Counts memory that is allocated for `value`. The count never decreases, so the limit also bounds the time. Throws InputError if the
  /// limit is exceeded.
  void take_memory(const GltfValue& value, uint64_t count, uint64_t bytes_each);
  std::size_t memory_left() const { return max_memory_ > memory_in_use_ ? max_memory_ - memory_in_use_ : 0; }
  std::vector<std::string>& warnings() { return warnings_; }

  static constexpr double kMaxNumber = std::numeric_limits<float>::max();
  static constexpr uint64_t kMaxInteger = uint64_t{1} << 53;

 private:
  void numbers(const GltfValue& object, const char* key, double* values, std::size_t n) const;
  double number_value(const GltfValue& value) const;
  std::string place_of(const GltfValue& value) const;
  const GltfValue& required(const GltfValue& object, const char* key) const;

  std::string file_;
  std::unique_ptr<const GltfValue> root_;
  std::size_t max_memory_, memory_in_use_;
  int placed_warnings_ = 0;
  std::vector<std::string>& warnings_;
  std::set<std::string, std::less<>> known_warnings_;
};

/// Returns a string from a file in quotation marks for use in a message. Control characters are removed, and long strings are cut.
std::string gltf_quoted(std::string_view text);

}  // namespace halfspace::HS_LANES
