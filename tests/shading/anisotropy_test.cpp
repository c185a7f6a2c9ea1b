// SPDX-License-Identifier: Apache-2.0
//
// Tests anisotropic lookups. Compares the footprint with its ellipse axes in double, the mip level with the expected one, and the result
// with the average of the texture over the pixel's footprint, a parallelogram.
#include <gtest/gtest.h>

#include <numbers>

#include "shading/texture_reference.h"
#include "support/constants.h"

namespace halfspace {
namespace {

/// A footprint defined by its axes in texels: J = rotation(angle)·diag(longer, shorter)·rotation(inner).
struct Ellipse {
  double longer, shorter, angle, inner;

  glm::dvec2 direction() const { return {std::cos(angle), std::sin(angle)}; }
  glm::dvec2 column(double inner_x, double inner_y) const {
    const glm::dvec2 across(-std::sin(angle), std::cos(angle));
    return direction() * (longer * inner_x) + across * (shorter * inner_y);
  }
  glm::dvec2 dx() const { return column(std::cos(inner), std::sin(inner)); }
  glm::dvec2 dy() const { return column(-std::sin(inner), std::cos(inner)); }
};

Ellipse random_ellipse(std::mt19937& random, double max_ratio, double min_short, double max_short) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double shorter = min_short * std::pow(max_short / min_short, unit(random));
  return {shorter * std::pow(max_ratio, unit(random)), shorter, 2 * std::numbers::pi * unit(random), 2 * std::numbers::pi * unit(random)};
}

// ---- the footprint ------------------------------------------------------------------------------------------------------

TEST(Footprint, MatchesTheAxes) {
  std::mt19937 random(1);
  const glm::dvec2 size(640, 480);
  for (int i = 0; i < 200000; ++i) {
    const Ellipse e = random_ellipse(random, 40.0, 0.1, 100.0);
    const int max_probes = 1 + static_cast<int>(random() % 16);
    const Footprint<float> got = footprint(640, 480, vec2<float>(e.dx() / size), vec2<float>(e.dy() / size), max_probes);
    const double shorter = std::max(e.shorter, 1.0), ratio = e.longer / shorter;
    // The implementation rounds the ratio up once it exceeds an integer by 1/1024; the ratio itself has a rounding error of about 1e-6.
    const double low = std::clamp(std::ceil(ratio * (1 - 0x1p-9)), 1.0, static_cast<double>(max_probes));
    const double high = std::clamp(std::ceil(ratio), 1.0, static_cast<double>(max_probes));
    ASSERT_GE(got.probes, low) << ratio;
    ASSERT_LE(got.probes, high) << ratio;
    const double probe = std::max(shorter, e.longer / std::min(std::ceil(ratio), static_cast<double>(max_probes)));
    ASSERT_NEAR(static_cast<double>(got.lod), std::log2(std::max(probe, 1.0)), 1.0 / 256) << e.longer << ' ' << e.shorter;
    const double exact = std::max(shorter, e.longer / got.probes);
    ASSERT_NEAR(static_cast<double>(got.lod), std::log2(std::max(exact, 1.0)), 2e-5) << e.longer << ' ' << e.shorter;
    // The span is parallel to the longer axis; its length is the part of the axis that one probe does not cover. For a near-circle, the
    // direction is arbitrary and the span is short.
    const glm::dvec2 span = glm::dvec2(got.span) * size, want = e.direction() * (got.probes > 1 ? e.longer - exact : 0.0);
    ASSERT_LE(std::min(glm::length(span - want), glm::length(span + want)), 1e-4 * e.longer) << e.longer << ' ' << e.shorter;
  }
}

TEST(Footprint, CirclesUseOneProbeAtTheIsotropicLevel) {
  std::mt19937 random(2);
  for (int i = 0; i < 10000; ++i) {
    const Ellipse e = random_ellipse(random, 1.0, 0.1, 1000.0);
    const vec2<float> dx(e.dx() / 256.0), dy(e.dy() / 256.0);
    const Footprint<float> got = footprint(256, 256, dx, dy, 16);
    ASSERT_EQ(got.probes, 1);
    ASSERT_EQ(got.span, vec2<float>(0.0f));
    ASSERT_NEAR(got.lod, std::max(level_of_detail(256, 256, dx, dy), 0.0f), 1e-5f);
  }
}

TEST(Footprint, ExtremeDerivativesUseOneProbe) {
  for (const float wild : {kNaN, kInf, -kInf, 3e38f, 1e12f}) {
    const Footprint<float> got = footprint(64, 64, vec2<float>(wild, 0.1f), vec2<float>(0.0f, 0.01f), 16);
    EXPECT_EQ(got.probes, 1) << wild;
    EXPECT_EQ(got.span, vec2<float>(0.0f)) << wild;
    EXPECT_EQ(got.lod, level_of_detail(64, 64, vec2<float>(wild, 0.1f), vec2<float>(0.0f, 0.01f))) << wild;
  }
  EXPECT_EQ(footprint(64, 64, vec2<float>(0.0f), vec2<float>(0.0f), 16).probes, 1);
  EXPECT_EQ(footprint(64, 64, vec2<float>(0.0f), vec2<float>(0.0f), 16).lod, 0.0f);
  EXPECT_EQ(footprint(64, 64, vec2<float>(0.5f, 0.0f), vec2<float>(0.5f, 0.0f), 16).probes, 16);  // zero area
}

// ---- levels -------------------------------------------------------------------------------------------------------------

TEST(Anisotropy, ReadsTheLevelThatMatchesTheProbeSize) {
  std::vector<Image<glm::u8vec4>> levels;  // level l has the constant value 16·l
  for (int size = 256, l = 0; size >= 1; size /= 2, ++l) {
    levels.emplace_back(size, size);
    std::fill_n(levels.back().data(), size * size, glm::u8vec4(static_cast<uint8_t>(16 * l)));
  }
  const Texture2D ruler(levels, TexelFormat::rgba8);
  std::mt19937 random(3);
  for (int i = 0; i < 20000; ++i) {
    const Ellipse e = random_ellipse(random, 40.0, 0.3, 100.0);
    const Sampler sampler{.anisotropy = 1 + static_cast<int>(random() % 16)};
    const vec2<float> dx(e.dx() / 256.0), dy(e.dy() / 256.0);
    double longest = e.longer, level = std::log2(std::max(glm::length(e.dx()), glm::length(e.dy())));  // for anisotropy 1
    if (sampler.anisotropy > 1) {
      const double shorter = std::max(e.shorter, 1.0);
      level = std::log2(std::max(shorter, longest / std::min(std::ceil(longest / shorter), static_cast<double>(sampler.anisotropy))));
    }
    const double got = static_cast<double>(ruler.sample(sampler, vec2<float>(0.3f, 0.7f), dx, dy).x) * 255.0 / 16.0;
    ASSERT_NEAR(got, std::clamp(level, 0.0, 8.0), 1.0 / 256.0) << e.longer << ' ' << e.shorter;
  }
}

// ---- the average over the pixel -------------------------------------------------------------------------------------------

/// Returns the average of the texture over the pixel's footprint, a parallelogram, from 64 x 64 bilinear samples of level 0 in double.
glm::dvec4 average(const Texture2D& texture, const Sampler& sampler, const glm::dvec2& uv, const glm::dvec2& dx, const glm::dvec2& dy) {
  constexpr int kSide = 64;
  glm::dvec4 sum(0.0);
  for (int i = 0; i < kSide * kSide; ++i) {
    const glm::dvec2 at = uv + dx * ((i % kSide + 0.5) / kSide - 0.5) + dy * ((i / kSide + 0.5) / kSide - 0.5);
    sum += texture.sample_level(sampler, vec2<double>(at.x, at.y), 0.0);
  }
  return sum / static_cast<double>(kSide * kSide);
}

TEST(Anisotropy, FilteredWaveMatchesItsAverage) {
  // Filtering a wave cos(k·x + φ) with an even kernel of mass 1 and covariance V multiplies it by 1 − kᵀVk/2 + O(k⁴). To leading order, two
  // kernels therefore differ by |kᵀ(V1 − V2)k|/2. The covariances, in texels, with w the size of a probe:
  // - parallelogram of bilinear texels (a tent, 1/6): J·Jᵀ/12 + 1/6
  // - N probes spaced (longer − w)/(N − 1) along the longer axis: at most (longer² − w²)/12 + w²/6, and at least the same with longer = N·w
  // - one probe, which is a box and a tent of 2^λ: w²/12 + w²/6; between two levels up to 9/8 of that
  // Along each axis, V1 − V2 is between −1/6 and w²·(0.28 + 1/6), so the error is at most |k|²·w²·0.45/2. For |k|·longer <= 1, the
  // fourth-order terms are below a tenth of that, and float rounding is below 1e-4.
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr int kSide = 512;
  double worst = 0.0, worst_isotropic = 0.0;
  for (int trial = 0; trial < 12; ++trial) {
    const glm::dvec2 cycles{static_cast<int>(random() % 7) - 3, static_cast<int>(random() % 7) - 3};  // braces fix the order
    const glm::dvec2 k = cycles * (2 * std::numbers::pi / kSide);
    Image<glm::vec4> image(kSide, kSide);
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) image.at(x, y) = glm::vec4(static_cast<float>(std::cos(glm::dot(k, glm::dvec2(x + 0.5, y + 0.5)))));
    }
    const Texture2D texture(image, TexelFormat::rgba32f);
    for (int i = 0; i < 60; ++i) {
      const Ellipse e = random_ellipse(random, 16.0, 0.4, 8.0);
      if (glm::length(k) * e.longer > 1.0) continue;
      const glm::dvec2 uv{unit(random), unit(random)}, dx = e.dx() / static_cast<double>(kSide), dy = e.dy() / static_cast<double>(kSide);
      const double want = average(texture, Sampler(), uv, dx, dy).x;
      const auto error = [&](int anisotropy) {
        const Sampler sampler{.anisotropy = anisotropy};
        return std::fabs(static_cast<double>(texture.sample(sampler, vec2<float>(uv), vec2<float>(dx), vec2<float>(dy)).x) - want);
      };
      const double w = std::max(e.shorter, 1.0), bound = 1.1 * 0.5 * 0.45 * glm::dot(k, k) * w * w + 1e-4;
      ASSERT_LE(error(16), bound) << e.longer << ' ' << e.shorter << " at " << e.angle;
      worst = std::max(worst, error(16));
      worst_isotropic = std::max(worst_isotropic, error(1));
    }
  }
  EXPECT_LT(worst, 0.012);  // measured: 0.0108
  EXPECT_GT(worst_isotropic, 0.1);
}

