// SPDX-License-Identifier: Apache-2.0
//
// Compares the data of the stages with values computed by hand, and with the pipeline itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string_view>

#include "explain/fragment_values.h"
#include "explain/prepared.h"
#include "explain/stage_emission.h"
#include "explain/stage_example.h"
#include "explain/stage_geometry.h"
#include "explain/stage_pictures.h"
#include "explain/stage_shadow.h"
#include "explain/stage_terms.h"
#include "explain/stage_tone.h"
#include "halfspace/raster/pipeline/pixel_box.h"
#include "halfspace/render/frame/frame.h"

namespace halfspace {
namespace {

// One triangle in front of an orthographic camera. The view shows 4 x 4 units in 64 x 64 pixels, so a unit is 16 pixels.
constexpr const char* kPlane = R"({"version": 1, "ambient": 0.25,
  "cameras": {"c": {"type": "orthographic", "position": [0, 0, 10], "target": [0, 0, 0], "height": 4, "near": 1, "far": 21}},
  "lights": {"sun": {"direction": [0, 0, 1], "intensity": 0.5}},
  "objects": {"square": {"shape": "plane", "size": 2, "rotation": [90, 0, 0], "specular": 0, "color": [0.5, 0.5, 0.5]}}})";

TEST(Stages, AVertexPassesThroughAllSpaces) {
  const PreparedText s(kPlane, 64, 64);
  s.visit([&](const PassContext& context, const StageGeometry& g) {
    ASSERT_EQ(g.primitives.size() % 2, 0u);
    const StageExample e = stage_example(s.prepared, context, g, 0);
    for (const StageVertex& v : e.vertices) {
      ASSERT_TRUE(v.position_ws.has_value());
      EXPECT_NEAR(v.position_ws->z, 0.0, 1e-12);
      EXPECT_NEAR(v.position_vs->z, -10.0, 1e-12) << "10 units in front of the camera";
      EXPECT_NEAR(v.ndc.x, v.position_ws->x / 2.0, 1e-6);
      EXPECT_EQ(v.window.x, static_cast<int32_t>(std::lround((v.position_ws->x * 16.0 + 32.0) * 256.0)));
      EXPECT_EQ(v.window.y, static_cast<int32_t>(std::lround((v.position_ws->y * 16.0 + 32.0) * 256.0)));
      EXPECT_NEAR(v.window.z, 11.0 / 20.0, 1e-6) << "reversed: 1 at the near plane, 0 at the far plane";
      EXPECT_EQ(v.window.inv_w, 1.0f);
      EXPECT_EQ(v.outcode, 0);
    }
  });
}

// The normals of the square point to the camera. Their lines are half a unit long, of the 20 units between the far and the near plane.
TEST(Stages, AGeometryFunctionEmitsThreeLinesPerTriangle) {
  std::string text = kPlane;
  text.insert(text.rfind("}}}"), R"(, "normal_lines": 0.5)");
  const PreparedText s(text, 64, 64);
  const std::vector<StageEmission> emissions = stage_emissions(s.prepared, s.workers);
  ASSERT_EQ(emissions.size(), 1u);
  const StageEmission& e = emissions[0];
  EXPECT_EQ(e.draw, 1u);
  EXPECT_EQ(e.received.primitive_count(), 2u);
  EXPECT_EQ(e.emitted.primitive_count(), 6u);
  EXPECT_EQ(emission_example(e, false, {64, 64}), std::optional<std::size_t>(0)) << "the triangles have equal areas";
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<std::size_t> lines = emitted_for(e, i);
    ASSERT_EQ(lines, (std::vector<std::size_t>{3 * i, 3 * i + 1, 3 * i + 2}));
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec4 corner = clip_position(e.received, 3 * i + k), start = clip_position(e.emitted, 2 * lines[k]);
      const glm::vec4 tip = clip_position(e.emitted, 2 * lines[k] + 1);
      EXPECT_EQ(start, corner);
      EXPECT_EQ(glm::vec3(tip.x, tip.y, tip.w), glm::vec3(start.x, start.y, start.w));
      EXPECT_NEAR(tip.z - start.z, 0.5 / 20.0, 1e-6) << "float rounding";
      const glm::dvec2 at = window_position(e.received, 3 * i + k, {64, 64});
      EXPECT_NEAR(std::fabs(at.x - 32.0), 16.0, 1e-4) << "a corner of the square";
      EXPECT_NEAR(std::fabs(at.y - 32.0), 16.0, 1e-4);
    }
  }
}

