// SPDX-License-Identifier: Apache-2.0
//
// Numbers that plain formulas cannot take: no length, no light, too much of it, huge exponents; and the same bits at every width.
#include <immintrin.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "halfspace/core/lane_math.h"
#include "halfspace/core/srgb.h"
#include "halfspace/shading/lighting.h"
#include "halfspace/shading/surface_detail.h"
#include "halfspace/shading/tone.h"
#include "stability/judge.h"
#include "stability/lane_hash.h"
#include "support/constants.h"
#include "support/program.h"

namespace halfspace::stability {
namespace {

// ---- normal maps --------------------------------------------------------------------------------------------------------

TEST(Stability, NormalMapsWithoutFrames) {
  Image<glm::u8vec4> codes(3, 1);
  codes.at(0, 0) = {128, 128, 255, 255};
  codes.at(1, 0) = {0, 0, 0, 255};        // no normal at all
  codes.at(2, 0) = {255, 128, 128, 255};  // along the tangent
  const Texture2D map(codes, TexelFormat::rgba8);
  const DetailMap detail{.map = &map, .sampler = {.mag = Filter::nearest, .min = Filter::nearest}};
  const glm::vec3 vectors[] = {{0, 0, 0}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {1e-30f, 0, 0}, {0, 1e-25f, 0}};
  int plain = 0, ours = 0;
  for (const glm::vec3& n : vectors) {
    for (const glm::vec3& tangent : vectors) {
      for (int texel = 0; texel < 3; ++texel) {
        const vec2<float> uv((static_cast<float>(texel) + 0.5f) / 3.0f, 0.5f);
        const MapCoordinates<float> at{uv, vec2<float>(0.0f), vec2<float>(0.0f)};
        const vec3<float> m = normalize_or_zero(normal_from_map(detail, at, vec3<float>(n), vec3<float>(tangent), 1.0f));
        ours += !(std::isfinite(m.x) && std::isfinite(m.y) && std::isfinite(m.z));
        // The textbook's frame: every axis made a unit vector.
        const glm::vec3 t = glm::normalize(tangent - n * glm::dot(n, tangent)), b = glm::cross(glm::normalize(n), t);
        const glm::vec3 code = glm::vec3(codes.at(texel, 0)) / 255.0f * 2.0f - 1.0f,
                        p = glm::normalize(t * code.x + b * code.y + n * code.z);
        plain += !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
      }
    }
  }
  judge({13, "normal maps at poles, seams, without tangents",
         "normals and tangents of no length, parallel or tiny; an orthonormal frame against the frame as it is",
         "normals that are NaN or infinite, of 108"},
        plain, 50, ours, 0);
}

// ---- tone ---------------------------------------------------------------------------------------------------------------

TEST(Stability, WildLight) {
  int plain = 0, ours = 0;
  for (const float x : {kNaN, kInf, -kInf, -1.0f, -0.0f, 0.0f, 1e-40f, 0.5f, 1e20f, 3.4e38f}) {
    for (const float exposure : {0.0f, 1.0f, 1e9f}) {
      for (const ToneCurve curve :
           {ToneCurve::none, ToneCurve::reinhard, ToneCurve::reinhard_extended, ToneCurve::exponential, ToneCurve::aces}) {
        for (const ToneOn on : {ToneOn::channel, ToneOn::luminance}) {
          const auto rgb = tone_map(SceneLight<float>{{x, 0.2f, x}}, {exposure, curve, on, 4.0f}).rgb;
          for (int k = 0; k < 3; ++k) ours += !(rgb[k] >= 0.0f && rgb[k] <= 1.0f);
          if (on == ToneOn::luminance) continue;
          // NaN and negative light are dark, infinite light is as bright as the curve goes, unless nothing is exposed.
          if (!(x > 0.0f)) ours += rgb.x != 0.0f;
          if (x == kInf) ours += rgb.x != (exposure > 0.0f ? 1.0f : 0.0f);
        }
        const float c = tone_curve(curve, x * exposure, 4.0f);
        plain += !(c >= 0.0f && c <= 1.0f);
      }
    }
  }
  judge({20, "tone mapping of NaN, infinite and negative light",
         "NaN, ±infinity, −1, 3e38 at exposures 0 to 1e9, five curves; the curve alone against tone_map",
         "results outside of [0, 1]; ours: also NaN that is not 0, infinity that is not 1"},
        plain, 50, ours, 0);
}

TEST(Stability, DoubleGamma) {
  double twice = 0.0, power = 0.0, ours = 0.0;
  for (int i = 0; i <= 100000; ++i) {
    const double x = i / 100000.0;
    const auto encode = [](double y) { return y <= 0.0031308 ? 12.92 * y : 1.055 * std::pow(y, 1.0 / 2.4) - 0.055; };
    const double exact = 255.0 * encode(x);
    twice = std::max(twice, std::abs(255.0 * encode(encode(x)) - exact));
    power = std::max(power, std::abs(255.0 * std::pow(x, 1.0 / 2.2) - exact));
    ours = std::max(ours, std::abs(static_cast<double>(linear_to_srgb(static_cast<float>(x))) - exact));
  }
  EXPECT_GE(power, 8.0) << "pow(1/2.2) is no sRGB";
  // Half a code is what rounding costs; 1e-4 the float that x is.
  judge({21, "double gamma", "light from 0 to 1; encoded twice against once, by types that allow no second time",
         "largest error in 8-bit codes"},
        twice, 70.0, ours, 0.5001);
}

// ---- highlights ---------------------------------------------------------------------------------------------------------

TEST(Stability, PowersAndNormals) {
  int plain = 0, ours = 0;
  double worst = 0.0;
  const Light light{};
  for (const float shininess : {0.0f, 1e-30f, 1.0f, 200.0f, 1e5f}) {
    for (const glm::vec3& n :
         {glm::vec3(0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0), glm::vec3(kNaN), glm::vec3(0, 1e-20f, 1e-20f)}) {
      for (const glm::vec3& v : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0), glm::vec3(0)}) {
        for (const LightModel model : {LightModel::phong, LightModel::blinn_phong}) {
          const auto lit = illuminate<float>(std::span(&light, 1), model, shininess, {{0, 0, 0}, n, v});
          ours += !(lit.specular.x >= 0.0f && lit.specular.x <= 1.0f && lit.diffuse.x >= 0.0f);
          if (!(n.z > 0.0f)) ours += lit.specular.x != 0.0f;  // the light stands behind, or the normal says nothing
        }
        // The usual shader: half vector and normal made unit vectors, the power by exp2 and log2.
        const glm::vec3 h = glm::normalize(glm::vec3(0, 0, 1) + v);
        const float c = std::max(glm::dot(glm::normalize(n), h), 0.0f), s = std::exp2(shininess * std::log2(c));
        plain += !(s >= 0.0f && s <= 1.0f);
      }
    }
    for (int i = 1; i <= 1000; ++i) {
      const float c = static_cast<float>(i) / 1000.0f;
      const double exact = std::pow(static_cast<double>(c), static_cast<double>(shininess));
      if (exact > 1e-37) worst = std::max(worst, std::abs(static_cast<double>(halfspace::pow(c, shininess)) / exact - 1.0));
    }
  }
  EXPECT_LE(worst, 1.2 * 0x1p-23) << "1.2 ulp, at exponents to 1e5";
  judge({23, "specular pow(0, 0), huge exponents, NaN normals",
         "exponents 0 to 1e5, normals and directions of no length and NaN; unit vectors and exp2(n log2 c) against illuminate",
         "highlights outside of [0, 1]; ours: also those of light from behind"},
        plain, 30, ours, 0);
}

