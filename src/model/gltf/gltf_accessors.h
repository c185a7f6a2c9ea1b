// SPDX-License-Identifier: Apache-2.0
//
// Typed arrays of glTF files. Data may be interleaved, normalized integers, sparse, or missing (all zeros).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "halfspace/model/gltf/gltf_buffers.h"
#include "halfspace/model/gltf/gltf_document.h"

namespace halfspace::HS_LANES {

enum class GltfComponent : uint16_t { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

/// An accessor whose range has been checked.
struct GltfAccessor {
  const GltfValue* json = nullptr;
  std::size_t index = 0;               ///< index in the list of accessors
  std::span<const std::byte> bytes{};  ///< starts with the first element; empty if all elements are 0
  std::size_t count = 0, stride = 0;
  GltfComponent component = GltfComponent::float32;
  int width = 1;  ///< components per element; 16 for matrices
  bool normalized = false;
};

/// Indices of the vertices to read; empty for all vertices.
using GltfSubset = std::span<const uint32_t>;

class GltfAccessors {
 public:
  GltfAccessors(GltfDocument& document, GltfBuffers& buffers) : document_(document), buffers_(buffers) {}

  /// Returns the accessor that a member of an object refers to. The member must exist.
  GltfAccessor find(const GltfValue& object, const char* key);
  /// Like find, but does not locate the data.
  GltfAccessor describe(const GltfValue& object, const char* key) const;

  /// Reads floats or integers as floats. Normalized integers become values in [0, 1] or [−1, 1].
  std::vector<float> read_floats(const GltfAccessor& accessor, GltfSubset subset = {});
  /// Like read_floats, for accessors with as many components as the vector. T: glm::vec2, vec3, vec4.
  template <class T>
  std::vector<T> read(const GltfAccessor& accessor, GltfSubset subset = {}) {
    check_width(accessor, T::length());
    document_.take_memory(*accessor.json, subset.empty() ? accessor.count : subset.size(), sizeof(T));
    std::vector<T> values(subset.empty() ? accessor.count : subset.size());
    if (!values.empty()) read_into(accessor, subset, &values[0].x);
    return values;
  }
  /// Reads unsigned integers. The accessor must have `width` components per element.
  std::vector<uint32_t> read_integers(const GltfAccessor& accessor, int width, GltfSubset subset = {});

  /// Decoded values of an accessor as tightly packed elements. They replace its buffer view.
  struct Decoded {
    std::vector<std::byte> bytes;
    std::size_t count = 0;
    GltfComponent component = GltfComponent::float32;
  };
  /// Replaces the values of an accessor until clear_decoded() is called.
  void set_decoded(std::size_t accessor, Decoded decoded) { decoded_.insert_or_assign(accessor, std::move(decoded)); }
  void clear_decoded() { decoded_.clear(); }

  /// Returns the bytes of a buffer view. The index must be valid.
  std::span<const std::byte> view_bytes(std::size_t view) { return buffers_.view(view).bytes; }

  /// Throws InputError unless the accessor has this many components per element.
  void check_width(const GltfAccessor& accessor, int width) const;
  GltfDocument& document() { return document_; }

 private:
  std::span<const std::byte> range(const GltfValue& place, int view, uint64_t offset, uint64_t count, std::size_t element_size,
                                   std::size_t& stride);
  // V: float, or uint32_t for unsigned integers.
  template <class V>
  void read_into(const GltfAccessor& accessor, GltfSubset subset, V* values);
  template <class V>
  void read_dense(const GltfAccessor& accessor, GltfSubset subset, V* values) const;
  template <class V>
  void apply_sparse(const GltfAccessor& accessor, V* values);
  std::vector<uint32_t> sparse_indices(const GltfAccessor& accessor, const GltfValue& sparse);

  GltfDocument& document_;
  GltfBuffers& buffers_;
  std::map<std::size_t, Decoded> decoded_;  // key: index of the accessor
};

}  // namespace halfspace::HS_LANES
