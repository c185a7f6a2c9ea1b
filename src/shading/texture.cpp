// SPDX-License-Identifier: Apache-2.0
//
// Construction of Texture2D: levels are copied or computed, checked, and packed into one allocation.
#include "halfspace/shading/texture.h"

#include <algorithm>
#include <cstring>

#include "halfspace/core/default_init_allocator.h"
#include "halfspace/core/half.h"
#include "halfspace/shading/texels.h"

namespace halfspace {

namespace {

constexpr int half_size(int size) { return std::max(1, size / 2); }

// ---- averaging: number types, and conversion from and to texels ---------------------------------------------------------

/// Number is the type of the weights. Sum holds the channels of a texel in the units that are averaged: linear values for floats and
/// for the color of srgb8a8, otherwise integer codes. Averaging equal texels is exact: the error of a sum is far less than half a
/// code, or far less than half an ulp of a float.
template <class Texel>
struct Averaging;
template <>
struct Averaging<uint8_t> {
  using Number = float;
  using Sum = float;
};
template <>
struct Averaging<uint16_t> {
  using Number = double;
  using Sum = double;
};
template <>
struct Averaging<glm::u8vec4> {
  using Number = float;
  using Sum = glm::vec4;
};
template <>
struct Averaging<glm::vec4> {
  using Number = double;
  using Sum = glm::dvec4;
};
template <class Texel>
using SumOf = typename Averaging<Texel>::Sum;

/// Returns the channels of an rgba16f texel.
IntN<4> halves(const glm::vec4& v) { return float_to_finite_half(detail::clamped_texel(v)); }

/// Returns the linear color as the format stores it.
glm::vec4 stored(const glm::vec4& v, TexelFormat format) {
  glm::vec4 r;
  store(&r.x, format == TexelFormat::rgba32f ? detail::clamped_texel(v) : half_to_float(halves(v)));
  return r;
}

float to_averaged(uint8_t t, TexelFormat) { return t; }
double to_averaged(uint16_t t, TexelFormat) { return t; }
glm::vec4 to_averaged(glm::u8vec4 t, TexelFormat format) {
  if (format == TexelFormat::rgba8) return glm::vec4(t);
  return {kSrgbToLinear[t.x], kSrgbToLinear[t.y], kSrgbToLinear[t.z], static_cast<float>(t.w)};
}
glm::dvec4 to_averaged(const glm::vec4& t, TexelFormat format) { return glm::dvec4(stored(t, format)); }

uint8_t to_texel(float v, TexelFormat) { return static_cast<uint8_t>(round_to_int(v)); }
uint16_t to_texel(double v, TexelFormat) { return static_cast<uint16_t>(round_to_int(v)); }
glm::u8vec4 to_texel(const glm::vec4& v, TexelFormat format) {
  if (format == TexelFormat::rgba8) return glm::u8vec4(round_to_int(v.x), round_to_int(v.y), round_to_int(v.z), round_to_int(v.w));
  return glm::u8vec4(linear_to_srgb(v.x), linear_to_srgb(v.y), linear_to_srgb(v.z), round_to_int(v.w));
}
glm::vec4 to_texel(const glm::dvec4& v, TexelFormat format) { return stored(glm::vec4(v), format); }

// Calls f(row) for every row, using the workers if there are any.
template <class F>
void for_each_row(const Workers* workers, int rows, const F& f) {
  if (workers != nullptr && rows > 1) return workers->for_each(rows, f);
  for (int row = 0; row < rows; ++row) f(row);
}

// ---- the next level ---------------------------------------------------------------------------------------------------

/// The texels along one axis that a texel of the next level averages, and their weights, which add up to 1.
template <class Number>
struct Taps {
  int first;
  int count;
  Number weight[3];
};

template <class Number>
Taps<Number> taps_of(int size, int i) {
  if (size == 1) return {0, 1, {1}};
  if (size % 2 == 0) return {2 * i, 2, {Number(0.5f), Number(0.5f)}};
  const auto n = static_cast<Number>(size / 2), whole = static_cast<Number>(size), at = static_cast<Number>(i);
  return {2 * i, 3, {(n - at) / whole, n / whole, (at + 1) / whole}};
}

/// Computes the next level of an image of the given size. row_of(r, buffer) returns a pointer to row r, and may use the buffer for it.
template <class Texel, class RowOf>
Image<SumOf<Texel>> next_level(int width, int height, const RowOf& row_of, const Workers* workers) {
  using Number = typename Averaging<Texel>::Number;
  using Sum = SumOf<Texel>;
  Image<Sum> to(half_size(width), half_size(height));
  std::vector<Taps<Number>> columns;
  for (int x = 0; x < to.width(); ++x) columns.push_back(taps_of<Number>(width, x));
  const auto row_length = static_cast<std::size_t>(width);
  if (width % 2 == 0 && height % 2 == 0) {  // the same result as below, since multiplication by 1/2 is exact
    for_each_row(workers, to.height(), [&](int y) {
      std::vector<Sum, DefaultInitAllocator<Sum>> buffer(2 * row_length);
      const Sum *first = row_of(2 * y, buffer.data()), *second = row_of(2 * y + 1, buffer.data() + row_length);
      for (Sum& v : to.row(y)) {
        v = Number(0.25f) * ((first[0] + second[0]) + (first[1] + second[1]));
        first += 2;
        second += 2;
      }
    });
    return to;
  }
  for_each_row(workers, to.height(), [&](int y) {
    std::vector<Sum> buffer(row_length), sum(row_length);
    const Taps<Number> rows = taps_of<Number>(height, y);
    for (int j = 0; j < rows.count; ++j) {
      const Sum* row = row_of(rows.first + j, buffer.data());
      const Number weight = rows.weight[j];
      for (std::size_t x = 0; x < sum.size(); ++x) sum[x] = j == 0 ? weight * row[x] : sum[x] + weight * row[x];
    }
    Sum* out = to.row(y).data();
    for (const Taps<Number>& taps : columns) {
      const Sum* from = sum.data() + taps.first;
      Sum v = taps.weight[0] * from[0];
      for (int i = 1; i < taps.count; ++i) v += taps.weight[i] * from[i];
      *out++ = v;
    }
  });
  return to;
}

// ---- packing of texels into 32-bit words, as texels.h reads them ------------------------------------------------------

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
    store(words + i * 2, __builtin_convertvector(halves(t).v, Shorts));
  }
}

}  // namespace

