// SPDX-License-Identifier: Apache-2.0
//
// Reads the values in the data of a PLY file one after the other.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "halfspace/model/ply/ply_header.h"

namespace halfspace::HS_LANES {

class PlyValues {
 public:
  PlyValues(std::string_view data, PlyEncoding encoding, const std::string& file)
      : at_(data.data()), end_(data.data() + data.size()), encoding_(encoding), file_(file) {}

  /// Sets the row that error messages name.
  void set_row(const PlyElement& element, uint64_t row) {
    element_ = &element;
    row_ = row;
  }
  /// Throws InputError "FILE: element 'NAME', row N: what".
  [[noreturn]] void fail(const std::string& what) const;

  /// Returns the next value, which is exact for all types. Throws InputError at the end of the data.
  double number(PlyType type) {
    if (encoding_ == PlyEncoding::ascii) return ascii_number();
    switch (type) {
      case PlyType::int8: return static_cast<double>(binary<int8_t>());
      case PlyType::uint8: return static_cast<double>(binary<uint8_t>());
      case PlyType::int16: return static_cast<double>(binary<int16_t>());
      case PlyType::uint16: return static_cast<double>(binary<uint16_t>());
      case PlyType::int32: return static_cast<double>(binary<int32_t>());
      case PlyType::uint32: return static_cast<double>(binary<uint32_t>());
      case PlyType::float32: return static_cast<double>(binary<float>());
      case PlyType::float64: return binary<double>();
    }
    return 0.0;
  }

  /// Returns the length of a list. Throws InputError if the data is too short for it.
  std::size_t list_length(const PlyProperty& list) {
    const double length = number(*list.count_type);
    const std::size_t item_bytes = encoding_ == PlyEncoding::ascii ? 2 : size_of(list.type);
    const std::size_t max_length = (static_cast<std::size_t>(end_ - at_) + 1) / item_bytes;
    if (!(length >= 0.0 && length <= static_cast<double>(max_length))) fail_length(list, length, max_length);
    return static_cast<std::size_t>(length);
  }

  /// Reads a list of three 32-bit integers if the next list is one and the file is little-endian. Returns whether it was.
  bool read_triangle(std::array<uint32_t, 3>& triangle) {
    constexpr std::size_t kBytes = 1 + sizeof triangle;
    if (encoding_ != PlyEncoding::little_endian || static_cast<std::size_t>(end_ - at_) < kBytes || *at_ != 3) return false;
    std::memcpy(triangle.data(), at_ + 1, sizeof triangle);
    at_ += kBytes;
    return true;
  }

  /// Reads 32-bit floats if the file is little-endian and long enough. Returns whether it was.
  bool read_floats(std::span<double> row) {
    if (encoding_ != PlyEncoding::little_endian || static_cast<std::size_t>(end_ - at_) < row.size() * sizeof(float)) return false;
    for (double& value : row) {
      float number;
      std::memcpy(&number, at_, sizeof number);
      at_ += sizeof number;
      value = static_cast<double>(number);
    }
    return true;
  }

  /// Skips a value or a list.
  void skip(const PlyProperty& property) {
    const std::size_t count = property.count_type ? list_length(property) : 1;
    for (std::size_t i = 0; i < count; ++i) number(property.type);
  }

 private:
  template <class T>
  T binary() {
    if (static_cast<std::size_t>(end_ - at_) < sizeof(T)) fail_at_end();
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at_, sizeof(T));
    at_ += sizeof(T);
    if (encoding_ == PlyEncoding::big_endian) std::ranges::reverse(bytes);
    return std::bit_cast<T>(bytes);
  }

  double ascii_number();
  [[noreturn]] void fail_at_end() const;
  [[noreturn]] void fail_length(const PlyProperty& list, double length, std::size_t max_length) const;

  const char* at_;
  const char* end_;
  PlyEncoding encoding_;
  const std::string& file_;
  const PlyElement* element_ = nullptr;
  uint64_t row_ = 0;
};

}  // namespace halfspace::HS_LANES
