// SPDX-License-Identifier: Apache-2.0
#include "oracle/framebuffer.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "halfspace/core/srgb.h"
#include "oracle/arithmetic.h"

namespace halfspace::oracle {

namespace {

uint8_t encode_unorm8(float x) {
  return static_cast<uint8_t>(std::lround(static_cast<double>(clamped(x, 0.0f, 1.0f)) * 255.0));  // the product is exact and never a tie
}

float decode_half(uint16_t h) {
  const int exponent = h >> 10 & 31;
  const int mantissa = h & 1023;
  if (exponent == 31 && mantissa != 0)
    return std::bit_cast<float>((h & 0x8000u) << 16 | 0x7fc00000u | static_cast<uint32_t>(mantissa) << 13);
  const double size = exponent == 31 ? HUGE_VAL : exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
  return static_cast<float>((h & 0x8000) != 0 ? -size : size);
}

// Rounds to the nearest half, ties to even. Infinities and values that are too large become the largest finite half.
uint16_t encode_half(float x) {
  const uint32_t sign = std::bit_cast<uint32_t>(x) >> 16 & 0x8000u;
  if (std::isnan(x)) return static_cast<uint16_t>(sign | 0x7e00u | (std::bit_cast<uint32_t>(x) >> 13 & 0x3ffu));
  const double size = std::fmin(std::fabs(static_cast<double>(x)), 65504.0);
  if (size < 0x1p-14) return static_cast<uint16_t>(sign | static_cast<uint32_t>(std::nearbyint(size * 0x1p24)));
  const int exponent = std::ilogb(size);
  const auto mantissa =
      static_cast<uint32_t>(std::nearbyint(std::ldexp(size, 10 - exponent)));  // 1024 to 2048; 2048 carries into the exponent
  return static_cast<uint16_t>(sign | ((static_cast<uint32_t>(exponent + 14) << 10) + mantissa));
}

template <class T>
T read(const std::vector<std::byte>& bytes, std::size_t index) {
  T t;
  std::memcpy(&t, &bytes[index * sizeof(T)], sizeof t);
  return t;
}
template <class T>
void write(std::vector<std::byte>& bytes, std::size_t index, T t) {
  std::memcpy(&bytes[index * sizeof(T)], &t, sizeof t);
}

// Calls f for every sample of a framebuffer.
template <class F>
void for_each_sample(const Framebuffer& b, F f) {
  for (int y = 0; y < b.height(); ++y) {
    for (int x = 0; x < b.width(); ++x) {
      for (int s = 0; s < b.samples(); ++s) f(Sample{x, y, s});
    }
  }
}

}  // namespace

Framebuffer::Framebuffer(int width, int height, std::vector<ColorFormat> colors, DepthFormat depth, int samples)
    : width_(width), height_(height), samples_(samples), color_formats_(std::move(colors)), depth_format_(depth) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(samples);
  for (const ColorFormat f : color_formats_) color_bytes.emplace_back(pixels * static_cast<std::size_t>(bytes_per_pixel(f)));
  depth_bytes.resize(pixels * static_cast<std::size_t>(bytes_per_pixel(depth)));
}

std::size_t Framebuffer::pixel(const Sample& s) const {
  const int row = s.number * height_ + (height_ - 1 - s.y);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(s.x);
}

void Framebuffer::clear_color(std::size_t attachment, glm::vec4 value) {
  for_each_sample(*this, [&](const Sample& s) { set_color(attachment, s, value); });
}

void Framebuffer::clear_depth(float value, uint8_t stencil_value) {
  for_each_sample(*this, [&](const Sample& s) {
    set_depth(s, depth_value(clamped(value, 0.0f, 1.0f)));
    set_stencil(s, stencil_value);
  });
}

glm::vec4 Framebuffer::color(std::size_t attachment, const Sample& s) const {
  glm::vec4 c(0.0f);
  const std::vector<std::byte>& bytes = color_bytes[attachment];
  for (int k = 0; k < 4; ++k) {
    const std::size_t i = pixel(s) * 4 + static_cast<std::size_t>(k);
    switch (color_formats_[attachment]) {
      case ColorFormat::none: break;
      case ColorFormat::rgba8: c[k] = static_cast<float>(read<uint8_t>(bytes, i)) / 255.0f; break;
      case ColorFormat::srgb8a8:
        c[k] = k == 3 ? static_cast<float>(read<uint8_t>(bytes, i)) / 255.0f : kSrgbToLinear[read<uint8_t>(bytes, i)];
        break;
      case ColorFormat::rgba16f: c[k] = decode_half(read<uint16_t>(bytes, i)); break;
      case ColorFormat::rgba32f: c[k] = read<float>(bytes, i); break;
      default: break;  // formats with fewer channels have tests of their own
    }
  }
  return c;
}

