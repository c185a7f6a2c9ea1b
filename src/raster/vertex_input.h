// SPDX-License-Identifier: Apache-2.0
//
// Where a draw's vertices and indices lie: typed, bounds-checked views of the caller's memory.
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

namespace halfspace {

/// Floats of one attribute (or of several that lie side by side), one row a vertex.
struct VertexStream {
  const float* data = nullptr;
  int32_t stride = 0;      ///< from one vertex to the next, in floats
  int32_t components = 0;  ///< floats read per vertex
  std::size_t count = 0;   ///< vertices, or rows for instances
  uint32_t divisor = 0;    ///< 0: one row a vertex; n: one row for n instances (glVertexAttribDivisor)
};

/// A VertexStream of elements of type T, which Pass::draw compares with the shader's Attributes at compile time.
template <class T>
struct StreamOf : VertexStream {
  using Element = T;
};

/// A stream of tightly packed float, glm::vec2/3/4, or structs of floats such as Attributes<float>.
template <class T>
StreamOf<T> stream(std::span<const T> values) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(float) == 0 && alignof(T) == alignof(float));
  constexpr auto n = static_cast<int32_t>(sizeof(T) / sizeof(float));
  return {{reinterpret_cast<const float*>(values.data()), n, n, values.size()}};
}
template <class T>
StreamOf<T> stream(const std::vector<T>& values) {
  return stream(std::span<const T>(values));
}

/// A stream of one member of an interleaved vertex struct: stream(vertices, &MyVertex::normal).
template <class V, class F>
StreamOf<F> stream(std::span<const V> vertices, F V::*member) {
  static_assert(std::is_trivially_copyable_v<V> && sizeof(V) % sizeof(float) == 0 && sizeof(F) % sizeof(float) == 0);
  static_assert(std::is_same_v<F, float> || std::is_same_v<typename F::value_type, float>, "vertex attributes are made of float");
  StreamOf<F> s{{nullptr, sizeof(V) / sizeof(float), sizeof(F) / sizeof(float), vertices.size()}};
  if (!vertices.empty()) s.data = reinterpret_cast<const float*>(&(vertices.front().*member));
  return s;
}
template <class V, class F>
StreamOf<F> stream(const std::vector<V>& vertices, F V::*member) {
  return stream(std::span<const V>(vertices), member);
}

/// The stream with one row per `divisor` instances (≥ 1) instead of one per vertex.
template <std::derived_from<VertexStream> S>
S per_instance(S stream, uint32_t divisor = 1) {
  HS_CHECK_OP(divisor, >=, 1u);
  stream.divisor = divisor;
  return stream;
}

inline constexpr std::size_t kMaxStreams = kMaxFields;

/// The streams of a draw, in the order of the members of the shader's Attributes.
struct VertexView {
  std::array<VertexStream, kMaxStreams> streams;
  int stream_count = 0;
  std::size_t vertex_count = 0;
  std::size_t instance_count = std::size_t{1} << 31;  ///< for how many instances the per-instance streams have rows
  bool has_instance_streams = false;
  int components = 0;  ///< floats per vertex, of all streams
};

/// A VertexView whose streams' element types are known.
template <class... T>
struct VertexViewOf : VertexView {};

/// The streams of a view, wherever they are kept.
struct VertexStreams {
  std::span<const VertexStream> streams{};
  bool has_instance_streams = false;
};

/// The streams as the vertices of one instance see them: those of one row for several instances stand still. Where there are such, the
/// answer lies in `room`.
using StreamRoom = std::array<VertexStream, kMaxStreams>;
std::span<const VertexStream> at_instance(const VertexStreams& vertices, uint32_t instance, StreamRoom& room);

namespace detail {
/// streams: at most kMaxStreams.
VertexView bind_streams(std::span<const VertexStream> streams);
VertexView bind_streams(std::span<const VertexStream> streams, std::size_t vertex_count);
}  // namespace detail

/// Binds streams to the members of Attributes, in order. All streams with one row per vertex hold the same number of vertices, and there is
/// at least one such stream; each has at most 2^31 floats.
template <std::derived_from<VertexStream>... S>
auto make_vertex_view(const S&... streams) {
  static_assert(sizeof...(S) >= 1, "make_vertex_view() of no streams needs the number of vertices");
  const std::array<VertexStream, sizeof...(S)> list{streams...};
  if constexpr ((requires { typename S::Element; } && ...)) {
    return VertexViewOf<typename S::Element...>{detail::bind_streams(list)};
  } else {
    return detail::bind_streams(list);
  }
}

/// The same with an explicit number of vertices: for shaders without per-vertex streams, which compute their vertices from VertexId.
/// vertex_count: at most 2^32 − 1.
template <std::derived_from<VertexStream>... S>
auto make_vertex_view(std::size_t vertex_count, const S&... streams) {
  const std::array<VertexStream, sizeof...(S)> list{streams...};
  if constexpr ((requires { typename S::Element; } && ...)) {
    return VertexViewOf<typename S::Element...>{detail::bind_streams(list, vertex_count)};
  } else {
    return detail::bind_streams(list, vertex_count);
  }
}

/// GL_PRIMITIVE_RESTART_FIXED_INDEX: the largest index of its type ends a strip, fan or list and begins the next.
enum class PrimitiveRestart : bool { off, on };

/// The index list of a draw, checked once when made: build it once for a mesh and use it in every frame. Views the
/// caller's memory, which must stay unchanged as long as the Indices are used. Without a list: 0, 1, 2, …
class Indices {
 public:
  /// vertex_count consecutive vertices.
  static Indices sequential(std::size_t vertex_count);
  /// Every index must be below vertex_count; one beyond it is the caller's bug (HS_CHECK).
  Indices(std::span<const uint32_t> list, std::size_t vertex_count, PrimitiveRestart restart = PrimitiveRestart::off);
  Indices(std::span<const uint16_t> list, std::size_t vertex_count, PrimitiveRestart restart = PrimitiveRestart::off);
  Indices(const std::vector<uint32_t>& list, std::size_t vertex_count) : Indices(std::span<const uint32_t>(list), vertex_count) {}
  Indices(std::vector<uint32_t>&& list, std::size_t vertex_count) = delete;  // the list must outlive the Indices

  std::size_t size() const { return size_; }
  uint32_t operator[](std::size_t i) const { return wide_ ? wide_[i] : narrow_ ? narrow_[i] : static_cast<uint32_t>(i); }
  /// The list from place i on where it is one of 32-bit indices, else null.
  const uint32_t* words(std::size_t i) const { return wide_ ? wide_ + i : nullptr; }
  /// Is index i simply i?
  bool is_sequential() const { return wide_ == nullptr && narrow_ == nullptr; }
  /// The smallest and one past the largest index used.
  uint32_t first_vertex() const { return first_; }
  uint32_t end_vertex() const { return end_; }
  /// The distinct indices in rising order, or empty where every vertex of [first, end) is used.
  std::span<const uint32_t> used() const { return used_; }
  std::size_t used_count() const { return used_.empty() ? end_ - first_ : used_.size(); }
  /// The places in the list that hold no index but a restart, in rising order.
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

}  // namespace halfspace
