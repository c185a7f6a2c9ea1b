// SPDX-License-Identifier: Apache-2.0
//
// Construction of Texture2D: levels are copied or computed, checked, and packed into one allocation.
#include "halfspace/shading/texture/texture.h"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "halfspace/core/float_mode.h"
#include "halfspace/shading/texture/texel_reader.h"
#include "halfspace/shading/texture/texels.h"

namespace halfspace::HS_LANES {

namespace {

// ---- packing of texels into 32-bit words, red in the low bits ------------------------------------------------------

/// Number of texels of a level, including its border.
std::size_t with_border(int width, int height) { return static_cast<std::size_t>(width + 2) * static_cast<std::size_t>(height + 2); }

/// Number of 32-bit words that hold the given number of texels.
std::size_t words_of(std::size_t texels, TexelFormat format) {
  switch (format) {
    case TexelFormat::r8: return (texels + 3) / 4;
    case TexelFormat::r16: return (texels + 1) / 2;
    case TexelFormat::rgba16f: return texels * 2;
    case TexelFormat::rgba32f: return texels * 4;
    default: return texels;
  }
}

int32_t packed(glm::u8vec4 t) {
  const uint32_t bits = t.x | static_cast<uint32_t>(t.y) << 8 | static_cast<uint32_t>(t.z) << 16 | static_cast<uint32_t>(t.w) << 24;
  return static_cast<int32_t>(bits);
}

// Stores texel i. For r8 and r16, the word must still be 0.
void put(int32_t* words, std::size_t i, uint8_t t, TexelFormat) {
  words[i / 4] |= static_cast<int32_t>(static_cast<uint32_t>(t) << (i % 4 * 8));
}
void put(int32_t* words, std::size_t i, uint16_t t, TexelFormat) {
  words[i / 2] |= static_cast<int32_t>(static_cast<uint32_t>(t) << (i % 2 * 16));
}
void put(int32_t* words, std::size_t i, glm::u8vec4 t, TexelFormat) { words[i] = packed(t); }
void put(int32_t* words, std::size_t i, const glm::vec4& t, TexelFormat format) {
  if (format == TexelFormat::rgba32f) {
    store(words + i * 4, detail::clamped_texel(t));
  } else {
    using Shorts __attribute__((vector_size(8))) = uint16_t;
    store(words + i * 2, __builtin_convertvector(detail::half_channels(t).v, Shorts));
  }
}

}  // namespace

Texture2D::Texture2D(const Image<glm::u8vec4>& base, TexelFormat format, const Workers* workers) : format_(format) {
  HS_CHECK(format == TexelFormat::rgba8 || format == TexelFormat::srgb8a8,
           "Texture2D: the format does not match an image of u8vec4; expected rgba8 or srgb8a8");
  add_chain(base, workers);
  add_alphas(workers);
}
Texture2D::Texture2D(const Image<uint8_t>& base) : format_(TexelFormat::r8) { add_chain(base, nullptr); }
Texture2D::Texture2D(const Image<uint16_t>& base) : format_(TexelFormat::r16) { add_chain(base, nullptr); }
Texture2D::Texture2D(const Image<glm::vec4>& base, TexelFormat format, const Workers* workers) : format_(format) {
  HS_CHECK(format == TexelFormat::rgba16f || format == TexelFormat::rgba32f,
           "Texture2D: the format does not match an image of vec4; expected rgba16f or rgba32f");
  add_chain(base, workers);
}

Texture2D::Texture2D(std::span<const Image<glm::u8vec4>> levels, TexelFormat format) : format_(format) {
  HS_CHECK(format == TexelFormat::rgba8 || format == TexelFormat::srgb8a8,
           "Texture2D: the format does not match an image of u8vec4; expected rgba8 or srgb8a8");
  add_levels(levels);
  add_alphas(nullptr);
}
Texture2D::Texture2D(std::span<const Image<glm::vec4>> levels, TexelFormat format) : format_(format) {
  HS_CHECK(format == TexelFormat::rgba16f || format == TexelFormat::rgba32f,
           "Texture2D: the format does not match an image of vec4; expected rgba16f or rgba32f");
  add_levels(levels);
}

template <class Texel>
void Texture2D::add_levels(std::span<const Image<Texel>> levels) {
  const FloatMode float_mode;
  HS_CHECK_OP(levels.size(), >=, 1u, "Texture2D: there are no levels; expected at least one");
  std::size_t size = 0;
  for (const Image<Texel>& level : levels) size += with_border(level.width(), level.height());
  texels_.reserve(words_of(size, format_) + kRowSlack);
  for (const Image<Texel>& level : levels) add_level(level, nullptr);
}

template <class Texel>
void Texture2D::add_chain(const Image<Texel>& base, const Workers* workers) {
  const FloatMode float_mode;
  const std::size_t size = with_border(base.width(), base.height());
  texels_.reserve(words_of(size + size / 2, format_));
  add_level(base, workers);  // checks the size
  for (const Image<Texel>& level : mip_chain(base, format_, workers)) add_level(level, workers);
}

template <class Texel>
void Texture2D::add_level(const Image<Texel>& image, const Workers* workers) {
  std::size_t begin = 0;
  if (levels_ == 0) {
    HS_CHECK_OP(std::min(image.width(), image.height()), >=, 1,
                "Texture2D: the image is empty; expected a width and a height of at least 1");
    HS_CHECK_OP(std::max(image.width(), image.height()), <=, kMaxSize,
                "Texture2D: the image is too large; expected sides of at most 32768");
  } else {
    const int last = levels_ - 1;
    HS_CHECK_OP(std::max(width(last), height(last)), >, 1,
                "Texture2D: there are levels after the one of 1x1 texels; expected it to be the last");
    HS_CHECK_OP(image.width(), ==, detail::half_size(width(last)),
                "Texture2D: a level has the wrong width; expected half the width of the level before");
    HS_CHECK_OP(image.height(), ==, detail::half_size(height(last)),
                "Texture2D: a level has the wrong height; expected half the height of the level before");
    begin = index_of(last, width(last) - 1, height(last) - 1) + static_cast<std::size_t>(width(last)) + 4;
  }
  const std::size_t end = begin + with_border(image.width(), image.height());
  HS_CHECK_OP(words_of(end, format_), <, std::size_t{1} << 31,
              "Texture2D: the texture takes too many words of 32 bits; expected fewer than 2^31");  // limit of 32-bit indices
  texels_.resize(words_of(end, format_) + kRowSlack);
  const auto l = static_cast<std::size_t>(levels_++);
  width_[l] = image.width();
  height_[l] = image.height();
  pitch_[l] = image.width() + 2;
  columns_[l] = as_int(static_cast<float>(image.width()));
  rows_[l] = as_int(static_cast<float>(image.height()));
  offset_[l] = static_cast<int32_t>(begin) + image.width() + 3;
  const int unit = detail::texel_unit(format_), stride = texel_info(format_).bytes / unit;
  table_.format = format_;
  table_.levels = levels_;
  table_.level[l] = {offset_[l] * std::ptrdiff_t{stride * unit}, image.width(), image.height(), 1, pitch_[l] * stride, 0};
  // Rows of r8 and r16 may share a word, but these formats never have workers.
  const int last_y = image.height() - 1;
  const std::size_t pitch = static_cast<std::size_t>(image.width()) + 2;
  detail::for_each_row(workers, image.height() + 2, [&](int i) {
    const std::span<const Texel> row = image.row(i == 0 ? last_y : i > image.height() ? 0 : i - 1);
    std::size_t at = begin + static_cast<std::size_t>(i) * pitch;
    put(texels_.data(), at++, row.back(), format_);
    for (const Texel& t : row) put(texels_.data(), at++, t, format_);
    put(texels_.data(), at, row.front(), format_);
  });
}

void Texture2D::add_alphas(const Workers* workers) {
  const auto alpha = [](int32_t texel) { return static_cast<uint16_t>(static_cast<uint32_t>(texel) >> 24); };
  // Calls f(first, pitch) for all rows but the last of each level, with the borders. first: index of the first texel of the row.
  const auto for_each_row = [&](const auto& f) {
    for (std::size_t l = 0; l < static_cast<std::size_t>(levels_); ++l) {
      const auto pitch = static_cast<std::size_t>(pitch_[l]);
      const std::size_t begin = static_cast<std::size_t>(offset_[l]) - pitch - 1;
      detail::for_each_row(workers, height_[l] + 1, [&](int row) { f(begin + static_cast<std::size_t>(row) * pitch, pitch); });
    }
  };
  // The last row repeats another one, so it need not be checked.
  std::atomic<bool> varies = false;
  for_each_row([&](std::size_t first, std::size_t pitch) {
    if (varies.load(std::memory_order_relaxed)) return;
    const int32_t* row = texels_.data() + first;
    if (std::any_of(row, row + pitch, [&](int32_t texel) { return alpha(texel) != alpha(texels_[0]); }))
      varies.store(true, std::memory_order_relaxed);
  });
  if (!varies) return;
  alphas_.resize(texels_.size() - kRowSlack);
  for_each_row([&](std::size_t first, std::size_t pitch) {
    for (std::size_t i = first; i < first + pitch; ++i)
      alphas_[i] = static_cast<uint16_t>(alpha(texels_[i]) | alpha(texels_[i + pitch]) << 8);
  });
}

/// Returns an index in texels, counted from the start of the allocation.
std::size_t Texture2D::index_of(int level, int x, int row) const {
  HS_CHECK(level >= 0 && level < levels_, "Texture2D: there is no such level; expected 0 to levels() - 1");
  HS_CHECK(x >= 0 && x < width(level) && row >= 0 && row < height(level),
           "Texture2D: the texel is outside of its level; expected a column and a row inside");
  const auto l = static_cast<std::size_t>(level);
  return static_cast<std::size_t>(offset_[l] + row * pitch_[l] + x);
}

glm::u8vec4 Texture2D::texel(int level, int x, int row) const {
  HS_CHECK(format_ == TexelFormat::rgba8 || format_ == TexelFormat::srgb8a8,
           "Texture2D::texel: the texture has another format; expected rgba8 or srgb8a8");
  const auto t = static_cast<uint32_t>(texels_[index_of(level, x, row)]);
  return {t & 255, (t >> 8) & 255, (t >> 16) & 255, t >> 24};
}

}  // namespace halfspace::HS_LANES
