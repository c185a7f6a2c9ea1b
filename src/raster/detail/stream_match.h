// SPDX-License-Identifier: Apache-2.0
//
// Compares vertex streams with the members of a shader's Attributes: their element types at compile time or, if a plain VertexView does not
// have them, their components when a draw is added. Private, but installed because pass.h includes it.
//
// Attributes are a sequence of vectors: one per member, and one per column or element of an array. The streams must provide the same
// sequence. The elements of a stream are one vector, or a struct whose members are vectors, one after the other. Two kinds of struct
// members are compared less strictly, because C++ cannot tell what they are: floats in a row (they may be an array) can be a vector
// together, and matrices, arrays and nested structs can be any sequence of whole vectors of their size.
#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include "halfspace/core/vec.h"
#include "halfspace/raster/vertex_input.h"
#include "halfspace/shading/varyings.h"

namespace halfspace::HS_LANES::detail {

/// A vector of Attributes.
struct AttributeVector {
  std::size_t components;
  bool is_integer;
};

template <class Tuple>
struct VectorsOf;
template <class... F>
struct VectorsOf<std::tuple<F&...>> {
  static constexpr std::size_t count = (std::size_t{0} + ... + kVectorsIn<std::remove_const_t<F>>);
  static constexpr std::array<AttributeVector, count> value = [] {
    std::array<AttributeVector, count> out{};
    std::size_t i = 0;
    const auto add = [&](std::size_t vectors, std::size_t components, bool is_integer) {
      for (std::size_t k = 0; k < vectors; ++k) out[i++] = {components / vectors, is_integer};
    };
    (add(kVectorsIn<std::remove_const_t<F>>, FieldTraits<std::remove_const_t<F>>::components, kIntegerField<std::remove_const_t<F>>), ...);
    (void)add;
    return out;
  }();
};

enum class PartKind : uint8_t {
  vector,  ///< a number or a vector: exactly one vector of Attributes
  number,  ///< one number of a vector
  block    ///< any sequence of whole vectors
};
/// A part of the element of a stream.
struct StreamPart {
  PartKind kind;
  std::size_t components;
};

/// Number of components of T if it is a vector of floats, otherwise 0.
template <class T>
inline constexpr std::size_t kVectorSize = 0;
template <int L>
inline constexpr std::size_t kVectorSize<VecN<L, float>> = L;
template <glm::length_t L>
inline constexpr std::size_t kVectorSize<glm::vec<L, float>> = L;

// Convert to the members of a struct that are a part of the given kind. `n`: components, or 0 for any number.
template <std::size_t n>
struct VectorField {
  template <class T>
  requires(kVectorSize<T> == n) operator T() const;
};
template <std::size_t n>
struct BlockField {
  template <class T>
  requires(std::is_class_v<T>&& kVectorSize<T> == 0 && (n == 0 || sizeof(T) == n * sizeof(float))) operator T() const;
};

/// Whether a Field converts to member `sizeof...(I)` of the aggregate T.
template <class T, class Field, std::size_t... I>
constexpr bool is_field(std::index_sequence<I...>) {
  return requires { T{((void)I, AnyField{})..., Field{}}; };
}

template <class T, std::size_t i, std::size_t n = 1>
constexpr StreamPart block_at() {
  if constexpr (is_field<T, BlockField<n>>(std::make_index_sequence<i>{}) || n * sizeof(float) >= sizeof(T)) {
    return {PartKind::block, n};
  } else {
    return block_at<T, i, n + 1>();
  }
}

/// Returns the part that member i of the aggregate T is.
template <class T, std::size_t i>
constexpr StreamPart part_at() {
  constexpr std::make_index_sequence<i> before;
  // A member that is an array class is found as a block, before its first element is taken for a vector.
  if constexpr (is_field<T, BlockField<0>>(before)) return block_at<T, i>();
  if constexpr (is_field<T, VectorField<2>>(before)) return {PartKind::vector, 2};
  if constexpr (is_field<T, VectorField<3>>(before)) return {PartKind::vector, 3};
  if constexpr (is_field<T, VectorField<4>>(before)) return {PartKind::vector, 4};
  return {PartKind::number, 1};
}

template <class T, std::size_t... I>
constexpr std::array<StreamPart, sizeof...(I)> parts_of_struct(std::index_sequence<I...>) {
  return {part_at<T, I>()...};
}

template <std::size_t N>
constexpr std::size_t components_of_parts(const std::array<StreamPart, N>& parts) {
  std::size_t n = 0;
  for (const StreamPart& p : parts) n += p.components;
  return n;
}

/// Returns the parts of the element type of a stream.
template <class T>
constexpr auto parts_of() {
  constexpr std::size_t size = sizeof(T) / sizeof(float);
  if constexpr (std::is_arithmetic_v<T> || kVectorSize<T> != 0 || requires { T::length(); }) {
    constexpr bool is_matrix = requires { typename T::col_type; };
    return std::array{StreamPart{is_matrix ? PartKind::block : PartKind::vector, size}};
  } else if constexpr (std::is_class_v<T> && std::is_aggregate_v<T> && !requires { typename T::value_type; }) {
    constexpr auto parts = parts_of_struct<T>(std::make_index_sequence<count_fields<T, size>()>{});
    if constexpr (components_of_parts(parts) == size) {
      return parts;
    } else {
      return std::array{StreamPart{PartKind::block, size}};
    }
  } else {
    return std::array{StreamPart{PartKind::block, size}};
  }
}

/// Whether the elements of a stream are integers.
template <class T>
inline constexpr bool kIntegerElement = std::is_same_v<typename NumberIn<T>::type, int32_t>;

/// Compares the parts of streams with the vectors of Attributes, in order.
class StreamMatcher {
 public:
  constexpr explicit StreamMatcher(std::span<const AttributeVector> vectors) : vectors_(vectors) {}

