// SPDX-License-Identifier: Apache-2.0
//
// Passes with eight color attachments of different formats, drawn by Halfspace and by Mesa.
#include <cmath>
#include <cstdio>

#include <epoxy/gl.h>

#include "mesa/mesa_context.h"
#include "mesa/texel_tolerance.h"
#include "mesa/twin_frame.h"

namespace halfspace::test {
namespace attachments {
namespace {

constexpr int kSize = 32;

/// Four real colors, two of signed integers and two of unsigned ones. place: in pixels.
struct EightColors {
  template <class R>
  struct Attributes {
    vec4<R> pos_clip;
    vec2<R> place;
  };
  template <class R>
  struct Varyings {
    vec2<R> place;
  };
  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.place = in.place;
    return in.pos_clip;
  }
  static constexpr const char* kVertexGlsl = R"(#version 450 core
    layout(location = 0) in vec4 pos_clip;
    layout(location = 1) in vec2 in_place;
    out vec2 place;
    void main() {
      place = in_place;
      gl_Position = pos_clip;
    })";

  template <class R>
  TypedFragment<R, vec4<R>, vec4<R>, vec4<R>, vec4<R>, ivec4<R>, ivec4<R>, uvec4<R>, uvec4<R>> fragment(const Varyings<R>& in) const {
    const R s = in.place.x * R(1.0f / 32.0f), t = in.place.y * R(1.0f / 32.0f);
    const vec4<R> a(s, t, s * t, R(1.0f) - s), b(s * R(2.0f) - R(0.5f), R(0.5f) - t, s - t, t);
    const ivec2<R> i(in.place);
    const IntOf<R> x = i.x, y = i.y;
    const ivec4<R> c(x, y - IntOf<R>(20), x - y, (x ^ y) & IntOf<R>(3));
    const ivec4<R> d(x + y, x, y, x & IntOf<R>(3));
    return {{a, b, a, b, c, c, uvec4<R>(d), uvec4<R>(d)}};
  }
  static constexpr const char* kFragmentGlsl = R"(#version 450 core
    in vec2 place;
    layout(location = 0) out vec4 color_0;
    layout(location = 1) out vec4 color_1;
    layout(location = 2) out vec4 color_2;
    layout(location = 3) out vec4 color_3;
    layout(location = 4) out ivec4 color_4;
    layout(location = 5) out ivec4 color_5;
    layout(location = 6) out uvec4 color_6;
    layout(location = 7) out uvec4 color_7;
    void main() {
      float s = place.x * (1.0 / 32.0), t = place.y * (1.0 / 32.0);
      color_0 = color_2 = vec4(s, t, s * t, 1.0 - s);
      color_1 = color_3 = vec4(s * 2.0 - 0.5, 0.5 - t, s - t, t);
      int x = int(place.x), y = int(place.y);
      color_4 = color_5 = ivec4(x, y - 20, x - y, (x ^ y) & 3);
      color_6 = color_7 = uvec4(x + y, x, y, x & 3);
    })";
};

