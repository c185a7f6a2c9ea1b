// SPDX-License-Identifier: Apache-2.0
//
// Vertex streams: arrays of attributes in memory that the caller owns, in any format of OpenGL 4.6, section 10.3.
//
//   std::vector<glm::vec3> positions = ...;
//   std::vector<glm::u8vec4> colors = ...;
//   std::vector<glm::u16vec2> uvs = ...;         // halves
//   std::vector<glm::u8vec4> joints = ...;
//   make_vertex_view(stream(positions), stream<ReadAs::normalized>(colors), stream<ReadAs::halves>(uvs), stream<ReadAs::integers>(joints));
//
// The attributes of this view are vec3<R>, vec4<R>, vec2<R> and std::array<IntOf<R>, 4>.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <span>
#include <type_traits>

#include <glm/glm.hpp>

#include "halfspace/core/aggregate_reflection.h"
#include "halfspace/core/check.h"

namespace halfspace::HS_LANES {

/// Type of the numbers of a stream in memory. The last two are four numbers in 32 bits: x in the lowest ten bits, then y, z, and w in the
/// upper two bits (GL_UNSIGNED_INT_2_10_10_10_REV, GL_INT_2_10_10_10_REV).
enum class ComponentType : uint8_t {
  float32,
  float16,
  float64,
  uint8,
  int8,
  uint16,
  int16,
  uint32,
  int32,
  uint_2_10_10_10,
  int_2_10_10_10
};

constexpr bool is_packed(ComponentType type) { return type == ComponentType::uint_2_10_10_10 || type == ComponentType::int_2_10_10_10; }

/// How a shader receives the numbers of a stream (OpenGL 4.6, sections 2.3.5 and 10.3.1).
enum class ReadAs : uint8_t {
  floats,      ///< R: the nearest float to the number, without scaling
  normalized,  ///< R: of b bits, c/(2^b − 1) if unsigned, in [0, 1], or max(c/(2^(b−1) − 1), −1) if signed
  integers,    ///< IntOf<R>: the value; unsigned 32-bit integers keep their bits
  halves       ///< R: the numbers are IEEE 754 binary16; for stream() in uint16_t, and in a VertexStream as ComponentType::float16
};

/// Four packed numbers; see ComponentType. Read as normalized or as floats.
struct Uint2_10_10_10 {
  uint32_t bits;
};
struct Int2_10_10_10 {
  uint32_t bits;
};

/// Array with one row per vertex or group of instances. A row contains one attribute, or several consecutive ones. Neither the data nor the
/// stride need to be aligned. A stride of 0 gives all vertices the same row (glVertexAttrib).
struct VertexStream {
  const std::byte* data = nullptr;
  int32_t stride = 0;      ///< distance between rows, in bytes
  int32_t components = 0;  ///< numbers that the shader receives per row; 4 if they are packed
  std::size_t count = 0;   ///< number of rows
  uint32_t divisor = 0;    ///< 0: one row per vertex; n: one row per n instances (glVertexAttribDivisor)
  ComponentType type = ComponentType::float32;
  ReadAs read_as = ReadAs::floats;
  int32_t missing = 0;  ///< the last components, which a row does not contain; see with_components()
  bool bgra = false;    ///< see bgra()
};

/// Writes the components of the given rows of the stream to `out`, one row after the other, as the shader receives them. Integers are
/// stored as the bits of a float. Rows must be less than stream.count.
void read_rows(const VertexStream& stream, std::span<const uint32_t> rows, float* out);
/// The same for one row.
void read_row(const VertexStream& stream, std::size_t row, float* out);
/// Returns the bytes of a row: all of them are read.
std::size_t row_bytes(const VertexStream& stream);
/// Returns true if the stream consists of floats that the vertex stage reads in place: aligned, read as floats, and none missing.
bool is_read_in_place(const VertexStream& stream);

/// A VertexStream with elements that the shader receives as type T: of floats, or of int32_t. Pass::draw compares T with the shader's
/// Attributes at compile time.
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

/// The type of the numbers in T: a number, a vector, an array, or an array of one of these. Packed numbers are a type of their own.
template <class T>
struct NumberIn : std::type_identity<T> {};
template <class T>
requires requires { typename T::value_type; }
struct NumberIn<T> : NumberIn<typename T::value_type> {};
template <class T, std::size_t N>
struct NumberIn<T[N]> : NumberIn<T> {};

template <class T>
inline constexpr bool kIsPacked = std::is_same_v<T, Uint2_10_10_10> || std::is_same_v<T, Int2_10_10_10>;

/// Whether a stream can read numbers of type T in this way.
template <class T, ReadAs as>
consteval bool can_read() {
  constexpr bool small = std::is_integral_v<T> && sizeof(T) <= 4 && !std::is_same_v<T, bool>;
  switch (as) {
    case ReadAs::floats: return small || kIsPacked<T> || std::is_same_v<T, float> || std::is_same_v<T, double>;
    case ReadAs::normalized: return small || kIsPacked<T>;
    case ReadAs::integers: return small;
    case ReadAs::halves: return std::is_same_v<T, uint16_t>;
  }
  return false;
}

template <class T, ReadAs as>
consteval ComponentType component_type() {
  if constexpr (as == ReadAs::halves) return ComponentType::float16;
  if constexpr (std::is_same_v<T, Uint2_10_10_10>) return ComponentType::uint_2_10_10_10;
  if constexpr (std::is_same_v<T, Int2_10_10_10>) return ComponentType::int_2_10_10_10;
  if constexpr (std::is_floating_point_v<T>) return sizeof(T) == 4 ? ComponentType::float32 : ComponentType::float64;
  constexpr bool is_unsigned = std::is_unsigned_v<T>;
  if constexpr (sizeof(T) == 1) return is_unsigned ? ComponentType::uint8 : ComponentType::int8;
  if constexpr (sizeof(T) == 2) return is_unsigned ? ComponentType::uint16 : ComponentType::int16;
  return is_unsigned ? ComponentType::uint32 : ComponentType::int32;
}

/// What the shader receives for n numbers of a stream: a number, a vector, or an array.
template <class Number, std::size_t n>
struct Received : std::type_identity<std::array<Number, n>> {};
template <class Number>
struct Received<Number, 1> : std::type_identity<Number> {};
template <class Number, std::size_t n>
requires(n >= 2 && n <= 4) struct Received<Number, n> : std::type_identity<glm::vec<static_cast<int>(n), Number>> {
};

/// Properties of a stream with elements of type T that are read in the given way.
template <class T, ReadAs as>
struct ReadElement {
  using Number = typename NumberIn<T>::type;
  static constexpr std::size_t n = kIsPacked<Number> ? 4 : sizeof(T) / sizeof(Number);
  using Read = std::conditional_t<as == ReadAs::integers, int32_t, float>;
  static constexpr bool is_matrix = requires { typename T::col_type; };  // not one vector, even if it has four numbers
  using Stream = StreamOf<std::conditional_t<is_matrix, std::array<Read, n>, typename Received<Read, n>::type>>;

