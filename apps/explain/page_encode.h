// SPDX-License-Identifier: Apache-2.0
//
// Encodes pictures and arrays for HTML pages.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/image.h"

namespace halfspace {

/// Returns a data URI of a PNG file.
std::string picture_uri(const Image<glm::u8vec4>& picture);

/// Returns a PNG file in base64 that contains the bytes, three per pixel, padded with zeros. PNG compresses them, and pages can decompress
/// PNG files without a library.
std::string packed_bytes(std::span<const std::byte> bytes);

/// Encodes an array of numbers as byte planes: the first bytes of all elements, then the second bytes, and so on. Planes compress better.
template <class T>
std::string packed_planes(std::span<const T> values) {
  const std::span<const std::byte> bytes = std::as_bytes(values);
  std::vector<std::byte> planes(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) planes[i % sizeof(T) * values.size() + i / sizeof(T)] = bytes[i];
  return packed_bytes(planes);
}

/// Returns the color of a heat map for t in [0, 1], from dark blue to light yellow. Lightness increases with t.
glm::u8vec4 heat_color(float t);

/// Converts linear light in [0, 1] to 8-bit sRGB values.
glm::u8vec4 srgb_code(const glm::vec3& linear);

/// Escapes JSON for use inside a <script> element, so that it does not contain "</".
std::string script_safe(std::string_view json);

}  // namespace halfspace
