// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace halfspace::HS_LANES {

namespace {

struct TypeName {
  std::string_view name;
  int width;
};
constexpr std::array<TypeName, 5> kTypes = {{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}};

std::size_t size_of(GltfComponent component) {
  switch (component) {
    case GltfComponent::int8:
    case GltfComponent::uint8: return 1;
    case GltfComponent::int16:
    case GltfComponent::uint16: return 2;
    case GltfComponent::uint32:
    case GltfComponent::float32: return 4;
  }
  return 0;
}

// Calls f with a value of the component's C++ type.
template <class F>
void with_type(GltfComponent component, F f) {
  switch (component) {
    case GltfComponent::int8: return f(int8_t{});
    case GltfComponent::uint8: return f(uint8_t{});
    case GltfComponent::int16: return f(int16_t{});
    case GltfComponent::uint16: return f(uint16_t{});
    case GltfComponent::uint32: return f(uint32_t{});
    case GltfComponent::float32: return f(float{});
  }
}

// Data may be unaligned.
template <class T>
T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

template <class T>
float as_float(T value, bool normalized) {
  if constexpr (std::is_floating_point_v<T>) {
    return value;
  } else {
    if (!normalized) return static_cast<float>(value);
    return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max()), -1.0f);
  }
}

// Calls store(i, component, value) for all components of all elements of type T.
template <class T, class F>
void for_components(const GltfAccessor& accessor, GltfSubset subset, F store) {
  const std::size_t n = subset.empty() ? accessor.count : subset.size();
  const auto width = static_cast<std::size_t>(accessor.width);
  for (std::size_t i = 0; i < n; ++i) {
    const std::byte* at = accessor.bytes.data() + (subset.empty() ? i : subset[i]) * accessor.stride;
    for (std::size_t c = 0; c < width; ++c) store(i * width + c, load<T>(at + c * sizeof(T)));
  }
}

GltfComponent component_of(const GltfDocument& document, const GltfValue& json) {
  const uint64_t code = document.integer(json, "componentType");
  if (code < 5120 || code > 5126 || code == 5124) {
    document.fail(json, "componentType", fmt::format("{}; expected 5120, 5121, 5122, 5123, 5125 or 5126", code));
  }
  return static_cast<GltfComponent>(code);
}

}  // namespace

std::span<const std::byte> GltfAccessors::range(const GltfValue& place, int view_index, uint64_t offset, uint64_t count,
                                                std::size_t element_size, std::size_t& stride) {
  const GltfView& view = buffers_.view(static_cast<std::size_t>(view_index));
  stride = view.stride == 0 ? element_size : view.stride;
  const std::size_t size = view.bytes.size();
  if (stride < element_size) {
    document_.fail(place, fmt::format("an element has {} bytes, but the stride of the buffer view is {}; expected a larger stride",
                                      element_size, stride));
  }
  if (count == 0) return {};
  if (offset > size || element_size > size - offset || (count - 1) > (size - offset - element_size) / stride) {
    document_.fail(place, "count", fmt::format("{} elements do not fit in the {} bytes of the buffer view; expected fewer", count, size));
  }
  return view.bytes.subspan(offset);
}

GltfAccessor GltfAccessors::describe(const GltfValue& object, const char* key) const {
  const GltfValue& list = document_.list("accessors");
  GltfAccessor accessor;
  accessor.index = static_cast<std::size_t>(document_.required_index(object, key, list.size()));
  const GltfValue& json = list[accessor.index];
  accessor.json = &json;
  accessor.count = document_.integer(json, "count");
  accessor.component = component_of(document_, json);
  const std::string type = document_.string(json, "type");
  const auto known = std::ranges::find(kTypes, type, &TypeName::name);
  if (known == kTypes.end())
    document_.fail(json, "type", gltf_quoted(type) + " cannot be used here; expected SCALAR, VEC2, VEC3, VEC4 or MAT4");
  accessor.width = known->width;
  accessor.normalized = document_.boolean(json, "normalized");
  if (accessor.count >= std::numeric_limits<uint32_t>::max()) document_.fail(json, "count", "is too large; expected less than 2^32 - 1");
  return accessor;
}

GltfAccessor GltfAccessors::find(const GltfValue& object, const char* key) {
  GltfAccessor accessor = describe(object, key);
  const GltfValue& json = *accessor.json;
  if (const auto decoded = decoded_.find(accessor.index); decoded != decoded_.end()) {
    accessor.bytes = decoded->second.bytes;
    accessor.count = decoded->second.count;
    accessor.component = decoded->second.component;
    accessor.stride = size_of(accessor.component) * static_cast<std::size_t>(accessor.width);
    return accessor;
  }
  const int view = document_.index(json, "bufferView", document_.list("bufferViews").size());
  const uint64_t offset = document_.integer(json, "byteOffset", 0);
  const std::size_t element_size = size_of(accessor.component) * static_cast<std::size_t>(accessor.width);
  if (view >= 0) accessor.bytes = range(json, view, offset, accessor.count, element_size, accessor.stride);
  return accessor;
}

void GltfAccessors::check_width(const GltfAccessor& accessor, int width) const {
  if (accessor.width == width) return;
  const auto name = std::ranges::find(kTypes, width, &TypeName::width);
  document_.fail(*accessor.json, "type", fmt::format("has {} components; expected {}", accessor.width, name->name));
}

