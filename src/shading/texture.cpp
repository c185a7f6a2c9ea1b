// SPDX-License-Identifier: Apache-2.0
//
// Texture2D's levels: taken over or computed, checked, and packed into one allocation.
#include "shading/texture.h"

#include <algorithm>
#include <iterator>

namespace halfspace {

namespace {

constexpr int half_size(int size) { return std::max(1, size / 2); }

/// Which texels of a side one texel of the next level averages, and with which weights (they add up to 1).
struct Taps {
  int first;
  int count;
  float weight[3];
};

Taps taps_of(int size, int i) {
  if (size == 1) return {0, 1, {1.0f}};
  if (size % 2 == 0) return {2 * i, 2, {0.5f, 0.5f}};
  const float n = static_cast<float>(size / 2), whole = static_cast<float>(size), at = static_cast<float>(i);
  return {2 * i, 3, {(n - at) / whole, n / whole, (at + 1.0f) / whole}};
}

// Texels in the units that are averaged: whole codes, and linear values for the colour of srgb8a8.
glm::vec4 to_averaged(glm::u8vec4 t, TexelFormat format) {
  if (format == TexelFormat::rgba8) return glm::vec4(t);
  return {kSrgbToLinear[t.x], kSrgbToLinear[t.y], kSrgbToLinear[t.z], static_cast<float>(t.w)};
}

glm::u8vec4 to_texel(const glm::vec4& v, TexelFormat format) {
  if (format == TexelFormat::rgba8) return glm::u8vec4(round_to_int(v.x), round_to_int(v.y), round_to_int(v.z), round_to_int(v.w));
  return glm::u8vec4(linear_to_srgb(v.x), linear_to_srgb(v.y), linear_to_srgb(v.z), round_to_int(v.w));
}

/// The next level of a picture of the given size; row(r, buffer) gives its row r, perhaps by filling the buffer.
template <class RowOf>
Image<glm::vec4> next_level(int width, int height, const RowOf& row_of) {
  Image<glm::vec4> to(half_size(width), half_size(height));
  std::vector<Taps> columns;
  for (int x = 0; x < to.width(); ++x) columns.push_back(taps_of(width, x));
  std::vector<glm::vec4> buffer(static_cast<std::size_t>(width)), sum(buffer.size());
  for (int y = 0; y < to.height(); ++y) {
    const Taps rows = taps_of(height, y);
    for (int j = 0; j < rows.count; ++j) {
      const glm::vec4* row = row_of(rows.first + j, buffer.data());
      const float weight = rows.weight[j];
      for (std::size_t x = 0; x < sum.size(); ++x) sum[x] = j == 0 ? weight * row[x] : sum[x] + weight * row[x];
    }
    glm::vec4* out = to.row(y).data();
    for (const Taps& taps : columns) {
      const glm::vec4* from = sum.data() + taps.first;
      glm::vec4 v = taps.weight[0] * from[0];
      for (int i = 1; i < taps.count; ++i) v += taps.weight[i] * from[i];
      *out++ = v;
    }
  }
  return to;
}

int32_t packed(glm::u8vec4 t) {
  const uint32_t bits = t.x | static_cast<uint32_t>(t.y) << 8 | static_cast<uint32_t>(t.z) << 16 | static_cast<uint32_t>(t.w) << 24;
  return static_cast<int32_t>(bits);
}

}  // namespace

std::vector<Image<glm::u8vec4>> mip_chain(const Image<glm::u8vec4>& base, TexelFormat format) {
  std::vector<Image<glm::u8vec4>> levels;
  if (base.width() <= 1 && base.height() <= 1) return levels;
  Image<glm::vec4> averaged = next_level(base.width(), base.height(), [&](int r, glm::vec4* buffer) {
    std::transform(base.row(r).begin(), base.row(r).end(), buffer, [format](glm::u8vec4 t) { return to_averaged(t, format); });
    return static_cast<const glm::vec4*>(buffer);
  });
  while (true) {
    Image<glm::u8vec4>& level = levels.emplace_back(averaged.width(), averaged.height());
    std::transform(averaged.texels().begin(), averaged.texels().end(), level.data(),
                   [format](const glm::vec4& v) { return to_texel(v, format); });
    if (averaged.width() == 1 && averaged.height() == 1) break;
    averaged = next_level(averaged.width(), averaged.height(), [&](int r, glm::vec4*) { return averaged.row(r).data(); });
  }
  return levels;
}

Texture2D::Texture2D(const Image<glm::u8vec4>& base, TexelFormat format) : format_(format) {
  add_level(base);  // checks the size
  const auto size = static_cast<std::size_t>(base.width() + 1) * static_cast<std::size_t>(base.height());
  texels_.reserve(size + size / 2);
  for (const Image<glm::u8vec4>& level : mip_chain(base, format)) add_level(level);
}

Texture2D::Texture2D(std::span<const Image<glm::u8vec4>> levels, TexelFormat format) : format_(format) {
  HS_CHECK_OP(levels.size(), >=, 1u);
  std::size_t size = 0;
  for (const Image<glm::u8vec4>& level : levels)
    size += static_cast<std::size_t>(level.width() + 1) * static_cast<std::size_t>(level.height());
  texels_.reserve(size);
  for (const Image<glm::u8vec4>& level : levels) add_level(level);
}

void Texture2D::add_level(const Image<glm::u8vec4>& image) {
  if (levels_ == 0) {
    HS_CHECK_OP(std::min(image.width(), image.height()), >=, 1);
    HS_CHECK_OP(std::max(image.width(), image.height()), <=, kMaxSize);
  } else {
    HS_CHECK_OP(std::max(width(levels_ - 1), height(levels_ - 1)), >, 1);
    HS_CHECK_OP(image.width(), ==, half_size(width(levels_ - 1)));
    HS_CHECK_OP(image.height(), ==, half_size(height(levels_ - 1)));
  }
  const auto l = static_cast<std::size_t>(levels_++);
  width_[l] = image.width();
  height_[l] = image.height();
  offset_[l] = static_cast<int32_t>(texels_.size());
  for (int y = 0; y < image.height(); ++y) {
    const auto row = image.row(y);
    std::transform(row.begin(), row.end(), std::back_inserter(texels_), packed);
    texels_.push_back(packed(row[0]));
  }
}

glm::u8vec4 Texture2D::texel(int level, int x, int row) const {
  HS_CHECK_OP(level, <, levels_);
  HS_CHECK(x >= 0 && x < width(level) && row >= 0 && row < height(level));
  const auto l = static_cast<std::size_t>(level);
  const auto t = static_cast<uint32_t>(texels_[static_cast<std::size_t>(offset_[l] + row * (width_[l] + 1) + x)]);
  return {t & 255, (t >> 8) & 255, (t >> 16) & 255, t >> 24};
}

}  // namespace halfspace