template <class Texel>
std::vector<Image<Texel>> mip_chain(const Image<Texel>& base, TexelFormat format, const Workers* workers) {
  using Sum = SumOf<Texel>;
  std::vector<Image<Texel>> levels;
  if (base.width() <= 1 && base.height() <= 1) return levels;
  const auto base_row = [&](int r, Sum* buffer) {
    std::transform(base.row(r).begin(), base.row(r).end(), buffer, [format](const Texel& t) { return to_averaged(t, format); });
    return static_cast<const Sum*>(buffer);
  };
  Image<Sum> averaged = next_level<Texel>(base.width(), base.height(), base_row, workers);
  while (true) {
    Image<Texel>& level = levels.emplace_back(averaged.width(), averaged.height());
    for_each_row(workers, level.height(), [&](int y) {
      std::transform(averaged.row(y).begin(), averaged.row(y).end(), level.row(y).begin(),
                     [format](const Sum& v) { return to_texel(v, format); });
    });
    if (averaged.width() == 1 && averaged.height() == 1) break;
    const auto row = [&](int r, Sum*) -> const Sum* { return averaged.row(r).data(); };
    averaged = next_level<Texel>(averaged.width(), averaged.height(), row, workers);
  }
  return levels;
}

template std::vector<Image<uint8_t>> mip_chain(const Image<uint8_t>&, TexelFormat, const Workers*);
template std::vector<Image<uint16_t>> mip_chain(const Image<uint16_t>&, TexelFormat, const Workers*);
template std::vector<Image<glm::u8vec4>> mip_chain(const Image<glm::u8vec4>&, TexelFormat, const Workers*);
template std::vector<Image<glm::vec4>> mip_chain(const Image<glm::vec4>&, TexelFormat, const Workers*);

Texture2D::Texture2D(const Image<glm::u8vec4>& base, TexelFormat format, const Workers* workers) : format_(format) {
  HS_CHECK(format == TexelFormat::rgba8 || format == TexelFormat::srgb8a8);
  add_chain(base, workers);
  add_alphas();
}
Texture2D::Texture2D(const Image<uint8_t>& base) : format_(TexelFormat::r8) { add_chain(base, nullptr); }
Texture2D::Texture2D(const Image<uint16_t>& base) : format_(TexelFormat::r16) { add_chain(base, nullptr); }
Texture2D::Texture2D(const Image<glm::vec4>& base, TexelFormat format, const Workers* workers) : format_(format) {
  HS_CHECK(format == TexelFormat::rgba16f || format == TexelFormat::rgba32f);
  add_chain(base, workers);
}

Texture2D::Texture2D(std::span<const Image<glm::u8vec4>> levels, TexelFormat format) : format_(format) {
  HS_CHECK(format == TexelFormat::rgba8 || format == TexelFormat::srgb8a8);
  add_levels(levels);
  add_alphas();
}
Texture2D::Texture2D(std::span<const Image<glm::vec4>> levels, TexelFormat format) : format_(format) {
  HS_CHECK(format == TexelFormat::rgba16f || format == TexelFormat::rgba32f);
  add_levels(levels);
}

