// SPDX-License-Identifier: Apache-2.0
//
// Tests the final stage of rendering: automatic exposure, tone curves and encodings applied per tile, and the memory use of HDR.
#include "halfspace/render/frame/display.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>
#include <random>

#include "halfspace/core/half.h"
#include "halfspace/raster/shade/tile_memory.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "halfspace/shading/values/tone.h"
#include "render/naive_picture.h"
#include "support/sanitized.h"

namespace {

// Counts the allocations of at least `least` bytes while `counting` is set.
std::atomic<bool> counting{false};
std::atomic<std::size_t> min_size{0}, large{0};

void count(std::size_t size) {
  if (counting && size >= min_size) ++large;
}
void* counted_or_null(std::size_t size) {
  count(size);
  return std::malloc(size == 0 ? 1 : size);
}
[[maybe_unused]] void* counted(std::size_t size) {
  void* p = counted_or_null(size);
  if (p == nullptr) throw std::bad_alloc();
  return p;
}

}  // namespace

#if !HS_SANITIZED  // sanitizers replace these themselves
void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  count(size);
  const auto a = static_cast<std::size_t>(alignment);
  void* p = std::aligned_alloc(a, (size + a - 1) / a * a);
  if (p == nullptr) throw std::bad_alloc();
  return p;
}
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return counted_or_null(size); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return counted_or_null(size); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
#endif

namespace halfspace {
namespace {

// Returns a scene with values above 1: a ball under a bright sun in front of a uniform sky.
SceneDescription bright_scene(const std::vector<std::string>& settings = {}) {
  SceneFile scene = SceneFile::parse(R"({"version": 1, "ambient": 0.3,
    "lights": {"sun": {"direction": [1, 1, 1], "intensity": 20}},
    "objects": {"ball": {"color": [0.9, 0.5, 0.1], "specular": 0.5}},
    "environments": {"sky": {"map": [4, 2, 0.5]}},
    "background": {"type": "environment", "environment": "sky"}})",
                                     "test.json", ".");
  scene.set(settings);
  return scene.description();
}

// ---- average luminance -------------------------------------------------------------------------------------------------

TEST(AutoExposure, MatchesTheLogAverageInDouble) {
  std::mt19937 random(1);
  Image<glm::vec4> light(123, 77);  // full and partial tiles
  double sum = 0;
  for (int y = 0; y < 77; ++y) {
    for (int x = 0; x < 123; ++x) {
      const auto next = [&] { return std::exp2(static_cast<float>(random() % 24000) / 1000.0f - 14.0f); };
      const float r = next(), g = next(), b = next();
      light.at(x, y) = {r, g, b, 1};
      sum += std::log(1e-6 + 0.2126 * static_cast<double>(r) + 0.7152 * static_cast<double>(g) + 0.0722 * static_cast<double>(b));
    }
  }
  const double want = std::exp(sum / (123 * 77));
  const Workers one(1), two(2), seven(7);
  const double got = log_average_luminance(light, one);
  EXPECT_NEAR(got, want, 1e-6 * want) << "each logarithm is at most 14 and has an error of one ulp, 1e-6";
  EXPECT_EQ(log_average_luminance(light, two), got);
  EXPECT_EQ(log_average_luminance(light, seven), got);
}

TEST(AutoExposure, HalfFloatsGiveTheSameAverageAsFloats) {
  Image<U16Vec4> halfs(9, 5);
  Image<glm::vec4> floats(9, 5);
  for (int i = 0; i < 45; ++i) {
    const auto h = static_cast<uint16_t>(0x2000 + 500 * i);
    halfs.data()[i] = U16Vec4(h, h, h, h);
    floats.data()[i] = glm::vec4(half_to_float(h));
  }
  const Workers workers(1);
  EXPECT_EQ(log_average_luminance(halfs, workers), log_average_luminance(floats, workers));
}

TEST(AutoExposure, InvalidValuesCountAsBlack) {
  const Workers workers(1);
  const auto average = [&](float x) {
    Image<glm::vec4> light(2, 2);
    std::fill_n(light.data(), 4, glm::vec4(x));
    return log_average_luminance(light, workers);
  };
  for (const float x : {0.0f, -1.0f, detail::kNaN, -detail::kInfinity}) EXPECT_NEAR(average(x), 1e-6, 1e-12) << x;
  EXPECT_NEAR(average(detail::kInfinity), 65504.0, 0.1);
  EXPECT_NEAR(average(0.18f), 0.18 + 1e-6, 1e-7);
}

TEST(AutoExposure, MapsTheAverageToTheKeyValue) {
  // A uniform sky of any luminance is displayed at key_value. The mapping is linear because there is no tone curve.
  for (const char* map : {"sky.map=0.004", "sky.map=3", "sky.map=900"}) {
    for (const char* format : {"post.format=rgba16f", "post.format=rgba32f"}) {
      const SceneDescription scene = bright_scene(
          {"ball.visible=false", map, format, "post.hdr=true", "post.tone=none", "post.auto_exposure=true", "post.key_value=0.3"});
      const Image<glm::u8vec4> picture = picture_of(scene, 16, 16);
      // The offset of 1e-6 is a relative change of 2.5e-4 at 0.004, and a half float has a relative precision of 5e-4. Together they change
      // a value of 0.3 by a tenth of 1/255.
      EXPECT_NEAR(picture.at(8, 8).x, linear_to_srgb(0.3f), 1) << map;
    }
  }
}