TEST(Stages, TheTrianglesOfASquareCoverEachPixelOnce) {
  const PreparedText s(kPlane, 64, 64);
  s.visit([&](const PassContext& context, const StageGeometry& g) {
    uint64_t sum = 0;
    for (std::size_t i = 0; i < g.triangles.size(); ++i)
      sum += covered_pixels(context, context.draws[g.primitives[g.primitive_of[i]].draw], std::span(&g.triangles[i], 1));
    EXPECT_EQ(sum, 32u * 32u);
    const Draw& draw = context.draws[g.primitives[0].draw];
    EXPECT_EQ(covered_pixels(context, draw, g.triangles), 32u * 32u);
    const std::array twice{g.triangles[0], g.triangles[0]};
    EXPECT_EQ(covered_pixels(context, draw, twice), covered_pixels(context, draw, std::span(twice).first(1))) << "each pixel counts once";
  });
}

TEST(Stages, BinsHoldTheTrianglesOfTheirTiles) {
  const PreparedText s(kPlane, 128, 64);  // the square covers 32 x 32 pixels in the middle: 16 columns in each of the two tiles
  s.visit([&](const PassContext& context, const StageGeometry& g) {
    const std::vector<uint32_t> counts = triangles_per_tile(context);
    ASSERT_EQ(counts.size(), 2u);
    std::array<uint32_t, 2> expected{};
    for (std::size_t i = 0; i < g.triangles.size(); ++i) {
      const Draw& draw = context.draws[g.primitives[g.primitive_of[i]].draw];
      for (int tile = 0; tile < 2; ++tile) {
        bool touches = false;
        for (int y = 0; y < 64; ++y) {
          for (int x = 64 * tile; x < 64 * tile + 64; ++x) touches |= covers(context, draw, g.triangles[i], x, y, 0);
        }
        expected[static_cast<std::size_t>(tile)] += touches;
      }
    }
    EXPECT_EQ(counts[0], expected[0]);
    EXPECT_EQ(counts[1], expected[1]);
  });
}

// Each primitive is set up separately to find its outcome. The sums must equal the counters of the pass.
TEST(Stages, OutcomesAddUpToTheStatisticsOfThePass) {
  for (const char* name : {"earth", "day-night", "particles", "shadow-plane", "pipeline"}) {
    const PreparedText s(SceneFile::open(name).at(0.0), 160, 90);
    Image<glm::u8vec4> picture(160, 90);
    const PassStatistics expected = render(s.prepared, picture, s.workers);
    s.visit([&](const PassContext&, const StageGeometry& g) {
      std::array<uint64_t, kStageOutcomes> n{};
      for (const StagePrimitive& p : g.primitives) ++n[static_cast<std::size_t>(p.outcome)];
      EXPECT_EQ(g.primitives.size(), expected.primitives_in) << name;
      EXPECT_EQ(n[static_cast<std::size_t>(StageOutcome::outside)], expected.culled_outside) << name;
      EXPECT_EQ(n[static_cast<std::size_t>(StageOutcome::face)], expected.culled_face) << name;
      EXPECT_EQ(n[static_cast<std::size_t>(StageOutcome::degenerate)], expected.culled_degenerate) << name;
      EXPECT_EQ(n[static_cast<std::size_t>(StageOutcome::no_sample)], expected.culled_no_sample) << name;
      EXPECT_EQ(n[static_cast<std::size_t>(StageOutcome::clipped)], expected.clipped) << name;
      EXPECT_EQ(g.triangles.size(), expected.triangles_binned) << name;
    });
  }
}

TEST(Stages, TilesHoldAsManyEntriesAsThePassBins) {
  const PreparedText s(SceneFile::open("earth").at(0.0), 160, 90);
  Image<glm::u8vec4> picture(160, 90);
  const PassStatistics expected = render(s.prepared, picture, s.workers);
  s.visit([&](const PassContext& context, const StageGeometry&) {
    uint64_t sum = 0;
    for (const uint32_t n : triangles_per_tile(context)) sum += n;
    EXPECT_EQ(sum, expected.bin_entries);
  });
}

