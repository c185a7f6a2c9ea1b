// SPDX-License-Identifier: Apache-2.0
//
// Creates textures of every format for the tests, and implements OpenGL 4.6, section 8.14.2, in double on integer texel indices.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "halfspace/shading/texture/texture.h"

namespace halfspace::test {

inline constexpr TexelFormat kFormats[] = {TexelFormat::rgba8, TexelFormat::srgb8a8, TexelFormat::r8,
                                           TexelFormat::r16,   TexelFormat::rgba16f, TexelFormat::rgba32f};
inline constexpr Wrap kWraps[] = {Wrap::repeat, Wrap::mirrored, Wrap::clamp, Wrap::border, Wrap::mirrored_clamp};

/// Returns a texture whose texels are derived from the 32-bit value bits(x, row): integer channels are its low bits, floats are computed
/// from its bytes.
template <class Bits>
Texture2D make_texture(int width, int height, TexelFormat format, const Bits& bits) {
  Image<glm::u8vec4> codes(width, height);
  Image<uint8_t> r8(width, height);
  Image<uint16_t> r16(width, height);
  Image<glm::vec4> linear(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const uint32_t b = bits(x, y);
      const glm::u8vec4 bytes(b & 255, b >> 8 & 255, b >> 16 & 255, b >> 24);
      codes.at(x, y) = bytes;
      r8.at(x, y) = bytes.x;
      r16.at(x, y) = static_cast<uint16_t>(b & 0xffff);
      linear.at(x, y) = (glm::vec4(bytes) - glm::vec4(100.0f)) * glm::vec4(0.37f, 0.11f, 1.0f, 0x1p-20f);
    }
  }
  switch (format) {
    case TexelFormat::r8: return Texture2D(r8);
    case TexelFormat::r16: return Texture2D(r16);
    case TexelFormat::rgba16f:
    case TexelFormat::rgba32f: return {linear, format};
    default: return {codes, format};
  }
}
inline Texture2D make_noise(int width, int height, TexelFormat format, unsigned seed) {
  std::mt19937 random(seed);
  return make_texture(width, height, format, [&](int, int) { return static_cast<uint32_t>(random()); });
}

/// Returns the texel that OpenGL reads for index i along an axis; −1 stands for the border.
inline int wrapped_index(int64_t i, int size, Wrap wrap) {
  const auto modulo = [](int64_t a, int64_t n) { return ((a % n) + n) % n; };
  switch (wrap) {
    case Wrap::repeat: return static_cast<int>(modulo(i, size));
    case Wrap::mirrored: {
      const int64_t a = modulo(i, 2 * size) - size;
      return static_cast<int>(size - 1 - (a >= 0 ? a : -(1 + a)));
    }
    case Wrap::clamp: return static_cast<int>(std::clamp<int64_t>(i, 0, size - 1));
    case Wrap::border: return i < 0 || i >= size ? -1 : static_cast<int>(i);
    case Wrap::mirrored_clamp: return static_cast<int>(std::clamp<int64_t>(i >= 0 ? i : -1 - i, 0, size - 1));
  }
  return -1;
}

/// A filtered value and the range of the texels that contribute to it.
struct Mixed {
  glm::dvec4 value{0.0}, low{INFINITY}, high{-INFINITY};
  void add(double weight, const glm::dvec4& v) {
    value += weight * v;
    low = glm::min(low, v);
    high = glm::max(high, v);
  }
};

/// Returns the sampler's border color as represented in the texture's format.
inline glm::dvec4 border_of(const Texture2D& texture, const Sampler& sampler) {
  const TexelFormat f = texture.format();
  glm::dvec4 b(sampler.border_color);
  if (f != TexelFormat::rgba16f && f != TexelFormat::rgba32f) b = glm::clamp(b, 0.0, 1.0);
  return f == TexelFormat::r8 || f == TexelFormat::r16 ? glm::dvec4(b.x, 0, 0, 1) : b;
}

inline void mix_level(const Texture2D& texture, const Sampler& sampler, double s, double t, int level, bool nearest, double weight,
                      Mixed& to) {
  const int w = texture.width(level), h = texture.height(level);
  const auto texel = [&](double x, double y) {
    const int i = wrapped_index(static_cast<int64_t>(x), w, sampler.wrap_s), j = wrapped_index(static_cast<int64_t>(y), h, sampler.wrap_t);
    return i < 0 || j < 0 ? border_of(texture, sampler) : glm::dvec4(texture.value(level, i, j));
  };
  if (nearest) return to.add(weight, texel(std::floor(s * w), std::floor(t * h)));
  const double u = s * w - 0.5, v = t * h - 0.5, x = std::floor(u), y = std::floor(v), a = u - x, b = v - y;
  for (int k = 0; k < 4; ++k) to.add(weight * (k % 2 ? a : 1 - a) * (k / 2 ? b : 1 - b), texel(x + k % 2, y + k / 2));
}

/// Performs an isotropic lookup at a given level of detail.
inline Mixed reference(const Texture2D& texture, const Sampler& sampler, double s, double t, double lod) {
  Mixed mixed;
  const bool magnified = !(lod > 0), nearest = (magnified ? sampler.mag : sampler.min) == Filter::nearest;
  const double clamped = magnified || sampler.min != Filter::trilinear ? 0 : std::min(lod, texture.levels() - 1.0),
               level = std::floor(clamped);
  mix_level(texture, sampler, s, t, static_cast<int>(level), nearest, 1 - (clamped - level), mixed);
  if (clamped > level) mix_level(texture, sampler, s, t, static_cast<int>(level) + 1, nearest, clamped - level, mixed);
  return mixed;
}

}  // namespace halfspace::test
