// SPDX-License-Identifier: Apache-2.0
//
// Targets that are views: rectangles, levels, layers and faces, in either order of rows, and images of all samples. tests/property draws
// random scenes into views and compares stored samples with the oracle.
#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "halfspace/core/texel_codec.h"
#include "halfspace/raster/blit.h"
#include "raster/raster_test.h"
#include "support/throwing_checks.h"

namespace halfspace::raster_test::target_views {
namespace {

constexpr int kEdge = 70;  // tiles at the right and upper border are partial
constexpr std::byte kGuard{0xa5};

const std::vector<glm::vec4>& everywhere() {
  static const std::vector<glm::vec4> positions = full_screen();
  return positions;
}
VertexView whole_target() { return make_vertex_view(stream(everywhere())); }

// The window position as a color, which has no symmetry.
struct PlaceShader : PositionShader {
  float scale = 1.0f;
  explicit PlaceShader(float s = 1.0f) : scale(s) {}
  template <class R>
  Fragment<R> fragment(const NoVaryings<R>&, const Pixel<R>& px) const {
    return {vec4<R>(px.x * scale, px.y * scale, (px.x + px.y * 2.0f) * scale, R(0.75f))};
  }
};

// Triangles that cover parts of the target, and of pixels.
std::vector<glm::vec4> some_triangles(uint64_t seed, int count) {
  Random random(seed);
  std::vector<glm::vec4> p;
  for (int i = 0; i < 3 * count; ++i) p.emplace_back(random.real(-1.2f, 1.2f), random.real(-1.2f, 1.2f), random.real(-0.9f, 0.9f), 1.0f);
  return p;
}

// Memory with a view in the middle.
struct Memory {
  std::vector<std::byte> bytes;
  TexelView view;

