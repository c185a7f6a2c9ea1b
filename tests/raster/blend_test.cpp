// SPDX-License-Identifier: Apache-2.0
//
// Tests blending into rgba8 buffers against the formulas in double precision, and the specialized functions against the general one.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "halfspace/raster/tile/blend.h"
#include "halfspace/raster/tile/tile_format.h"
#include "halfspace/raster/tile/write_programs.h"
#include "raster/raster_test.h"

namespace halfspace {

namespace {

using namespace raster_test;

constexpr int kEquations = static_cast<int>(BlendEquation::max) + 1;
constexpr int kFactors = static_cast<int>(BlendFactor::one_minus_src1_alpha) + 1;
// The bound that blend_codes.h states: half a code for the final rounding, and the rounding errors before it.
constexpr double kTolerance = 0.5 + 1e-4;

double in_range(double x) { return x > 0.0 ? std::min(x, 1.0) : 0.0; }  // 0 for NaN

struct Colors {
  glm::dvec4 src, src1, dst, constant;  // in [0, 1]
};

// OpenGL 4.6, table 17.2.
double factor_of(BlendFactor f, const Colors& c, int k) {
  using enum BlendFactor;
  switch (f) {
    case zero: return 0.0;
    case one: return 1.0;
    case src_color: return c.src[k];
    case one_minus_src_color: return 1.0 - c.src[k];
    case dst_color: return c.dst[k];
    case one_minus_dst_color: return 1.0 - c.dst[k];
    case src_alpha: return c.src.w;
    case one_minus_src_alpha: return 1.0 - c.src.w;
    case dst_alpha: return c.dst.w;
    case one_minus_dst_alpha: return 1.0 - c.dst.w;
    case constant_color: return c.constant[k];
    case one_minus_constant_color: return 1.0 - c.constant[k];
    case constant_alpha: return c.constant.w;
    case one_minus_constant_alpha: return 1.0 - c.constant.w;
    case src_alpha_saturate: return k == 3 ? 1.0 : std::min(c.src.w, 1.0 - c.dst.w);
    case src1_color: return c.src1[k];
    case one_minus_src1_color: return 1.0 - c.src1[k];
    case src1_alpha: return c.src1.w;
    case one_minus_src1_alpha: return 1.0 - c.src1.w;
  }
  return 0.0;
}

double blended(const BlendState& s, const Colors& c, int k) {
  const double source = c.src[k] * factor_of(k == 3 ? s.source_alpha : s.source_color, c, k);
  const double destination = c.dst[k] * factor_of(k == 3 ? s.destination_alpha : s.destination_color, c, k);
  switch (k == 3 ? s.alpha_equation : s.color_equation) {
    case BlendEquation::add: return in_range(source + destination);
    case BlendEquation::subtract: return in_range(source - destination);
    case BlendEquation::reverse_subtract: return in_range(destination - source);
    case BlendEquation::min: return std::min(c.src[k], c.dst[k]);
    case BlendEquation::max: return std::max(c.src[k], c.dst[k]);
  }
  return 0.0;
}

// The first packet of a buffer, and colors to blend with it.
struct Packet {
  Random random{17};
  std::unique_ptr<ColorBuffer> buffer = std::make_unique<ColorBuffer>();
  PacketColor src, src1;
  std::array<uint32_t, kLanes> before;

  Packet() { buffer->format = ColorFormat::rgba8; }
  void fill() {
    for (int i = 0; i < kLanes; ++i) {
      before[static_cast<std::size_t>(i)] = random.bits();
      for (std::size_t k = 0; k < 4; ++k) {
        set_lane(src[k], i, value());
        set_lane(src1[k], i, value());
      }
    }
    reset();
  }
  void reset() { std::memcpy(buffer->bytes.data(), before.data(), sizeof before); }
  std::array<uint32_t, kLanes> codes() const {
    std::array<uint32_t, kLanes> c;
    std::memcpy(c.data(), buffer->bytes.data(), sizeof c);
    return c;
  }

