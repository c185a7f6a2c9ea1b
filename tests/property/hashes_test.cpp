// SPDX-License-Identifier: Apache-2.0
//
// Hashes of the pixels of fixed scenes, which must be equal for every compiler, lane width, instruction set (x86-64-v3 and later) and
// optimization level.
#include <gtest/gtest.h>

#include "property/random_scene.h"
#include "support/expected_hash.h"
#include "support/hash.h"
#include "support/test_output.h"

namespace halfspace {

namespace {

uint64_t hash_of(const Pictures& p) {
  Hash hash;
  for (const auto* bytes : {&p.color, &p.depth, &p.post}) {
    for (const std::byte b : *bytes) hash.add(std::to_integer<uint64_t>(b));
  }
  return hash.value();
}

struct NamedScene {
  std::string name;
  Scene scene;
};

Scene blank(ColorFormat color, DepthFormat depth) {
  Scene s;
  s.width = 157;
  s.height = 101;
  s.color.format = color;
  s.depth.format = depth;
  s.color.clear_value = glm::vec4(0.1f, 0.2f, 0.4f, 1.0f);
  return s;
}

template <class S>
void add(Scene& scene, const S& shader, const DrawState& state, uint64_t seed, std::initializer_list<Kind> kinds) {
  using A = typename S::template Attributes<float>;
  Random random(seed);
  Geometry g;
  const Rect viewport = viewport_of(scene, state);
  for (const Kind kind : kinds) add_triangles(kind, viewport, state.depth.clip, random, g);
  std::vector<A> rows;
  for (const glm::vec4& p : g.positions) {
    std::array<float, kComponents<A>> row{};
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = k < 4 ? p[static_cast<int>(k)] : random.real(0.0f, 1.0f);
    rows.push_back(from_components<A, float>(row));
  }
  scene.draws.push_back(make_draw(shader, "", std::move(rows), g.indices, state, VertexLayout::tight, IndexLayout::wide));
}

constexpr std::initializer_list<Kind> kEasy{Kind::whole_target, Kind::tiny, Kind::small, Kind::medium, Kind::medium, Kind::mesh, Kind::fan};
constexpr std::initializer_list<Kind> kHard{Kind::whole_target,   Kind::huge,  Kind::beyond_guard,   Kind::sliver,
                                            Kind::behind_the_eye, Kind::steep, Kind::crossing_depth, Kind::fan};

void add_formats(std::vector<NamedScene>& out) {
  const std::pair<ColorFormat, const char*> colors[] = {{ColorFormat::rgba8, "rgba8"},
                                                        {ColorFormat::srgb8a8, "srgb8a8"},
                                                        {ColorFormat::rgba16f, "rgba16f"},
                                                        {ColorFormat::rgba32f, "rgba32f"}};
  const std::pair<DepthFormat, const char*> depths[] = {{DepthFormat::d16, "d16"}, {DepthFormat::d24, "d24"}, {DepthFormat::d32f, "d32f"}};
  for (const auto& [color, color_name] : colors) {
    for (const auto& [depth, depth_name] : depths) {
      Scene s = blank(color, depth);
      add(s, ColorShader{}, {.depth = {.compare = CompareOp::less_equal}}, 1, kEasy);
      add(s, MixedShader{}, {}, 2, kHard);
      DrawState blended;
      blended.blend.emplace();
      add(s, DerivativeShader{}, blended, 3, {Kind::medium, Kind::fan, Kind::steep});
      out.push_back({std::string(color_name) + "-" + depth_name, s});
    }
  }
}

void add_states(std::vector<NamedScene>& out) {
  const auto scene = [&out](const char* name, ColorFormat color, DepthFormat depth, auto fill) {
    Scene s = blank(color, depth);
    fill(s);
    out.push_back({name, s});
  };
  const DepthState reversed{.compare = CompareOp::greater, .clip = ClipDepth::zero_to_one};
  scene("reversed-z", ColorFormat::rgba32f, DepthFormat::d32f, [&](Scene& s) {
    s.depth.clear_value = 0.0f;
    add(s, ColorShader{}, {.depth = reversed}, 4, kEasy);
    add(s, PixelShader{}, {.depth = reversed, .offset = {.slope = 1.0f, .constant = 3.0f}}, 5, kHard);
  });
  scene("culling-and-windings", ColorFormat::rgba8, DepthFormat::d24, [](Scene& s) {
    add(s, MixedShader{}, {.cull = CullMode::back}, 6, kEasy);
    add(s, MixedShader{}, {.cull = CullMode::front, .front = Winding::clockwise, .provoking = ProvokingVertex::first}, 7, kHard);
  });
  scene("viewport-and-scissor", ColorFormat::srgb8a8, DepthFormat::d32f, [](Scene& s) {
    add(s, ColorShader{}, {.viewport = Rect{-20, 13, 150, 70}, .scissor = Rect{9, 9, 90, 60}}, 8, kHard);
    add(s, PixelShader{}, {.viewport = Rect{100, 50, 80, 80}}, 9, kEasy);
  });
  scene("depth-clamp-and-range", ColorFormat::rgba16f, DepthFormat::d16, [](Scene& s) {
    add(s, ColorShader{}, {.depth = {.clamp = true, .range_near = 0.8f, .range_far = 0.3f}}, 10, kHard);
    add(s, ColorShader{}, {.depth = {.compare = CompareOp::greater_equal, .range_near = 0.25f}}, 11, kEasy);
  });
  scene("polygon-offset", ColorFormat::rgba8, DepthFormat::d32f, [](Scene& s) {
    add(s, ColorShader{}, {}, 12, kEasy);
    add(s, PixelShader{}, {.offset = {.slope = -1.5f, .constant = -4.0f, .clamp = -0.02f}}, 12, kEasy);
  });
  scene("equal-after-less", ColorFormat::rgba32f, DepthFormat::d24, [](Scene& s) {
    add(s, ColorShader{}, {}, 13, kHard);
    add(s, DerivativeShader{}, {.depth = {.compare = CompareOp::equal}}, 13, kHard);
  });
  scene("discard", ColorFormat::srgb8a8, DepthFormat::d32f, [](Scene& s) {
    add(s, CutoutShader<false>{}, {}, 14, kEasy);
    add(s, CutoutShader<true>{}, {}, 15, kHard);
  });
  scene("depth-writing", ColorFormat::rgba8, DepthFormat::d24, [](Scene& s) {
    add(s, BumpShader<false>{}, {}, 16, kEasy);
    add(s, BumpShader<true>{}, {}, 17, kHard);
  });
  scene("faces", ColorFormat::rgba32f, DepthFormat::d32f, [](Scene& s) {
    add(s, FaceShader{}, {}, 18, kEasy);
    add(s, FaceCutoutShader{}, {.provoking = ProvokingVertex::first}, 19, kHard);
  });
  scene("blend-factors", ColorFormat::rgba16f, DepthFormat::none, [](Scene& s) {
    for (int f = 0; f < 10; ++f) {
      const auto factor = static_cast<BlendFactor>(f), other = static_cast<BlendFactor>(9 - f);
      DrawState state;
      state.blend = BlendState{BlendEquation::add, factor, other, BlendEquation::add, other, factor};
      add(s, ColorShader{}, state, static_cast<uint64_t>(20 + f), {Kind::whole_target, Kind::medium});
    }
  });
  scene("blend-equations", ColorFormat::rgba8, DepthFormat::none, [](Scene& s) {
    for (int e = 0; e < 5; ++e) {
      DrawState state;
      state.blend = BlendState{static_cast<BlendEquation>(e),     BlendFactor::one, BlendFactor::one,
                               static_cast<BlendEquation>(4 - e), BlendFactor::one, BlendFactor::one};
      add(s, ColorShader{}, state, static_cast<uint64_t>(30 + e), {Kind::medium, Kind::huge, Kind::medium});
    }
  });
  scene("post", ColorFormat::rgba32f, DepthFormat::d32f, [](Scene& s) {
    s.has_color_image = false;
    s.post_format = ColorFormat::srgb8a8;
    add(s, ColorShader{.brightness = 8.0f}, {}, 40, kEasy);
    add(s, MixedShader{}, {}, 41, kHard);
  });
  scene("depth-only", ColorFormat::none, DepthFormat::d32f, [](Scene& s) { add(s, DepthShader{}, {}, 42, kHard); });
}

std::vector<NamedScene> all_scenes() {
  std::vector<NamedScene> scenes;
  add_formats(scenes);
  add_states(scenes);
  return scenes;
}

TEST(Hashes, PixelsMatchTheCommittedHashes) {
  for (const NamedScene& s : all_scenes()) {
    const Pictures pictures = run_pass(s.scene, {}, 2).pictures;
    EXPECT_TRUE(expect_hash(s.name, hash_of(pictures)))
        << write_failed_picture(s.name, codes_of(s.scene, pictures), codes_of(s.scene, run_oracle(s.scene).pictures));
  }
  expect_no_other_hashes();
}

TEST(Hashes, ScenesMatchTheOracle) {
  for (const NamedScene& s : all_scenes()) {
    EXPECT_EQ(difference(s.scene, run_oracle(s.scene).pictures, run_pass(s.scene, {}, 2).pictures), "") << s.name;
  }
}

}  // namespace

}  // namespace halfspace
