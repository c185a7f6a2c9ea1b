// SPDX-License-Identifier: Apache-2.0
//
// Passes that sample what earlier passes drew, without a copy and without a flip.
#include <gtest/gtest.h>

#include <cstring>

#include "halfspace/raster/blit.h"
#include "halfspace/raster/pass.h"
#include "halfspace/shading/texture/texture_memory.h"

namespace halfspace {
namespace sampled_targets {
namespace {

constexpr int kWidth = 37, kHeight = 23;
const std::vector<glm::vec2> kFullScreen{{-1, -1}, {3, -1}, {-1, 3}};
// A shape without any symmetry.
const std::vector<glm::vec2> kShape{{-0.9f, -0.7f}, {0.8f, -0.2f}, {-0.4f, 0.6f}};

struct ColorShader {
  template <class R>
  struct Attributes {
    vec2<R> position;
  };
  template <class R>
  struct Varyings {
    vec2<R> place;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.place = in.position;
    return vec4<R>(in.position, in.position.x * R(0.25f) + in.position.y * R(0.125f), R(1.0f));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {vec4<R>(in.place.x * R(0.5f) + R(0.5f), in.place.y * R(0.5f) + R(0.5f), R(0.25f), R(1.0f))};
  }
};

// Copies a texture to the window, with the texture coordinates of OpenGL.
struct CopyShader {
  const Texture2DView* texture;
  template <class R>
  struct Attributes {
    vec2<R> position;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.position * R(0.5f) + vec2<R>(R(0.5f));
    return vec4<R>(in.position, R(0.0f), R(1.0f));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in) const {
    return {texture->sample_level(Sampler{.mag = Filter::nearest, .min = Filter::nearest}, in.uv, R(0.0f))};
  }
};

const Workers& workers() {
  static const Workers instance(2);
  return instance;
}

void draw_shape(const ColorTarget& color, const DepthTarget& depth = {}, int samples = 1) {
  Pass pass(color.width, color.height, color, depth, {.samples = samples});
  pass.draw(ColorShader{}, make_vertex_view(stream(kShape)));
  pass.run(workers());
}

void draw_copy(const Texture2DView& texture, const ColorTarget& target) {
  Pass pass(target.width, target.height, target, {});
  pass.draw(CopyShader{&texture}, make_vertex_view(stream(kFullScreen)));
  pass.run(workers());
}

TEST(SampledTargets, AColorIsSampledWhereItWasDrawn) {
  TextureMemory first(TextureKind::two_d, TexelFormat::rgba8, {kWidth, kHeight}),
      second(TextureKind::two_d, TexelFormat::rgba8, {kWidth, kHeight});
  draw_shape(color_target(first.level()));
  draw_copy(first.view<TextureKind::two_d>(), color_target(second.level()));
  int drawn = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const auto word = [&](TextureMemory& memory) {
        uint32_t v;
        std::memcpy(&v, memory.level().at(x, y), sizeof v);
        return v;
      };
      ASSERT_EQ(word(second), word(first)) << x << " " << y;
      drawn += word(first) != 0;
    }
  }
  EXPECT_GT(drawn, 100);
  // Row 0 is the bottom of the window: the shape begins at y = −0.7, 3.45 rows above it, and ends at y = 0.6.
  const auto covered = [&](int row) {
    for (int x = 0; x < kWidth; ++x) {
      if (first.level().at(x, row)[3] != std::byte{0}) return true;
    }
    return false;
  };
  EXPECT_FALSE(covered(2));
  EXPECT_TRUE(covered(4));
  EXPECT_TRUE(covered(17));
  EXPECT_FALSE(covered(19));
}

TEST(SampledTargets, AnImageIsSampledThroughItsFlippedView) {
  Image<glm::u8vec4> image(kWidth, kHeight), copy(kWidth, kHeight);
  draw_shape(rgba8_target(image));
  draw_copy(Texture2DView(texel_view(image, TexelFormat::rgba8).flipped()), rgba8_target(copy));
  EXPECT_EQ(copy, image);
}

TEST(SampledTargets, LevelsLayersAndFacesAreTargets) {
  Image<glm::u8vec4> expected(16, 16);
  draw_shape(rgba8_target(expected));
  TextureMemory cube(TextureKind::cube, TexelFormat::rgba8, {32, 32, 6}, 2);
  draw_shape(color_target(cube.layer(4, 1)));
  const TextureCubeView view = cube.view<TextureKind::cube>();
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const vec4<float> texel = view.fetch<float>(ivec3<float>(x, y, 4), 1);
      ASSERT_EQ(glm::vec4(texel) * 255.0f, glm::round(glm::vec4(texel) * 255.0f));
      ASSERT_EQ(glm::u8vec4(glm::vec4(texel) * 255.0f), expected.at(x, 15 - y));
      EXPECT_EQ(view.fetch<float>(ivec3<float>(x, y, 3), 1).w, 0.0f);
    }
  }
}

