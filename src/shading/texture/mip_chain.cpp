// SPDX-License-Identifier: Apache-2.0
//
// Computes the coarser mip levels of a texture.
#include <algorithm>

#include "halfspace/core/default_init_allocator.h"
#include "halfspace/core/half.h"
#include "halfspace/core/lane_bytes.h"
#include "halfspace/core/srgb.h"
#include "halfspace/shading/texture/mip_taps.h"
#include "halfspace/shading/texture/texels.h"
#include "halfspace/shading/texture/texture.h"

namespace halfspace::HS_LANES {

namespace {

// ---- averaging: number types, and conversion from and to texels ---------------------------------------------------------

/// Number is the type of the weights. Sum holds the channels of a texel in the units that are averaged: linear values for floats and for
/// the color of srgb8a8, otherwise integer values. Averaging equal texels is exact: the error of a sum is far less than half an LSB of an
/// integer, or half an ulp of a float.
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

/// Returns the linear color as the format stores it.
glm::vec4 stored(const glm::vec4& v, TexelFormat format) {
  glm::vec4 r;
  store(&r.x, format == TexelFormat::rgba32f ? detail::clamped_texel(v) : half_to_float(detail::half_channels(v)));
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

// ---- rows of texels -----------------------------------------------------------------------------------------------------

/// Converts a row of texels to the numbers that are averaged.
template <class Texel>
void average_row(std::span<const Texel> from, SumOf<Texel>* to, TexelFormat format) {
  std::ranges::transform(from, to, [format](const Texel& t) { return to_averaged(t, format); });
}

/// The inverse: converts a row of averages to texels.
template <class Texel>
void texel_row(std::span<const SumOf<Texel>> from, Texel* to, TexelFormat format) {
  std::ranges::transform(from, to, [format](const SumOf<Texel>& v) { return to_texel(v, format); });
}

/// For 8-bit RGBA texels, the lanes of a vector are the channels of successive texels.
constexpr std::size_t kTexelsPerVector = kLanes / 4;

void average_row(std::span<const glm::u8vec4> from, glm::vec4* to, TexelFormat format) {
  std::size_t x = 0;
  if constexpr (kLanes >= 4) {
    const Mask alpha = (iota<Int>() & 3) == 3;
    for (; x + kTexelsPerVector <= from.size(); x += kTexelsPerVector) {
      const Int codes = load_u8<Int>(&from[x].x);
      const Real numbers = to_real<Real>(codes);
      store(&to[x].x, format == TexelFormat::rgba8 ? numbers : select(alpha, numbers, srgb_to_linear<Real>(codes)));
    }
  }
  for (; x < from.size(); ++x) to[x] = to_averaged(from[x], format);
}

void texel_row(std::span<const glm::vec4> from, glm::u8vec4* to, TexelFormat format) {
  std::size_t x = 0;
  if constexpr (kLanes >= 4) {
    const Mask alpha = (iota<Int>() & 3) == 3;
    for (; x + kTexelsPerVector <= from.size(); x += kTexelsPerVector) {
      const Real v = load<Real>(&from[x].x);
      store_u8(&to[x].x, format == TexelFormat::rgba8 ? round_to_int(v) : select(alpha, round_to_int(v), linear_to_srgb(v)));
    }
  }
  for (; x < from.size(); ++x) to[x] = to_texel(from[x], format);
}

// ---- the next level ---------------------------------------------------------------------------------------------------

/// Averages squares of 2x2 texels of two rows.
template <class Number, class Sum>
void halve_rows(const Sum* first, const Sum* second, std::span<Sum> to) {
  for (Sum& v : to) {
    v = Number(0.25f) * ((first[0] + second[0]) + (first[1] + second[1]));
    first += 2;
    second += 2;
  }
}

/// Computes the next level of an image of the given size. row_of(r, buffer) returns a pointer to row r, and may use the buffer for it.
template <class Texel, class RowOf>
Image<SumOf<Texel>> next_level(int width, int height, const RowOf& row_of, const Workers* workers) {
  using Number = typename Averaging<Texel>::Number;
  using Sum = SumOf<Texel>;
  Image<Sum> to(detail::half_size(width), detail::half_size(height));
  std::vector<detail::MipTaps<Number>> columns;
  for (int x = 0; x < to.width(); ++x) columns.push_back(detail::mip_taps<Number>(width, x));
  const auto row_length = static_cast<std::size_t>(width);
  if (width % 2 == 0 && height % 2 == 0) {  // the same result as below, since multiplication by 1/2 is exact
    detail::for_each_row(workers, to.height(), [&](int y) {
      std::vector<Sum, DefaultInitAllocator<Sum>> buffer(2 * row_length);
      const Sum *first = row_of(2 * y, buffer.data()), *second = row_of(2 * y + 1, buffer.data() + row_length);
      halve_rows<Number>(first, second, to.row(y));
    });
    return to;
  }
  detail::for_each_row(workers, to.height(), [&](int y) {
    std::vector<Sum> buffer(row_length), sum(row_length);
    const detail::MipTaps<Number> rows = detail::mip_taps<Number>(height, y);
    for (int j = 0; j < rows.count; ++j) {
      const Sum* row = row_of(rows.first + j, buffer.data());
      const Number weight = rows.weight[j];
      for (std::size_t x = 0; x < sum.size(); ++x) sum[x] = j == 0 ? weight * row[x] : sum[x] + weight * row[x];
    }
    Sum* out = to.row(y).data();
    for (const detail::MipTaps<Number>& taps : columns) {
      const Sum* from = sum.data() + taps.first;
      Sum v = taps.weight[0] * from[0];
      for (int i = 1; i < taps.count; ++i) v += taps.weight[i] * from[i];
      *out++ = v;
    }
  });
  return to;
}

}  // namespace

template <class Texel>
std::vector<Image<Texel>> mip_chain(const Image<Texel>& base, TexelFormat format, const Workers* workers) {
  using Sum = SumOf<Texel>;
  std::vector<Image<Texel>> levels;
  if (base.width() <= 1 && base.height() <= 1) return levels;
  const auto base_row = [&](int r, Sum* buffer) {
    average_row(base.row(r), buffer, format);
    return static_cast<const Sum*>(buffer);
  };
  Image<Sum> averaged;
  if (base.width() % 4 == 0 && base.height() % 4 == 0) {
    // The second level reads each row of the first level once, so the sums of the first level, which is the largest, are not stored.
    Image<Texel>& level = levels.emplace_back(base.width() / 2, base.height() / 2);
    const auto row_length = static_cast<std::size_t>(base.width());
    const auto level_row = [&](int r, Sum* buffer) {
      std::vector<Sum, DefaultInitAllocator<Sum>> rows(2 * row_length);
      const std::span<Sum> sums(buffer, row_length / 2);
      halve_rows<typename Averaging<Texel>::Number>(base_row(2 * r, rows.data()), base_row(2 * r + 1, rows.data() + row_length), sums);
      texel_row(std::span<const Sum>(sums), level.row(r).data(), format);
      return static_cast<const Sum*>(buffer);
    };
    averaged = next_level<Texel>(level.width(), level.height(), level_row, workers);
  } else {
    averaged = next_level<Texel>(base.width(), base.height(), base_row, workers);
  }
  while (true) {
    Image<Texel>& level = levels.emplace_back(averaged.width(), averaged.height());
    detail::for_each_row(workers, level.height(), [&](int y) { texel_row(std::as_const(averaged).row(y), level.row(y).data(), format); });
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

}  // namespace halfspace::HS_LANES
