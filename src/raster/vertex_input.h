// SPDX-License-Identifier: Apache-2.0
//
// Vertices and indices of a draw: typed, bounds-checked views of memory that the caller owns.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "halfspace/core/aggregate_reflection.h"
#include "halfspace/core/check.h"

namespace halfspace::HS_LANES {

/// Array of floats with one row per vertex or group of instances. A row contains one attribute, or several consecutive ones.
struct VertexStream {
  const float* data = nullptr;
  int32_t stride = 0;      ///< distance between rows, in floats
  int32_t components = 0;  ///< floats read per row
  std::size_t count = 0;   ///< number of rows
  uint32_t divisor = 0;    ///< 0: one row per vertex; n: one row per n instances (glVertexAttribDivisor)
};

/// A VertexStream with elements of type T. Pass::draw compares T with the shader's Attributes at compile time.
template <class T>
struct StreamOf : VertexStream {
  using Element = T;
};

namespace detail {

template <class T>
consteval bool consists_of_floats();

// Converts to any type that consists of floats.
struct FloatField {
  template <class T>
  requires(consists_of_floats<T>()) operator T() const;
};

template <class T, std::size_t... I>
constexpr bool has_float_fields(std::index_sequence<I...>) {
  return requires { T{((void)I, FloatField{})...}; };
}

/// Returns true if all numbers in an object of type T are floats. T may be float, an array, a class with a value_type such as a vector or a
/// matrix, or an aggregate of these. Elements of arrays in an aggregate count as members of it.
template <class T>
consteval bool consists_of_floats() {
  if constexpr (std::is_array_v<T>) {
    return consists_of_floats<std::remove_all_extents_t<T>>();
  } else if constexpr (requires { typename T::value_type; }) {
    return consists_of_floats<typename T::value_type>();
  } else if constexpr (std::is_class_v<T> && std::is_aggregate_v<T>) {
    return has_float_fields<T>(std::make_index_sequence<count_fields<T, sizeof(T) / sizeof(float)>()>{});
  } else {
    return std::is_same_v<T, float>;
  }
}

}  // namespace detail

/// Creates a stream of tightly packed float, glm::vec2/3/4, or structs of floats such as Attributes<float>. Elements with other numbers,
/// such as uint32_t, glm::ivec4 or a struct with a packed color, do not compile; of such a struct, a member can be a stream (see below).
template <class T>
StreamOf<T> stream(std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(float) == 0 && alignof(T) == alignof(float));
  static_assert(detail::consists_of_floats<T>(), "vertex attributes must consist of floats");
  constexpr auto n = static_cast<int32_t>(sizeof(T) / sizeof(float));
  return {{reinterpret_cast<const float*>(values.data()), n, n, values.size()}};
}
template <class T>
StreamOf<T> stream(const std::vector<T>& values) {
  return stream(std::span<const T>(values));
}

/// Creates a stream of one member of an interleaved vertex struct: stream(vertices, &MyVertex::normal).
template <class V, class F>
StreamOf<F> stream(std::span<const V> vertices, F V::*member) {
  static_assert(std::is_trivially_copyable_v<V> && sizeof(V) % sizeof(float) == 0 && sizeof(F) % sizeof(float) == 0);
  static_assert(detail::consists_of_floats<F>(), "vertex attributes must consist of floats");
  StreamOf<F> s{{nullptr, sizeof(V) / sizeof(float), sizeof(F) / sizeof(float), vertices.size()}};
  if (!vertices.empty()) s.data = reinterpret_cast<const float*>(&(vertices.front().*member));
  return s;
}
template <class V, class F>
StreamOf<F> stream(const std::vector<V>& vertices, F V::*member) {
  return stream(std::span<const V>(vertices), member);
}
template <class T, class... Member>
void stream(const std::vector<T>&& values, Member...) = delete;  // the vector must outlive the stream

/// Returns the stream with one row per `divisor` instances instead of one row per vertex. divisor must be at least 1.
template <std::derived_from<VertexStream> S>
S per_instance(S stream, uint32_t divisor = 1) {
  HS_CHECK_OP(divisor, >=, 1u, "per_instance: the divisor is 0; expected at least 1");
  stream.divisor = divisor;
  return stream;
}

inline constexpr std::size_t kMaxStreams = kMaxFields;

/// Vertex streams of a draw, in the order of the members of the shader's Attributes.
struct VertexView {
  std::array<VertexStream, kMaxStreams> streams;
  int stream_count = 0;
  std::size_t vertex_count = 0;
  std::size_t instance_count = std::size_t{1} << 31;  ///< number of instances for which the per-instance streams have rows
  bool has_instance_streams = false;
  int components = 0;  ///< floats per vertex in all streams
};

/// A VertexView that stores the element types of its streams at compile time.
template <class... T>
struct VertexViewOf : VertexView {};

/// Non-owning reference to the streams of a view.
struct VertexStreams {
  std::span<const VertexStream> streams{};
  bool has_instance_streams = false;
};