TEST(SampledTargets, DepthIsATextureLikeAnyOther) {
  for (const TexelFormat format : {TexelFormat::d16, TexelFormat::d24, TexelFormat::d32f, TexelFormat::d24s8, TexelFormat::d32fs8}) {
    TextureMemory depth(TextureKind::two_d, format, {kWidth, kHeight}), color(TextureKind::two_d, TexelFormat::rgba8, {kWidth, kHeight});
    draw_shape(color_target(color.level()), depth_target(depth.level()));
    TextureMemory copy(TextureKind::two_d, TexelFormat::r32f, {kWidth, kHeight});
    draw_copy(depth.view<TextureKind::two_d>(), color_target(copy.level()));
    const Texture2DView source = depth.view<TextureKind::two_d>(), result = copy.view<TextureKind::two_d>();
    int nearer = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const float d = source.fetch<float>(ivec3<float>(x, y, 0)).x;
        ASSERT_EQ(result.fetch<float>(ivec3<float>(x, y, 0)).x, d);
        nearer += d < 1.0f;
      }
    }
    EXPECT_GT(nearer, 100) << texel_info(format).name;
  }
}

TEST(SampledTargets, StoredSamplesAreFetched) {
  TextureMemory samples(TextureKind::multisample, TexelFormat::rgba32f, {kWidth, kHeight, 4}),
      resolved(TextureKind::two_d, TexelFormat::rgba32f, {kWidth, kHeight});
  draw_shape(color_target(samples.level()), {}, 4);
  resolve(samples.level(), resolved.level());
  const TextureMultisampleView view = samples.view<TextureKind::multisample>();
  int edges = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      float sum = 0.0f;
      for (int k = 0; k < 4; ++k) sum += view.fetch<float>(ivec3<float>(x, y, k)).w;
      ASSERT_EQ(resolved.view<TextureKind::two_d>().fetch<float>(ivec3<float>(x, y, 0)).w, sum * 0.25f);
      edges += sum != 0.0f && sum != 4.0f;
    }
  }
  EXPECT_GT(edges, 10);
}

// Moves vertices to the positions that a texture holds.
struct FetchShader {
  const Texture2DView* positions;
  template <class R>
  struct Attributes {
    vec2<R> texel;
  };
  template <class R>
  struct Varyings {};
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    const vec4<R> p = positions->fetch<R>(ivec3<R>(truncate_to_int(in.texel.x), truncate_to_int(in.texel.y), IntOf<R>(0)));
    return vec4<R>(p.x, p.y, R(0.0f), R(1.0f));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>&) const {
    return {vec4<R>(R(1.0f))};
  }
};

TEST(SampledTargets, VertexFunctionsReadTextures) {
  TextureMemory positions(TextureKind::two_d, TexelFormat::rg32f, {3, 1});
  for (int i = 0; i < 3; ++i) positions.set(i, 0, 0, 0, glm::vec4(kShape[static_cast<std::size_t>(i)], 0.0f, 0.0f));
  const Texture2DView view = positions.view<TextureKind::two_d>();
  Image<glm::u8vec4> expected(kWidth, kHeight), image(kWidth, kHeight);
  draw_shape(rgba8_target(expected));
  Pass pass(kWidth, kHeight, rgba8_target(image), {});
  const std::vector<glm::vec2> texels{{0, 0}, {1, 0}, {2, 0}};
  pass.draw(FetchShader{&view}, make_vertex_view(stream(texels)));
  pass.run(workers());
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) ASSERT_EQ(image.at(x, y).w, expected.at(x, y).w);
  }
}

}  // namespace
}  // namespace sampled_targets
}  // namespace halfspace
