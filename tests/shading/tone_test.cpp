// SPDX-License-Identifier: Apache-2.0
//
// Tests the tone curves for every half-float value, the display encodings, and dithering.
#include "halfspace/shading/values/tone.h"

#include <gtest/gtest.h>

#include <cmath>

#include "halfspace/core/half.h"
#include "halfspace/core/srgb.h"

namespace halfspace {
namespace {

constexpr ToneCurve kCurves[]{ToneCurve::none, ToneCurve::reinhard, ToneCurve::reinhard_extended, ToneCurve::exponential, ToneCurve::aces};

// The curves of tone.h in double, clamped to [0, 1].
double truth(ToneCurve curve, double x, double white) {
  double y = x;
  if (curve == ToneCurve::reinhard) y = x / (1 + x);
  if (curve == ToneCurve::reinhard_extended) y = x * (1 + x / (white * white)) / (1 + x);
  if (curve == ToneCurve::exponential) y = -std::expm1(-x);
  if (curve == ToneCurve::aces) y = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  return std::min(y, 1.0);
}

float shown(float x, const ToneMapping& tone) { return tone_map(SceneLight<float>{glm::vec3(x)}, tone).rgb.x; }

class EveryCurve : public testing::TestWithParam<ToneCurve> {};
std::string name_of(const testing::TestParamInfo<ToneCurve>& info) {
  static constexpr std::array<const char*, 5> kNames{"none", "reinhard", "reinhard_extended", "exponential", "aces"};
  return kNames[static_cast<std::size_t>(info.param)];
}
INSTANTIATE_TEST_SUITE_P(ToneCurves, EveryCurve, testing::ValuesIn(kCurves), name_of);

TEST_P(EveryCurve, BeginsAtZeroAndEndsAtOne) {
  for (const ToneOn on : {ToneOn::luminance, ToneOn::channel}) {
    const ToneMapping tone{.curve = GetParam(), .on = on};
    EXPECT_EQ(shown(0.0f, tone), 0.0f);
    EXPECT_EQ(shown(-0.0f, tone), 0.0f);
    // The rounded sum 0.2126 + 0.7152 + 0.0722 may be an ulp below 1, and the quotient may lose another.
    EXPECT_NEAR(shown(detail::kInfinity, tone), 1.0f, on == ToneOn::luminance ? 2e-7f : 0.0f);
    EXPECT_NEAR(shown(3e38f, tone), 1.0f, on == ToneOn::luminance ? 2e-7f : 0.0f);
    for (const float bad : {detail::kNaN, -detail::kNaN, -1.0f, -1e-40f, -detail::kInfinity}) EXPECT_EQ(shown(bad, tone), 0.0f) << bad;
  }
}

TEST_P(EveryCurve, MatchesItsFormulaForEveryHalfAndIsMonotonic) {
  for (const float exposure : {1.0f, 0.01f, 50.0f}) {
    const ToneMapping tone{.exposure = exposure, .curve = GetParam(), .white = 4.0f};
    float last = 0.0f;
    for (uint32_t h = 0; h < 0x7c00; ++h) {  // non-negative finite halves
      const float x = half_to_float(static_cast<uint16_t>(h)), y = shown(x, tone);
      ASSERT_TRUE(y >= last && y <= 1.0f) << x;
      // About six roundings of 6e-8. In addition, 1 − e^(−x) inherits the error of the power near 1: 1.02 ulp (6e-8).
      const double want = truth(GetParam(), static_cast<double>(x) * static_cast<double>(exposure), 4.0);
      ASSERT_NEAR(static_cast<double>(y), want, 4e-7 * want + (GetParam() == ToneCurve::exponential && want > 0.06 ? 1e-7 : 1e-40)) << x;
      last = y;
    }
    for (uint32_t h = 0x8000; h < 0x10000; ++h) ASSERT_EQ(shown(half_to_float(static_cast<uint16_t>(h)), tone), 0.0f) << h;  // −0 to −NaN
    for (uint32_t h = 0x7c00; h < 0x8000; ++h)
      ASSERT_EQ(shown(half_to_float(static_cast<uint16_t>(h)), tone), h == 0x7c00 ? 1.0f : 0.0f) << h;
  }
}

TEST(ToneCurves, MatchHandComputedValues) {
  EXPECT_EQ(shown(1.0f, {.curve = ToneCurve::none}), 1.0f);
  EXPECT_EQ(shown(1.0f, {.curve = ToneCurve::reinhard}), 0.5f);
  EXPECT_EQ(shown(1.0f, {.curve = ToneCurve::reinhard_extended, .white = 2.0f}), 0.625f);
  EXPECT_EQ(shown(2.0f, {.curve = ToneCurve::reinhard_extended, .white = 2.0f}), 1.0f) << "white point";
  EXPECT_LT(shown(1.99f, {.curve = ToneCurve::reinhard_extended, .white = 2.0f}), 1.0f);
  EXPECT_FLOAT_EQ(shown(1.0f, {.curve = ToneCurve::exponential}), 0.63212056f);
  EXPECT_FLOAT_EQ(shown(0.5f, {.exposure = 2.0f, .curve = ToneCurve::exponential}), 0.63212056f);
  EXPECT_FLOAT_EQ(shown(1.0f, {.curve = ToneCurve::aces}), 2.54f / 3.16f);
  EXPECT_EQ(shown(20.0f, {.curve = ToneCurve::aces}), 1.0f) << "the peak of 1.033 is clamped";
}

TEST(ToneCurves, ZeroExposureIsBlack) {
  for (const ToneCurve curve : kCurves) {
    for (const float x : {0.0f, 1.0f, 65504.0f, detail::kInfinity, detail::kNaN})
      EXPECT_EQ(shown(x, {.exposure = 0.0f, .curve = curve}), 0.0f);
  }
}

TEST(ToneCurves, LuminanceModePreservesHue) {
  const ToneMapping tone{.curve = ToneCurve::reinhard, .on = ToneOn::luminance};
  const glm::vec3 light(2.0f, 1.0f, 0.5f);
  const glm::vec3 c = tone_map(SceneLight<float>{light}, tone).rgb;
  const float y = luminance(vec3<float>(light));
  for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(c[k], light[k] / (1 + y));
  EXPECT_FLOAT_EQ(luminance(vec3<float>(c)), y / (1 + y));
  // Channel mode maps each channel separately, which changes the hue.
  const glm::vec3 each = tone_map(SceneLight<float>{light}, {.curve = ToneCurve::reinhard}).rgb;
  for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(each[k], light[k] / (1 + light[k]));
}

TEST(ToneCurves, LuminanceModePreservesHueOfDarkColors) {
  // The factor is a quotient of two small numbers, so the curve must not suffer from cancellation.
  for (const ToneCurve curve : {ToneCurve::reinhard, ToneCurve::exponential}) {
    for (const float x : {1e-3f, 1e-6f, 1e-12f, 1e-30f}) {
      const float y = tone_map(SceneLight<float>{glm::vec3(x)}, {.curve = curve, .on = ToneOn::luminance}).rgb.x;
      EXPECT_NEAR(y / x, 1.0f, x + 1e-6f) << x;
    }
  }
}

TEST(DisplayEncoding, SrgbMatchesTheExactValuesExceptForTies) {
  int differ = 0;
  for (int i = 0; i <= 1 << 16; ++i) {
    const float x = static_cast<float>(i) * 0x1p-16f;
    const float e = encode_srgb(DisplayLight<float>{glm::vec3(x)}).rgb.x;
    ASSERT_TRUE(e >= 0.0f && e <= 1.0f);
    const auto code = static_cast<double>(linear_to_srgb(x));
    ASSERT_LE(std::abs(static_cast<double>(e) * 255 - code), 0.5 + 1e-4) << x;  // e has an error of about 3e-7
    differ += std::nearbyint(static_cast<double>(e) * 255) != code;
  }
  EXPECT_LE(differ, 8) << "differs for more inputs than the few of the 65536 that are within 1e-4 of one of the 255 ties";
}

TEST(DisplayEncoding, GammaMatchesPow) {
  for (const float gamma : {1.0f, 1.8f, 2.2f}) {
    for (int i = 0; i <= 1000; ++i) {
      const float x = static_cast<float>(i) / 1000.0f;
      EXPECT_NEAR(static_cast<double>(encode_gamma(DisplayLight<float>{glm::vec3(x)}, gamma).rgb.x),
                  std::pow(static_cast<double>(x), 1 / static_cast<double>(gamma)), 3e-7);
    }
  }
}

TEST(Dithering, EveryThresholdOccursOncePerBlock) {
  for (const int x0 : {0, 8, 1024}) {
    std::array<int, 64> seen{};
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) ++seen[static_cast<std::size_t>(dither_threshold<float>(x0 + x, y) * 64.0f)];
    }
    for (const int n : seen) EXPECT_EQ(n, 1);
  }
}

