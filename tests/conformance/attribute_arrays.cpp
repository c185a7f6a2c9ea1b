// SPDX-License-Identifier: Apache-2.0
#include "conformance/attribute_arrays.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "halfspace/core/half.h"
#include "support/random.h"

namespace halfspace::conformance {

namespace {

// Returns the bytes of a number in memory, or of four packed ones.
int bytes_of(ComponentType type) {
  switch (type) {
    case ComponentType::uint8:
    case ComponentType::int8: return 1;
    case ComponentType::float16:
    case ComponentType::uint16:
    case ComponentType::int16: return 2;
    case ComponentType::float64: return 8;
    default: return 4;
  }
}

int row_size(const AttributeFormat& f) { return is_packed(f.type) ? 4 : bytes_of(f.type) * f.components; }

bool is_signed(ComponentType type) {
  return type == ComponentType::int8 || type == ComponentType::int16 || type == ComponentType::int32 ||
         type == ComponentType::int_2_10_10_10;
}

// Returns component k of a row as an unsigned code.
uint64_t code_at(ComponentType type, const std::byte* row, int k) {
  uint64_t code = 0;
  if (is_packed(type)) {
    std::memcpy(&code, row, 4);
    return code >> (10 * k) & (k == 3 ? 3u : 1023u);
  }
  std::memcpy(&code, row + k * bytes_of(type), static_cast<std::size_t>(bytes_of(type)));
  return code;
}

int bits_of(ComponentType type, int k) { return !is_packed(type) ? 8 * bytes_of(type) : k == 3 ? 2 : 10; }

double half_number(uint64_t code) {
  const auto exponent = static_cast<int>(code >> 10 & 31), significand = static_cast<int>(code & 1023);
  const double size = exponent == 0 ? std::ldexp(significand, -24) : std::ldexp(1024 + significand, exponent - 25);
  return (code & 0x8000) != 0 ? -size : size;
}

// Returns component k of a row that contains it, before it is normalized.
double number_at(ComponentType type, const std::byte* row, int k) {
  const uint64_t code = code_at(type, row, k);
  switch (type) {
    case ComponentType::float32: return static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(code)));
    case ComponentType::float16: return half_number(code);
    case ComponentType::float64: return std::bit_cast<double>(code);
    default: break;
  }
  const int bits = bits_of(type, k);
  const bool is_negative = is_signed(type) && code >> (bits - 1) != 0;
  return static_cast<double>(code) - (is_negative ? std::ldexp(1.0, bits) : 0.0);
}

void append(uint64_t code, int bytes, std::vector<std::byte>& to) {
  const auto* from = reinterpret_cast<const std::byte*>(&code);  // little endian, as in scene.cpp
  to.insert(to.end(), from, from + bytes);
}

uint64_t code_of(ComponentType type, int number) {
  switch (type) {
    case ComponentType::float32: return std::bit_cast<uint32_t>(static_cast<float>(number));
    case ComponentType::float16: return float_to_half(static_cast<float>(number));
    case ComponentType::float64: return std::bit_cast<uint64_t>(static_cast<double>(number));
    default: return static_cast<uint64_t>(number);
  }
}

uint64_t random_code(ComponentType type, Random& random) {
  const double real = random.real(-8.0, 8.0);  // as a double, usually not a float
  switch (type) {
    case ComponentType::float32: return std::bit_cast<uint32_t>(static_cast<float>(real));
    case ComponentType::float16: return static_cast<uint64_t>(random.below(31) << 10 | random.below(1024) | random.below(2) << 15);
    case ComponentType::float64: return std::bit_cast<uint64_t>(real);
    default: return random.bits();
  }
}

AttributeArray array_of(const AttributeFormat& f, std::size_t count, std::vector<std::byte> bytes) {
  AttributeArray a;
  a.memory = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  a.stream = {.data = a.memory->data(),
              .stride = row_size(f),
              .components = 4,
              .count = count,
              .type = f.type,
              .read_as = f.read_as,
              .missing = 4 - f.components,
              .bgra = f.bgra};
  return a;
}

}  // namespace

AttributeArray position_array(const AttributeFormat& f, std::span<const glm::ivec2> positions) {
  std::vector<std::byte> bytes;
  for (const glm::ivec2& p : positions) {
    const std::array<int, 4> coordinates{p.x, p.y, 0, 1};
    if (is_packed(f.type)) {
      append(static_cast<uint64_t>(p.x | p.y << 10 | 1 << 30), 4, bytes);
      continue;
    }
    for (int k = 0; k < f.components; ++k) append(code_of(f.type, coordinates[static_cast<std::size_t>(k)]), bytes_of(f.type), bytes);
  }
  return array_of(f, positions.size(), std::move(bytes));
}

AttributeArray random_array(const AttributeFormat& f, std::size_t count, uint64_t seed) {
  Random random(seed);
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i < count; ++i) {
    for (int k = 0; k < (is_packed(f.type) ? 1 : f.components); ++k) append(random_code(f.type, random), bytes_of(f.type), bytes);
  }
  return array_of(f, count, std::move(bytes));
}

std::vector<AttributeArray> interleaved(std::span<const AttributeArray> arrays, int offset, int gap) {
  const std::size_t rows = arrays[0].stream.count;
  std::vector<std::byte> bytes(static_cast<std::size_t>(offset), std::byte{0xff});
  std::vector<std::size_t> begins;  // of the attributes of the first row
  for (std::size_t i = 0; i < rows; ++i) {
    for (const AttributeArray& a : arrays) {
      if (i == 0) begins.push_back(bytes.size());
      const std::byte* row = a.stream.data + i * static_cast<std::size_t>(a.stream.stride);
      bytes.insert(bytes.end(), row, row + a.stream.stride);
      bytes.insert(bytes.end(), static_cast<std::size_t>(gap), std::byte{0xff});
    }
  }
  const auto stride = static_cast<int32_t>((bytes.size() - static_cast<std::size_t>(offset)) / rows);
  const auto memory = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
  std::vector<AttributeArray> out(arrays.begin(), arrays.end());
  for (std::size_t a = 0; a < out.size(); ++a) {
    out[a].memory = memory;
    out[a].stream.data = memory->data() + begins[a];
    out[a].stream.stride = stride;
  }
  return out;
}

std::array<float, 4> numbers_of(const VertexStream& s, std::size_t row) {
  const std::byte* at = s.data + row * static_cast<std::size_t>(s.stride);
  std::array<float, 4> out{};
  for (int k = 0; k < 4; ++k) {
    const bool is_missing = k >= s.components - s.missing;
    const int stored = s.bgra && k < 3 ? 2 - k : k;
    double number = is_missing ? (k == 3 ? 1.0 : 0.0) : number_at(s.type, at, stored);
    if (s.read_as == ReadAs::normalized && !is_missing) {
      const int bits = bits_of(s.type, stored);
      number = std::max(number / (std::ldexp(1.0, is_signed(s.type) ? bits - 1 : bits) - 1.0), -1.0);
    }
    out[static_cast<std::size_t>(k)] = s.read_as == ReadAs::integers
                                           ? std::bit_cast<float>(static_cast<uint32_t>(static_cast<int64_t>(number)))
                                           : static_cast<float>(number);
  }
  return out;
}

}  // namespace halfspace::conformance
