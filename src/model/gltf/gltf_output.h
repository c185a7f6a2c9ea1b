// SPDX-License-Identifier: Apache-2.0
//
// The output of the glTF writer: the JSON document and its buffer.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

using OutputJson = nlohmann::ordered_json;

/// Returns the first N components of a vector as an array.
template <class V>
OutputJson json_array(const V& v) {
  OutputJson list = OutputJson::array();
  for (glm::length_t i = 0; i < V::length(); ++i) list.push_back(static_cast<double>(v[i]));
  return list;
}

class GltfOutput {
 public:
  OutputJson json = {{"asset", {{"version", "2.0"}, {"generator", "Halfspace"}}}};
  std::vector<std::byte> buffer;
  std::vector<std::string> warnings;

  /// Appends an item to a list of the document and returns its index.
  int add(const char* list, OutputJson item);
  int count(const char* list) const { return json.contains(list) ? static_cast<int>(json[list].size()) : 0; }

  /// Adds `value` to the extensions of an object, and lists the extension in the document.
  void extend(OutputJson& object, const char* extension, OutputJson value);

  /// Adds a warning, unless it has been added before.
  void warn(const std::string& text);

  /// The use of an accessor, which determines the target of its buffer view.
  enum class Use { vertices, indices, other };

  /// Appends bytes to the buffer and returns the index of a buffer view.
  int view(std::span<const std::byte> bytes, Use use = Use::other);

  /// Adds a buffer view and an accessor. T: float, a vector or matrix of floats, or uint32_t.
  template <class T>
  int accessor(const std::vector<T>& values, Use use) {
    if constexpr (std::is_same_v<T, float>) return float_accessor(std::as_bytes(std::span(values)), values.size(), "SCALAR", use);
    if constexpr (std::is_same_v<T, glm::vec2>) return float_accessor(std::as_bytes(std::span(values)), values.size(), "VEC2", use);
    if constexpr (std::is_same_v<T, glm::vec3>) return float_accessor(std::as_bytes(std::span(values)), values.size(), "VEC3", use);
    if constexpr (std::is_same_v<T, glm::vec4>) return float_accessor(std::as_bytes(std::span(values)), values.size(), "VEC4", use);
    if constexpr (std::is_same_v<T, glm::mat4>) return float_accessor(std::as_bytes(std::span(values)), values.size(), "MAT4", use);
  }
  /// Adds an accessor of 16-bit or 32-bit indices.
  int index_accessor(const std::vector<uint32_t>& values, std::size_t vertices);
  /// Adds an accessor of Booleans. false: 0.
  int flag_accessor(const std::vector<float>& values);
  int joint_accessor(const std::vector<std::array<uint16_t, 4>>& values);

  /// Adds the minimum and maximum of the values, which glTF requires for positions and times.
  void set_bounds(int accessor, std::span<const float> values, int width);

 private:
  int float_accessor(std::span<const std::byte> bytes, std::size_t count, const char* type, Use use);
  int accessor_of(int view, int component, std::size_t count, const char* type);

  std::set<std::string> extensions_;
};

/// An image file that belongs to a document.
struct GltfImageFile {
  std::string name;
  int image;  ///< index in Model::images
};
struct GltfTextureOutput {
  std::vector<GltfImageFile> files;
  std::vector<int> textures;  ///< for each of Model::textures, its index in the document, or -1 if glTF cannot store its image
};
/// Writes samplers, images and textures. Images become views of the buffer if `embed` is set, otherwise files named "STEM_imageN".
GltfTextureOutput write_gltf_textures(const Model& model, const std::string& stem, bool embed, GltfOutput& out);

/// textures: indices of textures in the document, as above.
void write_gltf_materials(const Model& model, const std::vector<int>& textures, GltfOutput& out);
void write_gltf_meshes_and_nodes(const Model& model, GltfOutput& out);
void write_gltf_cameras_and_lights(const Model& model, GltfOutput& out);
void write_gltf_skins_and_animations(const Model& model, GltfOutput& out);

/// Encodes the characters of a file name that a URI cannot contain.
std::string percent_encoded(const std::string& name);

}  // namespace halfspace::HS_LANES