void expect_same_texels(const TwinTexture& texture) {
  const TexelFormat format = texture.format();
  const Texture2DView view = texture.view<TextureKind::two_d>();
  constexpr std::size_t pixels = std::size_t{kSize} * kSize;
  std::vector<glm::dvec4> mesa(pixels);
  const auto read = [&](auto values, GLenum layout, GLenum type) {
    glGetTextureImage(texture.mesa(), 0, layout, type, static_cast<GLsizei>(pixels * sizeof(values[0])), values.data());
    for (std::size_t i = 0; i < pixels; ++i) mesa[i] = glm::dvec4(values[i]);
  };
  const ColorType type = color_type(format);
  if (type == ColorType::real) read(std::vector<glm::vec4>(pixels), GL_RGBA, GL_FLOAT);
  if (type == ColorType::signed_integer) read(std::vector<glm::ivec4>(pixels), GL_RGBA_INTEGER, GL_INT);
  if (type == ColorType::unsigned_integer) read(std::vector<glm::uvec4>(pixels), GL_RGBA_INTEGER, GL_UNSIGNED_INT);
  expect_no_error();
  int differing = 0;
  double worst = 0.0;
  glm::dvec4 low(INFINITY), high(-INFINITY);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const ivec3<float> at(x, y, 0);
      glm::dvec4 ours(glm::vec4(type == ColorType::real ? view.fetch<float>(at) : vec4<float>(0.0f)));
      if (type != ColorType::real) {
        const ivec4<float> v = view.fetch_integers<float>(at);
        ours = glm::dvec4(v.x, v.y, v.z, v.w);
      }
      const glm::dvec4& other = mesa[static_cast<std::size_t>(y * kSize + x)];
      for (int k = 0; k < texel_info(format).channels; ++k) {
        const double difference = std::fabs(ours[k] - other[k]);
        worst = std::max(worst, difference);
        differing += !(difference <= texel_tolerance(format, k, ours[k]));
      }
      low = glm::min(low, ours);
      high = glm::max(high, ours);
    }
  }
  std::printf("  %.*s: the largest difference is %.3g\n", static_cast<int>(texel_info(format).name.size()), texel_info(format).name.data(),
              worst);
  EXPECT_EQ(differing, 0) << texel_info(format).name;
  EXPECT_GT(high.x, low.x) << texel_info(format).name;
}

class MesaAttachments : public MesaTest {};

TEST_F(MesaAttachments, EightOfAllFormatsAgree) {
  using enum TexelFormat;
  // Without the sRGB formats, which tests/mesa/shading_test.cpp draws.
  constexpr TexelFormat reals[] = {r8,   rg8,    rgb8,      rgba8,      r8_snorm,       rg8_snorm, rgba8_snorm, r16,
                                   rg16, rgba16, r16_snorm, rg16_snorm, rgba16_snorm,   r16f,      rg16f,       rgba16f,
                                   r32f, rg32f,  rgba32f,   rgb10_a2,   r11f_g11f_b10f, rgb565,    rgb5_a1,     rgba4};
  constexpr TexelFormat sints[] = {r8i, rg8i, rgba8i, r16i, rg16i, rgba16i, r32i, rg32i, rgba32i};
  constexpr TexelFormat uints[] = {r8ui, rg8ui, rgba8ui, r16ui, rg16ui, rgba16ui, r32ui, rg32ui, rgba32ui, rgb10_a2ui};
  struct Row {
    glm::vec4 pos_clip;
    glm::vec2 place;
  };
  constexpr float kAll = 2.0f * kSize;
  const std::vector<Row> rows{
      {{-1.0f, -1.0f, 0.0f, 1.0f}, {0.0f, 0.0f}}, {{3.0f, -1.0f, 0.0f, 1.0f}, {kAll, 0.0f}}, {{-1.0f, 3.0f, 0.0f, 1.0f}, {0.0f, kAll}}};
  const VertexView vertices = make_vertex_view(stream(rows, &Row::pos_clip), stream(rows, &Row::place));
  for (std::size_t first = 0; first < std::size(reals); first += 4) {
    std::vector<std::unique_ptr<TwinTexture>> textures;
    const auto add = [&](TexelFormat f) {
      textures.push_back(std::make_unique<TwinTexture>(TextureKind::two_d, f, TextureSize{kSize, kSize, 1}));
    };
    for (std::size_t k = 0; k < 4; ++k) add(reals[(first + k) % std::size(reals)]);
    for (std::size_t k = 0; k < 2; ++k) add(sints[(first / 2 + k) % std::size(sints)]);
    for (std::size_t k = 0; k < 2; ++k) add(uints[(first / 2 + k) % std::size(uints)]);
    std::vector<TwinTarget> targets;
    for (const auto& t : textures) targets.push_back({*t});
    TwinStage stage(targets);
    stage.draw(EightColors{}, EightColors::kVertexGlsl, EightColors::kFragmentGlsl, vertices, {}, [](const UniformSetter&) {});
    stage.run();
    for (const auto& t : textures) expect_same_texels(*t);
  }
}

}  // namespace
}  // namespace attachments
}  // namespace halfspace::test