  Memory(TexelFormat format, int width, int height, int layers = 1, std::ptrdiff_t padding = 1) {
    const std::ptrdiff_t row_pitch = (width + 7) * std::ptrdiff_t{texel_info(format).bytes} + padding;
    const std::ptrdiff_t layer_pitch = (height + 5) * row_pitch;
    bytes.assign(static_cast<std::size_t>(layers * layer_pitch), kGuard);
    view = TexelView{format, bytes.data(), width + 7, height + 5, layers, row_pitch, layer_pitch}.part(3, 2, width, height);
  }
  bool is_clean_around() const {
    std::vector<std::byte> rest = bytes;
    TexelView inside = view;
    inside.data = rest.data() + (view.data - bytes.data());
    for (int layer = 0; layer < view.layers; ++layer) {
      for (int y = 0; y < view.height; ++y) std::fill_n(inside.at(0, y, layer), view.width * texel_info(view.format).bytes, kGuard);
    }
    return std::ranges::all_of(rest, [](std::byte b) { return b == kGuard; });
  }
};

bool equal(const ConstTexelView& a, const ConstTexelView& b) {
  for (int layer = 0; layer < a.layers; ++layer) {
    for (int y = 0; y < a.height; ++y) {
      if (std::memcmp(a.at(0, y, layer), b.at(0, y, layer), static_cast<std::size_t>(a.width) * texel_info(a.format).bytes) != 0)
        return false;
    }
  }
  return a.width == b.width && a.height == b.height && a.layers == b.layers;
}

template <class F>
void for_each_format(F f) {
  for (std::size_t i = 1; i < kTexelFormats; ++i) f(static_cast<TexelFormat>(i));
}
bool is_real_color(TexelFormat f) { return !is_depth(f) && !is_integer(f) && f != TexelFormat::rgb9_e5; }

TEST(TargetViews, RowZeroIsTheBottomOfTheWindow) {
  Image<glm::vec4> image(kEdge, 50), top_first(kEdge, 50);
  const TexelView view = texel_view(image, TexelFormat::rgba32f);
  Pass pass(kEdge, 50, color_target(view), {});
  pass.draw(PlaceShader(), whole_target());
  pass.run(one_worker());
  Pass other(kEdge, 50, rgba32f_target(top_first), {});
  other.draw(PlaceShader(), whole_target());
  other.run(one_worker());
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < kEdge; ++x) {
      const glm::vec2 center(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      ASSERT_EQ(glm::vec2(decode_texel(TexelFormat::rgba32f, view.at(x, y))), center);
      ASSERT_EQ(glm::vec2(image.at(x, y)), center);
      ASSERT_EQ(pixel(top_first, x, y), image.at(x, y));
    }
  }
  EXPECT_TRUE(equal(view, texel_view(top_first, TexelFormat::rgba32f).flipped()));
  // The reverse of a view is an image that stores the top row first.
  Image<glm::vec4> flipped(kEdge, 50);
  Pass again(kEdge, 50, color_target(texel_view(flipped, TexelFormat::rgba32f).flipped()), {});
  again.draw(PlaceShader(), whole_target());
  again.run(one_worker());
  EXPECT_EQ(flipped, top_first);
}

TEST(TargetViews, TexelsAreTheInverse) {
  Image<glm::u8vec4> image(9, 5);
  const auto same = [](const TexelView& a, const TexelView& b) {
    return a.format == b.format && a.data == b.data && a.width == b.width && a.height == b.height && a.layers == b.layers &&
           a.row_pitch == b.row_pitch && (a.layers == 1 || a.layer_pitch == b.layer_pitch);
  };
  const TexelView view = texel_view(image, TexelFormat::rgba8);
  EXPECT_TRUE(same(target_texels(rgba8_target(image)), view.flipped()));
  EXPECT_TRUE(same(target_texels(color_target(view)), view));
  EXPECT_TRUE(same(target_texels(color_target(view.part(2, 1, 3, 3).flipped())), view.part(2, 1, 3, 3).flipped()));
  Memory layers(TexelFormat::d24s8, 6, 4, 4);
  EXPECT_TRUE(same(target_texels(depth_target(layers.view)), layers.view));
  EXPECT_EQ(depth_target(layers.view).store, StoreOp::store);
  // Images of samples without a pitch follow each other.
  ColorTarget target = rgba8_target(image);
  target.samples = 4;
  EXPECT_EQ(target_texels(target).layer_pitch, 9 * 5 * 4);
}

// Draws into a part of the target, with cleared, loaded and constant tiles; then loads and draws again.
template <class Target>
void draw_twice(Target target, int width, int height, bool flush) {
  const auto draw = [&](uint64_t seed) {
    const std::vector<glm::vec4> p = some_triangles(seed, 3);
    PassOptions options;
    if (flush) options.tuning = {.chunk_triangles = 1, .bin_budget = 1};
    const auto add = [&](Pass& pass, const auto& shader) {
      pass.draw(shader, make_vertex_view(stream(p)), {.scissor = Rect{0, 0, width - 1, std::min(height, 67)}});
      pass.run(two_workers());
    };
    if constexpr (std::is_same_v<Target, DepthTarget>) {
      Pass pass(width, height, ColorTarget{}, target, options);
      pass.draw_depth(PositionShader{}, make_vertex_view(stream(p)));
      pass.run(two_workers());
    } else {
      Pass pass(width, height, target, {}, options);
      if (color_type(target.format) == ColorType::signed_integer) return add(pass, ConstantIntegers<ivec4>(glm::ivec4(5, -6, 7, -8)));
      if (color_type(target.format) == ColorType::unsigned_integer) return add(pass, ConstantIntegers<uvec4>(glm::ivec4(5, 6, 7, 8)));
      add(pass, PlaceShader(0.01f));
    }
  };
  draw(1);
  target.load = LoadOp::load;
  draw(2);
}

TEST(TargetViews, NothingIsWrittenAroundTheView) {
  for_each_format([](TexelFormat format) {
    if (format == TexelFormat::rgb9_e5) return;
    for (const bool flush : {false, true}) {
      for (const bool flip : {false, true}) {
        // All rows of tiles but the first are partly constant.
        Memory memory(format, kEdge, 150);
        std::vector<std::byte> expected(static_cast<std::size_t>(kEdge * 150 * texel_info(format).bytes));
        const TexelView view = flip ? memory.view.flipped() : memory.view;
        if (is_depth(format)) {
          DepthTarget image{.format = format, .data = expected.data(), .width = kEdge, .height = 150, .store = StoreOp::store};
          draw_twice(image, kEdge, 150, false);
          draw_twice(depth_target(view), kEdge, 150, flush);
          EXPECT_TRUE(equal(target_texels(image), view)) << texel_info(format).name;
        } else {
          ColorTarget image{.format = format, .data = expected.data(), .width = kEdge, .height = 150};
          image.clear_value = is_integer(format) ? std::bit_cast<glm::vec4>(glm::ivec4(1, 2, 3, 4)) : glm::vec4(0.1f, 0.2f, 0.3f, 0.4f);
          ColorTarget target = color_target(view);
          target.clear_value = image.clear_value;
          draw_twice(image, kEdge, 150, false);
          draw_twice(target, kEdge, 150, flush);
          EXPECT_TRUE(equal(target_texels(image), view)) << texel_info(format).name;
        }
        EXPECT_TRUE(memory.is_clean_around()) << texel_info(format).name;
      }
    }
  });
}

// Large images are written with streaming stores and filled in long runs, which depends on the alignment and on the pitch.
TEST(TargetViews, LargeImagesAreViewsToo) {
  constexpr int kWidth = 1024, kHeight = 1040;
  for (const int margin : {0, 16, 17}) {
    for (const bool flip : {false, true}) {
      Image<glm::u8vec4> atlas(kWidth + 2 * margin, kHeight + 2), image(kWidth, kHeight);
      std::fill_n(atlas.data(), atlas.texels().size(), glm::u8vec4(0xa5));
      TexelView view = texel_view(atlas, TexelFormat::rgba8).part(margin, 1, kWidth, kHeight);
      if (flip) view = view.flipped();
      const std::vector<glm::vec4> p = some_triangles(3, 2);
      for (const bool constant : {false, true}) {
        for (ColorTarget target : {rgba8_target(image), color_target(view)}) {
          target.clear_value = {0.25f, 0.5f, 0.75f, 1.0f};
          Pass pass(kWidth, kHeight, target, {});
          if (!constant) pass.draw(PlaceShader(1.0f / 1024), make_vertex_view(stream(p)), {.scissor = Rect{0, 0, kWidth, 500}});
          pass.run(two_workers());
        }
        EXPECT_TRUE(equal(target_texels(rgba8_target(image)), view));
      }
      for (int y = 0; y < atlas.height(); ++y) {
        for (int x = 0; x < atlas.width(); ++x) {
          const bool inside = x >= margin && x < margin + kWidth && y >= 1 && y <= kHeight;
          ASSERT_TRUE(inside || atlas.at(x, y) == glm::u8vec4(0xa5));
        }
      }
    }
  }
}

// The levels of a texture follow each other, and its faces are layers of each level.
TEST(TargetViews, LevelsAndFacesAreDrawnIntoOneByOne) {
  constexpr int kFaces = 6;
  std::vector<glm::vec4> texels(kFaces * (64 + 16 + 4 + 1));
  std::vector<TexelView> levels;
  glm::vec4* next = texels.data();
  for (int size = 8; size > 0; size /= 2) {
    const std::ptrdiff_t pitch = size * std::ptrdiff_t{sizeof(glm::vec4)};
    levels.push_back({TexelFormat::rgba32f, reinterpret_cast<std::byte*>(next), size, size, kFaces, pitch, pitch * size});
    next += kFaces * size * size;
  }
  const auto color = [](std::size_t level, int face) { return glm::vec4(static_cast<float>(level), static_cast<float>(face), 2.0f, 3.0f); };
  for (std::size_t l = 0; l < levels.size(); ++l) {
    for (int face = kFaces - 1; face >= 0; --face) {
      Pass pass(levels[l].width, levels[l].height, color_target(levels[l].part_of_layers(face)), {});
      pass.draw(ConstantShader(color(l, face)), whole_target());
      pass.run(one_worker());
    }
  }
  const glm::vec4* texel = texels.data();
  for (std::size_t l = 0; l < levels.size(); ++l) {
    for (int face = 0; face < kFaces; ++face) {
      for (int i = 0; i < levels[l].width * levels[l].height; ++i) EXPECT_EQ(*texel++, color(l, face));
    }
  }
}

TEST(TargetViews, ThePostStepWritesToThem) {
  Image<glm::vec4> from(kEdge, kEdge);
  Memory memory(TexelFormat::rgba32f, kEdge, kEdge);
  Pass pass(kEdge, kEdge, rgba32f_target(from), {});
  pass.draw(PlaceShader(), whole_target());
  pass.post([](auto color) { return color * 0.5f; }, color_target(memory.view));
  pass.run(two_workers());
  for (int y = 0; y < kEdge; ++y) {
    for (int x = 0; x < kEdge; ++x) ASSERT_EQ(decode_texel(TexelFormat::rgba32f, memory.view.at(x, y)), pixel(from, x, y) * 0.5f);
  }
  EXPECT_TRUE(memory.is_clean_around());
}

class TargetViewsMisuse : public ThrowingChecksTest {};

TEST_F(TargetViewsMisuse, RowsAndSamplesThatOverlapAreRefused) {
  Image<glm::u8vec4> image(16, 32);
  ColorTarget target = color_target(texel_view(image, TexelFormat::rgba8).part(0, 0, 16, 8));
  const auto message = [](const ColorTarget& t, int samples = 1) { return failure_of([&] { Pass(16, 8, t, {}, {.samples = samples}); }); };
  EXPECT_EQ(message(target), "");
  for (const std::ptrdiff_t pitch : {63, -63, 1, -1}) {
    ColorTarget narrow = target;
    narrow.row_pitch = pitch;
    EXPECT_NE(message(narrow).find("the row pitch is smaller than a row"), std::string::npos) << pitch;
  }
  target.samples = 4;
  target.sample_pitch = 0;
  EXPECT_EQ(message(target, 4), "");
  for (const int samples : {1, 2, 8}) EXPECT_NE(message(target, samples).find("another number of samples"), std::string::npos);
  target.sample_pitch = 7 * 64;
  EXPECT_NE(message(target, 4).find("the images of its samples or layers overlap"), std::string::npos);
  Image<glm::u8vec4> light(16, 8);
  EXPECT_NE(failure_of([&] {
              Pass pass(16, 8, rgba8_target(light), {}, {.samples = 4});
              ColorTarget to = target;
              to.sample_pitch = 8 * 64;
              pass.post([](auto color) { return color; }, to);
            }).find("another number of samples"),
            std::string::npos);
}

TEST_F(TargetViewsMisuse, TargetsThatShareMemoryAreRefused) {
  Image<uint32_t> image(64, 64);
  const TexelView all = texel_view(image, TexelFormat::rgba8);
  const auto message = [](const ColorTarget& a, const ColorTarget& b) { return failure_of([&] { Pass(16, 8, std::array{a, b}, {}); }); };
  const auto at = [&](int x, int y) { return color_target(all.part(x, y, 16, 8)); };
  for (const bool flip : {false, true}) {
    const auto other = [&](int x, int y) { return flip ? color_target(all.part(x, y, 16, 8).flipped()) : at(x, y); };
    // Rectangles of one atlas, whose rows alternate, are legal exactly if they are disjoint.
    for (int x = 0; x <= 48; ++x) {
      for (int y = 0; y <= 56; ++y) {
        const bool disjoint = x >= 36 || x <= 4 || y >= 28 || y <= 12;
        ASSERT_EQ(message(at(20, 20), other(x, y)).empty(), disjoint) << x << ' ' << y;
      }
    }
  }
  EXPECT_NE(message(at(0, 0), at(0, 0)).find("two targets use the same memory"), std::string::npos);
  // Targets that are only loaded may share memory; nothing is written.
  ColorTarget loaded = at(0, 0);
  loaded.load = LoadOp::load;
  EXPECT_NE(message(at(8, 0), loaded), "");
  loaded.store = StoreOp::dont_care;
  EXPECT_NE(message(at(8, 0), loaded), "");
  EXPECT_EQ(message(loaded, loaded), "");
  TexelView depth = all.part(15, 7, 16, 8);
  depth.format = TexelFormat::d32f;
  EXPECT_NE(failure_of([&] { Pass(16, 8, at(0, 0), depth_target(depth)); }), "");
  EXPECT_EQ(failure_of([&] { Pass(16, 8, at(40, 0), depth_target(depth)); }), "");
  const auto post = [&](ColorTarget from, const ColorTarget& to) {
    return failure_of([&] { Pass(16, 8, from, {}).post([](auto color) { return color; }, to); });
  };
  EXPECT_NE(post(at(0, 0), at(0, 0)), "");
  EXPECT_EQ(post(at(0, 0), at(16, 0)), "");
  EXPECT_EQ(post(loaded, at(0, 0)), "");  // each tile is loaded before it is written
}

// ---- stored samples ----------------------------------------------------------------------------------------------

DrawState sample_state(int sample) {
  DrawState state;
  state.sample_mask = 1u << sample;
  state.depth.compare = CompareOp::always;
  return state;
}

TEST(StoredSamples, LayersAreSamples) {
  for (const int samples : {2, 4, 8}) {
    for (const bool flip : {false, true}) {
      Memory color(TexelFormat::rgba32f, kEdge, 40, samples), depth(TexelFormat::d32f, kEdge, 40, samples);
      const TexelView colors = flip ? color.view.flipped() : color.view, depths = flip ? depth.view.flipped() : depth.view;
      std::vector<std::vector<glm::vec4>> positions;
      for (int s = 0; s < samples; ++s) positions.push_back(full_screen(static_cast<float>(s) / 8.0f));
      Pass pass(kEdge, 40, color_target(colors), depth_target(depths), {.samples = samples});
      for (int s = 0; s < samples; ++s) {
        pass.draw(PlaceShader(static_cast<float>(s + 1)), make_vertex_view(stream(positions[static_cast<std::size_t>(s)])),
                  sample_state(s));
      }
      pass.run(two_workers());
      for (int s = 0; s < samples; ++s) {
        for (int y = 0; y < 40; ++y) {
          for (int x = 0; x < kEdge; ++x) {
            const glm::vec4 c = decode_texel(TexelFormat::rgba32f, colors.at(x, y, s));
            const float scale = static_cast<float>(s + 1);
            ASSERT_EQ(glm::vec2(c), glm::vec2((static_cast<float>(x) + 0.5f) * scale, (static_cast<float>(y) + 0.5f) * scale));
            ASSERT_EQ(decode_texel(TexelFormat::d32f, depths.at(x, y, s)).x, 0.5f + static_cast<float>(s) / 16.0f);
          }
        }
      }
      EXPECT_TRUE(color.is_clean_around() && depth.is_clean_around());
    }
  }
}

TEST(StoredSamples, TwoPassesEqualOne) {
  const std::vector<glm::vec4> first = some_triangles(5, 9), second = some_triangles(6, 9);
  for (const int samples : {2, 4, 8}) {
    for (const TexelFormat format :
         {TexelFormat::rgba8, TexelFormat::srgb8a8, TexelFormat::rgba16f, TexelFormat::rgba32f, TexelFormat::rg16}) {
      for (const PassTuning& tuning : {PassTuning{}, PassTuning{.tile_size = 16, .chunk_triangles = 1, .bin_budget = 1}}) {
        const PassOptions options{.samples = samples, .tuning = tuning};
        DrawState blended;
        blended.blend.emplace();
        Memory expected(format, kEdge, kEdge), actual(format, kEdge, kEdge), stored(format, kEdge, kEdge, samples);
        Memory expected_depth(TexelFormat::d24s8, kEdge, kEdge), depth(TexelFormat::d24s8, kEdge, kEdge);
        Memory stored_depth(TexelFormat::d24s8, kEdge, kEdge, samples);
        Pass one(kEdge, kEdge, color_target(expected.view), depth_target(expected_depth.view), options);
        one.draw(PlaceShader(0.01f), make_vertex_view(stream(first)));
        one.draw(PlaceShader(0.02f), make_vertex_view(stream(second)), blended);
        one.run(two_workers());

        Pass begin(kEdge, kEdge, color_target(stored.view), depth_target(stored_depth.view), options);
        begin.draw(PlaceShader(0.01f), make_vertex_view(stream(first)));
        begin.run(two_workers());
        ColorTarget target = color_target(stored.view);
        DepthTarget depth_loaded = depth_target(stored_depth.view);
        target.load = depth_loaded.load = LoadOp::load;
        Pass end(kEdge, kEdge, target, depth_loaded, options);
        end.draw(PlaceShader(0.02f), make_vertex_view(stream(second)), blended);
        end.run(one_worker());
        resolve(stored.view, actual.view);
        resolve(stored_depth.view, depth.view, ResolveMode::sample_0);
        EXPECT_TRUE(equal(expected.view, actual.view)) << texel_info(format).name << ' ' << samples;
        EXPECT_TRUE(equal(expected_depth.view, depth.view)) << texel_info(format).name << ' ' << samples;

        // A pass without draws resolves what it loads, for example in a post step.
        Memory posted(format, kEdge, kEdge);
        target.store = StoreOp::dont_care;
        Pass last(kEdge, kEdge, target, {}, options);
        last.post([](auto color) { return color; }, color_target(posted.view));
        last.run(two_workers());
        EXPECT_TRUE(equal(expected.view, posted.view)) << texel_info(format).name << ' ' << samples;
      }
    }
  }
}

TEST(StoredSamples, ResolveEqualsTheEndOfAPass) {
  const std::vector<glm::vec4> p = some_triangles(7, 40);
  for_each_format([&](TexelFormat format) {
    if (!is_real_color(format)) return;
    for (const int samples : {1, 2, 4, 8}) {
      Memory expected(format, kEdge, kEdge), stored(format, kEdge, kEdge, samples), actual(format, kEdge, kEdge);
      for (const TexelView& view : {expected.view, stored.view}) {
        ColorTarget target = color_target(view);
        target.clear_value = {0.9f, 0.1f, -0.3f, 0.6f};
        Pass pass(kEdge, kEdge, target, {}, {.samples = samples});
        DrawState state;
        state.sample_shading = true;
        pass.draw(PlaceShader(0.013f), make_vertex_view(stream(p)), state);
        pass.run(two_workers());
      }
      resolve(stored.view, actual.view, ResolveMode::mean, &two_workers());
      EXPECT_TRUE(equal(expected.view, actual.view)) << texel_info(format).name << ' ' << samples;
    }
  });
}

TEST(StoredSamples, DepthResolvesToItsExtremes) {
  Image<DepthStencil> samples(5, 12), result(5, 3);
  Random random(8);
  for (int i = 0; i < 60; ++i) samples.data()[i] = {static_cast<float>(random.below(4)) / 4.0f, static_cast<uint32_t>(i)};
  const std::ptrdiff_t pitch = 5 * sizeof(DepthStencil);
  const TexelView view{TexelFormat::d32fs8, reinterpret_cast<std::byte*>(samples.data()), 5, 3, 4, pitch, 3 * pitch};
  for (const ResolveMode mode : {ResolveMode::min, ResolveMode::max, ResolveMode::sample_0}) {
    resolve(view, texel_view(result, TexelFormat::d32fs8), mode);
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 5; ++x) {
        DepthStencil best = samples.at(x, y);
        for (int s = 1; s < 4; ++s) {
          const DepthStencil& other = samples.at(x, 3 * s + y);
          if ((mode == ResolveMode::min && other.depth < best.depth) || (mode == ResolveMode::max && other.depth > best.depth))
            best = other;
        }
        EXPECT_EQ(result.at(x, y), best);
      }
    }
  }
}

}  // namespace
}  // namespace halfspace::raster_test::target_views
