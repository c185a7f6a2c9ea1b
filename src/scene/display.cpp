// SPDX-License-Identifier: Apache-2.0
#include "scene/display.h"

#include <algorithm>
#include <vector>

#include "core/half.h"

namespace halfspace {

namespace {

glm::vec3 rgb_of(const glm::vec4& c) { return glm::vec3(c); }
glm::vec3 rgb_of(const U16Vec4& c) { return {half_to_float(c.x), half_to_float(c.y), half_to_float(c.z)}; }

template <class Pixel>
double log_average(const Image<Pixel>& light, const Workers& workers) {
  std::vector<double> rows(static_cast<std::size_t>(light.height()));
  workers.for_each(light.height(), [&](int row) {
    double sum = 0.0;
    for (const Pixel& pixel : light.row(row)) {
      const float held = clamp(luminance<float>(rgb_of(pixel)), 0.0f, kMaxHalf);
      sum += static_cast<double>(log(kLeastLuminance + held));
    }
    rows[static_cast<std::size_t>(row)] = sum;
  });
  double sum = 0.0;
  for (const double row : rows) sum += row;
  return static_cast<double>(exp(static_cast<float>(sum / (static_cast<double>(light.width()) * light.height()))));
}

ToneMapping tone_of(const PostDescription& post, double exposure) {
  // Beyond 1e9 nothing is left to be told apart, and an infinity would make NaN of black.
  return {static_cast<float>(std::min(exposure, 1e9)), post.tone, post.tone_on, static_cast<float>(post.white)};
}

// To light on the display, for a target that encodes it exactly.
struct ToDisplayLight {
  ToneMapping tone;

  template <class R>
  vec4<R> operator()(const vec4<R>& color) const {
    return vec4<R>(tone_map(SceneLight<R>{vec3<R>(color)}, tone).rgb, color.w);
  }
};

// To codes over 255, for a target that stores them as they are.
struct ToCodes {
  ToneMapping tone;
  DisplayEncoding encode;
  float gamma;
  bool dither;

  template <class R>
  vec4<R> operator()(const vec4<R>& color, IntOf<R> x, IntOf<R> y) const {
    const DisplayLight<R> light = tone_map(SceneLight<R>{vec3<R>(color)}, tone);
    Encoded<R> e = encode == DisplayEncoding::srgb ? encode_srgb(light) : encode_gamma(light, gamma);
    if (dither) e = dithered(e, dither_threshold<R>(x, y));
    return vec4<R>(e.rgb, color.w);
  }
};

}  // namespace

double log_average_luminance(const Image<U16Vec4>& light, const Workers& workers) { return log_average(light, workers); }
double log_average_luminance(const Image<glm::vec4>& light, const Workers& workers) { return log_average(light, workers); }

void show(Pass& pass, const PostDescription& post, double exposure, Image<glm::u8vec4>& picture) {
  const ToneMapping tone = tone_of(post, exposure);
  if (post.encode == DisplayEncoding::srgb && !post.dither) {
    pass.post(ToDisplayLight{tone}, srgb8a8_target(picture));
  } else {
    pass.post(ToCodes{tone, post.encode, static_cast<float>(post.gamma), post.dither}, rgba8_target(picture));
  }
}

}  // namespace halfspace