TEST(Stages, AClippedTriangleEndsAtTheNearPlane) {
  const PreparedText s(R"({"version": 1, "cameras": {"c": {"position": [0, 0.5, 0], "target": [0, 0.5, -1], "near": 0.5, "far": 50}},
    "lights": {"sun": {}}, "objects": {"floor": {"shape": "plane", "size": 20}}})",
                       96, 64);
  s.visit([&](const PassContext& context, const StageGeometry& g) {
    uint32_t clipped = 0;
    for (uint32_t i = 0; i < g.primitives.size(); ++i) {
      if (g.primitives[i].outcome != StageOutcome::clipped) continue;
      ++clipped;
      const StageClip c = stage_clip(context, g, i);
      EXPECT_GE(c.polygon.count, 3);
      for (int k = 0; k < c.polygon.count; ++k) {
        const ClipCorner& corner = c.polygon.corners[static_cast<std::size_t>(k)];
        EXPECT_GE(corner.pos_clip.w, 0.5 - 1e-6) << "behind the near plane";
        EXPECT_NEAR(corner.weights.x + corner.weights.y + corner.weights.z, 1.0, 1e-12);
      }
    }
    EXPECT_GE(clipped, 1u);
  });
}

// Every covered sample of a triangle is a fragment, and the other samples are not.
TEST(Stages, CoverageMatchesTheFragmentsOfTheFrame) {
  for (const int samples : {1, 4}) {
    SceneFile file = SceneFile::open("shadow-knot");
    file.set({"samples=" + std::to_string(samples)});
    const PreparedText s(file.at(0.0), 96, 54);
    const FrameTrace trace = trace_frame(s.prepared, s.workers);
    uint64_t traced = 0;
    for (int y = 0; y < 54; ++y) {
      for (int x = 0; x < 96; ++x) traced += trace.count({x, y});
    }
    s.visit([&](const PassContext& context, const StageGeometry& g) {
      uint64_t covered = 0;
      for (std::size_t i = 0; i < g.triangles.size(); ++i) {
        const Draw& draw = context.draws[g.primitives[g.primitive_of[i]].draw];
        const PixelBounds box = pixel_bounds(draw, g.triangles[i], draw.bounds, context.samples_at);
        for (int y = box.y0; y < box.y1; ++y) {
          for (int x = box.x0; x < box.x1; ++x) {
            for (int k = 0; k < samples; ++k) covered += covers(context, draw, g.triangles[i], x, y, k);
          }
        }
      }
      EXPECT_EQ(covered, traced) << samples;
    });
  }
}

TEST(Stages, DepthBlocksBoundTheDepthBuffer) {
  for (const int samples : {1, 4}) {
    for (const char* name : {"earth", "day-night", "particles", "shapes"}) {
      SceneFile file = SceneFile::open(name);
      file.set({"samples=" + std::to_string(samples)});
      const PreparedText s(file.at(0.0), 96, 54);
      const DepthBlocks blocks = depth_blocks(s.prepared, trace_frame(s.prepared, s.workers));
      const Image<float> depth = depth_buffer(s.prepared, s.workers);
      std::vector<float> low(blocks.low.size(), 1.0f), high(low.size(), 0.0f);
      for (int y = 0; y < 54; ++y) {
        for (int x = 0; x < 96; ++x) {
          const auto b = static_cast<std::size_t>((53 - y) / 8 * blocks.columns + x / 8);
          low[b] = std::min(low[b], depth.at(x, y));
          high[b] = std::max(high[b], depth.at(x, y));
        }
      }
      for (std::size_t b = 0; b < low.size(); ++b) {
        EXPECT_LE(blocks.low[b], low[b]) << name;
        EXPECT_GE(blocks.high[b], high[b]) << name;
        if (samples > 1) continue;  // the depth buffer has sample 0 only
        EXPECT_EQ(blocks.low[b], low[b]) << name;
        EXPECT_EQ(blocks.high[b], high[b]) << name;
      }
    }
  }
}

