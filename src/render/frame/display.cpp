// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/frame/display.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <numeric>
#include <vector>

#include "halfspace/core/half.h"
#include "halfspace/shading/values/tone.h"

namespace halfspace::HS_LANES {

namespace {

// Size of the squares that are summed separately. It does not depend on the tile size of a pass, which therefore does not affect the
// result.
constexpr int kMeterTile = 64;

glm::vec3 rgb_of(const glm::vec4& c) { return glm::vec3(c); }
glm::vec3 rgb_of(const U16Vec4& c) { return {half_to_float(c.x), half_to_float(c.y), half_to_float(c.z)}; }

// Returns the sum of log(kMinLuminance + luminance) over a square of the image. Logarithms are computed in SIMD lanes but added in
// pixel order, so the result is bit-identical for every SIMD width.
template <class Pixel>
double log_sum(const Image<Pixel>& light, int x0, int y0) {
  const int width = std::min(kMeterTile, light.width() - x0), y1 = std::min(y0 + kMeterTile, light.height());
  std::array<float, kMeterTile> values{};
  double sum = 0.0;
  for (int y = y0; y < y1; ++y) {
    const Pixel* pixels = light.row(y).data() + x0;
    for (int x = 0; x < width; ++x) values[static_cast<std::size_t>(x)] = luminance<float>(rgb_of(pixels[x]));
    for (float* v = values.data(); v < values.data() + kMeterTile; v += kLanes) {
      store(v, log(Real(kMinLuminance) + clamp(load<Real>(v), 0.0f, kMaxHalf)));
    }
    for (int x = 0; x < width; ++x) sum += static_cast<double>(values[static_cast<std::size_t>(x)]);
  }
  return sum;
}

template <class Pixel>
double log_average(const Image<Pixel>& light, const Workers& workers) {
  const auto tiles_along = [](int size) { return (size + kMeterTile - 1) / kMeterTile; };
  const int columns = tiles_along(light.width()), rows = tiles_along(light.height());
  std::vector<double> sums(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  workers.for_each(columns * rows, [&](int tile) {
    sums[static_cast<std::size_t>(tile)] = log_sum(light, tile % columns * kMeterTile, tile / columns * kMeterTile);
  });
  const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
  return static_cast<double>(exp(static_cast<float>(sum / (static_cast<double>(light.width()) * light.height()))));
}

// Converts to linear display light, for targets that encode sRGB exactly.
struct ToDisplayLight {
  ToneMapping tone;

  template <class R>
  vec4<R> operator()(const vec4<R>& color) const {
    return vec4<R>(tone_map(SceneLight<R>{vec3<R>(color)}, tone).rgb, color.w);
  }
};

// Converts to encoded values in [0, 1], for targets that store values unchanged.
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

// Converts premultiplied alpha to straight alpha.
template <Number R>
vec4<R> straight(const vec4<R>& color) {
  const MaskOf<R> is_seen = color.w > R(0);
  return select(is_seen, vec4<R>(vec3<R>(color) / select(is_seen, color.w, R(1)), color.w), vec4<R>(R(0)));
}

// Converts colors to straight alpha and applies `next`.
template <class F>
struct Straightened {
  F next;

  template <class R, class... Position>
  requires std::invocable<const F&, vec4<R>, Position...> vec4<R>
  operator()(const vec4<R>& color, Position... position) const { return next(straight(color), position...); }
};

// Converts the lit part of a pixel and adds its unlit part (see unlit_layer.h). `next` encodes the result, which is display light.
template <class F>
struct WithUnlit {
  ToneMapping tone;
  const Image<glm::vec4>* unlit;
  bool premultiplied;
  F next;

  template <class R>
  vec4<R> operator()(const vec4<R>& color, IntOf<R> x, IntOf<R> y) const {
    const vec4<R> u = unlit_at<R>(x, y);
    const R a = premultiplied ? color.w : R(1), rest = max(a - u.w, R(0));
    const MaskOf<R> is_lit = rest > R(0);
    const vec3<R> light = (vec3<R>(color) - vec3<R>(u)) / select(is_lit, rest, R(1));
    vec3<R> shown = tone_map(SceneLight<R>{light}, tone).rgb * rest;
    for (int k = 0; k < 3; ++k) shown[k] += min(u[k], u.w);
    const vec4<R> sum(shown, color.w);
    return finished(premultiplied ? straight(sum) : sum, x, y);
  }

 private:
  template <class R>
  vec4<R> unlit_at(IntOf<R> x, IntOf<R> y) const {
    const int width = unlit->width(), height = unlit->height();
    const float* first = &unlit->data()->x;
    const IntOf<R> column = min(x, IntOf<R>(width - 1)), row = max(IntOf<R>(height - 1) - y, IntOf<R>(0));  // packets can exceed the image
    const IntOf<R> at = (row * width + column) * 4;
    return {gather(first, at), gather(first, at + 1), gather(first, at + 2), gather(first, at + 3)};
  }

  template <class R>
  vec4<R> finished(const vec4<R>& color, IntOf<R> x, IntOf<R> y) const {
    if constexpr (std::invocable<const F&, vec4<R>, IntOf<R>, IntOf<R>>) {
      return next(color, x, y);
    } else {
      return next(color);
    }
  }
};

// Returns the light unchanged; it may exceed the displayable range.
struct ToLight {
  template <class R>
  vec4<R> operator()(const vec4<R>& color) const {
    return straight(color);
  }
};

// Adds a post step for colors with premultiplied or straight alpha. make(tone): returns a functor that applies the tone mapping and encodes
// the result.
template <class F>
void add_post(Pass& pass, const ToneMapping& tone, const F& make, const ColorTarget& target, Premultiplied premultiplied,
              const Image<glm::vec4>& unlit) {
  using Function = decltype(make(tone));
  if (!unlit.empty()) {
    pass.post(WithUnlit<Function>{tone, &unlit, premultiplied == Premultiplied::yes, make(ToneMapping{})}, target);
  } else if (premultiplied == Premultiplied::yes) {
    pass.post(Straightened<Function>{make(tone)}, target);
  } else {
    pass.post(make(tone), target);
  }
}

}  // namespace

ToneMapping tone_of(const PostDescription& post, double exposure) {
  // An exposure above 1e9 makes no visible difference. Infinity would turn black into NaN.
  return {static_cast<float>(std::min(exposure, 1e9)), post.tone, post.tone_on, static_cast<float>(post.white)};
}

double log_average_luminance(const Image<U16Vec4>& light, const Workers& workers) { return log_average(light, workers); }
double log_average_luminance(const Image<glm::vec4>& light, const Workers& workers) { return log_average(light, workers); }

void show(Pass& pass, const PostDescription& post, double exposure, Image<glm::u8vec4>& picture, Premultiplied premultiplied,
          const Image<glm::vec4>& unlit) {
  const ToneMapping tone = tone_of(post, exposure);
  if (post.encode == DisplayEncoding::srgb && !post.dither) {
    add_post(
        pass, tone, [](const ToneMapping& t) { return ToDisplayLight{t}; }, srgb8a8_target(picture), premultiplied, unlit);
  } else {
    const auto codes = [&](const ToneMapping& t) { return ToCodes{t, post.encode, static_cast<float>(post.gamma), post.dither}; };
    add_post(pass, tone, codes, rgba8_target(picture), premultiplied, unlit);
  }
}

void show_fine(Pass& pass, const PostDescription& post, double exposure, Image<glm::vec4>& encoded, Premultiplied premultiplied,
               const Image<glm::vec4>& unlit) {
  const auto codes = [&](const ToneMapping& t) { return ToCodes{t, post.encode, static_cast<float>(post.gamma), false}; };
  add_post(pass, tone_of(post, exposure), codes, rgba32f_target(encoded), premultiplied, unlit);
}

void show_light(Pass& pass, Image<glm::vec4>& light) { pass.post(ToLight{}, rgba32f_target(light)); }

}  // namespace halfspace::HS_LANES
