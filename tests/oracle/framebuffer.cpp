// SPDX-License-Identifier: Apache-2.0
#include "oracle/framebuffer.h"

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "oracle/arithmetic.h"
#include "oracle/texels.h"

namespace halfspace::oracle {

namespace {

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

void Framebuffer::clear_depth(float value) {
  for_each_sample(*this, [&](const Sample& s) { set_depth(s, depth_value(clamped(value, 0.0f, 1.0f))); });
}
void Framebuffer::clear_stencil(uint8_t value) {
  for_each_sample(*this, [&](const Sample& s) { set_stencil(s, value); });
}

std::size_t Framebuffer::texel(std::size_t attachment, const Sample& s) const {
  return pixel(s) * static_cast<std::size_t>(bytes_per_pixel(color_formats_[attachment]));
}

glm::vec4 Framebuffer::color(std::size_t attachment, const Sample& s) const {
  if (color_formats_[attachment] == ColorFormat::none) return glm::vec4(0.0f);
  return read_texel(color_formats_[attachment], &color_bytes[attachment][texel(attachment, s)]);
}

void Framebuffer::set_color(std::size_t attachment, const Sample& s, glm::vec4 value) {
  if (color_formats_[attachment] == ColorFormat::none) return;
  write_texel(color_formats_[attachment], value, &color_bytes[attachment][texel(attachment, s)]);
}

void Framebuffer::combine_color(std::size_t attachment, const Sample& s, glm::vec4 value, LogicOp op, const ColorMask& mask) {
  const ColorFormat format = color_formats_[attachment];
  std::array<std::byte, 16> source{};
  write_texel(format, value, source.data());
  std::byte* const stored = &color_bytes[attachment][texel(attachment, s)];
  const TexelInfo& info = texel_info(format);
  for (int k = 0; k < info.channels; ++k) {
    const int first = info.bits == 0 ? channel_shift(format, k) : k * info.bits;
    for (int bit = first; bit < first + channel_bits(format, k); ++bit) {
      const auto byte = static_cast<std::size_t>(bit / 8);
      const std::byte one = std::byte{1} << (bit % 8);
      const bool from_source = (source[byte] & one) != std::byte{0}, from_stored = (stored[byte] & one) != std::byte{0};
      const bool result = (static_cast<int>(op) >> ((from_source ? 0 : 2) + (from_stored ? 0 : 1)) & 1) != 0;
      if (mask[k]) stored[byte] = result ? stored[byte] | one : stored[byte] & ~one;
    }
  }
}

double Framebuffer::depth(const Sample& s) const {
  const std::size_t i = pixel(s);
  switch (depth_format_) {
    case DepthFormat::d16: return read<uint16_t>(depth_bytes, i);
    case DepthFormat::d24: return read<uint32_t>(depth_bytes, i);
    case DepthFormat::d32f: return static_cast<double>(read<float>(depth_bytes, i));
    case DepthFormat::d24s8: return read<uint32_t>(depth_bytes, i) / 256;
    case DepthFormat::d32fs8: return static_cast<double>(read<float>(depth_bytes, 2 * i));
    default: break;
  }
  return 0.0;
}

void Framebuffer::set_depth(const Sample& s, double value) {
  const std::size_t i = pixel(s);
  switch (depth_format_) {
    case DepthFormat::d16: write(depth_bytes, i, static_cast<uint16_t>(value)); break;
    case DepthFormat::d24: write(depth_bytes, i, static_cast<uint32_t>(value)); break;
    case DepthFormat::d32f: write(depth_bytes, i, static_cast<float>(value)); break;
    case DepthFormat::d24s8: write(depth_bytes, i, static_cast<uint32_t>(value) * 256 + stencil(s)); break;
    case DepthFormat::d32fs8: write(depth_bytes, 2 * i, static_cast<float>(value)); break;
    default: break;
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
      if (is_integer(color_formats_[a])) {
        to.set_color(a, pixel, color(a, pixel));
        continue;
      }
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
