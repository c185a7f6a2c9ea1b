// SPDX-License-Identifier: Apache-2.0
//
// Builds glTF files for the tests.
#pragma once

#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "halfspace/model/gltf/read_gltf.h"

namespace halfspace {

using GltfJson = nlohmann::json;

/// A glTF file with one buffer, which is stored as a data URI.
class GltfBuilder {
 public:
  GltfJson json = {{"asset", {{"version", "2.0"}}}};

  /// Appends an item to a list and returns its index.
  int add(const char* list, GltfJson item) {
    json[list].push_back(std::move(item));
    return static_cast<int>(json[list].size()) - 1;
  }

  /// Adds a buffer view with these bytes. stride: 0 means none.
  int view(std::span<const std::byte> data, std::size_t stride = 0) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    GltfJson item = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", data.size()}};
    if (stride != 0) item["byteStride"] = stride;
    bytes_.insert(bytes_.end(), data.begin(), data.end());
    return add("bufferViews", item);
  }
  template <class T>
  int view(const std::vector<T>& values, std::size_t stride = 0) {
    return view(std::as_bytes(std::span(values)), stride);
  }

  /// Adds an accessor for tightly packed values. width: number of components per element.
  template <class T>
  int accessor(const std::vector<T>& values, std::size_t width, bool normalized = false) {
    GltfJson item = {
        {"bufferView", view(values)}, {"componentType", component<T>()}, {"count", values.size() / width}, {"type", type(width)}};
    if (normalized) item["normalized"] = true;
    return add("accessors", item);
  }

  /// Adds a mesh with one primitive, and a node that draws it. Returns the index of the node.
  int mesh_node(GltfJson primitive) {
    const int mesh = add("meshes", {{"primitives", GltfJson::array({std::move(primitive)})}});
    return add("nodes", {{"mesh", mesh}});
  }
  /// Adds the positions of a triangle, (0, 0, 0), (1, 0, 0), (0, 1, 0), and returns the accessor.
  int triangle() { return accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3); }

  GltfJson finished() const {
    GltfJson whole = json;
    if (!bytes_.empty())
      whole["buffers"] = {{{"byteLength", bytes_.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes_)}}};
    return whole;
  }
  std::string text() const { return finished().dump(); }
  Model read(const ReadModelOptions& options = {}) const { return read_text(text(), options); }

  /// Returns the file as GLB.
  std::string glb() const {
    GltfJson whole = json;
    if (!bytes_.empty()) whole["buffers"] = {{{"byteLength", bytes_.size()}}};
    std::string text = whole.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string binary(reinterpret_cast<const char*>(bytes_.data()), bytes_.size());
    binary.resize((binary.size() + 3) / 4 * 4);
    return "glTF" + word(2) + word(12 + 8 + text.size() + 8 + binary.size()) + word(text.size()) + "JSON" + text + word(binary.size()) +
           std::string("BIN\0", 4) + binary;
  }

  static Model read_text(std::string_view text, const ReadModelOptions& options = {}, const std::filesystem::path& file = "/none/a.gltf") {
    return read_gltf(file, std::as_bytes(std::span(text)), options);
  }
  static std::string word(std::size_t x) {
    const auto n = static_cast<uint32_t>(x);
    std::string s(4, '\0');
    std::memcpy(s.data(), &n, 4);
    return s;
  }
  static std::string base64(std::span<const std::byte> data) {
    static constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < data.size(); i += 3) {
      uint32_t bits = 0;
      for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < data.size() ? static_cast<uint32_t>(data[i + k]) : 0u);
      for (std::size_t k = 0; k < 4; ++k) text += i + k > data.size() ? '=' : kLetters[bits >> (18 - 6 * k) & 63];
    }
    return text;
  }

 private:
  template <class T>
  static int component() {
    if constexpr (std::is_same_v<T, int8_t>) return 5120;
    if constexpr (std::is_same_v<T, uint8_t>) return 5121;
    if constexpr (std::is_same_v<T, int16_t>) return 5122;
    if constexpr (std::is_same_v<T, uint16_t>) return 5123;
    if constexpr (std::is_same_v<T, uint32_t>) return 5125;
    return 5126;
  }
  static const char* type(std::size_t width) {
    switch (width) {
      case 1: return "SCALAR";
      case 2: return "VEC2";
      case 3: return "VEC3";
      case 4: return "VEC4";
      default: return "MAT4";
    }
  }

  std::vector<std::byte> bytes_;
};

}  // namespace halfspace