  static Stream stream(const void* data, std::size_t stride, std::size_t count) {
    return {{static_cast<const std::byte*>(data), static_cast<int32_t>(stride), static_cast<int32_t>(n), count, 0,
             component_type<Number, as>(), as == ReadAs::halves ? ReadAs::floats : as}};
  }
};

/// Always true; compilation fails with a message if elements of type T cannot be read in the given way.
template <class T, ReadAs as>
consteval bool require_readable() {
  using Number = typename NumberIn<T>::type;
  static_assert(can_read<Number, as>(),
                "the elements of a stream<ReadAs::…> must be numbers, or vectors or arrays of them: floats and normalized read 8-, 16- and "
                "32-bit integers and packed numbers, floats also float and double, integers only integers, and halves only uint16_t");
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(Number) == 0);
  static_assert(!kIsPacked<Number> || sizeof(T) == sizeof(Number), "packed numbers are one attribute: expected no arrays of them");
  return true;
}

/// The same for a stream of floats.
template <class T>
consteval bool require_floats() {
  static_assert(consists_of_floats<T>(),
                "vertex attributes must consist of floats; for other numbers, say how to read them: stream<ReadAs::normalized>(…), "
                "stream<ReadAs::floats>(…), stream<ReadAs::integers>(…) or stream<ReadAs::halves>(…)");
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(float) == 0);
  return true;
}

template <class T>
StreamOf<T> float_stream(const void* data, std::size_t stride, std::size_t count) {
  return {{static_cast<const std::byte*>(data), static_cast<int32_t>(stride), static_cast<int32_t>(sizeof(T) / sizeof(float)), count}};
}

