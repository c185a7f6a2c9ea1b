// SPDX-License-Identifier: Apache-2.0
#include "conformance/blits.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "conformance/texture_lookups.h"

namespace halfspace::conformance::blits {

namespace {

// ---- formats -------------------------------------------------------------------------------------------------------

/// The least and the greatest value of a channel.
struct Range {
  double low, high;
};
Range range_of(TexelFormat format, int k) {
  const TexelInfo& info = texel_info(format);
  switch (info.kind) {
    case TexelKind::unorm:
    case TexelKind::srgb: return {0.0, 1.0};
    case TexelKind::snorm: return {-1.0, 1.0};
    case TexelKind::sints: return {-std::ldexp(1.0, info.bits - 1), std::ldexp(1.0, info.bits - 1) - 1.0};
    case TexelKind::uints: return {0.0, std::ldexp(1.0, channel_bits(format, k)) - 1.0};
    case TexelKind::shared_exponent: return {0.0, 65408.0};
    default: break;
  }
  if (format == TexelFormat::r11f_g11f_b10f) return {0.0, k == 2 ? 64512.0 : 65024.0};
  if (info.bits == 16) return {-65504.0, 65504.0};
  return {-INFINITY, INFINITY};
}

/// Distance between neighboring floats with a mantissa of `bits` bits, of which the least normal one has the given exponent.
double float_step(double value, int bits, int least_exponent) {
  const int exponent = value == 0.0 ? least_exponent : std::max(std::ilogb(value), least_exponent);
  return std::ldexp(1.0, exponent - bits);
}
double srgb_step(double linear) {
  const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  const auto decoded = [](double code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  const double code = std::min(std::floor(encoded * 255.0), 254.0);
  // A code is rounded before it is decoded, and the middle of two codes is at most 1% of their distance from that of their numbers.
  return 1.02 * (decoded(code + 1.0) - decoded(code));
}
double step_of(TexelFormat format, int k, const glm::dvec4& value) {
  const TexelInfo& info = texel_info(format);
  switch (info.kind) {
    case TexelKind::unorm: return 1.0 / (std::ldexp(1.0, channel_bits(format, k)) - 1.0);
    case TexelKind::srgb: return k == 3 ? 1.0 / 255.0 : srgb_step(value[k]);
    case TexelKind::snorm: return 1.0 / (std::ldexp(1.0, info.bits - 1) - 1.0);
    case TexelKind::shared_exponent: {
      const double largest = std::max({value.x, value.y, value.z});
      // The mantissa of the largest channel has 9 bits, unless it is rounded up to 512.
      const double step = float_step(largest, 8, -16);
      return largest > 511.5 * step ? 2.0 * step : step;
    }
    case TexelKind::floats: break;
    default: return 0.0;  // integers are not rounded
  }
  const int bits = channel_bits(format, k);
  return bits == 32 ? float_step(value[k], 23, -126) : float_step(value[k], bits == 16 ? 10 : bits - 5, -14);
}

/// A value that will be rounded to a format: within its range, and with its steps.
Texel converted(TexelFormat format, const glm::dvec4& value, const glm::dvec4& error) {
  Texel texel{value, {}, error, true};
  for (int k = 0; k < compared_channels(format); ++k) {
    const Range range = range_of(format, k);
    texel.value[k] = std::clamp(value[k], range.low, range.high);
  }
  for (int k = 0; k < compared_channels(format); ++k) texel.step[k] = step_of(format, k, texel.value);
  return texel;
}

// ---- positions -----------------------------------------------------------------------------------------------------

/// The texel at a position in the source, and the distance from its beginning.
struct Position {
  int64_t texel;
  double fraction;
};
/// The position of the center of texel x of the destination, moved by `halves` half texels.
Position position_of(int x, int from_begin, int from_size, int to_begin, int to_size, int halves) {
  // from_begin + (x + 1/2 - to_begin)·from_size/to_size + halves/2 as a fraction of integers.
  int64_t numerator = (2 * int64_t{from_begin} + halves) * to_size + (2 * (int64_t{x} - to_begin) + 1) * from_size;
  int64_t denominator = 2 * int64_t{to_size};
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  const int64_t rest = (numerator % denominator + denominator) % denominator;
  return {(numerator - rest) / denominator, static_cast<double>(rest) / static_cast<double>(denominator)};
}
bool is_inside(int64_t x, int begin, int size) { return x >= std::min(begin, begin + size) && x < std::max(begin, begin + size); }

/// One axis of a blit.
struct Axis {
  int from_begin, from_size, from_texels, to_begin, to_size;

  Position at(int x, int halves) const { return position_of(x, from_begin, from_size, to_begin, to_size, halves); }
  bool writes(int x) const {
    if (!is_inside(x, to_begin, to_size)) return false;
    const int64_t source = at(x, 0).texel;
    return source >= 0 && source < from_texels && is_inside(source, from_begin, from_size);
  }
  /// Whether x is inside of the rectangle, but its source is left to the implementation (see blits.h).
  bool varies(int x, BlitFilter filter) const {
    if (!is_inside(x, to_begin, to_size)) return false;
    const Position p = at(x, filter == BlitFilter::linear ? -1 : 0);
    if (!writes(x)) return true;
    if (filter == BlitFilter::nearest) return p.fraction == 0.0;
    return p.fraction != 0.0 && (limited(p.texel) != p.texel || limited(p.texel + 1) != p.texel + 1);
  }
  /// The nearest texel of the part of the source rectangle that exists.
  int limited(int64_t texel) const {
    const int64_t least = std::max(0, std::min(from_begin, from_begin + from_size));
    const int64_t greatest = std::min(from_texels, std::max(from_begin, from_begin + from_size)) - 1;
    return static_cast<int>(std::clamp(texel, least, greatest));
  }
};

class Reference {
 public:
  Reference(const BlitCase& c, const TexelView& from) : c_(c), from_(from) {}

  Texel texel(int x, int y, int layer) const {
    if (c_.resolve) return resolved(x, y);
    Texel texel;
    if (columns_.writes(x) && rows_.writes(y)) texel = c_.filter == BlitFilter::linear ? filtered(x, y, layer) : nearest(x, y, layer);
    texel.varies = columns_.varies(x, c_.filter) || rows_.varies(y, c_.filter);
    return texel;
  }

 private:
  glm::dvec4 source(int64_t x, int64_t y, int layer) const {
    return value_of(c_.from, from_.at(static_cast<int>(x), static_cast<int>(y), layer));
  }
  /// Texels are decoded to floats, whose last bit may be wrong.
  static glm::dvec4 decoding_error(const glm::dvec4& value) { return 0x1p-23 * glm::abs(value); }
  /// The mean of texels of at most the given size adds some roundings of floats.
  static glm::dvec4 filter_error(const glm::dvec4& size) { return 0x1p-21 * size; }

  Texel nearest(int x, int y, int layer) const {
    const glm::dvec4 value = source(columns_.at(x, 0).texel, rows_.at(y, 0).texel, layer);
    return c_.from == c_.to ? Texel{value, {}, {}, true} : converted(c_.to, value, decoding_error(value));
  }

  Texel filtered(int x, int y, int layer) const {
    const Position u = columns_.at(x, -1), v = rows_.at(y, -1);
    glm::dvec4 sum(0.0), size(0.0);
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) {
        const glm::dvec4 value = source(columns_.limited(u.texel + i), rows_.limited(v.texel + j), layer);
        sum += value * (i == 0 ? 1.0 - u.fraction : u.fraction) * (j == 0 ? 1.0 - v.fraction : v.fraction);
        size = glm::max(size, glm::abs(value));
      }
    }
    return converted(c_.to, sum, filter_error(size));
  }

