// SPDX-License-Identifier: Apache-2.0
//
// Compares pixel histories of complete scenes with the rendered pictures.
#include "explain/pixel_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "explain/history_text.h"
#include "halfspace/render/frame/frame.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "support/files.h"
#include "support/workers.h"

namespace halfspace {

namespace {

constexpr int kWidth = 160, kHeight = 90;

// A scene, prepared and traced.
struct TracedScene {
  TracedScene(const SceneFile& file, const Workers& workers)
      : description(file.at(0.5)),
        assets(workers),
        prepared(assets.prepare(description, kWidth, kHeight)),
        trace(trace_frame(prepared, workers)) {}
  TracedScene(const std::string& name, const std::vector<std::string>& settings) : TracedScene(opened(name, settings), one_worker()) {}

  static SceneFile opened(const std::string& name, const std::vector<std::string>& settings) {
    SceneFile file = SceneFile::open(name);
    file.set(settings);
    return file;
  }

  SceneDescription description;
  SceneAssets assets;
  PreparedScene prepared;
  FrameTrace trace;
};

// Returns pixels spread over the picture, and the pixel with the most fragments.
std::vector<glm::ivec2> some_pixels(const FrameTrace& trace) {
  std::vector<glm::ivec2> pixels{trace.busiest_pixel()};
  for (int y = 2; y < kHeight; y += 11) {
    for (int x = 3; x < kWidth; x += 13) pixels.emplace_back(x, y);
  }
  return pixels;
}

// The sum of the terms differs from the color by rounding. Each of at most 20 terms is evaluated separately, with an error of a few ulps of
// intermediate results, which may be larger than the final result. With per-vertex lighting, the vertices are also computed and
// interpolated again.
void expect_terms_add_up(const FragmentDetail& d, const std::string& where) {
  if (d.terms.empty()) return;
  for (std::size_t k = 0; k < 3; ++k) {
    double sum = 0.0, size = 0.0;
    for (const NamedValue& t : d.terms) {
      sum += static_cast<double>(t.values[k]);
      size += std::abs(static_cast<double>(t.values[k]));
    }
    EXPECT_NEAR(sum, static_cast<double>(d.color[static_cast<int>(k)]), 1e-5 * size + 1e-7) << where << d.shader;
  }
}

// Checks a history against the picture and the fragments that the renderer shaded.
void expect_sound(const PixelHistory& h, const FrameTrace& trace, const std::string& where) {
  EXPECT_EQ(h.display.code, trace.picture.at(h.pixel.x, h.pixel.y)) << where;
  std::vector<glm::vec4> samples(h.samples.size());
  std::vector<bool> changed(h.samples.size());
  for (const FragmentDetail& d : h.fragments) {
    const TracedFragment& f = d.fragment;
    if (f.outcome >= FragmentOutcome::shaded) {
      samples[f.sample] = f.value;
      changed[f.sample] = true;
    }
    EXPECT_NEAR(d.barycentrics.x + d.barycentrics.y + d.barycentrics.z, 1.0f, 1e-5f) << where;
    expect_terms_add_up(d, where);
  }
  for (std::size_t s = 0; s < samples.size(); ++s) {
    if (!changed[s]) continue;
    EXPECT_EQ(samples[s], h.samples[s]) << where << s;
  }
}

void expect_sound_histories(const std::string& name, const std::vector<std::string>& settings) {
  const TracedScene t(name, settings);
  Image<glm::u8vec4> picture(kWidth, kHeight);
  const PassStatistics statistics = render(t.prepared, picture, one_worker());
  EXPECT_TRUE(std::ranges::equal(picture.texels(), t.trace.picture.texels())) << name;
  EXPECT_EQ(statistics, t.trace.statistics) << name;
  const std::vector<glm::ivec2> pixels = some_pixels(t.trace);
  const std::vector<PixelHistory> histories = pixel_histories(t.description, t.prepared, t.trace, pixels, one_worker());
  for (const PixelHistory& h : histories) {
    const std::string where = name + " " + std::to_string(h.pixel.x) + "," + std::to_string(h.pixel.y) + " ";
    expect_sound(h, t.trace, where);
  }
}

TEST(PixelHistory, EndsWithThePictureInAllShippedScenes) {
  for (const ShippedScene& shipped : shipped_scenes()) expect_sound_histories(std::string(shipped.name), {"samples=1"});
}

TEST(PixelHistory, EndsWithThePictureWithFourSamples) {
  for (const ShippedScene& shipped : shipped_scenes()) expect_sound_histories(std::string(shipped.name), {"samples=4"});
}

TEST(PixelHistory, EndsWithThePictureForEachWayOfDisplaying) {
  expect_sound_histories("shapes", {"post.hdr=true", "post.auto_exposure=true", "post.tone=reinhard"});
  expect_sound_histories("shapes", {"post.hdr=true", "post.format=rgba32f", "post.dither=true", "post.encode=gamma"});
  expect_sound_histories("shapes", {"background.type=transparent"});
}

TEST(PixelHistory, EndsWithThePictureAtEachShadingRate) {
  for (const char* rate : {"none", "flat", "provoking", "gouraud", "phong"}) {
    SceneFile file = SceneFile::open("shapes");
    std::vector<std::string> settings;
    for (const auto& [name, object] : file.description().objects) settings.push_back("objects." + name + ".shading=" + rate);
    expect_sound_histories("shapes", settings);
  }
}

// Shading a fragment in float gives the same color as the renderer's SIMD lanes.
TEST(PixelHistory, ScalarAndLaneShadingAreBitIdentical) {
  int compared = 0;
  for (const ShippedScene& shipped : shipped_scenes()) {
    const TracedScene t(std::string(shipped.name), {"samples=1"});
    const std::vector<glm::ivec2> pixels = some_pixels(t.trace);
    FrameTrace unshaded = t.trace;  // if no fragment is shaded, pixel_histories() computes all colors
    for (TracedFragment& f : unshaded.fragments) f.is_shaded = false;
    const auto shaded = pixel_histories(t.description, t.prepared, t.trace, pixels, one_worker());
    const auto computed = pixel_histories(t.description, t.prepared, unshaded, pixels, one_worker());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      for (std::size_t k = 0; k < shaded[i].fragments.size(); ++k) {
        if (!shaded[i].fragments[k].fragment.is_shaded) continue;
        EXPECT_EQ(shaded[i].fragments[k].color, computed[i].fragments[k].color) << shipped.name << " " << pixels[i].x << "," << pixels[i].y;
        ++compared;
      }
    }
  }
  EXPECT_GE(compared, 500);
}

TEST(PixelHistory, NamesTheSurfaceThatTheFrameShows) {
  const TracedScene t("day-night", {"samples=1"});
  Image<uint32_t> object(kWidth, kHeight), triangle(kWidth, kHeight);
  Image<glm::vec3> barycentrics(kWidth, kHeight);
  render_frame(t.prepared, {.object = &object, .triangle = &triangle, .barycentrics = &barycentrics}, one_worker());
  const std::vector<glm::ivec2> pixels = some_pixels(t.trace);
  int compared = 0;
  for (const PixelHistory& h : pixel_histories(t.description, t.prepared, t.trace, pixels, one_worker())) {
    const auto visible = std::ranges::find_if(
        h.fragments, [](const FragmentDetail& d) { return d.fragment.outcome == FragmentOutcome::shaded && d.object != "background"; });
    const uint32_t expected = object.at(h.pixel.x, h.pixel.y);
    if (visible == h.fragments.end()) continue;
    ASSERT_LT(expected, t.description.objects.size());
    EXPECT_EQ(visible->object, t.description.objects[expected].first);
    EXPECT_EQ(visible->fragment.primitive, triangle.at(h.pixel.x, h.pixel.y));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(visible->barycentrics[k], barycentrics.at(h.pixel.x, h.pixel.y)[k], 2e-3f);
    ++compared;
  }
  EXPECT_GE(compared, 50);
}

TEST(PixelHistory, DoesNotDependOnTheNumberOfThreads) {
  const SceneFile file = TracedScene::opened("day-night", {"samples=2"});
  const TracedScene one(file, one_worker()), two(file, two_workers());
  const std::vector<glm::ivec2> pixels = some_pixels(one.trace);
  EXPECT_EQ(one.trace.first, two.trace.first);
  const auto a = pixel_histories(one.description, one.prepared, one.trace, pixels, one_worker());
  const auto b = pixel_histories(two.description, two.prepared, two.trace, pixels, two_workers());
  for (std::size_t i = 0; i < pixels.size(); ++i) EXPECT_EQ(history_json(a[i], one.trace), history_json(b[i], two.trace));
}

TEST(PixelHistory, KeepsAtMost64FragmentsAndPrefersShadedOnes) {
  const TracedScene t("particles", {"particles.count=20000", "samples=4"});
  const glm::ivec2 busiest = t.trace.busiest_pixel();
  ASSERT_GT(t.trace.count(busiest), FrameTrace::kMaxFragments);
  EXPECT_EQ(t.trace.at(busiest).size(), FrameTrace::kMaxFragments);
  const auto h = pixel_histories(t.description, t.prepared, t.trace, std::span(&busiest, 1), one_worker())[0];
  EXPECT_EQ(h.others, t.trace.count(busiest) - FrameTrace::kMaxFragments);
  expect_sound(h, t.trace, "particles ");
  EXPECT_GE(std::ranges::count_if(h.fragments, [](const FragmentDetail& d) { return d.fragment.is_shaded; }), 1);
}

TEST(PixelHistory, JsonHasTheSameFloats) {
  const TracedScene t("day-night", {"samples=1"});
  const glm::ivec2 busiest = t.trace.busiest_pixel();
  const PixelHistory h = pixel_histories(t.description, t.prepared, t.trace, std::span(&busiest, 1), one_worker())[0];
  const nlohmann::json json = nlohmann::json::parse(history_json(h, t.trace));
  EXPECT_EQ(json["pixel"], nlohmann::json({busiest.x, busiest.y}));
  EXPECT_EQ(json["window"][1].get<float>(), static_cast<float>(kHeight - busiest.y) - 0.5f);
  ASSERT_EQ(json["fragments"].size(), h.fragments.size());
  for (std::size_t i = 0; i < h.fragments.size(); ++i) {
    EXPECT_EQ(json["fragments"][i]["depth"].get<float>(), h.fragments[i].fragment.depth);
    EXPECT_EQ(json["fragments"][i]["color"][1].get<float>(), h.fragments[i].color.y);
  }
  EXPECT_EQ(json["code"][0].get<int>(), h.display.code.x);
}

}  // namespace

}  // namespace halfspace