TEST(Dithering, BlockMeanIsWithin1Over128OfAnLsb) {
  double worst = 0;
  for (int i = 0; i <= 4000; ++i) {
    const float e = static_cast<float>(i) / 4000.0f;
    double sum = 0;
    for (int y = 0; y < 8; ++y) {
      for (int x = 0; x < 8; ++x) {
        const float code = dithered(Encoded<float>{glm::vec3(e)}, dither_threshold<float>(x, y)).rgb.x * 255.0f;
        ASSERT_LT(std::abs(code - e * 255.0f), 1.0f + 1e-4f);
        sum += static_cast<double>(linear_to_unorm8(code / 255.0f));
      }
    }
    worst = std::max(worst, std::abs(sum / 64 - static_cast<double>(e) * 255));
  }
  EXPECT_LE(worst, 1.0 / 128 + 1e-4);  // the product with 255 is rounded to 2^-17
  for (const float end : {0.0f, 1.0f}) EXPECT_FLOAT_EQ(dithered(Encoded<float>{glm::vec3(end)}, 63.5f / 64).rgb.x, end);
}

template <int W>
void expect_lanes_are_float() {
  using R = RealN<W>;
  for (const ToneCurve curve : kCurves) {
    for (const ToneOn on : {ToneOn::luminance, ToneOn::channel}) {
      const ToneMapping tone{.exposure = 1.5f, .curve = curve, .on = on, .white = 3.0f};
      for (uint32_t h = 0; h < 0x10000; h += 16) {
        vec3<R> light;
        IntOf<R> x(0);
        for (int k = 0; k < W; ++k) {
          const float v = half_to_float(static_cast<uint16_t>(h + static_cast<uint32_t>(k)));
          set_lane(light.x, k, v);
          set_lane(light.y, k, 0.5f * v);
          set_lane(light.z, k, 1.0f);
          set_lane(x, k, k);
        }
        const DisplayLight<R> display = tone_map(SceneLight<R>{light}, tone);
        const vec3<R> codes = dithered(encode_srgb(display), dither_threshold<R>(x, IntOf<R>(3))).rgb;
        for (int k = 0; k < W; ++k) {
          const DisplayLight<float> one = tone_map(SceneLight<float>{{lane(light.x, k), lane(light.y, k), 1.0f}}, tone);
          const glm::vec3 want = dithered(encode_srgb(one), dither_threshold<float>(k, 3)).rgb;
          for (int c = 0; c < 3; ++c) ASSERT_EQ(lane(codes[c], k), want[c]) << h;
        }
      }
    }
  }
}

TEST(ToneCurves, LanesMatchScalarBits) {
  expect_lanes_are_float<4>();
  expect_lanes_are_float<8>();
  expect_lanes_are_float<16>();
}

}  // namespace
}  // namespace halfspace
