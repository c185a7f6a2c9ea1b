// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/blit.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "halfspace/core/float_mode.h"
#include "halfspace/core/texel_codec.h"
#include "halfspace/raster/tile/texel_overlap.h"

namespace halfspace::HS_LANES {

namespace {

constexpr int64_t kMaxBlitSize = 1 << 20;
constexpr int kRowsPerTask = 16;

// One row or column of the destination, and the two of the source that it is made of.
struct Tap {
  int to;
  int first, second;
  float weight;  // of the second one
};
using Taps = std::vector<Tap>;

// A range of texels along an axis, from one corner of a rectangle to the other.
struct Range {
  int64_t low, size;
  bool reversed;
};
Range range_of(int begin, int size) { return {std::min<int64_t>(begin, int64_t{begin} + size), std::abs(int64_t{size}), size < 0}; }

// Returns the taps of all destination texels inside of a view of to_size texels whose source is inside of a view of from_size texels.
Taps taps_of(const Range& from, int from_size, const Range& to, int to_size, BlitFilter filter) {
  Taps taps;
  if (from.size == 0) return taps;
  const int64_t begin = std::max<int64_t>(to.low, 0), end = std::min<int64_t>(to.low + to.size, to_size);
  const int64_t least = std::max<int64_t>(from.low, 0), greatest = std::min<int64_t>(from.low + from.size, from_size) - 1;
  const int64_t unit = 2 * to.size;  // positions in the source are multiples of 1/unit
  for (int64_t x = begin; x < end; ++x) {
    int64_t position = from.size * (2 * (x - to.low) + 1);
    if (from.reversed != to.reversed) position = from.size * unit - position;
    const int64_t nearest = from.low + position / unit;
    if (nearest < least || nearest > greatest) continue;
    Tap tap{static_cast<int>(x), static_cast<int>(nearest), static_cast<int>(nearest), 0.0f};
    if (filter == BlitFilter::linear) {
      const int64_t from_center = position + unit / 2;  // from the center of the texel before the rectangle
      const int64_t first = from.low - 1 + from_center / unit;
      tap.first = static_cast<int>(std::clamp(first, least, greatest));
      tap.second = static_cast<int>(std::clamp(first + 1, least, greatest));
      tap.weight = static_cast<float>(from_center % unit) / static_cast<float>(unit);
    }
    taps.push_back(tap);
  }
  return taps;
}

// Calls task(i) for each i in [0, count).
template <class F>
void for_each(const Workers* workers, int count, const F& task) {
  const FloatMode float_mode;
  if (workers == nullptr) {
    for (int i = 0; i < count; ++i) task(i);
    return;
  }
  workers->for_each((count + kRowsPerTask - 1) / kRowsPerTask, [&](int group) {
    for (int i = group * kRowsPerTask; i < std::min((group + 1) * kRowsPerTask, count); ++i) task(i);
  });
}

void convert_texel(TexelFormat from_format, const std::byte* from, TexelFormat to_format, std::byte* to) {
  if (is_integer(from_format)) {
    encode_integers(to_format, decode_integers(from_format, from), to);
  } else {
    encode_texel(to_format, decode_texel(from_format, from), to);
  }
}

// Copies the nearest texels of a row.
void copy_row(const ConstTexelView& from, const TexelView& to, int layer, const Tap& y, const Taps& columns) {
  const auto bytes = static_cast<std::size_t>(texel_info(from.format).bytes);
  if (from.format != to.format) {
    for (const Tap& x : columns) convert_texel(from.format, from.at(x.first, y.first, layer), to.format, to.at(x.to, y.to, layer));
  } else if (columns.back().first - columns.front().first == columns.back().to - columns.front().to) {  // neither scaled nor mirrored
    std::memcpy(to.at(columns.front().to, y.to, layer), from.at(columns.front().first, y.first, layer), columns.size() * bytes);
  } else {
    for (const Tap& x : columns) std::memcpy(to.at(x.to, y.to, layer), from.at(x.first, y.first, layer), bytes);
  }
}

// If both colors are the same, so is the result. A color with weight 0 does not matter, not even if it is infinite.
glm::vec4 mix_colors(const glm::vec4& a, const glm::vec4& b, float weight) {
  if (weight == 0.0f) return a;
  glm::vec4 mixed;
  for (int k = 0; k < 4; ++k) mixed[k] = a[k] == b[k] ? a[k] : a[k] * (1.0f - weight) + b[k] * weight;
  return mixed;
}

void filter_row(const ConstTexelView& from, const TexelView& to, int layer, const Tap& y, const Taps& columns) {
  const auto read = [&](int x, int row) { return decode_texel(from.format, from.at(x, row, layer)); };
  const auto read_between = [&](const Tap& x, int row) {
    const glm::vec4 first = read(x.first, row);
    return x.weight == 0.0f ? first : mix_colors(first, read(x.second, row), x.weight);
  };
  for (const Tap& x : columns) {
    const glm::vec4 first = read_between(x, y.first);
    const glm::vec4 color = y.weight == 0.0f ? first : mix_colors(first, read_between(x, y.second), y.weight);
    encode_texel(to.format, color, to.at(x.to, y.to, layer));
  }
}

void check_size(const Rect& r) {
  for (const int x : {r.x, r.y, r.width, r.height})
    HS_CHECK_OP(std::abs(int64_t{x}), <=, kMaxBlitSize, "blit: a rectangle is too large or too far away; expected at most 2^20");
}

void check_formats(TexelFormat from, TexelFormat to, BlitFilter filter) {
  HS_CHECK(from != TexelFormat::none && to != TexelFormat::none, "blit: a view has no format; expected two formats");
  const bool has_integers = is_integer(from) || is_integer(to), has_depth = is_depth(from) || is_depth(to);
  HS_CHECK(!has_integers || texel_info(from).kind == texel_info(to).kind,
           "blit: integers are copied to a format of another type; expected integers of the same sign");
  HS_CHECK(!has_depth || from == to, "blit: depth is copied to another format; expected the same depth format");
  HS_CHECK(filter == BlitFilter::nearest || (!has_integers && !has_depth), "blit: integers or depth are filtered; expected nearest");
}

// Returns the part of a view in a rectangle, or a view without layers if it is empty.
ConstTexelView part_of(const ConstTexelView& view, const Rect& r) {
  const Range x = range_of(r.x, r.width), y = range_of(r.y, r.height);
  const Rect inside = intersect({static_cast<int>(x.low), static_cast<int>(y.low), static_cast<int>(x.size), static_cast<int>(y.size)},
                                {0, 0, view.width, view.height});
  return inside.width > 0 && inside.height > 0 ? view.part(inside.x, inside.y, inside.width, inside.height) : ConstTexelView{.layers = 0};
}

// The mean of `count` colors, a power of two. They are added pairwise, as at the end of a pass. Where all are the same, their sum can be
// infinite, but the mean is not.
glm::vec4 mean_of(std::array<glm::vec4, 8>& colors, std::size_t count) {
  const glm::vec4 first = colors[0];
  std::array<bool, 4> same{true, true, true, true};
  for (std::size_t s = 1; s < count; ++s) {
    for (int k = 0; k < 4; ++k) same[static_cast<std::size_t>(k)] &= as_int(colors[s][k]) == as_int(first[k]);
  }
  for (std::size_t n = count; n > 1; n /= 2) {
    for (std::size_t i = 0; i < n / 2; ++i) colors[i] = colors[2 * i] + colors[2 * i + 1];
  }
  glm::vec4 mean = colors[0] * (1.0f / static_cast<float>(count));
  for (int k = 0; k < 4; ++k) {
    if (same[static_cast<std::size_t>(k)]) mean[k] = first[k];
  }
  return mean;
}

void resolve_mean(const ConstTexelView& samples, const TexelView& to, int y) {
  std::array<glm::vec4, 8> colors;
  for (int x = 0; x < to.width; ++x) {
    for (int s = 0; s < samples.layers; ++s) colors[static_cast<std::size_t>(s)] = decode_texel(samples.format, samples.at(x, y, s));
    encode_texel(to.format, mean_of(colors, static_cast<std::size_t>(samples.layers)), to.at(x, y));
  }
}

void resolve_depth(const ConstTexelView& samples, const TexelView& to, bool smallest, int y) {
  for (int x = 0; x < to.width; ++x) {
    const std::byte* best = samples.at(x, y);
    float depth = decode_texel(samples.format, best).x;
    for (int s = 1; s < samples.layers; ++s) {
      const std::byte* const texel = samples.at(x, y, s);
      const float other = decode_texel(samples.format, texel).x;
      if (smallest ? other < depth : other > depth) {
        best = texel;
        depth = other;
      }
    }
    std::memcpy(to.at(x, y), best, texel_info(to.format).bytes);
  }
}

}  // namespace

void blit(const ConstTexelView& from, const Rect& from_rect, const TexelView& to, const Rect& to_rect, BlitFilter filter,
          const Workers* workers) {
  check_formats(from.format, to.format, filter);
  check_size(from_rect);
  check_size(to_rect);
  HS_CHECK_OP(from.layers, ==, to.layers, "blit: the views have different numbers of layers; expected the same number");
  HS_CHECK(!overlap(part_of(from, from_rect), part_of(to, to_rect)), "blit: the rectangles share memory; expected separate memory");
  const Range from_x = range_of(from_rect.x, from_rect.width), from_y = range_of(from_rect.y, from_rect.height);
  const Range to_x = range_of(to_rect.x, to_rect.width), to_y = range_of(to_rect.y, to_rect.height);
  const Taps columns = taps_of(from_x, from.width, to_x, to.width, filter), rows = taps_of(from_y, from.height, to_y, to.height, filter);
  if (columns.empty() || rows.empty()) return;
  const bool filters = filter == BlitFilter::linear && (from_x.size != to_x.size || from_y.size != to_y.size);
  for (int layer = 0; layer < to.layers; ++layer) {
    for_each(workers, static_cast<int>(rows.size()), [&](int i) {
      const Tap& y = rows[static_cast<std::size_t>(i)];
      if (filters) {
        filter_row(from, to, layer, y, columns);
      } else {
        copy_row(from, to, layer, y, columns);
      }
    });
  }
}

void resolve(const ConstTexelView& samples, const TexelView& to, ResolveMode mode, const Workers* workers) {
  HS_CHECK(samples.width == to.width && samples.height == to.height && to.layers == 1,
           "resolve: the views do not match; expected two of the same size, the second with one layer");
  HS_CHECK(samples.layers == 1 || samples.layers == 2 || samples.layers == 4 || samples.layers == 8,
           "resolve: the number of layers is not one of samples; expected 1, 2, 4 or 8");
  const Rect all{0, 0, to.width, to.height};
  if (mode == ResolveMode::sample_0) return blit(samples.part_of_layers(0), all, to, all, BlitFilter::nearest, workers);
  check_formats(samples.format, to.format, BlitFilter::nearest);
  if (mode == ResolveMode::mean) {
    HS_CHECK(!is_integer(to.format) && !is_depth(to.format), "resolve: integers and depth have no mean; expected another mode or format");
  } else {
    HS_CHECK(is_depth(to.format), "resolve: min and max apply to depth; expected a depth format");
  }
  HS_CHECK(!overlap(samples, to), "resolve: the views share memory; expected separate memory");
  for_each(workers, to.height, [&](int y) {
    if (mode == ResolveMode::mean) {
      resolve_mean(samples, to, y);
    } else {
      resolve_depth(samples, to, mode == ResolveMode::min, y);
    }
  });
}

}  // namespace halfspace::HS_LANES
