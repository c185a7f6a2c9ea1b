// SPDX-License-Identifier: Apache-2.0
#include "explain/stage_tone.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "halfspace/core/half.h"
#include "halfspace/render/frame/display.h"

namespace halfspace {

namespace {

double metered(const Image<glm::vec4>& light, LightFormat format, const Workers& workers) {
  if (format != LightFormat::rgba16f) return log_average_luminance(light, workers);
  Image<U16Vec4> half(light.width(), light.height());
  std::ranges::transform(light.texels(), half.data(), [](const glm::vec4& c) {
    return U16Vec4{float_to_half(c.x), float_to_half(c.y), float_to_half(c.z), float_to_half(c.w)};
  });
  return log_average_luminance(half, workers);
}

void count(StageTone& out, const Image<glm::vec4>& light) {
  out.histogram.assign(static_cast<std::size_t>((kHighStop - kLowStop) * kBinsPerStop), 0);
  const float low = std::ldexp(1.0f, kLowStop), high = std::ldexp(1.0f, kHighStop);
  for (const glm::vec4& c : light.texels()) {
    const float y = luminance<float>(vec3<float>(glm::vec3(c)));
    if (!(y >= low)) {
      ++out.dark;
    } else if (y >= high) {
      ++out.bright;
    } else {
      ++out.histogram[(std::bit_cast<uint32_t>(y) - std::bit_cast<uint32_t>(low)) >> 20];
    }
  }
}

glm::vec3 displayed(const ToneMapping& tone, const glm::vec3& light) {
  const DisplayLight<float> d = tone_map(SceneLight<float>{vec3<float>(light)}, tone);
  return {d.rgb.x, d.rgb.y, d.rgb.z};
}

}  // namespace

StageTone stage_tone(const PreparedScene& scene, const Image<glm::vec4>& light, const Workers& workers) {
  const PostDescription& post = scene.post;
  StageTone out;
  out.hdr = post.hdr;
  out.tone = {1.0f, ToneCurve::none, ToneOn::channel, 1.0f};
  if (post.hdr) {
    double exposure = post.exposure;
    if (post.auto_exposure) {
      out.log_average = metered(light, post.format, workers);
      exposure = post.exposure * post.key_value / out.log_average;
    }
    out.tone = {static_cast<float>(std::min(exposure, 1e9)), post.tone, post.tone_on, static_cast<float>(post.white)};
  }
  count(out, light);
  for (int i = kLowStop * 2; i <= kHighStop * 2; ++i) {  // two points per stop
    const float x = std::ldexp(i % 2 == 0 ? 1.0f : 1.5f, i >> 1);
    out.curve.push_back({x, displayed(out.tone, glm::vec3(x)).x});
  }
  return out;
}

ToneSteps tone_steps(const PreparedScene& scene, const ToneMapping& tone, const glm::vec3& light) {
  ToneSteps s{light, light * tone.exposure, displayed(tone, light), {}, {}};
  const DisplayLight<float> display{vec3<float>(s.display)};
  const bool gamma = scene.post.hdr && scene.post.encode == DisplayEncoding::gamma;
  const Encoded<float> e = gamma ? encode_gamma(display, static_cast<float>(scene.post.gamma)) : encode_srgb(display);
  s.encoded = {e.rgb.x, e.rgb.y, e.rgb.z};
  s.code = glm::ivec3(s.encoded * 255.0f + 0.5f);
  return s;
}

}  // namespace halfspace