TEST(Anisotropy, MoreProbesApproachTheAverageOfNoise) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Texture2D texture = test::make_noise(128, 128, TexelFormat::r8, 6);
  double squares[17] = {};
  constexpr int kCount = 1500;
  for (int i = 0; i < kCount; ++i) {
    Ellipse e = random_ellipse(random, 1.0, 0.8, 3.0);
    e.longer = e.shorter * (4.0 + 12.0 * unit(random));
    const glm::dvec2 uv{unit(random), unit(random)}, dx = e.dx() / 128.0, dy = e.dy() / 128.0;
    const double want = average(texture, Sampler(), uv, dx, dy).x;
    for (const int anisotropy : {1, 2, 4, 8, 16}) {
      const Sampler sampler{.anisotropy = anisotropy};
      const double got = static_cast<double>(texture.sample(sampler, vec2<float>(uv), vec2<float>(dx), vec2<float>(dy)).x);
      squares[anisotropy] += (got - want) * (got - want);
    }
  }
  // The measured RMS errors are 0.049 for isotropic filtering, 0.043 for 2 probes, then 0.032, 0.021 and, for 16 probes, 0.017. The
  // remaining error comes from the trilinear probe, which is wider than its box. For a single footprint in noise, only the contrast bounds
  // the error.
  for (int anisotropy = 2; anisotropy <= 16; anisotropy *= 2) EXPECT_LT(squares[anisotropy], squares[anisotropy / 2]);
  EXPECT_LT(std::sqrt(squares[16] / kCount), 0.018);
  EXPECT_GT(std::sqrt(squares[1] / kCount), 0.045);
}