  Texel resolved(int x, int y) const {
    const glm::dvec4 first = source(x, y, 0);
    if (*c_.resolve == ResolveMode::sample_0)
      return c_.from == c_.to ? Texel{first, {}, {}, true} : converted(c_.to, first, decoding_error(first));
    glm::dvec4 sum(0.0), size(0.0), least = first, greatest = first;
    for (int sample = 0; sample < c_.from_size.depth; ++sample) {
      const glm::dvec4 value = source(x, y, sample);
      sum += value / static_cast<double>(c_.from_size.depth);
      size = glm::max(size, glm::abs(value));
      if (value.x < least.x) least = value;
      if (value.x > greatest.x) greatest = value;
    }
    if (*c_.resolve == ResolveMode::mean) return converted(c_.to, sum, filter_error(size));
    return {*c_.resolve == ResolveMode::min ? least : greatest, {}, {}, true};
  }

  const BlitCase& c_;
  TexelView from_;
  Axis columns_{c_.from_rect.x, c_.from_rect.width, c_.from_size.width, c_.to_rect.x, c_.to_rect.width};
  Axis rows_{c_.from_rect.y, c_.from_rect.height, c_.from_size.height, c_.to_rect.y, c_.to_rect.height};
};

TexelView destination(const BlitCase& c, TextureMemory& to) { return c.flipped ? to.level().flipped() : to.level(); }

template <class F>
void for_each_texel(const BlitCase& c, F f) {
  const int layers = c.resolve ? 1 : c.to_size.depth;
  for (int layer = 0; layer < layers; ++layer) {
    for (int y = 0; y < c.to_size.height; ++y) {
      for (int x = 0; x < c.to_size.width; ++x) f(x, y, layer);
    }
  }
}

}  // namespace