TEST(AutoExposure, IsBitIdenticalForAnyThreadCount) {
  const SceneDescription scene = bright_scene({"post.hdr=true", "post.auto_exposure=true"});
  const Image<glm::u8vec4> one = picture_of(scene, 200, 120, 1);
  EXPECT_EQ(picture_of(scene, 200, 120, 2), one);
  EXPECT_EQ(picture_of(scene, 200, 120, 7), one);
}

// ---- image -------------------------------------------------------------------------------------------------------------

// The encoded image must equal the linear image with tone.h applied to each pixel.
TEST(Display, PixelsMatchTheToneMappedLinearImage) {
  constexpr int kSize = 96;
  const Image<glm::vec4> light = light_of(bright_scene(), kSize, kSize);
  for (const char* tone : {"none", "reinhard", "reinhard_extended", "exponential", "aces"}) {
    for (const char* on : {"luminance", "channel"}) {
      for (const char* encode : {"srgb", "gamma"}) {
        for (const char* dither : {"false", "true"}) {
          const SceneDescription scene =
              bright_scene({"post.hdr=true", "post.format=rgba32f", "post.exposure=0.7", std::string("post.tone=") + tone,
                            std::string("post.tone_on=") + on, std::string("post.encode=") + encode, "post.gamma=1.9",
                            std::string("post.dither=") + dither});
          const Image<glm::u8vec4> picture = picture_of(scene, kSize, kSize);
          const ToneMapping mapping{.exposure = 0.7f, .curve = scene.post.tone, .on = scene.post.tone_on, .white = 4.0f};
          for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
              const DisplayLight<float> shown = tone_map(SceneLight<float>{glm::vec3(light.at(x, y))}, mapping);
              Encoded<float> e = encode[0] == 's' ? encode_srgb(shown) : encode_gamma(shown, 1.9f);
              if (dither[0] == 't') e = dithered(e, dither_threshold<float>(x, kSize - 1 - y));
              for (int k = 0; k < 3; ++k) {
                const bool exact = encode[0] == 's' && dither[0] == 'f';
                const int want = exact ? linear_to_srgb(shown.rgb[k]) : linear_to_unorm8(e.rgb[k]);
                ASSERT_EQ(int{picture.at(x, y)[k]}, want) << tone << " " << on << " " << encode << " " << dither << " " << x << " " << y;
              }
              ASSERT_EQ(picture.at(x, y).w, 255);
            }
          }
        }
      }
    }
  }
}

TEST(Display, PostKeysAreIgnoredWithoutHdr) {
  const Image<glm::u8vec4> plain = picture_of(bright_scene(), 64, 48);
  EXPECT_EQ(picture_of(bright_scene({"post.exposure=0.1", "post.tone=exponential", "post.encode=gamma", "post.dither=true",
                                     "post.auto_exposure=true"}),
                       64, 48),
            plain);
  EXPECT_EQ(plain.at(1, 1), glm::u8vec4(255, 255, linear_to_srgb(0.5f), 255)) << "values above 1 are clamped";
  // HDR without exposure and tone curve gives the same image. The format is rgba32f, so no value is rounded to half.
  EXPECT_EQ(picture_of(bright_scene({"post.hdr=true", "post.tone=none", "post.format=rgba32f"}), 64, 48), plain);
}

TEST(Display, LinearOutputPrecedesExposureAndToneCurve) {
  EXPECT_EQ(light_of(bright_scene({"post.hdr=true", "post.exposure=9", "post.tone=reinhard", "post.auto_exposure=true"}), 32, 32),
            light_of(bright_scene(), 32, 32));
}

// Returns how many allocations made during rendering have at least `bytes` bytes per pixel of the image.
std::size_t large_blocks(const std::vector<std::string>& settings, std::size_t bytes) {
  // Less than 1 MiB at 16 bytes per pixel, because allocate_lines requests larger blocks directly from the system.
  constexpr int kWidth = 256, kHeight = 255;
  const Workers workers(2);
  SceneAssets assets(workers);
  const PreparedScene scene = assets.prepare(bright_scene(settings), kWidth, kHeight);
  Image<glm::u8vec4> picture(kWidth, kHeight);
  { const TileMemoryLease first, second, third; }  // threads then take their tile memory, which is also large, from the pool
  min_size = std::size_t{kWidth} * kHeight * bytes;
  large = 0;
  counting = true;
  render(scene, picture, workers);
  counting = false;
  return large;
}

TEST(Display, AllocatesHdrMemoryOnlyIfNeeded) {
  if (kSanitized) GTEST_SKIP() << "the sanitizer replaces the allocator, so allocations are not counted";
  EXPECT_EQ(large_blocks({}, 4), 0u) << "without HDR, no block is as large as the image";
  EXPECT_EQ(large_blocks({"post.hdr=true"}, 4), 0u) << "HDR without auto exposure needs only tile memory";
  EXPECT_EQ(large_blocks({"post.hdr=true", "post.auto_exposure=true"}, 8), 1u) << "one block for the linear image";
  EXPECT_EQ(large_blocks({"post.hdr=true", "post.auto_exposure=true", "post.format=rgba32f"}, 16), 1u);
}

}  // namespace
}  // namespace halfspace