// ---- the same bits ------------------------------------------------------------------------------------------------------

TEST(Stability, SameBitsAtEveryWidth) {
  const std::vector<float> in = hash_inputs();
  const uint64_t one = lane_hash<float>(in);
  int ours = 0;
  ours += lane_hash<RealN<4>>(in) != one;
  ours += lane_hash<RealN<8>>(in) != one;
  ours += lane_hash<RealN<16>>(in) != one;
  // What processors differ in: the estimate of 1/x, even after a step of Newton's.
  int plain = 0;
  for (const float x : in) {
    const float r = _mm_cvtss_f32(_mm_rcp_ss(_mm_set_ss(x))), refined = r * (2.0f - x * r);
    plain += std::isnormal(1.0f / x) && refined != 1.0f / x;
  }
  judge({26, "different bits by threads, lanes, processors",
         "elementary functions, interpolation and encoding at 1, 4, 8 and 16 lanes; rcp with one step of Newton's against division",
         "plain: values that are not 1/x rounded, of 4,096; ours: widths that differ"},
        plain, 500, ours, 0);
}

#ifdef HALFSPACE_ISA_PROGRAMS
// The same functions in programs of their own, compiled for one instruction set each.
TEST(Stability, SameBitsForEveryInstructionSet) {
  const std::vector<float> in = hash_inputs();
  char want[32];
  std::snprintf(want, sizeof want, "%016llx\n", static_cast<unsigned long long>(lane_hash<float>(in)));
  int ours = 0, ran = 0;
  std::string programs = HALFSPACE_ISA_PROGRAMS;
  for (std::size_t at = 0; at < programs.size();) {
    const std::size_t end = std::min(programs.find(':', at), programs.size());
    const std::string program = programs.substr(at, end - at);
    at = end + 1;
    if (program.ends_with("v4") ? !__builtin_cpu_supports("avx512vl") : !__builtin_cpu_supports("avx2")) continue;
    ++ran;
    ours += run_command(program).text != want;
  }
  if (ran == 0) GTEST_SKIP() << "this processor has neither AVX2 nor AVX-512";
  // What a library chooses by processor: its functions differ from ours in last bits, and from version to version among themselves.
  int plain = 0;
  for (const float x : in) plain += std::exp2(x) != halfspace::exp2(x);
  judge(
      {26, "different bits by threads, lanes, processors", "the same in programs for x86-64-v3 and -v4; the C library's exp2 against ours",
       "plain: values that differ, of 4,096; ours: programs that differ"},
      plain, 1, ours, 0);
}
#endif

}  // namespace
}  // namespace halfspace::stability
