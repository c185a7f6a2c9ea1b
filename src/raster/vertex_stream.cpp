// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/vertex_stream.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "halfspace/core/half.h"

namespace halfspace::HS_LANES {

namespace {

template <class T>
T load_number(const std::byte* p) {
  T number;
  std::memcpy(&number, p, sizeof number);
  return number;
}

// Integers of up to 16 bits and their limits are exact floats, so the quotient is rounded once. Those of 32 bits are divided in double.
template <class T>
float normalized_number(T c) {
  using Wide = std::conditional_t<sizeof(T) <= 2, float, double>;
  const Wide quotient = static_cast<Wide>(c) / static_cast<Wide>(std::numeric_limits<T>::max());
  return static_cast<float>(std::max(quotient, Wide(-1)));
}

template <class T>
float integer_bits(T c) {
  return std::bit_cast<float>(static_cast<int32_t>(c));
}

// Returns `bits` bits of a packed word, sign-extended if T is signed.
template <class T>
T packed_field(uint32_t word, int first, int bits) {
  return static_cast<T>(static_cast<T>(word << (32 - first - bits)) >> (32 - bits));
}

// T is uint32_t or int32_t.
template <class T>
void unpack_2_10_10_10(uint32_t word, bool normalized, float* out) {
  constexpr float ten_bits = std::is_signed_v<T> ? 511.0f : 1023.0f, two_bits = std::is_signed_v<T> ? 1.0f : 3.0f;
  for (int k = 0; k < 4; ++k) {
    const auto number = static_cast<float>(packed_field<T>(word, 10 * k, k < 3 ? 10 : 2));
    out[k] = normalized ? std::max(number / (k < 3 ? ten_bits : two_bits), -1.0f) : number;
  }
}

// Components of a row in memory.
int32_t stored_components(const VertexStream& s) { return s.components - s.missing; }

void append_missing(const VertexStream& s, float* row) {
  for (int32_t k = stored_components(s); k < s.components; ++k) {
    const int32_t value = k == 3 ? 1 : 0;
    row[k] = s.read_as == ReadAs::integers ? std::bit_cast<float>(value) : static_cast<float>(value);
  }
}

// Calls convert(bytes of a row, out) for each row.
template <class F>
void for_each_row(const VertexStream& s, std::span<const uint32_t> rows, float* out, F convert) {
  for (const uint32_t row : rows) {
    convert(s.data + std::size_t{row} * static_cast<std::size_t>(s.stride), out);
    append_missing(s, out);
    if (s.bgra) std::swap(out[0], out[2]);
    out += s.components;
  }
}

template <class T, class F>
void convert_numbers(const VertexStream& s, std::span<const uint32_t> rows, float* out, F convert) {
  for_each_row(s, rows, out, [&](const std::byte* from, float* to) {
    for (int32_t k = 0; k < stored_components(s); ++k) to[k] = convert(load_number<T>(from + static_cast<std::size_t>(k) * sizeof(T)));
  });
}

template <class T>
void read_integers(const VertexStream& s, std::span<const uint32_t> rows, float* out) {
  switch (s.read_as) {
    case ReadAs::normalized: return convert_numbers<T>(s, rows, out, normalized_number<T>);
    case ReadAs::integers: return convert_numbers<T>(s, rows, out, integer_bits<T>);
    case ReadAs::floats:
    case ReadAs::halves: return convert_numbers<T>(s, rows, out, [](T c) { return static_cast<float>(c); });
  }
}

template <class T>
void read_packed(const VertexStream& s, std::span<const uint32_t> rows, float* out) {
  for_each_row(s, rows, out, [&](const std::byte* from, float* to) {
    unpack_2_10_10_10<T>(load_number<uint32_t>(from), s.read_as == ReadAs::normalized, to);
  });
}

std::size_t bytes_of(ComponentType type) {
  switch (type) {
    case ComponentType::uint8:
    case ComponentType::int8: return 1;
    case ComponentType::float16:
    case ComponentType::uint16:
    case ComponentType::int16: return 2;
    case ComponentType::float64: return 8;
    case ComponentType::float32:
    case ComponentType::uint32:
    case ComponentType::int32:
    case ComponentType::uint_2_10_10_10:
    case ComponentType::int_2_10_10_10: return 4;
  }
  return 0;
}

}  // namespace

void read_rows(const VertexStream& s, std::span<const uint32_t> rows, float* out) {
  switch (s.type) {
    case ComponentType::float32:
      return for_each_row(s, rows, out, [&](const std::byte* from, float* to) { std::memcpy(to, from, row_bytes(s)); });
    case ComponentType::float16: return convert_numbers<uint16_t>(s, rows, out, [](uint16_t h) { return half_to_float(h); });
    case ComponentType::float64: return convert_numbers<double>(s, rows, out, [](double d) { return static_cast<float>(d); });
    case ComponentType::uint8: return read_integers<uint8_t>(s, rows, out);
    case ComponentType::int8: return read_integers<int8_t>(s, rows, out);
    case ComponentType::uint16: return read_integers<uint16_t>(s, rows, out);
    case ComponentType::int16: return read_integers<int16_t>(s, rows, out);
    case ComponentType::uint32: return read_integers<uint32_t>(s, rows, out);
    case ComponentType::int32: return read_integers<int32_t>(s, rows, out);
    case ComponentType::uint_2_10_10_10: return read_packed<uint32_t>(s, rows, out);
    case ComponentType::int_2_10_10_10: return read_packed<int32_t>(s, rows, out);
  }
}

void read_row(const VertexStream& s, std::size_t row, float* out) {
  VertexStream at = s;
  at.data += row * static_cast<std::size_t>(s.stride);
  constexpr uint32_t first = 0;
  read_rows(at, {&first, 1}, out);
}

std::size_t row_bytes(const VertexStream& s) {
  return bytes_of(s.type) * (is_packed(s.type) ? 1 : static_cast<std::size_t>(stored_components(s)));
}

bool is_read_in_place(const VertexStream& s) {
  return s.type == ComponentType::float32 && s.missing == 0 && reinterpret_cast<std::uintptr_t>(s.data) % alignof(float) == 0 &&
         static_cast<std::size_t>(s.stride) % sizeof(float) == 0;
}

}  // namespace halfspace::HS_LANES
