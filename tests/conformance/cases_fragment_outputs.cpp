// SPDX-License-Identifier: Apache-2.0
//
// Cases of colors of fragments, after the group fragment_out of VK-GL-CTS (GLES 3): real colors and integers are stored in attachments of
// every format.
#include <algorithm>
#include <cmath>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "conformance/outputs.h"
#include "conformance/shaders.h"
#include "support/random.h"

namespace halfspace::conformance {

namespace {

std::vector<ColorFormat> formats_of(ColorType type) {
  std::vector<ColorFormat> formats;
  for (std::size_t i = 1; i < kTexelFormats; ++i) {
    const auto f = static_cast<ColorFormat>(i);
    if (!is_depth(f) && f != ColorFormat::rgb9_e5 && color_type(f) == type) formats.push_back(f);
  }
  return formats;
}

std::string format_name(ColorFormat f) { return std::string(texel_info(f).name); }

ColorMask mask_of(const DrawState& s, std::size_t attachment) {
  return s.attachments[attachment] ? s.attachments[attachment]->mask : s.color_mask;
}

// Returns the value that a real color has in a format, before it is rounded to the nearest code.
double in_range(ColorFormat format, int channel, double value) {
  const TexelInfo& info = texel_info(format);
  if (info.kind == TexelKind::snorm) return std::clamp(value, -1.0, 1.0);
  if (info.kind == TexelKind::floats) return info.bits == 0 ? std::max(value, 0.0) : value;  // packed floats have no sign
  const double c = std::clamp(value, 0.0, 1.0);
  if (info.kind != TexelKind::srgb || channel == 3) return c;
  return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

// Returns half the distance of two codes at a value, plus what interpolation and the product in float can add.
double half_code(ColorFormat format, int channel, double value) {
  constexpr double kInterpolated = 1e-6;
  const TexelInfo& info = texel_info(format);
  const int bits = channel_bits(format, channel);
  if (info.kind == TexelKind::snorm) return 0.5 / (std::ldexp(1.0, bits - 1) - 1.0) + kInterpolated;
  if (info.kind != TexelKind::floats) return 0.5 / (std::ldexp(1.0, bits) - 1.0) + 4.0 * kInterpolated;  // sRGB has a slope of up to 12.92
  const int mantissa = bits == 32 ? 23 : bits == 16 ? 10 : bits - 5;
  return std::ldexp(std::max(std::fabs(value), 0x1p-14), -mantissa) * 0.5 + kInterpolated;
}

std::string wrong_reals(const Picture& p, const Seen& seen, int x, int y, std::size_t attachment, const Vertex* v) {
  const ColorFormat format = p.colors[attachment];
  const glm::vec4 got = seen.color(x, y, attachment);
  const ColorMask mask = mask_of(p.draws[0].state, attachment);
  for (int k = 0; k < texel_info(format).channels; ++k) {
    const double color = v != nullptr && mask[k] ? static_cast<double>(v->color[k]) * (1.0 - 0.25 * static_cast<double>(attachment))
                                                 : static_cast<double>(p.clear_color[k]);
    const double expected = in_range(format, k, color);
    if (!(std::fabs(static_cast<double>(got[k]) - expected) <= half_code(format, k, expected)))
      return "attachment " + std::to_string(attachment) + ", channel " + std::to_string(k) + ": " + std::to_string(expected) +
             " expected, got " + std::to_string(got[k]);
  }
  return {};
}

std::string wrong_integers(const Picture& p, const Seen& seen, int x, int y, std::size_t attachment, const Vertex* v) {
  const ColorFormat format = p.colors[attachment];
  const glm::ivec4 got = seen.integers(x, y, attachment);
  const ColorMask mask = mask_of(p.draws[0].state, attachment);
  const bool is_signed = color_type(format) == ColorType::signed_integer;
  for (int k = 0; k < texel_info(format).channels; ++k) {
    int64_t expected = 0;  // the clear value
    if (v != nullptr && mask[k]) {
      const int64_t small = (x + k + static_cast<int>(attachment)) & 3;
      expected = static_cast<int64_t>(v->extra[k]) * static_cast<int64_t>(p.draws[0].value) + small;
      const int bits = channel_bits(format, k);
      if (is_signed) expected = std::clamp(expected, -(int64_t{1} << (bits - 1)), (int64_t{1} << (bits - 1)) - 1);
      if (!is_signed) expected = std::clamp(expected, int64_t{0}, (int64_t{1} << bits) - 1);
    }
    const int64_t stored = is_signed ? int64_t{got[k]} : int64_t{static_cast<uint32_t>(got[k])};
    if (stored != expected)
      return "attachment " + std::to_string(attachment) + ", channel " + std::to_string(k) + ": " + std::to_string(expected) +
             " expected, got " + std::to_string(stored);
  }
  return {};
}

std::string stored_in_their_formats(const Picture& p, const Seen& seen) {
  return for_each_pixel(seen, [&](int x, int y) -> std::string {
    const bool is_drawn = x % kOutputCell < kOutputSize && y % kOutputCell < kOutputSize;
    const auto quad = static_cast<std::size_t>(x / kOutputCell * (p.height / kOutputCell) + y / kOutputCell);
    const Vertex* v = is_drawn ? &p.draws[0].vertices[4 * quad] : nullptr;
    for (std::size_t i = 0; i < p.colors.size(); ++i) {
      std::string wrong = is_integer(p.colors[i]) ? wrong_integers(p, seen, x, y, i, v) : wrong_reals(p, seen, x, y, i, v);
      if (!wrong.empty()) return wrong;
    }
    return {};
  });
}

constexpr ColorType kTypes[] = {ColorType::real, ColorType::signed_integer, ColorType::unsigned_integer};

void add_basic(Cases& cases) {
  for (const ColorType type : kTypes) {
    for (const ColorFormat format : formats_of(type))
      cases.push_back(
          {"basic_" + format_name(format), [=] { return with_outputs({format}, all_of_type(type), 5); }, stored_in_their_formats});
  }
}

// Several attachments of one format.
void add_arrays(Cases& cases) {
  for (const ColorType type : kTypes) {
    const std::vector<ColorFormat> formats = formats_of(type);
    for (std::size_t i = 0; i < formats.size(); ++i) {
      const ColorFormat format = formats[i];
      const std::size_t n = 2 + i % 3;
      cases.push_back({"array_" + format_name(format) + "_" + std::to_string(n),
                       [=] { return with_outputs(std::vector(n, format), all_of_type(type), 6); }, stored_in_their_formats});
    }
  }
}

// Integers that are too large or too small are clamped.
void add_clamped(Cases& cases) {
  for (const ColorType type : {ColorType::signed_integer, ColorType::unsigned_integer}) {
    for (const ColorFormat format : formats_of(type)) {
      const int bits = channel_bits(format, 0);
      if (bits == 32) continue;
      cases.push_back({"range_" + format_name(format),
                       [=] {
                         Picture p = with_outputs({format}, all_of_type(type), 7);
                         p.draws[0].value *= 4.0f;
                         return p;
                       },
                       stored_in_their_formats, false, "OpenGL does not define integers that the format cannot store"});
    }
  }
}

// Any formats of the types, each with a mask of its own in every other case.
void add_random(Cases& cases) {
  for (uint64_t seed = 0; seed < 48; ++seed) {
    cases.push_back({"random_" + std::to_string(seed),
                     [=] {
                       Random random(seed + 1000);
                       const OutputTypes& types = kOutputTypes[seed % kOutputTypes.size()];
                       std::vector<ColorFormat> formats;
                       for (int i = random.between(2, 4), k = 0; k < i; ++k) {
                         const std::vector<ColorFormat> all = formats_of(types[static_cast<std::size_t>(k)]);
                         formats.push_back(all[static_cast<std::size_t>(random.below(static_cast<int>(all.size())))]);
                       }
                       Picture p = with_outputs(formats, types, seed);
                       DrawState& s = p.draws[0].state;
                       for (std::size_t i = 0; seed % 2 == 1 && i < formats.size(); ++i) {
                         if (random.coin())
                           s.attachments[i] = AttachmentState{{}, {random.coin(), random.coin(), random.coin(), random.coin()}};
                       }
                       if (random.once_in(3)) p.samples = 4;
                       return p;
                     },
                     stored_in_their_formats, true});
  }
}

}  // namespace

Cases fragment_outputs_cases() {
  Cases cases;
  add_basic(cases);
  add_arrays(cases);
  add_clamped(cases);
  add_random(cases);
  return cases;
}

}  // namespace halfspace::conformance