template <class Texel>
void Texture2D::add_levels(std::span<const Image<Texel>> levels) {
  HS_CHECK_OP(levels.size(), >=, 1u);
  std::size_t size = 0;
  for (const Image<Texel>& level : levels) size += with_border(level.width(), level.height());
  texels_.reserve(words_of(size, format_) + kRowSlack);
  for (const Image<Texel>& level : levels) add_level(level, nullptr);
}

template <class Texel>
void Texture2D::add_chain(const Image<Texel>& base, const Workers* workers) {
  const std::size_t size = with_border(base.width(), base.height());
  texels_.reserve(words_of(size + size / 2, format_));
  add_level(base, workers);  // checks the size
  for (const Image<Texel>& level : mip_chain(base, format_, workers)) add_level(level, workers);
}

template <class Texel>
void Texture2D::add_level(const Image<Texel>& image, const Workers* workers) {
  std::size_t begin = 0;
  if (levels_ == 0) {
    HS_CHECK_OP(std::min(image.width(), image.height()), >=, 1);
    HS_CHECK_OP(std::max(image.width(), image.height()), <=, kMaxSize);
  } else {
    const int last = levels_ - 1;
    HS_CHECK_OP(std::max(width(last), height(last)), >, 1);
    HS_CHECK_OP(image.width(), ==, half_size(width(last)));
    HS_CHECK_OP(image.height(), ==, half_size(height(last)));
    begin = index_of(last, width(last) - 1, height(last) - 1) + static_cast<std::size_t>(width(last)) + 4;
  }
  const std::size_t end = begin + with_border(image.width(), image.height());
  HS_CHECK_OP(words_of(end, format_), <, std::size_t{1} << 31);  // limit of 32-bit indices
  texels_.resize(words_of(end, format_) + kRowSlack);
  const auto l = static_cast<std::size_t>(levels_++);
  width_[l] = image.width();
  height_[l] = image.height();
  pitch_[l] = image.width() + 2;
  columns_[l] = as_int(static_cast<float>(image.width()));
  rows_[l] = as_int(static_cast<float>(image.height()));
  offset_[l] = static_cast<int32_t>(begin) + image.width() + 3;
  // Rows of r8 and r16 may share a word, but these formats never have workers.
  const int last_y = image.height() - 1;
  const std::size_t pitch = static_cast<std::size_t>(image.width()) + 2;
  for_each_row(workers, image.height() + 2, [&](int i) {
    const std::span<const Texel> row = image.row(i == 0 ? last_y : i > image.height() ? 0 : i - 1);
    std::size_t at = begin + static_cast<std::size_t>(i) * pitch;
    put(texels_.data(), at++, row.back(), format_);
    for (const Texel& t : row) put(texels_.data(), at++, t, format_);
    put(texels_.data(), at, row.front(), format_);
  });
}

void Texture2D::add_alphas() {
  const auto alpha = [](int32_t texel) { return static_cast<uint16_t>(static_cast<uint32_t>(texel) >> 24); };
  const std::size_t end = texels_.size() - kRowSlack;
  const bool varies = std::any_of(texels_.begin(), texels_.begin() + static_cast<std::ptrdiff_t>(end),
                                  [&](int32_t texel) { return alpha(texel) != alpha(texels_[0]); });
  if (!varies) return;
  alphas_.resize(end);
  for (std::size_t l = 0; l < static_cast<std::size_t>(levels_); ++l) {
    const auto pitch = static_cast<std::size_t>(pitch_[l]);
    std::size_t i = static_cast<std::size_t>(offset_[l]) - pitch - 1;  // the first texel of the border
    for (const std::size_t last_row = i + pitch * static_cast<std::size_t>(height_[l] + 1); i < last_row; ++i)
      alphas_[i] = static_cast<uint16_t>(alpha(texels_[i]) | alpha(texels_[i + pitch]) << 8);
  }
}

/// Returns an index in texels, counted from the start of the allocation.
std::size_t Texture2D::index_of(int level, int x, int row) const {
  HS_CHECK(level >= 0 && level < levels_);
  HS_CHECK(x >= 0 && x < width(level) && row >= 0 && row < height(level));
  const auto l = static_cast<std::size_t>(level);
  return static_cast<std::size_t>(offset_[l] + row * pitch_[l] + x);
}

glm::u8vec4 Texture2D::texel(int level, int x, int row) const {
  HS_CHECK(format_ == TexelFormat::rgba8 || format_ == TexelFormat::srgb8a8);
  const auto t = static_cast<uint32_t>(texels_[index_of(level, x, row)]);
  return {t & 255, (t >> 8) & 255, (t >> 16) & 255, t >> 24};
}

}  // namespace halfspace