void Framebuffer::set_color(std::size_t attachment, const Sample& s, glm::vec4 value) {
  std::vector<std::byte>& bytes = color_bytes[attachment];
  for (int k = 0; k < 4; ++k) {
    const std::size_t i = pixel(s) * 4 + static_cast<std::size_t>(k);
    switch (color_formats_[attachment]) {
      case ColorFormat::none: break;
      case ColorFormat::rgba8: write(bytes, i, encode_unorm8(value[k])); break;
      case ColorFormat::srgb8a8: write(bytes, i, k == 3 ? encode_unorm8(value[k]) : static_cast<uint8_t>(linear_to_srgb(value[k]))); break;
      case ColorFormat::rgba16f: write(bytes, i, encode_half(value[k])); break;
      case ColorFormat::rgba32f: write(bytes, i, value[k]); break;
      default: break;
    }
  }
}

double Framebuffer::depth(const Sample& s) const {
  const std::size_t i = pixel(s);
  switch (depth_format_) {
    case DepthFormat::none: break;
    case DepthFormat::d16: return read<uint16_t>(depth_bytes, i);
    case DepthFormat::d24: return read<uint32_t>(depth_bytes, i);
    case DepthFormat::d32f: return static_cast<double>(read<float>(depth_bytes, i));
    case DepthFormat::d24s8: return read<uint32_t>(depth_bytes, i) / 256;
    case DepthFormat::d32fs8: return static_cast<double>(read<float>(depth_bytes, 2 * i));
  }
  return 0.0;
}

void Framebuffer::set_depth(const Sample& s, double value) {
  const std::size_t i = pixel(s);
  switch (depth_format_) {
    case DepthFormat::none: break;
    case DepthFormat::d16: write(depth_bytes, i, static_cast<uint16_t>(value)); break;
    case DepthFormat::d24: write(depth_bytes, i, static_cast<uint32_t>(value)); break;
    case DepthFormat::d32f: write(depth_bytes, i, static_cast<float>(value)); break;
    case DepthFormat::d24s8: write(depth_bytes, i, static_cast<uint32_t>(value) * 256 + stencil(s)); break;
    case DepthFormat::d32fs8: write(depth_bytes, 2 * i, static_cast<float>(value)); break;
  }
}

uint8_t Framebuffer::stencil(const Sample& s) const {
  if (depth_format_ == DepthFormat::d24s8) return read<uint8_t>(depth_bytes, 4 * pixel(s));  // little endian: the low byte
  if (depth_format_ == DepthFormat::d32fs8) return read<uint8_t>(depth_bytes, 8 * pixel(s) + 4);
  return 0;
}

void Framebuffer::set_stencil(const Sample& s, uint8_t value) {
  if (depth_format_ == DepthFormat::d24s8) write(depth_bytes, 4 * pixel(s), value);
  if (depth_format_ == DepthFormat::d32fs8) write(depth_bytes, 8 * pixel(s) + 4, value);
}

Framebuffer Framebuffer::resolved() const {
  if (samples_ == 1) return *this;
  Framebuffer to(width_, height_, color_formats_, depth_format_);
  for_each_sample(to, [&](const Sample& pixel) {
    for (std::size_t a = 0; a < color_formats_.size(); ++a) {
      std::vector<glm::vec4> c;
      for (int s = 0; s < samples_; ++s) c.push_back(color(a, {pixel.x, pixel.y, s}));
      while (c.size() > 1) {  // add adjacent pairs
        for (std::size_t i = 0; i < c.size() / 2; ++i) c[i] = c[2 * i] + c[2 * i + 1];
        c.resize(c.size() / 2);
      }
      to.set_color(a, pixel, c[0] * (1.0f / static_cast<float>(samples_)));
    }
    to.set_depth(pixel, depth(pixel));
    to.set_stencil(pixel, stencil(pixel));
  });
  return to;
}

double Framebuffer::depth_value(float z) const {
  switch (depth_format_) {
    case DepthFormat::d16: return std::nearbyint(static_cast<double>(z) * 65535.0);  // the products are exact
    case DepthFormat::d24s8:
    case DepthFormat::d24: return std::nearbyint(static_cast<double>(z) * 16777215.0);
    default: return static_cast<double>(z);
  }
}

}  // namespace halfspace::oracle
