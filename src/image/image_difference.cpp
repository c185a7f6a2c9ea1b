// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/image_difference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <vector>

#include "halfspace/core/float_mode.h"
#include "halfspace/core/lane_math.h"
#include "halfspace/core/srgb_curve.h"

namespace halfspace::HS_LANES {

namespace {

double difference(uint8_t a, uint8_t b) { return std::abs(int{a} - int{b}) / 255.0; }
double difference(float a, float b) { return std::abs(static_cast<double>(a) - static_cast<double>(b)); }

bool is_opaque(const Image<glm::u8vec4>& image) {
  return std::ranges::all_of(image.texels(), [](const glm::u8vec4& c) { return c.w == 255; });
}
bool is_opaque(const Image<glm::vec4>& image) {
  return std::ranges::all_of(image.texels(), [](const glm::vec4& c) { return c.w == 1.0f; });
}

// Rec. 709 luma: the weighted sum of the encoded channels, in [0, 1].
double luma(const glm::u8vec4& c) { return (0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z) / 255.0; }
double luma(const glm::vec4& c) {
  const auto encoded = [](float x) { return static_cast<double>(srgb_curve(glm::clamp(x, 0.0f, 1.0f))); };
  return 0.2126 * encoded(c.x) + 0.7152 * encoded(c.y) + 0.0722 * encoded(c.z);
}

// ---- structural similarity ----------------------------------------------------------------------------------------------

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;

std::array<double, 2 * kRadius + 1> gaussian() {
  std::array<double, 2 * kRadius + 1> weights{};
  for (int i = -kRadius; i <= kRadius; ++i) weights[static_cast<std::size_t>(i + kRadius)] = exp(-i * i / (2.0 * kSigma * kSigma));
  return weights;
}

// Computes Gaussian-weighted means along one axis, for `count` numbers that are `step` apart.
void blur_line(const double* from, double* to, int count, std::size_t step) {
  static const std::array<double, 2 * kRadius + 1> kWeights = gaussian();
  for (int i = 0; i < count; ++i) {
    double sum = 0.0, weight = 0.0;
    for (int k = std::max(i - kRadius, 0); k <= std::min(i + kRadius, count - 1); ++k) {
      const double w = kWeights[static_cast<std::size_t>(k - i + kRadius)];
      sum += w * from[static_cast<std::size_t>(k) * step];
      weight += w;
    }
    to[static_cast<std::size_t>(i) * step] = sum / weight;
  }
}

Image<double> blurred(const Image<double>& image) {
  Image<double> rows(image.width(), image.height()), both(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) blur_line(image.row(y).data(), rows.row(y).data(), image.width(), 1);
  const auto width = static_cast<std::size_t>(image.width());
  for (int x = 0; x < image.width(); ++x) blur_line(rows.data() + x, both.data() + x, image.height(), width);
  return both;
}

Image<double> product(const Image<double>& a, const Image<double>& b) {
  Image<double> out(a.width(), a.height());
  for (std::size_t i = 0; i < a.texels().size(); ++i) out.data()[i] = a.data()[i] * b.data()[i];
  return out;
}

template <class Texel>
Image<double> luma_of(const Image<Texel>& image) {
  Image<double> out(image.width(), image.height());
  std::ranges::transform(image.texels(), out.data(), [](const Texel& c) { return luma(c); });
  return out;
}

// Mean over all pixels (equation 17 of the paper) of the SSIM index (equation 13).
double mean_ssim(const Image<double>& a, const Image<double>& b) {
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  const Image<double> mean_a = blurred(a), mean_b = blurred(b), aa = blurred(product(a, a)), bb = blurred(product(b, b)),
                      ab = blurred(product(a, b));
  double sum = 0.0;
  for (std::size_t i = 0; i < a.texels().size(); ++i) {
    const double ma = mean_a.data()[i], mb = mean_b.data()[i];
    const double variance_a = aa.data()[i] - ma * ma, variance_b = bb.data()[i] - mb * mb, covariance = ab.data()[i] - ma * mb;
    sum += (2.0 * ma * mb + c1) * (2.0 * covariance + c2) / ((ma * ma + mb * mb + c1) * (variance_a + variance_b + c2));
  }
  return sum / static_cast<double>(a.texels().size());
}

// ---- all metrics --------------------------------------------------------------------------------------------------------

template <class Texel>
int compared_channels(const Image<Texel>& a, const Image<Texel>& b) {
  HS_CHECK(a.width() == b.width() && a.height() == b.height(), "compare_images: the images have different sizes; expected the same size");
  return is_opaque(a) && is_opaque(b) ? 3 : 4;
}

template <class Texel>
ImageDifference compare(const Image<Texel>& a, const Image<Texel>& b) {
  const FloatMode float_mode;
  HS_CHECK(!a.empty(), "compare_images: the images are empty; expected at least one pixel");
  ImageDifference d;
  d.channels = compared_channels(a, b);
  std::vector<double> largest;
  largest.reserve(a.texels().size());
  double squares = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < a.texels().size(); ++i) {
    largest.push_back(0.0);
    for (int k = 0; k < d.channels; ++k) {
      const double e = difference(a.data()[i][k], b.data()[i][k]);
      squares += e * e;
      sum += e;
      largest.back() = std::max(largest.back(), e);
    }
  }
  const auto count = static_cast<double>(largest.size());
  d.mean = sum / (count * d.channels);
  d.rmse = std::sqrt(squares / (count * d.channels));
  d.psnr_db = d.rmse > 0.0 ? -20.0 / std::numbers::ln10 * log(d.rmse) : std::numeric_limits<double>::infinity();
  d.share_above = static_cast<double>(std::ranges::count_if(largest, [](double e) { return e > 1.0 / 255.0; })) / count;
  d.differing = std::ranges::count_if(largest, [](double e) { return e > 0.0; });
  d.max = std::ranges::max(largest);
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.999 * count)) - 1;
  std::ranges::nth_element(largest, largest.begin() + rank);
  d.p999 = largest[static_cast<std::size_t>(rank)];
  d.ssim = mean_ssim(luma_of(a), luma_of(b));
  return d;
}

