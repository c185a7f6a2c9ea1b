// SPDX-License-Identifier: Apache-2.0
//
// Vertices and indices of a draw: typed, bounds-checked views of memory that the caller owns.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "halfspace/raster/vertex_stream.h"

namespace halfspace::HS_LANES {

inline constexpr std::size_t kMaxStreams = kMaxFields;

/// Largest number of components of the streams of a draw: 16 attributes of four.
inline constexpr int kMaxStreamComponents = 64;

/// Vertex streams of a draw, in the order of the members of the shader's Attributes.
struct VertexView {
  std::array<VertexStream, kMaxStreams> streams;
  int stream_count = 0;
  std::size_t vertex_count = 0;
  bool has_instance_streams = false;
  bool needs_conversion = false;    ///< some stream is not read in place (is_read_in_place)
  int components = 0;               ///< numbers per vertex in all streams
  uint64_t integer_components = 0;  ///< bit i: number i is an integer

  std::span<const VertexStream> used_streams() const { return std::span(streams).first(static_cast<std::size_t>(stream_count)); }
};

/// A VertexView that stores the element types of its streams at compile time.
template <class... T>
struct VertexViewOf : VertexView {};

/// Non-owning reference to the streams of a view.
struct VertexStreams {
  std::span<const VertexStream> streams{};
  bool has_instance_streams = false;
  bool needs_conversion = false;
};

/// Storage for the result of at_instance().
using StreamStorage = std::array<VertexStream, kMaxStreams>;
/// Returns the streams for the vertices of one instance. Per-instance streams point to the row of the instance and have a stride of 0; if
/// there are any, the result is stored in `storage`.
std::span<const VertexStream> at_instance(const VertexStreams& vertices, uint32_t instance, StreamStorage& storage);

/// Writes the attributes of one vertex to `out`: the components of its rows in all streams, as the shader receives them (read_row). There
/// must be room for the components of all streams.
void read_vertex(std::span<const VertexStream> streams, std::size_t vertex, std::span<float> out);

namespace detail {
/// Implementation of make_vertex_view(). There must be at most kMaxStreams streams.
VertexView bind_streams(std::span<const VertexStream> streams);
VertexView bind_streams(std::span<const VertexStream> streams, std::size_t vertex_count);
}  // namespace detail

/// Binds streams to the members of Attributes, in order. At least one stream must have one row per vertex, and all such streams must have
/// the same number of rows. Each stream must have fewer than 2^31 rows and 2^33 bytes, and all streams at most 64 numbers per vertex.
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

/// The index that ends the current strip, fan or list and starts a new one (OpenGL 4.6, section 10.3.6).
class PrimitiveRestart {
 public:
  static const PrimitiveRestart off;  ///< no index
  static const PrimitiveRestart on;   ///< the largest value of the index type (GL_PRIMITIVE_RESTART_FIXED_INDEX)
  /// A chosen index (glPrimitiveRestartIndex). A value that the index type does not have is never found.
  static constexpr PrimitiveRestart at(uint32_t index) { return PrimitiveRestart(Mode::chosen, index); }

  /// Returns true if index i of a list of T ends a primitive.
  template <class T>
  constexpr bool ends_at(T i) const {
    return mode_ != Mode::off && i == (mode_ == Mode::chosen ? index_ : std::numeric_limits<T>::max());
  }

 private:
  enum class Mode : uint8_t { off, largest, chosen };
  constexpr PrimitiveRestart(Mode mode, uint32_t index) : mode_(mode), index_(index) {}

  Mode mode_;
  uint32_t index_;
};
inline constexpr PrimitiveRestart PrimitiveRestart::off{Mode::off, 0};
inline constexpr PrimitiveRestart PrimitiveRestart::on{Mode::largest, 0};

/// Index list of a draw: 8-, 16- or 32-bit indices. The list is validated on construction, so create it once per mesh and use it in every
/// frame. It references the caller's memory, which must stay valid and unchanged while the Indices object is used.
class Indices {
 public:
  /// Returns the indices 0, 1, ..., vertex_count − 1, without a list. vertex_count must be less than 2^32.
  static Indices sequential(std::size_t vertex_count);
  /// Every index except for restarts must be less than vertex_count; otherwise an HS_CHECK fails.
  Indices(std::span<const uint32_t> list, std::size_t vertex_count, PrimitiveRestart restart = PrimitiveRestart::off);
  Indices(std::span<const uint16_t> list, std::size_t vertex_count, PrimitiveRestart restart = PrimitiveRestart::off);
  Indices(std::span<const uint8_t> list, std::size_t vertex_count, PrimitiveRestart restart = PrimitiveRestart::off);
  template <std::integral T>
  Indices(const std::vector<T>& list, std::size_t vertex_count, PrimitiveRestart restart = PrimitiveRestart::off)
      : Indices(std::span<const T>(list), vertex_count, restart) {}
  template <std::integral T>
  Indices(const std::vector<T>&&, std::size_t, PrimitiveRestart = PrimitiveRestart::off) = delete;  // the list must outlive the Indices

  /// Returns the `count` indices from place `first` on, which must be in the list. A list is scanned again, so create the ranges that are
  /// drawn in every frame once.
  Indices range(std::size_t first, std::size_t count) const;

  std::size_t size() const { return size_; }
  uint32_t operator[](std::size_t i) const {
    return wide_ ? wide_[i] : narrow_ ? narrow_[i] : bytes_ ? bytes_[i] : first_ + static_cast<uint32_t>(i);
  }
  /// Returns a pointer to index i if the list has 32-bit indices, otherwise null.
  const uint32_t* words(std::size_t i) const { return wide_ ? wide_ + i : nullptr; }
  /// Returns true if there is no list: index i is first_vertex() + i.
  bool is_sequential() const { return wide_ == nullptr && narrow_ == nullptr && bytes_ == nullptr; }
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
  void scan(std::span<const T> list, std::size_t vertex_count);

  const uint32_t* wide_ = nullptr;
  const uint16_t* narrow_ = nullptr;
  const uint8_t* bytes_ = nullptr;
  std::size_t size_ = 0;
  uint32_t first_ = 0, end_ = 0;
  PrimitiveRestart restart_ = PrimitiveRestart::off;
  std::vector<uint32_t> used_, restarts_;
};

}  // namespace halfspace::HS_LANES