// The level of detail follows from the axes of the footprint. The lookup works with squares of lengths: 2e-5 is a few ulps of float.
TEST(Stages, TheMipLevelFollowsFromTheAxes) {
  const PreparedText s(SceneFile::open("earth").at(0.0), 96, 54);
  const Image<MipLookup> lookups = mip_levels(s.prepared, s.workers);
  int compared = 0;
  for (const MipLookup& m : lookups.texels()) {
    if (m.probes == 0.0f) continue;
    const float size = m.is_anisotropic ? std::max(m.axes.y, m.axes.x / m.probes) : std::max(m.axes.x, m.axes.y);
    EXPECT_NEAR(m.lod, std::log2(size), 2e-5f);
    compared += m.is_anisotropic;
  }
  EXPECT_GT(compared, 100);
}

// ---- light ------------------------------------------------------------------------------------------------------------

// Ambient light of 0.25 and a frontal light of 0.5 on a surface with a gray of 0.5.
TEST(Stages, TermsMatchTheMaterial) {
  const PreparedText s(kPlane, 64, 64);
  const std::vector<LightTerm> terms = light_terms(s.prepared);
  ASSERT_EQ(terms.size(), 3u);
  const auto center = [&](const LightTerm& t) { return render_term(s.prepared, t, TermShadow::with, s.workers).at(32, 32).x; };
  const float albedo = render_term(s.prepared, terms[0], TermShadow::with, s.workers).at(32, 32).x / 0.25f;
  EXPECT_EQ(terms[0].name, "ambient");
  EXPECT_EQ(terms[1].name, "diffuse, sun");
  EXPECT_NEAR(center(terms[1]), albedo * 0.5f, 1e-6f);
  EXPECT_EQ(center(terms[2]), 0.0f) << "the background is hidden there";
}

// Terms are rendered separately, so their sum differs from the light of the frame only by rounding: 1e-5 of values around 1.
TEST(Stages, TermsAddUpToTheLight) {
  for (const char* name : {"earth", "day-night", "three-lights", "shadow-knot", "particles", "environment"}) {
    const PreparedText s(SceneFile::open(name).at(0.0), 96, 54);
    Image<glm::vec4> expected(96, 54), sum(96, 54);
    render(s.prepared, expected, s.workers);
    for (const LightTerm& t : light_terms(s.prepared)) {
      const Image<glm::vec4> part = render_term(s.prepared, t, TermShadow::with, s.workers);
      for (std::size_t i = 0; i < part.texels().size(); ++i) sum.data()[i] += part.texels()[i];
    }
    float worst = 0.0f;
    for (std::size_t i = 0; i < sum.texels().size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        const float a = sum.texels()[i][k], b = expected.texels()[i][k];
        worst = std::max(worst, std::fabs(a - b) / std::max(1.0f, std::fabs(b)));
      }
    }
    EXPECT_LT(worst, 1e-5f) << name;
  }
}

glm::vec3 product(const glm::vec3& a, const glm::vec3& b, float factor) { return a * b * factor; }

// The product of the factors differs from the term by rounding: six factors, with a relative error of 1e-6 each and of terms around 1.
TEST(Stages, FactorsOfTheLightMultiplyToTheTerms) {
  int compared = 0;
  for (const char* name : {"shapes", "three-lights", "shadow-knot", "day-night", "particles"}) {
    const PreparedText s(SceneFile::open(name).at(0.0), 96, 54);
    const FrameTrace trace = trace_frame(s.prepared, s.workers);
    s.visit([&](const PassContext& context, const StageGeometry&) {
      const TriangleInspector triangles(context);
      for (int i = 0; i < 96 * 54; i += 7) {
        const glm::ivec2 pixel(i % 96, i / 96);
        for (const TracedFragment& f : trace.at(pixel)) {
          if (!f.is_shaded) continue;
          InspectedTriangle t;
          triangles.find(f.id, t);
          const LightingDetail d =
              lighting_detail(s.prepared.draws[f.draw].shader, {t, {pixel.x, 53 - pixel.y}, kPixelCenter, f.depth}, {});
          for (const LightFactors& l : d.lights) {
            const glm::vec3 diffuse = product(l.diffuse_color, d.albedo * d.diffuse, l.n_l * l.shadow);
            const glm::vec3 specular = product(l.specular_color, d.specular, l.highlight * l.shadow);
            for (int k = 0; k < 3; ++k) {
              EXPECT_NEAR(diffuse[k], l.diffuse[k], 1e-5f * std::max(1.0f, l.diffuse[k])) << name << " " << pixel.x << "," << pixel.y;
              EXPECT_NEAR(specular[k], l.specular[k], 1e-5f * std::max(1.0f, l.specular[k])) << name << " " << pixel.x << "," << pixel.y;
            }
            ++compared;
          }
        }
      }
    });
  }
  EXPECT_GT(compared, 500);
}