template <class Texel>
Image<float> map_of(const Image<Texel>& a, const Image<Texel>& b) {
  const FloatMode float_mode;
  const int channels = compared_channels(a, b);
  Image<float> out(a.width(), a.height());
  for (std::size_t i = 0; i < a.texels().size(); ++i)
    for (int k = 0; k < channels; ++k)
      out.data()[i] = std::max(out.data()[i], static_cast<float>(difference(a.data()[i][k], b.data()[i][k])));
  return out;
}

glm::u8vec4 heat(float e) {
  constexpr std::array<glm::vec3, 5> kRamp = {glm::vec3(0, 0, 0), {0.1f, 0.1f, 0.9f}, {0.9f, 0.1f, 0.2f}, {1, 0.9f, 0.2f}, {1, 1, 1}};
  // The first of the four segments of the ramp ends at 1/255. The other three cover 1/255 to 1 on a logarithmic scale.
  const float codes = e * 255.0f, x = codes <= 1.0f ? codes : std::min(1.0f + 3.0f * log2(codes) / log2(255.0f), 4.0f);
  const auto i = std::min(static_cast<std::size_t>(x), kRamp.size() - 2);
  const glm::vec3 c = glm::mix(kRamp[i], kRamp[i + 1], x - static_cast<float>(i));
  return {glm::u8vec3(c * 255.0f + 0.5f), 255};
}

}  // namespace

ImageDifference compare_images(const Image<glm::u8vec4>& a, const Image<glm::u8vec4>& b) { return compare(a, b); }
ImageDifference compare_images(const Image<glm::vec4>& a, const Image<glm::vec4>& b) { return compare(a, b); }
Image<float> difference_map(const Image<glm::u8vec4>& a, const Image<glm::u8vec4>& b) { return map_of(a, b); }
Image<float> difference_map(const Image<glm::vec4>& a, const Image<glm::vec4>& b) { return map_of(a, b); }

Image<glm::u8vec4> difference_colors(const Image<float>& differences) {
  const FloatMode float_mode;
  Image<glm::u8vec4> out(differences.width(), differences.height());
  std::ranges::transform(differences.texels(), out.data(), heat);
  return out;
}

}  // namespace halfspace::HS_LANES