TEST(Anisotropy, MoreThanTheMaximumIsTheMaximum) {
  const Texture2D texture = test::make_noise(128, 128, TexelFormat::r8, 6);
  const vec2<float> uv(0.4f, 0.1f), along(0.5f, 0.0f), across(0.0f, 1.0f / 128.0f);  // an axis ratio of 64
  const auto sample = [&](int anisotropy) { return texture.sample(Sampler{.anisotropy = anisotropy}, uv, along, across).x; };
  EXPECT_NE(sample(kMaxAnisotropy), sample(kMaxAnisotropy / 2));
  EXPECT_EQ(sample(kMaxAnisotropy + 1), sample(kMaxAnisotropy));
  EXPECT_EQ(sample(1000), sample(kMaxAnisotropy));
}

TEST(Anisotropy, PreservesALineThatIsotropicFilteringBlurs) {
  // Pairs of black and white rows alternate. The footprint follows a white pair and is 16 texels long and one texel high.
  const Texture2D texture = test::make_texture(64, 64, TexelFormat::r8, [](int, int y) { return y / 2 % 2 == 0 ? 0u : 255u; });
  const vec2<float> uv(0.4f, 7.0f / 64.0f), along(16.0f / 64.0f, 0.0f), across(0.0f, 1.0f / 64.0f);
  EXPECT_NEAR(texture.sample(Sampler{.anisotropy = 1}, uv, along, across).x, 0.5f, 0.6f / 255.0f);  // level 4
  EXPECT_EQ(texture.sample(Sampler{.anisotropy = 16}, uv, along, across).x, 1.0f);                  // level 0
}

TEST(Anisotropy, IsContinuousNearACircularFootprint) {
  const Texture2D texture = test::make_noise(64, 64, TexelFormat::rgba8, 7);
  const Sampler sampler{.anisotropy = 16};
  const vec2<float> uv(0.37f, 0.21f), across(0.0f, 4.0f / 64.0f);
  const vec4<float> circle = texture.sample(sampler, uv, vec2<float>(4.0f / 64.0f, 0.0f), across);
  for (float ratio = 1.0f; ratio < 1.01f; ratio += 1e-4f) {
    const vec4<float> c = texture.sample(sampler, uv, vec2<float>(ratio * 4.0f / 64.0f, 0.0f), across);
    // Up to a ratio of 1 + 1/1024, the mip level of the single probe rises by 0.0014. Beyond that, two probes separate by (ratio − 1) times
    // their size. The result can change by at most this fraction of the contrast between level 2 and the adjacent level, which is below 1/2
    // here.
    for (int k = 0; k < 4; ++k) ASSERT_NEAR(c[k], circle[k], 0.0015f * 0.5f + (ratio - 1.0f) * 0.5f);
  }
}

}  // namespace
}  // namespace halfspace
