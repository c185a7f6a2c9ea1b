// SPDX-License-Identifier: Apache-2.0
//
// Image differences whose values are known in closed form.
#include "halfspace/image/image_difference.h"

#include <gtest/gtest.h>

#include <cmath>

namespace halfspace {
namespace {

template <class Texel>
Image<Texel> filled(int width, int height, const Texel& texel) {
  Image<Texel> image(width, height);
  std::fill_n(image.data(), image.texels().size(), texel);
  return image;
}

Image<glm::u8vec4> gray(int width, int height, uint8_t code) { return filled(width, height, glm::u8vec4(code, code, code, 255)); }

TEST(ImageDifference, IsZeroForIdenticalImages) {
  const Image<glm::u8vec4> image = gray(7, 5, 93);
  const ImageDifference d = compare_images(image, image);
  EXPECT_EQ(d.differing, 0);
  EXPECT_EQ(d.rmse, 0.0);
  EXPECT_TRUE(std::isinf(d.psnr_db));
  EXPECT_EQ(d.max, 0.0);
  EXPECT_EQ(d.p999, 0.0);
  EXPECT_EQ(d.share_above, 0.0);
  EXPECT_NEAR(d.ssim, 1.0, 1e-12);  // a ratio of equal numbers, summed 35 times
  EXPECT_EQ(d.channels, 3);
}

// Two uniform gray images. With zero variance, SSIM is (2ab + C1)/(a² + b² + C1).
TEST(ImageDifference, MatchesClosedFormForUniformGrays) {
  const struct { uint8_t a, b; } cases[] = {{0, 255}, {100, 101}, {100, 102}, {10, 200}, {255, 254}};
  for (const auto& c : cases) {
    const ImageDifference d = compare_images(gray(16, 12, c.a), gray(16, 12, c.b));
    const double a = c.a / 255.0, b = c.b / 255.0, e = std::abs(a - b), c1 = 1e-4;
    // The sum has 576 terms, each rounded to within 2^-53, so the error is at most 6e-14.
    EXPECT_NEAR(d.rmse, e, 1e-13);
    EXPECT_NEAR(d.mean, e, 1e-13);
    EXPECT_NEAR(d.psnr_db, -20.0 * std::log10(e), 2e-12);
    EXPECT_NEAR(d.max, e, 1e-15);
    EXPECT_NEAR(d.p999, e, 1e-15);
    EXPECT_EQ(d.share_above, std::abs(c.a - c.b) > 1 ? 1.0 : 0.0) << "a difference of exactly 1/255 does not count";
    EXPECT_NEAR(d.ssim, (2 * a * b + c1) / (a * a + b * b + c1), 1e-9);  // the variances cancel to about 1e-16, divided by C2 = 9e-4
  }
}

// First, one pixel of 2,000 (0.05%) differs in one channel, which the 99.9th percentile ignores. With three differing pixels (0.15%), the
// percentile is nonzero.
TEST(ImageDifference, ReportsFewDifferingPixels) {
  Image<glm::u8vec4> a = gray(50, 40, 50), b = a;
  b.at(3, 4).y = 101;
  const double e = 51.0 / 255.0;
  ImageDifference d = compare_images(a, b);
  EXPECT_NEAR(d.rmse, e / std::sqrt(3.0 * 2000.0), 1e-15);
  EXPECT_NEAR(d.mean, e / (3.0 * 2000.0), 1e-15);
  EXPECT_EQ(d.max, e);
  EXPECT_EQ(d.p999, 0.0);
  EXPECT_EQ(d.differing, 1);
  EXPECT_EQ(d.share_above, 1.0 / 2000.0);
  EXPECT_LT(d.ssim, 1.0);
  for (const int x : {10, 20}) b.at(x, 30).x = 60;  // 3 of 2,000: more than 0.1 %
  d = compare_images(a, b);
  EXPECT_EQ(d.differing, 3);
  EXPECT_EQ(d.p999, 10.0 / 255.0);
  EXPECT_EQ(d.max, e);
}

TEST(ImageDifference, IncludesAlphaUnlessBothImagesAreOpaque) {
  Image<glm::u8vec4> a = gray(10, 10, 80), b = a;
  b.at(0, 0).w = 155;
  const ImageDifference d = compare_images(a, b);
  EXPECT_EQ(d.channels, 4);
  EXPECT_EQ(d.max, 100.0 / 255.0);
  EXPECT_NEAR(d.rmse, 100.0 / 255.0 / 20.0, 1e-15);
}

TEST(ImageDifference, AcceptsLinearValuesAboveOne) {
  const auto light = [](float x) { return filled(20, 20, glm::vec4(x, x, x, 1.0f)); };
  const ImageDifference d = compare_images(light(4.0f), light(1.5f));
  EXPECT_EQ(d.max, 2.5);
  EXPECT_NEAR(d.psnr_db, -20.0 * std::log10(2.5), 1e-12);
  EXPECT_NEAR(d.ssim, 1.0, 1e-9) << "both display as white";
}

// A checkerboard compared with its inverse. The luma covariance is minus the variance v, so the last factor of SSIM is (C2 − 2v)/(C2 + 2v).
TEST(ImageDifference, SsimIsNegativeForInvertedStructure) {
  Image<glm::u8vec4> a(64, 64), b(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const auto code = static_cast<uint8_t>((x + y) % 2 == 0 ? 110 : 140);
      a.at(x, y) = {code, code, code, 255};
      b.at(x, y) = glm::u8vec4(glm::u8vec3(static_cast<uint8_t>(250 - code)), 255);
    }
  }
  const double v = 15.0 / 255.0 * 15.0 / 255.0, c2 = 9e-4;
  // Within a window, the mean of a checkerboard is uniform to about 1e-3 of its amplitude; near the border the deviation is larger.
  EXPECT_NEAR(compare_images(a, b).ssim, (c2 - 2 * v) / (c2 + 2 * v), 0.01);
}

TEST(ImageDifference, ColorsGetBrighterWithTheDifference) {
  Image<float> e(6, 1);
  const float steps[] = {0.0f, 0.5f / 255, 1.0f / 255, 16.0f / 255, 0.5f, 1.0f};
  for (int x = 0; x < 6; ++x) e.at(x, 0) = steps[x];
  const Image<glm::u8vec4> colors = difference_colors(e);
  EXPECT_EQ(colors.at(0, 0), glm::u8vec4(0, 0, 0, 255));
  EXPECT_EQ(colors.at(5, 0), glm::u8vec4(255, 255, 255, 255));
  for (int x = 1; x < 6; ++x) {
    const auto sum = [&](int i) { return int{colors.at(i, 0).x} + colors.at(i, 0).y + colors.at(i, 0).z; };
    EXPECT_GT(sum(x), sum(x - 1)) << x;
  }
  Image<float> beyond(1, 1);
  beyond.at(0, 0) = 1e9f;
  EXPECT_EQ(difference_colors(beyond).at(0, 0), glm::u8vec4(255, 255, 255, 255));
}

}  // namespace
}  // namespace halfspace