/// The same for a range that the caller passes.
template <class Range>
consteval bool require_lasting() {
  static_assert(std::is_lvalue_reference_v<Range> || std::ranges::borrowed_range<Range>, "the vector must outlive the stream");
  return true;
}

/// The address of a member of the first vertex, or null.
template <class Range, class V, class F>
const void* first_member(const Range& vertices, F V::*member) {
  return std::ranges::empty(vertices) ? nullptr : &((*std::ranges::data(vertices)).*member);
}

}  // namespace detail

/// Creates a stream of a vector, array or span of float, glm::vec2/3/4, or structs of floats such as Attributes<float>. Elements with other
/// numbers, such as uint32_t, glm::ivec4 or a struct with a packed color, do not compile: state how to read them, or make a stream of a
/// member (see below). The memory must stay valid and unchanged until Pass::run() returns, so a temporary vector does not compile.
template <std::ranges::contiguous_range Range>
auto stream(Range&& values) {
  using T = std::ranges::range_value_t<Range>;
  static_assert(detail::require_floats<T>() && detail::require_lasting<Range>());
  return detail::float_stream<T>(std::ranges::data(values), sizeof(T), std::ranges::size(values));
}

/// Creates a stream of one member of an interleaved vertex struct: stream(vertices, &MyVertex::normal).
template <std::ranges::contiguous_range Range, class V, class F>
auto stream(Range&& vertices, F V::*member) {
  static_assert(detail::require_floats<F>() && detail::require_lasting<Range>());
  return detail::float_stream<F>(detail::first_member(vertices, member), sizeof(std::ranges::range_value_t<Range>),
                                 std::ranges::size(vertices));
}

/// Creates a stream of numbers, or of vectors or arrays of numbers, of any type that can be read in the given way:
/// stream<ReadAs::normalized>(colors) with a std::vector<glm::u8vec4>.
template <ReadAs as, std::ranges::contiguous_range Range>
auto stream(Range&& values) {
  using T = std::ranges::range_value_t<Range>;
  static_assert(detail::require_readable<T, as>() && detail::require_lasting<Range>());
  return detail::ReadElement<T, as>::stream(std::ranges::data(values), sizeof(T), std::ranges::size(values));
}

/// The same for one member of an interleaved vertex struct: stream<ReadAs::integers>(vertices, &MyVertex::joints).
template <ReadAs as, std::ranges::contiguous_range Range, class V, class F>
auto stream(Range&& vertices, F V::*member) {
  static_assert(detail::require_readable<F, as>() && detail::require_lasting<Range>());
  return detail::ReadElement<F, as>::stream(detail::first_member(vertices, member), sizeof(std::ranges::range_value_t<Range>),
                                            std::ranges::size(vertices));
}

/// Returns the stream with one row per `divisor` instances instead of one row per vertex. divisor must be at least 1.
template <std::derived_from<VertexStream> S>
S per_instance(S stream, uint32_t divisor = 1) {
  HS_CHECK_OP(divisor, >=, 1u, "per_instance: the divisor is 0; expected at least 1");
  stream.divisor = divisor;
  return stream;
}

/// Returns the stream as one of vectors with N components (2 to 4), of which its rows contain fewer. As in OpenGL (4.6, section 10.3), the
/// missing second and third component are 0, and the fourth is 1: with_components<4>(stream(positions)).
template <int N, class T>
auto with_components(const StreamOf<T>& stream) {
  using Number = typename detail::NumberIn<T>::type;
  static_assert(
      std::is_same_v<T, typename detail::Received<Number, sizeof(T) / sizeof(Number)>::type> && sizeof(T) / sizeof(Number) < N && N <= 4,
      "with_components: expected a stream of numbers or of vectors with fewer components than the result, which has at most 4");
  StreamOf<glm::vec<N, Number>> out{stream};
  out.components = N;
  out.missing = stream.missing + N - stream.components;
  return out;
}

/// Returns the stream of normalized bytes or packed numbers with the first and third component of each row exchanged (GL_BGRA):
/// bgra(stream<ReadAs::normalized>(colors)). make_vertex_view() refuses other numbers.
inline StreamOf<glm::vec4> bgra(StreamOf<glm::vec4> stream) {
  stream.bgra = true;
  return stream;
}

}  // namespace halfspace::HS_LANES