template <class V>
void GltfAccessors::read_dense(const GltfAccessor& accessor, GltfSubset subset, V* values) const {
  const std::size_t n = (subset.empty() ? accessor.count : subset.size()) * static_cast<std::size_t>(accessor.width);
  if (accessor.bytes.empty()) {
    std::fill_n(values, n, V{});
    return;
  }
  constexpr GltfComponent kSame = std::is_same_v<V, float> ? GltfComponent::float32 : GltfComponent::uint32;
  const bool packed = accessor.stride == sizeof(V) * static_cast<std::size_t>(accessor.width);
  if (accessor.component == kSame && packed && subset.empty()) {
    std::memcpy(values, accessor.bytes.data(), n * sizeof(V));
    return;
  }
  with_type(accessor.component, [&]<class T>(T) {
    for_components<T>(accessor, subset, [&](std::size_t i, T value) {
      if constexpr (std::is_same_v<V, float>) {
        values[i] = as_float(value, accessor.normalized);
      } else {
        values[i] = static_cast<V>(value);
      }
    });
  });
}

std::vector<uint32_t> GltfAccessors::sparse_indices(const GltfAccessor& accessor, const GltfValue& sparse) {
  const GltfValue& json = document_.object(sparse, "indices");
  GltfAccessor indices{.json = &json, .count = document_.integer(sparse, "count"), .component = component_of(document_, json)};
  const bool is_unsigned =
      indices.component == GltfComponent::uint8 || indices.component == GltfComponent::uint16 || indices.component == GltfComponent::uint32;
  if (!is_unsigned) document_.fail(json, "componentType", "is not an unsigned integer; expected 5121, 5123 or 5125");
  if (indices.count > accessor.count) document_.fail(sparse, "count", "is larger than the accessor's count; expected at most that count");
  const int view = document_.required_index(json, "bufferView", document_.list("bufferViews").size());
  indices.bytes = range(sparse, view, document_.integer(json, "byteOffset", 0), indices.count, size_of(indices.component), indices.stride);
  std::vector<uint32_t> list = read_integers(indices, 1);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i] >= accessor.count || (i > 0 && list[i] <= list[i - 1])) {
      document_.fail(json, fmt::format("index {} is {}; expected increasing indices below {}", i, list[i], accessor.count));
    }
  }
  return list;
}

template <class V>
void GltfAccessors::apply_sparse(const GltfAccessor& accessor, V* values) {
  const GltfValue& sparse = document_.object(*accessor.json, "sparse");
  const std::vector<uint32_t> indices = sparse_indices(accessor, sparse);
  const GltfValue& json = document_.object(sparse, "values");
  const int view = document_.required_index(json, "bufferView", document_.list("bufferViews").size());
  const auto width = static_cast<std::size_t>(accessor.width);
  GltfAccessor source = accessor;
  source.count = indices.size();
  const std::size_t element_size = size_of(accessor.component) * width;
  source.bytes = range(sparse, view, document_.integer(json, "byteOffset", 0), source.count, element_size, source.stride);
  document_.take_memory(json, source.count * width, sizeof(V));
  std::vector<V> replacements(source.count * width);
  read_dense(source, {}, replacements.data());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    std::copy_n(replacements.data() + i * width, width, values + indices[i] * width);
  }
}

template <class V>
void GltfAccessors::read_into(const GltfAccessor& accessor, GltfSubset subset, V* values) {
  const bool sparse = document_.find(*accessor.json, "sparse") != nullptr;
  if (!sparse) return read_dense(accessor, subset, values);
  if (subset.empty()) {
    read_dense(accessor, {}, values);
    return apply_sparse(accessor, values);
  }
  const auto width = static_cast<std::size_t>(accessor.width);
  document_.take_memory(*accessor.json, accessor.count * width, sizeof(V));
  std::vector<V> all(accessor.count * width);
  read_into(accessor, {}, all.data());
  for (std::size_t i = 0; i < subset.size(); ++i) std::copy_n(all.data() + subset[i] * width, width, values + i * width);
}

template void GltfAccessors::read_into(const GltfAccessor&, GltfSubset, float*);

std::vector<float> GltfAccessors::read_floats(const GltfAccessor& accessor, GltfSubset subset) {
  const std::size_t n = (subset.empty() ? accessor.count : subset.size());
  document_.take_memory(*accessor.json, n * static_cast<std::size_t>(accessor.width), sizeof(float));
  std::vector<float> values(n * static_cast<std::size_t>(accessor.width));
  read_into(accessor, subset, values.data());
  return values;
}

std::vector<uint32_t> GltfAccessors::read_integers(const GltfAccessor& accessor, int width, GltfSubset subset) {
  check_width(accessor, width);
  const bool is_unsigned = accessor.component == GltfComponent::uint8 || accessor.component == GltfComponent::uint16 ||
                           accessor.component == GltfComponent::uint32;
  if (!is_unsigned) document_.fail(*accessor.json, "componentType", "is not an unsigned integer; expected 5121, 5123 or 5125");
  const std::size_t n = (subset.empty() ? accessor.count : subset.size()) * static_cast<std::size_t>(width);
  document_.take_memory(*accessor.json, n, sizeof(uint32_t));
  std::vector<uint32_t> values(n);
  read_into(accessor, subset, values.data());
  return values;
}

}  // namespace halfspace::HS_LANES