 private:
  // Mostly colors, but also values that must be clamped.
  float value() {
    if (random.once_in(10))
      return random.pick({-1.0f, 0.0f, 1.0f, 2.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()});
    return static_cast<float>(random.real(0.0, 1.0));
  }
};

double code_of(uint32_t pixel, int k) { return pixel >> 8 * k & 0xff; }

}  // namespace

TEST(Blend, CodesAreWithinTheErrorBoundForEveryFactorAndEquation) {
  Packet p;
  const PacketMask whole{0, static_cast<uint16_t>(kAllBits<Mask>)};
  for (int e = 0; e < kEquations; ++e) {
    for (int f = 0; f < kFactors * kFactors; ++f) {
      const auto equation = static_cast<BlendEquation>(e);
      const auto source = static_cast<BlendFactor>(f % kFactors), destination = static_cast<BlendFactor>(f / kFactors);
      const auto any_factor = [&] { return static_cast<BlendFactor>(p.random.below(kFactors)); };
      // Compiled states have the same factors for alpha, or 1 for the source.
      const bool same = p.random.coin();
      const BlendState state{.color_equation = equation,
                             .source_color = source,
                             .destination_color = destination,
                             .alpha_equation = equation,
                             .source_alpha = same              ? source
                                             : p.random.coin() ? BlendFactor::one
                                                               : any_factor(),
                             .destination_alpha = same || p.random.coin() ? destination : any_factor(),
                             .constant = {0.3f, 1.5f, -0.5f, 0.7f}};
      p.fill();
      write_batch(*p.buffer, std::span(&whole, 1), &p.src, &p.src1, {state, {}});
      const std::array<uint32_t, kLanes> codes = p.codes();
      p.reset();
      write_color(*p.buffer, 0, Mask(true), p.src, p.src1, {state, {}});
      ASSERT_EQ(p.codes(), codes) << "equation " << e << ", factors " << f % kFactors << ", " << f / kFactors;
      for (std::size_t i = 0; i < kLanes; ++i) {
        Colors c;
        for (int k = 0; k < 4; ++k) {
          const auto channel = static_cast<std::size_t>(k);
          c.src[k] = in_range(static_cast<double>(lane(p.src[channel], static_cast<int>(i))));
          c.src1[k] = in_range(static_cast<double>(lane(p.src1[channel], static_cast<int>(i))));
          c.dst[k] = code_of(p.before[i], k) / 255.0;
          c.constant[k] = in_range(static_cast<double>(state.constant[k]));
        }
        for (int k = 0; k < 4; ++k) {
          ASSERT_NEAR(code_of(codes[i], k), 255.0 * blended(state, c, k), kTolerance)
              << "equation " << e << ", factors " << f % kFactors << ", " << f / kFactors << ", channel " << k;
        }
      }
    }
  }
}

TEST(Blend, ProgramsWriteTheSameBitsAsTheGeneralCode) {
  Packet p;
  Random& random = p.random;
  const auto any_factor = [&] { return static_cast<BlendFactor>(random.below(kFactors)); };
  const auto any_equation = [&] { return random.coin() ? BlendEquation::add : static_cast<BlendEquation>(random.below(kEquations)); };
  const auto general = std::make_unique<ColorBuffer>();
  for (const ColorFormat format : {ColorFormat::rgba8, ColorFormat::srgb8a8, ColorFormat::rgba16f}) {
    // Each pair of factors occurs for color and alpha together, as in compiled states, and in random combinations.
    for (int f = 0; f < 4 * kFactors * kFactors; ++f) {
      const auto source = static_cast<BlendFactor>(f % kFactors), destination = static_cast<BlendFactor>(f / kFactors % kFactors);
      const bool same = random.coin();
      const BlendEquation equation = any_equation();
      const BlendState blend{.color_equation = equation,
                             .source_color = source,
                             .destination_color = destination,
                             .alpha_equation = same ? equation : any_equation(),
                             .source_alpha = same ? source : any_factor(),
                             .destination_alpha = same ? destination : any_factor(),
                             .constant = {0.3f, 1.5f, -0.5f, 0.7f}};
      AttachmentState state{.mask = {random.coin(), random.coin(), random.coin(), random.coin()}};
      if (random.coin()) state.mask = {};
      if (!random.once_in(10)) state.blend = blend;
      const PacketMask packet{3, static_cast<uint16_t>(random.bits() & kAllBits<Mask>)};
      p.fill();
      p.buffer->format = format;
      for (int i = 0; i < 4 * kLanes; ++i) {
        const auto half = static_cast<uint16_t>(float_to_half(static_cast<float>(random.real(-2.0, 2.0))));
        const auto pixel = static_cast<std::size_t>(packet.packet) * kLanes + static_cast<std::size_t>(i % kLanes);
        if (format == ColorFormat::rgba16f) plane<uint16_t>(*p.buffer, i / kLanes)[pixel] = half;
        if (format != ColorFormat::rgba16f) plane<uint32_t>(*p.buffer, 0)[pixel] = random.bits();
      }
      *general = *p.buffer;
      const auto before = std::make_unique<ColorBuffer>(*p.buffer);
      write_color(*general, packet.packet, mask_from_bits<Mask>(packet.lanes), p.src, p.src1, state);
      write_batch(*p.buffer, std::span(&packet, 1), &p.src, &p.src1, state);
      ASSERT_TRUE(p.buffer->bytes == general->bytes) << "format " << static_cast<int>(format) << ", factors " << f;
      if (state.blend && uses_second_source(*state.blend)) continue;
      *p.buffer = *before;
      write_program(format, state)(*p.buffer, packet, state, p.src[0], p.src[1], p.src[2], p.src[3], nullptr);
      ASSERT_TRUE(p.buffer->bytes == general->bytes) << "format " << static_cast<int>(format) << ", factors " << f;
    }
  }
}

TEST(Blend, KeepsTheCodesThatAStateDoesNotChange) {
  Packet p;
  const BlendState keeps{.source_color = BlendFactor::zero,
                         .destination_color = BlendFactor::one,
                         .source_alpha = BlendFactor::zero,
                         .destination_alpha = BlendFactor::one};
  for (int repeat = 0; repeat < 100; ++repeat) {
    p.fill();
    write_color(*p.buffer, 0, Mask(true), p.src, p.src1, {keeps, {}});
    ASSERT_EQ(p.codes(), p.before);
    write_color(*p.buffer, 0, Mask(true), p.src, p.src1, {BlendState{}, {.r = false, .g = false, .b = false, .a = false}});
    ASSERT_EQ(p.codes(), p.before);
    write_color(*p.buffer, 0, Mask(false), p.src, p.src1, {BlendState{}, {}});
    ASSERT_EQ(p.codes(), p.before);
  }
}

}  // namespace halfspace