/// Storage for the result of at_instance().
using StreamStorage = std::array<VertexStream, kMaxStreams>;
/// Returns the streams for the vertices of one instance. Per-instance streams point to the row of the instance and have a stride of 0; if
/// there are any, the result is stored in `storage`.
std::span<const VertexStream> at_instance(const VertexStreams& vertices, uint32_t instance, StreamStorage& storage);

namespace detail {
/// Implementation of make_vertex_view(). There must be at most kMaxStreams streams.
VertexView bind_streams(std::span<const VertexStream> streams);
VertexView bind_streams(std::span<const VertexStream> streams, std::size_t vertex_count);
}  // namespace detail

/// Binds streams to the members of Attributes, in order. At least one stream must have one row per vertex, and all such streams must have
/// the same number of rows. Each stream must have fewer than 2^31 floats.
template <std::derived_from<VertexStream>... S>
auto make_vertex_view(const S&... streams) {
  static_assert(sizeof...(S) >= 1, "make_vertex_view() without streams needs the number of vertices");
  const std::array<VertexStream, sizeof...(S)> list{streams...};
  if constexpr ((requires { typename S::Element; } && ...)) {
    return VertexViewOf<typename S::Element...>{detail::bind_streams(list)};
  } else {
    return detail::bind_streams(list);
  }
}

/// The same with an explicit vertex count, for shaders without per-vertex streams that compute their vertices from VertexId. vertex_count
/// must be less than 2^32.
template <std::derived_from<VertexStream>... S>
auto make_vertex_view(std::size_t vertex_count, const S&... streams) {
  const std::array<VertexStream, sizeof...(S)> list{streams...};
  if constexpr ((requires { typename S::Element; } && ...)) {
    return VertexViewOf<typename S::Element...>{detail::bind_streams(list, vertex_count)};
  } else {
    return detail::bind_streams(list, vertex_count);
  }
}

/// GL_PRIMITIVE_RESTART_FIXED_INDEX: the largest value of the index type ends the current strip, fan or list and starts a new one.
enum class PrimitiveRestart : bool { off, on };

/// Index list of a draw. The list is validated on construction, so create it once per mesh and use it in every frame. It references the
/// caller's memory, which must stay valid and unchanged while the Indices object is used.
class Indices {
 public:
  /// Returns the indices 0, 1, ..., vertex_count − 1, without a list. vertex_count must be less than 2^32.
  static Indices sequential(std::size_t vertex_count);
  /// Every index except for restarts must be less than vertex_count; otherwise an HS_CHECK fails.
  Indices(std::span<const uint32_t> list, std::size_t vertex_count, PrimitiveRestart restart = PrimitiveRestart::off);
  Indices(std::span<const uint16_t> list, std::size_t vertex_count, PrimitiveRestart restart = PrimitiveRestart::off);
  Indices(const std::vector<uint32_t>& list, std::size_t vertex_count, PrimitiveRestart restart = PrimitiveRestart::off)
      : Indices(std::span<const uint32_t>(list), vertex_count, restart) {}
  Indices(const std::vector<uint16_t>& list, std::size_t vertex_count, PrimitiveRestart restart = PrimitiveRestart::off)
      : Indices(std::span<const uint16_t>(list), vertex_count, restart) {}
  template <std::integral T>
  Indices(const std::vector<T>&&, std::size_t, PrimitiveRestart = PrimitiveRestart::off) = delete;  // the list must outlive the Indices

  std::size_t size() const { return size_; }
  uint32_t operator[](std::size_t i) const { return wide_ ? wide_[i] : narrow_ ? narrow_[i] : static_cast<uint32_t>(i); }
  /// Returns a pointer to index i if the list has 32-bit indices, otherwise null.
  const uint32_t* words(std::size_t i) const { return wide_ ? wide_ + i : nullptr; }
  /// Returns true if there is no list: index i is i.
  bool is_sequential() const { return wide_ == nullptr && narrow_ == nullptr; }
  /// All indices are in [first_vertex(), end_vertex()).
  uint32_t first_vertex() const { return first_; }
  uint32_t end_vertex() const { return end_; }
  /// Returns the distinct indices in ascending order. Empty if all indices in [first_vertex(), end_vertex()) are used.
  std::span<const uint32_t> used() const { return used_; }
  std::size_t used_count() const { return used_.empty() ? end_ - first_ : used_.size(); }
  /// Returns the positions of restarts in the list, in ascending order.
  std::span<const uint32_t> restarts() const { return restarts_; }

 private:
  Indices() = default;
  template <class T>
  void scan(std::span<const T> list, std::size_t vertex_count, PrimitiveRestart restart);

  const uint32_t* wide_ = nullptr;
  const uint16_t* narrow_ = nullptr;
  std::size_t size_ = 0;
  uint32_t first_ = 0, end_ = 0;
  std::vector<uint32_t> used_, restarts_;
};

}  // namespace halfspace::HS_LANES