void fill_source(TextureMemory& from) { lookups::fill_with_noise(from); }

int compared_channels(TexelFormat format) { return has_stencil(format) ? 2 : texel_info(format).channels; }

glm::dvec4 value_of(TexelFormat format, const std::byte* texel) {
  glm::dvec4 value = lookups::decoded(format, texel);
  if (is_depth(format)) value.y = lookups::stencil_of(format, texel);
  return value;
}

std::vector<Texel> texels_in_double(const BlitCase& c, TextureMemory& from) {
  const Reference reference(c, from.level());
  std::vector<Texel> texels;
  for_each_texel(c, [&](int x, int y, int layer) { texels.push_back(reference.texel(x, y, layer)); });
  return texels;
}

void run(const BlitCase& c, TextureMemory& from, TextureMemory& to) {
  if (c.resolve) {
    resolve(from.level(), destination(c, to), *c.resolve);
  } else {
    blit(from.level(), c.from_rect, destination(c, to), c.to_rect, c.filter);
  }
}

std::string check(const BlitCase& c) {
  TextureMemory from(TextureKind::two_d_array, c.from, c.from_size), to(TextureKind::two_d_array, c.to, c.to_size);
  fill_source(from);
  run(c, from, to);
  const std::vector<Texel> expected = texels_in_double(c, from);
  const TexelView seen = destination(c, to);
  std::ostringstream wrong;
  wrong.precision(9);
  std::size_t i = 0, written = 0;
  for_each_texel(c, [&](int x, int y, int layer) {
    const Texel& e = expected[i++];
    written += e.written;
    const std::byte* const texel = seen.at(x, y, layer);
    const bool untouched = std::all_of(texel, texel + texel_info(c.to).bytes, [](std::byte b) { return b == std::byte{0}; });
    if (!e.written && !untouched) wrong << "texel " << x << ' ' << y << " is written; ";
    const glm::dvec4 value = value_of(c.to, texel);
    for (int k = 0; k < compared_channels(c.to) && e.written; ++k) {
      if (std::fabs(value[k] - e.value[k]) > 0.5 * e.step[k] + e.error[k])
        wrong << "texel " << x << ' ' << y << ", channel " << k << " is " << value[k] << ", expected " << e.value[k] << "; ";
    }
  });
  if ((written == 0) != c.outside) wrong << written << " texels are written";
  return wrong.str().substr(0, 500);
}

}  // namespace halfspace::conformance::blits
