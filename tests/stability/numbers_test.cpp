// SPDX-License-Identifier: Apache-2.0
//
// Inputs that common formulas cannot handle: zero-length vectors, invalid and extreme light values, huge exponents. Also checks that
// results are bit-identical at every SIMD width.
#include <immintrin.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "halfspace/core/lane_math.h"
#include "halfspace/core/srgb.h"
#include "halfspace/shading/light/lighting.h"
#include "halfspace/shading/surface/surface_detail.h"
#include "halfspace/shading/values/tone.h"
#include "stability/lane_hash.h"
#include "stability/regime.h"
#include "support/constants.h"
#include "support/program.h"

namespace halfspace::stability {
namespace {

// ---- normal maps --------------------------------------------------------------------------------------------------------

TEST(Stability, NormalMapsWithoutValidFramesGiveFiniteNormals) {
  Image<glm::u8vec4> codes(3, 1);
  codes.at(0, 0) = {128, 128, 255, 255};
  codes.at(1, 0) = {0, 0, 0, 255};        // not a valid normal
  codes.at(2, 0) = {255, 128, 128, 255};  // parallel to the tangent
  const Texture2D map(codes, TexelFormat::rgba8);
  const DetailMap detail{.map = &map, .sampler = {.mag = Filter::nearest, .min = Filter::nearest}};
  const glm::vec3 vectors[] = {{0, 0, 0}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {1e-30f, 0, 0}, {0, 1e-25f, 0}};
  int common = 0, ours = 0;
  for (const glm::vec3& n : vectors) {
    for (const glm::vec3& tangent : vectors) {
      for (int texel = 0; texel < 3; ++texel) {
        const vec2<float> uv((static_cast<float>(texel) + 0.5f) / 3.0f, 0.5f);
        const MapCoordinates<float> at{uv, vec2<float>(0.0f), vec2<float>(0.0f)};
        const vec3<float> m = normalize_or_zero(normal_from_map(detail, at, vec3<float>(n), vec3<float>(tangent), 1.0f));
        ours += !(std::isfinite(m.x) && std::isfinite(m.y) && std::isfinite(m.z));
        // The usual orthonormal frame, with every axis normalized.
        const glm::vec3 t = glm::normalize(tangent - n * glm::dot(n, tangent)), b = glm::cross(glm::normalize(n), t);
        const glm::vec3 code = glm::vec3(codes.at(texel, 0)) / 255.0f * 2.0f - 1.0f,
                        p = glm::normalize(t * code.x + b * code.y + n * code.z);
        common += !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
      }
    }
  }
  record_and_check({13, "normal maps at poles and seams, and without tangents",
                    "zero-length, parallel and tiny normals and tangents; an orthonormalized frame vs. the unmodified frame",
                    "non-finite normals, of 108"},
                   common, 50, ours, 0);
}

// ---- tone ---------------------------------------------------------------------------------------------------------------

TEST(Stability, ToneMappingHandlesNonFiniteAndNegativeLight) {
  int common = 0, ours = 0;
  for (const float x : {kNaN, kInf, -kInf, -1.0f, -0.0f, 0.0f, 1e-40f, 0.5f, 1e20f, 3.4e38f}) {
    for (const float exposure : {0.0f, 1.0f, 1e9f}) {
      for (const ToneCurve curve :
           {ToneCurve::none, ToneCurve::reinhard, ToneCurve::reinhard_extended, ToneCurve::exponential, ToneCurve::aces}) {
        for (const ToneOn on : {ToneOn::channel, ToneOn::luminance}) {
          const auto rgb = tone_map(SceneLight<float>{{x, 0.2f, x}}, {exposure, curve, on, 4.0f}).rgb;
          for (int k = 0; k < 3; ++k) ours += !(rgb[k] >= 0.0f && rgb[k] <= 1.0f);
          if (on == ToneOn::luminance) continue;
          // NaN and negative light map to black, infinite light to the maximum of the curve, unless the exposure is 0.
          if (!(x > 0.0f)) ours += rgb.x != 0.0f;
          if (x == kInf) ours += rgb.x != (exposure > 0.0f ? 1.0f : 0.0f);
        }
        const float c = tone_curve(curve, x * exposure, 4.0f);
        common += !(c >= 0.0f && c <= 1.0f);
      }
    }
  }
  record_and_check({20, "tone mapping of NaN, infinite and negative light",
                    "NaN, ±infinity, −1 and 3e38 at exposures from 0 to 1e9, five curves; the curve alone vs. tone_map()",
                    "results outside [0, 1]; ours: also NaN not mapped to 0 and infinity not mapped to 1"},
                   common, 50, ours, 0);
}

TEST(Stability, SrgbIsEncodedOnlyOnce) {
  double twice = 0.0, power = 0.0, ours = 0.0;
  for (int i = 0; i <= 100000; ++i) {
    const double x = i / 100000.0;
    const auto encode = [](double y) { return y <= 0.0031308 ? 12.92 * y : 1.055 * std::pow(y, 1.0 / 2.4) - 0.055; };
    const double exact = 255.0 * encode(x);
    twice = std::max(twice, std::abs(255.0 * encode(encode(x)) - exact));
    power = std::max(power, std::abs(255.0 * std::pow(x, 1.0 / 2.2) - exact));
    ours = std::max(ours, std::abs(static_cast<double>(linear_to_srgb(static_cast<float>(x))) - exact));
  }
  EXPECT_GE(power, 8.0) << "pow(1/2.2) is not the sRGB curve";
  // Rounding costs half an LSB; 1e-4 allows for x being a float.
  record_and_check({21, "double gamma", "light from 0 to 1; encoded twice vs. once, using types that prevent a second encoding",
                    "largest error, in units of 1/255"},
                   twice, 70.0, ours, 0.5001);
}

// ---- highlights ---------------------------------------------------------------------------------------------------------

TEST(Stability, HighlightsAreBoundedForDegenerateInputs) {
  int common = 0, ours = 0;
  double worst = 0.0;
  const Light light{};
  for (const float shininess : {0.0f, 1e-30f, 1.0f, 200.0f, 1e5f}) {
    for (const glm::vec3& n :
         {glm::vec3(0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0), glm::vec3(kNaN), glm::vec3(0, 1e-20f, 1e-20f)}) {
      for (const glm::vec3& v : {glm::vec3(0, 0, 1), glm::vec3(0, 0, -1), glm::vec3(1, 0, 0), glm::vec3(0)}) {
        for (const LightModel model : {LightModel::phong, LightModel::blinn_phong}) {
          const auto lit = illuminate<float>(std::span(&light, 1), model, shininess, {{0, 0, 0}, n, v});
          ours += !(lit.specular.x >= 0.0f && lit.specular.x <= 1.0f && lit.diffuse.x >= 0.0f);
          if (!(n.z > 0.0f)) ours += lit.specular.x != 0.0f;  // the light is behind the surface, or the normal is invalid
        }
        // The common shader: normalized half vector and normal, and the power computed with exp2 and log2.
        const glm::vec3 h = glm::normalize(glm::vec3(0, 0, 1) + v);
        const float c = std::max(glm::dot(glm::normalize(n), h), 0.0f), s = std::exp2(shininess * std::log2(c));
        common += !(s >= 0.0f && s <= 1.0f);
      }
    }
    for (int i = 1; i <= 1000; ++i) {
      const float c = static_cast<float>(i) / 1000.0f;
      const double exact = std::pow(static_cast<double>(c), static_cast<double>(shininess));
      if (exact > 1e-37) worst = std::max(worst, std::abs(static_cast<double>(halfspace::pow(c, shininess)) / exact - 1.0));
    }
  }
  EXPECT_LE(worst, 1.2 * 0x1p-23) << "1.2 ulp, at exponents up to 1e5";
  record_and_check(
      {23, "specular pow(0, 0), huge exponents, NaN normals",
       "exponents from 0 to 1e5, zero-length and NaN normals and directions; normalized vectors and exp2(n log2 c) vs. illuminate()",
       "highlights outside [0, 1]; ours: also highlights from lights behind the surface"},
      common, 30, ours, 0);
}

// ---- bit-identical results ---------------------------------------------------------------------------------------------

TEST(Stability, IsBitIdenticalAtEverySimdWidth) {
  const std::vector<float> in = hash_inputs();
  const uint64_t one = lane_hash<float>(in);
  int ours = 0;
  ours += lane_hash<RealN<4>>(in) != one;
  ours += lane_hash<RealN<8>>(in) != one;
  ours += lane_hash<RealN<16>>(in) != one;
  // Processors differ in their estimate of 1/x, even after a Newton step.
  int common = 0;
  for (const float x : in) {
    const float r = _mm_cvtss_f32(_mm_rcp_ss(_mm_set_ss(x))), refined = r * (2.0f - x * r);
    common += std::isnormal(1.0f / x) && refined != 1.0f / x;
  }
  record_and_check({26, "results that depend on threads, SIMD width or processor",
                    "elementary functions, interpolation and encoding with 1, 4, 8 and 16 lanes; rcp with one Newton step vs. division",
                    "common: results of 4,096 that are not 1/x correctly rounded; ours: SIMD widths that differ"},
                   common, 500, ours, 0);
}

#ifdef HALFSPACE_ISA_PROGRAMS
// Evaluates the same functions in separate programs, each compiled for one instruction set.
TEST(Stability, IsBitIdenticalForEveryInstructionSet) {
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
  // The C library selects implementations by processor. Its results differ from ours in the last bits, and between versions.
  int common = 0;
  for (const float x : in) common += std::exp2(x) != halfspace::exp2(x);
  record_and_check({26, "results that depend on threads, SIMD width or processor",
                    "the same functions in programs for x86-64-v3 and x86-64-v4; exp2 of the C library vs. ours",
                    "common: values of 4,096 that differ; ours: programs that differ"},
                   common, 1, ours, 0);
}
#endif

}  // namespace
}  // namespace halfspace::stability