TEST(Stages, ToneStepsEndInThePixelValues) {
  const PreparedText s(SceneFile::open("day-night").at(0.0), 96, 54);
  Image<glm::vec4> light(96, 54);
  Image<glm::u8vec4> picture(96, 54);
  render(s.prepared, light, s.workers);
  render(s.prepared, picture, s.workers);
  const StageTone tone = stage_tone(s.prepared, light, s.workers);
  int far_off = 0;
  for (std::size_t i = 0; i < light.texels().size(); ++i) {
    const ToneSteps steps = tone_steps(s.prepared, tone.tone, glm::vec3(light.texels()[i]));
    for (int k = 0; k < 3; ++k) far_off += std::abs(steps.code[k] - int{picture.texels()[i][k]}) > 1;
  }
  EXPECT_EQ(far_off, 0) << "the pass rounds light to half precision, which changes an 8-bit value by at most 1";
}

TEST(Stages, TheHistogramCountsEveryPixel) {
  const PreparedText s(kPlane, 64, 64);
  Image<glm::vec4> light(4, 1);
  light.at(0, 0) = glm::vec4(0.0f);
  light.at(1, 0) = glm::vec4(1.0f);    // first bin of stop 0
  light.at(2, 0) = glm::vec4(1.126f);  // second bin
  light.at(3, 0) = glm::vec4(1e9f);
  const StageTone tone = stage_tone(s.prepared, light, s.workers);
  const auto bin = static_cast<std::size_t>(-kLowStop * kBinsPerStop);
  EXPECT_EQ(tone.histogram[bin], 1u);
  EXPECT_EQ(tone.histogram[bin + 1], 1u);
  EXPECT_EQ(tone.dark, 1u);
  EXPECT_EQ(tone.bright, 1u);
}

// A square of 2 x 2 units hovers one unit above a floor, and the light is vertical.
TEST(Stages, AShadowLookupFindsTheOccluder) {
  const PreparedText s(R"({"version": 1, "cameras": {"c": {"position": [0, 4, 9], "target": [0, 0, 0]}},
    "lights": {"sun": {"direction": [0, 1, 0]}},
    "objects": {"floor": {"shape": "plane", "size": 8}, "lid": {"shape": "plane", "size": 2, "position": [0, 1, 0]}},
    "shadow": {"method": "hard", "resolution": 512}})",
                       96, 64);
  ASSERT_EQ(s.prepared.lights.size(), 1u);
  const Light& light = s.prepared.lights[0].light;
  ASSERT_NE(light.shadow, nullptr);
  const auto at = [&](float x) {
    const glm::vec3 rws = glm::vec3(x, 0.0f, 0.0f) - glm::vec3(s.prepared.view.eye_ws);
    return shadow_lookup(light, rws, {0, 1, 0}, {0, 1, 0}, {0.5f, 0.5f});
  };
  const std::size_t middle = kShadowSide * kShadowSide / 2;
  EXPECT_EQ(at(0.0f).factor, 0.0f);
  EXPECT_EQ(at(0.0f).lit[middle], 0.0f);
  EXPECT_GT(at(0.0f).texels[middle], at(0.0f).biased) << "the lid is nearer to the light";
  EXPECT_EQ(at(3.0f).factor, 1.0f);
  EXPECT_EQ(at(3.0f).lit[middle], 1.0f);
}

// The floor and the lid of the previous test, with any filter.
class ShadowedFloor {
 public:
  explicit ShadowedFloor(const std::string& shadow)
      : scene_(R"({"version": 1, "cameras": {"c": {"position": [0, 4, 9], "target": [0, 0, 0]}},
    "lights": {"sun": {"direction": [0.3, 1, 0.2]}},
    "objects": {"floor": {"shape": "plane", "size": 8}, "lid": {"shape": "plane", "size": 2, "position": [0, 1, 0]}},
    "shadow": {"resolution": 512, )" +
                   shadow + "}}",
               96, 64) {}