  /// Takes the vectors of the next stream. Returns false if Attributes has other ones.
  constexpr bool take(std::span<const StreamPart> parts, bool is_integer) {
    for (const StreamPart& p : parts) {
      if (!take(p, is_integer)) return false;
    }
    return numbers_ == 0;  // a vector does not continue in the next stream
  }
  constexpr bool is_complete() const { return next_ == vectors_.size(); }

 private:
  constexpr bool is_next(std::size_t max_components, bool is_integer) const {
    return next_ < vectors_.size() && vectors_[next_].components <= max_components && vectors_[next_].is_integer == is_integer;
  }
  constexpr bool take(const StreamPart& p, bool is_integer) {
    if (p.kind == PartKind::number) {
      if (next_ == vectors_.size() || vectors_[next_].is_integer != is_integer) return false;
      if (++numbers_ == vectors_[next_].components) {
        ++next_;
        numbers_ = 0;
      }
      return true;
    }
    if (numbers_ != 0) return false;
    if (p.kind == PartKind::vector) return is_next(p.components, is_integer) && vectors_[next_++].components == p.components;
    std::size_t rest = p.components;
    while (rest != 0 && is_next(rest, is_integer)) rest -= vectors_[next_++].components;
    return rest == 0;
  }

  std::span<const AttributeVector> vectors_;
  std::size_t next_ = 0, numbers_ = 0;
};

/// Returns true if streams with elements T... provide the members of the attributes A.
template <class A, class... T>
constexpr bool streams_match() {
  constexpr auto vectors = VectorsOf<FieldsOf<A>>::value;
  StreamMatcher matcher(vectors);
  [[maybe_unused]] const auto take = [&]<class E>(std::type_identity<E>) {
    constexpr auto parts = parts_of<E>();
    return matcher.take(parts, kIntegerElement<E>);
  };
  return (take(std::type_identity<T>()) && ...) && matcher.is_complete();
}

/// Checks that the streams of a plain VertexView provide the members of the attributes A. A stream can have several members, and one of
/// nine floats can be three vec3 or a vec4, a vec3 and a vec2.
template <class A>
void check_streams(const VertexView& vertices) {
  constexpr auto vectors = VectorsOf<FieldsOf<A>>::value;
  StreamMatcher matcher(vectors);
  bool match = true;
  for (const VertexStream& s : vertices.used_streams()) {
    const StreamPart part{PartKind::block, static_cast<std::size_t>(s.components)};
    match = match && matcher.take(std::span(&part, 1), s.read_as == ReadAs::integers);
  }
  HS_CHECK(match && matcher.is_complete(),
           "Pass::draw: the vertex streams do not match the attributes of the shader; expected the components of the attributes, in their "
           "order, and stream<ReadAs::integers> for IntOf<R> and only for it");
}

template <class A, class V>
inline constexpr bool kStreamsMatch = true;  // a plain VertexView: see check_streams()
template <class A, class... T>
inline constexpr bool kStreamsMatch<A, VertexViewOf<T...>> = streams_match<A, T...>();

}  // namespace halfspace::HS_LANES::detail
