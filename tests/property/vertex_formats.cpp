// SPDX-License-Identifier: Apache-2.0
#include "property/vertex_formats.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace halfspace {

namespace {

struct FormatTraits {
  ComponentType type = ComponentType::float32;
  ReadAs read_as = ReadAs::floats;
};
FormatTraits traits_of(StreamFormat format) {
  switch (format) {
    case StreamFormat::in_place:
    case StreamFormat::floats: return {};
    case StreamFormat::halves: return {.type = ComponentType::float16};
    case StreamFormat::doubles: return {.type = ComponentType::float64};
    case StreamFormat::unorm8: return {ComponentType::uint8, ReadAs::normalized};
    case StreamFormat::snorm16: return {ComponentType::int16, ReadAs::normalized};
    case StreamFormat::scaled8: return {.type = ComponentType::int8};
  }
  return {};
}

// The largest code of a format of integers.
float max_code(StreamFormat format) { return format == StreamFormat::unorm8 ? 255.0f : format == StreamFormat::snorm16 ? 32767.0f : 7.0f; }
float nearest_code(StreamFormat format, float x) {
  const float max = max_code(format), scale = format == StreamFormat::scaled8 ? 1.0f : max;
  return std::clamp(std::nearbyint(x * scale), format == StreamFormat::unorm8 ? 0.0f : -max, max) + 0.0f;  // an integer 0 has no sign
}

// Returns the bits of a number that is a half: sign, exponent + 15, and ten bits of the significand.
uint16_t half_bits(float x) {
  int exponent = 0;
  const float significand = std::frexp(std::fabs(x), &exponent);  // [0.5, 1)
  const auto sign = static_cast<uint16_t>(std::signbit(x) ? 0x8000 : 0);
  if (significand == 0.0f) return sign;
  return static_cast<uint16_t>(sign | ((exponent + 14) << 10) | (static_cast<int>(significand * 2048.0f) & 0x3ff));
}

template <class T>
void append(T number, std::vector<std::byte>& to) {
  const auto* bytes = reinterpret_cast<const std::byte*>(&number);
  to.insert(to.end(), bytes, bytes + sizeof number);
}
void append(StreamFormat format, float x, std::vector<std::byte>& to) {
  switch (format) {
    case StreamFormat::in_place:
    case StreamFormat::floats: return append(x, to);
    case StreamFormat::halves: return append(half_bits(x), to);
    case StreamFormat::doubles: return append(static_cast<double>(x), to);
    case StreamFormat::unorm8: return append(static_cast<uint8_t>(nearest_code(format, x)), to);
    case StreamFormat::snorm16: return append(static_cast<int16_t>(nearest_code(format, x)), to);
    case StreamFormat::scaled8: return append(static_cast<int8_t>(nearest_code(format, x)), to);
  }
}

// Adds a stream with components of one kind. It starts at an odd address.
void add_run(const FormattedRows& rows, int begin, int end, bool is_integer, StreamFormat format, uint32_t divisor,
             std::vector<std::vector<std::byte>>& memory, std::vector<VertexStream>& streams) {
  std::vector<std::byte> bytes(1);
  std::size_t stride = 0;
  for (std::size_t row = 0; row < rows.count; ++row) {
    const std::size_t start = bytes.size();
    for (int k = begin; k < end; ++k) {
      const float x = rows.data[row * static_cast<std::size_t>(rows.components) + static_cast<std::size_t>(k)];
      append(is_integer ? StreamFormat::floats : format, x, bytes);  // the bits of an integer are those of a float
    }
    bytes.resize(bytes.size() + ((bytes.size() - start) % 2 == 0 ? 1 : 2));
    stride = bytes.size() - start;
  }
  memory.push_back(std::move(bytes));
  FormatTraits traits = traits_of(format);
  if (is_integer) traits = {ComponentType::int32, ReadAs::integers};
  streams.push_back(
      {memory.back().data() + 1, static_cast<int32_t>(stride), end - begin, rows.count, divisor, traits.type, traits.read_as});
}

}  // namespace

float rounded_to(StreamFormat format, float x) {
  switch (format) {
    case StreamFormat::in_place:
    case StreamFormat::floats:
    case StreamFormat::doubles: return x;
    case StreamFormat::halves: {
      int exponent = 0;
      const float significand = std::frexp(x, &exponent);
      return std::fabs(x) < 0x1p-14f ? 0.0f : std::ldexp(std::nearbyint(significand * 2048.0f), exponent - 11);
    }
    case StreamFormat::unorm8:
    case StreamFormat::snorm16: return nearest_code(format, x) / max_code(format);
    case StreamFormat::scaled8: return nearest_code(format, x);
  }
  return x;
}

void add_formatted(const FormattedRows& rows, int begin, int end, StreamFormat format, uint32_t divisor,
                   std::vector<std::vector<std::byte>>& memory, std::vector<VertexStream>& streams) {
  const auto is_integer = [&](int k) { return (rows.integer_components >> k & 1) != 0; };
  while (begin < end) {
    const bool is_position = begin < 4;
    int next = begin + 1;
    while (next < end && (next < 4) == is_position && is_integer(next) == is_integer(begin)) ++next;
    add_run(rows, begin, next, is_integer(begin), is_position ? StreamFormat::floats : format, divisor, memory, streams);
    begin = next;
  }
}

}  // namespace halfspace