  // smooth: the normal of the vertices, if it is not that of the floor.
  ShadowLookup at(float x, float z, const glm::vec3& smooth = glm::vec3(0.0f)) const {
    const glm::vec3 rws = glm::vec3(x, 0.0f, z) - glm::vec3(scene_.prepared.view.eye_ws);
    return shadow_lookup(scene_.prepared.lights[0].light, rws, {0, 1, 0}, {0, 1, 0}, {20.5f, 30.5f}, {smooth, 0.0f});
  }

 private:
  PreparedText scene_;
};

double weighted_sum(const ShadowLookup& s) {
  double sum = 0.0;
  for (std::size_t i = 0; i < s.weights.size(); ++i) sum += double{s.weights[i]} * double{s.lit[i]};
  return sum;
}

// The sum of weight times lit is the factor; and the weights do not depend on what is lit.
TEST(Stages, TheWeightsOfAShadowLookupGiveItsFactor) {
  for (const char* settings :
       {R"("method": "hard")", R"("method": "bilinear")", R"("method": "pcf3")", R"("method": "pcf3", "bias": "original")",
        R"("method": "pcf5")", R"("method": "pcf7")", R"("method": "vogel", "radius": 6)"}) {
    const ShadowedFloor floor(settings);
    int partial = 0;
    for (int i = 0; i < 400; ++i) {
      const ShadowLookup s = floor.at(-1.0f + 0.005f * static_cast<float>(i), 0.013f * static_cast<float>(i % 29));
      ASSERT_EQ(s.view, 0) << settings;
      ASSERT_EQ(s.weights.size(), s.lit.size()) << settings;
      EXPECT_NEAR(std::accumulate(s.weights.begin(), s.weights.end(), 0.0), 1.0, 1e-5) << settings;
      EXPECT_GE(std::ranges::min(s.weights), 0.0f) << settings;
      EXPECT_NEAR(weighted_sum(s), s.filtered, 2e-6) << settings;
      EXPECT_NEAR(weighted_sum(s) * s.terminator, s.factor, 2e-6) << settings;
      partial += s.factor > 0.0f && s.factor < 1.0f ? 1 : 0;
    }
    EXPECT_EQ(partial > 0, settings != std::string_view(R"("method": "hard")")) << settings;
  }
}

// A square of 1 x 1 or 3 x 3 texels around the point, which covers the texels at its sides partially.
TEST(Stages, TheWeightsOfAShadowLookupAreAreas) {
  for (const int width : {1, 3}) {
    const ShadowLookup s = ShadowedFloor(width == 1 ? R"("method": "bilinear")" : R"("method": "pcf3")").at(0.321f, 0.654f);
    const auto covered = [&](int texel, float middle) {
      const float low = std::max(static_cast<float>(texel), middle - 0.5f * static_cast<float>(width));
      return std::max(0.0f, std::min(static_cast<float>(texel) + 1.0f, middle + 0.5f * static_cast<float>(width)) - low);
    };
    for (int j = 0; j < kShadowSide; ++j) {
      for (int i = 0; i < kShadowSide; ++i) {
        const float area = covered(s.i - kShadowReach + i, s.x) * covered(s.j - kShadowReach + j, s.y);
        EXPECT_NEAR(s.weights[static_cast<std::size_t>(j * kShadowSide + i)], area / static_cast<float>(width * width), 1e-6);
      }
    }
  }
}

// Filters that are no sum over the texels shown have no weights. Light that fades where the smooth surface turns away is a factor of its
// own.
TEST(Stages, AShadowLookupWithoutWeights) {
  for (const char* settings : {R"("method": "vsm")", R"("method": "moments")", R"("method": "pcss")", R"("method": "vogel", "radius": 7)"})
    EXPECT_TRUE(ShadowedFloor(settings).at(0.0f, 0.0f).weights.empty()) << settings;
  const ShadowLookup s = ShadowedFloor(R"("method": "pcf5")").at(3.0f, 0.0f, glm::normalize(glm::vec3(-1.0f, 0.5f, 0.0f)));
  EXPECT_EQ(s.filtered, 1.0f);
  EXPECT_GT(s.terminator, 0.0f);
  EXPECT_LT(s.terminator, 1.0f);
  EXPECT_EQ(s.factor, s.filtered * s.terminator);
}

}  // namespace
}  // namespace halfspace
