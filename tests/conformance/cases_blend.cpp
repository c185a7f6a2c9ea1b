// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "conformance/geometry.h"
#include "conformance/groups.h"
#include "halfspace/core/srgb.h"

namespace halfspace::conformance {

namespace {

constexpr int kStrips = 8;  // vertical strips in the destination and horizontal ones in the source: 64 pairs of colors
constexpr const char* kFactorNames[] = {"zero",
                                        "one",
                                        "src_color",
                                        "one_minus_src_color",
                                        "dst_color",
                                        "one_minus_dst_color",
                                        "src_alpha",
                                        "one_minus_src_alpha",
                                        "dst_alpha",
                                        "one_minus_dst_alpha",
                                        "constant_color",
                                        "one_minus_constant_color",
                                        "constant_alpha",
                                        "one_minus_constant_alpha",
                                        "src_alpha_saturate",
                                        "src1_color",
                                        "one_minus_src1_color",
                                        "src1_alpha",
                                        "one_minus_src1_alpha"};
constexpr const char* kEquationNames[] = {"add", "subtract", "reverse_subtract", "min", "max"};
constexpr glm::vec4 kConstant(0.2f, 0.4f, 0.6f, 0.8f);

glm::vec4 destination_color(int strip) { return strip == 0 ? glm::vec4(0.0f) : strip == 7 ? glm::vec4(1.0f) : color_number(strip); }
glm::vec4 source_color(int strip) { return strip == 0 ? glm::vec4(1.0f) : strip == 7 ? glm::vec4(0.0f) : color_number(strip + 40); }
glm::vec4 second_color(int strip) { return color_number(strip + 60); }

Picture strips(ColorFormat format, Kind kind) {
  Picture p;
  p.width = p.height = 16;
  p.colors = {format};
  p.depth = DepthFormat::none;
  Drawing destination, source;
  for (int i = 0; i < kStrips; ++i) {
    add_rectangle(destination, p, {2.0 * i, 0, 2.0 * i + 2, 16}, destination_color(i));
    add_rectangle(source, p, {0, 2.0 * i, 16, 2.0 * i + 2}, source_color(i));
    for (std::size_t k = 0; k < 4; ++k) source.vertices[source.vertices.size() - 1 - k].extra = second_color(i);
  }
  source.kind = kind;
  p.draws = {std::move(destination), std::move(source)};
  return p;
}

double factor(BlendFactor f, int channel, const glm::dvec4& s, const glm::dvec4& s1, const glm::dvec4& d, const glm::dvec4& c) {
  const auto i = static_cast<int>(f);
  if (f == BlendFactor::zero) return 0.0;
  if (f == BlendFactor::one) return 1.0;
  if (f == BlendFactor::src_alpha_saturate) return channel == 3 ? 1.0 : std::min(s.w, 1.0 - d.w);
  // The other factors come in groups of four: color, one minus color, alpha, one minus alpha.
  const bool second = i > static_cast<int>(BlendFactor::src_alpha_saturate);
  glm::dvec4 of = s1;
  bool by_alpha = i >= static_cast<int>(BlendFactor::src1_alpha), minus = (i - static_cast<int>(BlendFactor::src1_color)) % 2 == 1;
  if (!second) {
    const std::string name = kFactorNames[i];
    of = name.find("src") != std::string::npos ? s : name.find("dst") != std::string::npos ? d : c;
    by_alpha = name.find("alpha") != std::string::npos;
    minus = name.find("minus") != std::string::npos;
  }
  const double v = by_alpha ? of.w : of[channel];
  return minus ? 1.0 - v : v;
}

double blended(BlendEquation e, double s, double fs, double d, double fd) {
  switch (e) {
    case BlendEquation::add: return s * fs + d * fd;
    case BlendEquation::subtract: return s * fs - d * fd;
    case BlendEquation::reverse_subtract: return d * fd - s * fs;
    case BlendEquation::min: return std::min(s, d);
    case BlendEquation::max: break;
  }
  return std::max(s, d);
}

// Returns the value that is read back after a linear value was stored; for sRGB, the encoded value.
double stored(ColorFormat format, int channel, double v) {
  if (format == ColorFormat::rgba32f || format == ColorFormat::rgba16f) return v;
  v = std::clamp(v, 0.0, 1.0);
  if (format == ColorFormat::rgba8 || channel == 3) return v;
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}
double to_light(ColorFormat format, int channel, float v) {
  if (format != ColorFormat::srgb8a8 || channel == 3) return static_cast<double>(v);
  return static_cast<double>(kSrgbToLinear[static_cast<std::size_t>(std::lround(v * 255.0f))]);
}

// Evaluates the formula in OpenGL 4.6, section 17.3.6, from the stored destination.
std::string blend_formula(const Picture& p, const Seen& seen) {
  Picture before = p;
  before.draws.pop_back();
  const Seen destination = draw(before);
  const DrawState& state = p.draws[1].state;
  for (std::size_t a = 0; a < p.colors.size(); ++a) {
    const ColorFormat format = p.colors[a];
    const bool own = state.attachments[a].has_value();
    const std::optional<BlendState> b = own ? state.attachments[a]->blend : state.blend;
    const ColorMask mask = own ? state.attachments[a]->mask : state.color_mask;
    const std::string wrong = for_each_pixel(seen, [&](int x, int y) -> std::string {
      const glm::dvec4 s1(second_color(y / 2));
      const glm::dvec4 s = a == 1 ? s1 : glm::dvec4(source_color(y / 2));
      glm::dvec4 d, expected;
      for (int k = 0; k < 4; ++k) d[k] = to_light(format, k, destination.color(x, y, a)[k]);
      for (int k = 0; k < 4; ++k) {
        double v = s[k];
        if (b) {
          const glm::dvec4 c(b->constant);
          const double fs = factor(k < 3 ? b->source_color : b->source_alpha, k, s, s1, d, c);
          const double fd = factor(k < 3 ? b->destination_color : b->destination_alpha, k, s, s1, d, c);
          v = blended(k < 3 ? b->color_equation : b->alpha_equation, s[k], fs, d[k], fd);
        }
        expected[k] = stored(format, k, mask[k] ? v : d[k]);
      }
      // Half an LSB for 8-bit formats, half an ulp for half floats, and a few roundings for floats.
      const double tolerance = format == ColorFormat::rgba32f ? 1e-6 : format == ColorFormat::rgba16f ? 0x1p-11 : kHalfCode;
      return expect_near(expected, seen.color(x, y, a), tolerance);
    });
    if (!wrong.empty()) return "attachment " + std::to_string(a) + ", " + wrong;
  }
  return {};
}

std::string name_of(ColorFormat format, const BlendState& b) {
  const auto half = [](BlendEquation e, BlendFactor s, BlendFactor d) {
    return std::string(kEquationNames[static_cast<int>(e)]) + "_" + kFactorNames[static_cast<int>(s)] + "_" +
           kFactorNames[static_cast<int>(d)];
  };
  return (format == ColorFormat::srgb8a8 ? "srgb8" : std::string(texel_info(format).name)) + "_" +
         half(b.color_equation, b.source_color, b.destination_color) + "_alpha_" +
         half(b.alpha_equation, b.source_alpha, b.destination_alpha);
}

void add(Cases& cases, ColorFormat format, BlendState b, Kind kind = Kind::color) {
  b.constant = kConstant;
  cases.push_back({name_of(format, b),
                   [=] {
                     Picture p = strips(format, kind);
                     p.draws[1].state.blend = b;
                     return p;
                   },
                   blend_formula, true});
}

constexpr int kOneSource = 15;  // number of factors that do not use the second source
BlendFactor factor_number(int i) { return static_cast<BlendFactor>(i % kOneSource); }

// Adds every pair of factors. Each case uses a different pair for alpha, so that all pairs occur for alpha, too.
void add_factors(Cases& cases, ColorFormat format) {
  for (int s = 0; s < kOneSource; ++s) {
    for (int d = 0; d < kOneSource; ++d) {
      const auto equation = static_cast<BlendEquation>((s + d) % 3);
      add(cases, format,
          {equation, factor_number(s), factor_number(d), static_cast<BlendEquation>(s % 3), factor_number(d + 4), factor_number(s + 9)});
    }
  }
}

void add_equations(Cases& cases, ColorFormat format) {
  for (int rgb = 0; rgb < 5; ++rgb) {
    for (int alpha = 0; alpha < 5; ++alpha) {
      add(cases, format,
          {static_cast<BlendEquation>(rgb), BlendFactor::src_alpha, BlendFactor::one, static_cast<BlendEquation>(alpha), BlendFactor::one,
           BlendFactor::src_alpha});
    }
  }
}

void add_second_sources(Cases& cases) {
  constexpr auto kFirst = static_cast<int>(BlendFactor::src1_color);
  for (const ColorFormat format : {ColorFormat::rgba8, ColorFormat::srgb8a8}) {
    for (int s = kFirst; s < kFirst + 4; ++s) {
      for (int d = kFirst; d < kFirst + 4; ++d) {
        const auto source = static_cast<BlendFactor>(s), destination = static_cast<BlendFactor>(d);
        add(cases, format, {BlendEquation::add, source, destination, BlendEquation::add, destination, source}, Kind::two_colors);
      }
    }
  }
}

// Adds cases in which only the alpha factors use the second source.
void add_second_alpha(Cases& cases) {
  constexpr auto kFirst = static_cast<int>(BlendFactor::src1_color);
  for (int i = 0; i < 4; ++i) {
    const auto second = static_cast<BlendFactor>(kFirst + i);
    const BlendFactor source = i % 2 == 0 ? second : BlendFactor::one, destination = i % 2 == 0 ? BlendFactor::dst_alpha : second;
    add(cases, ColorFormat::rgba8, {BlendEquation::add, BlendFactor::one, BlendFactor::dst_color, BlendEquation::add, source, destination},
        Kind::two_colors);
  }
}

// Adds cases with separate equations and masks per attachment.
void add_attachments(Cases& cases) {
  for (int i = 0; i < 20; ++i) {
    cases.push_back({"attachments_" + std::to_string(i),
                     [=] {
                       Picture p = strips(i % 2 == 0 ? ColorFormat::rgba8 : ColorFormat::rgba32f, Kind::two_colors);
                       p.colors.push_back(i % 3 == 0 ? ColorFormat::srgb8a8 : ColorFormat::rgba8);
                       p.draws[0].kind = Kind::two_colors;
                       for (Vertex& v : p.draws[0].vertices) v.extra = v.color * 0.5f;
                       DrawState& s = p.draws[1].state;
                       s.blend.emplace();
                       s.attachments[0] = AttachmentState{{}, {(i & 1) != 0, (i & 2) == 0, (i & 4) != 0, (i & 8) == 0}};
                       if (i % 4 != 3) {
                         const auto equation = static_cast<BlendEquation>(i % 5);
                         s.attachments[1] = AttachmentState{BlendState{equation, BlendFactor::dst_color, factor_number(i), equation,
                                                                       BlendFactor::one, factor_number(i + 7), kConstant},
                                                            {}};
                       }
                       return p;
                     },
                     blend_formula, true});
  }
}

}  // namespace

Cases blend_cases() {
  Cases cases;
  add_factors(cases, ColorFormat::rgba8);
  add_factors(cases, ColorFormat::srgb8a8);
  for (const ColorFormat f : {ColorFormat::rgba8, ColorFormat::rgba16f, ColorFormat::rgba32f}) add_equations(cases, f);
  add_second_sources(cases);
  add_second_alpha(cases);
  add_attachments(cases);
  return cases;
}

}  // namespace halfspace::conformance
