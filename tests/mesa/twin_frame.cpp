// SPDX-License-Identifier: Apache-2.0
#include "mesa/twin_frame.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string>

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "mesa/mesa_state.h"

namespace halfspace::test {

namespace {

GLenum gl_target(TextureKind kind) {
  switch (kind) {
    case TextureKind::one_d: return GL_TEXTURE_1D;
    case TextureKind::two_d: return GL_TEXTURE_2D;
    case TextureKind::rectangle: return GL_TEXTURE_RECTANGLE;
    case TextureKind::three_d: return GL_TEXTURE_3D;
    case TextureKind::one_d_array: return GL_TEXTURE_1D_ARRAY;
    case TextureKind::two_d_array: return GL_TEXTURE_2D_ARRAY;
    case TextureKind::cube: return GL_TEXTURE_CUBE_MAP;
    case TextureKind::cube_array: return GL_TEXTURE_CUBE_MAP_ARRAY;
    default: throw std::runtime_error("TwinTexture: there is no upload for this kind");
  }
}
bool has_flat_storage(TextureKind kind) {
  return kind == TextureKind::two_d || kind == TextureKind::rectangle || kind == TextureKind::cube;
}

// Format and type of texels in memory, for formats with 8, 16 or 32 bits per channel and for d32f.
struct Layout {
  GLenum format, type;
};
Layout layout_of(TexelFormat f) {
  if (f == TexelFormat::d32f) return {GL_DEPTH_COMPONENT, GL_FLOAT};
  const TexelInfo& info = texel_info(f);
  constexpr std::array<GLenum, 4> formats{GL_RED, GL_RG, GL_RGB, GL_RGBA};
  const bool floats = info.kind == TexelKind::floats;
  if (info.bits == 0 || !(floats || info.kind == TexelKind::unorm || info.kind == TexelKind::srgb))
    throw std::runtime_error("TwinTexture: there is no upload for this format");
  return {formats[static_cast<std::size_t>(info.channels - 1)], static_cast<GLenum>(info.bits == 8    ? GL_UNSIGNED_BYTE
                                                                                    : info.bits == 32 ? GL_FLOAT
                                                                                    : floats          ? GL_HALF_FLOAT
                                                                                                      : GL_UNSIGNED_SHORT)};
}

GLint gl_filter(Filter f) {
  constexpr std::array<GLint, 6> names{
      GL_NEAREST, GL_LINEAR, GL_LINEAR_MIPMAP_LINEAR, GL_NEAREST_MIPMAP_NEAREST, GL_LINEAR_MIPMAP_NEAREST, GL_NEAREST_MIPMAP_LINEAR};
  return names[static_cast<std::size_t>(f)];
}
GLint gl_wrap(Wrap w) {
  constexpr std::array<GLint, 5> names{GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER, GL_MIRROR_CLAMP_TO_EDGE};
  return names[static_cast<std::size_t>(w)];
}

std::vector<ColorTarget> color_targets(const std::vector<TwinTarget>& targets) {
  std::vector<ColorTarget> colors;
  for (const TwinTarget& t : targets) {
    colors.push_back(color_target(t.texture.ours().layer(t.layer)));
    colors.back().clear_value = t.clear;
  }
  return colors;
}
DepthTarget depth_target_of(const std::optional<TwinTarget>& t) {
  if (!t) return {};
  DepthTarget target = depth_target(t->texture.ours().layer(t->layer));
  target.clear_value = t->clear.x;
  return target;
}
const TextureSize& size_of(const std::vector<TwinTarget>& colors, const std::optional<TwinTarget>& depth) {
  return colors.empty() ? depth->texture.size() : colors[0].texture.size();
}

}  // namespace

TwinTexture::TwinTexture(TextureKind kind, TexelFormat format, const TextureSize& size, int levels)
    : memory_(kind, format, size, levels), format_(format), size_(size) {
  glCreateTextures(gl_target(kind), 1, &id_);
  if (has_flat_storage(kind)) {
    glTextureStorage2D(id_, levels, test::gl(format), size.width, size.height);
  } else {
    glTextureStorage3D(id_, levels, test::gl(format), size.width, size.height, size.depth);
  }
  expect_no_error();
}

TwinTexture::~TwinTexture() { glDeleteTextures(1, &id_); }

void TwinTexture::upload() {
  const auto [format, type] = layout_of(format_);
  const bool flat = has_flat_storage(memory_.kind()) && memory_.kind() != TextureKind::cube;
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (int k = 0; k < memory_.levels(); ++k) {
    const TexelView level = memory_.level(k);
    for (int layer = 0; layer < level.layers; ++layer) {
      for (int y = 0; y < level.height; ++y) {
        if (flat) {
          glTextureSubImage2D(id_, k, 0, y, level.width, 1, format, type, level.at(0, y, layer));
        } else {
          glTextureSubImage3D(id_, k, 0, y, layer, level.width, 1, 1, format, type, level.at(0, y, layer));
        }
      }
    }
  }
  expect_no_error();
}

void UniformSetter::operator()(const char* name, const TwinTexture& texture, const Sampler& sampler, bool compares) const {
  const auto set = [&](GLenum what, GLint value) { glTextureParameteri(texture.mesa(), what, value); };
  set(GL_TEXTURE_MAG_FILTER, gl_filter(sampler.mag));
  set(GL_TEXTURE_MIN_FILTER, gl_filter(sampler.min));
  set(GL_TEXTURE_WRAP_S, gl_wrap(sampler.wrap_s));
  set(GL_TEXTURE_WRAP_T, gl_wrap(sampler.wrap_t));
  set(GL_TEXTURE_WRAP_R, gl_wrap(sampler.wrap_r));
  glTextureParameterfv(texture.mesa(), GL_TEXTURE_BORDER_COLOR, &sampler.border_color.x);
  set(GL_TEXTURE_COMPARE_MODE, compares ? GL_COMPARE_REF_TO_TEXTURE : GL_NONE);
  set(GL_TEXTURE_COMPARE_FUNC, static_cast<GLint>(halfspace::gl(sampler.compare)));
  glBindTextureUnit(units_, texture.mesa());
  (*this)(name, static_cast<int>(units_++));
}

TwinStage::TwinStage(std::vector<TwinTarget> colors, std::optional<TwinTarget> depth)
    : colors_(std::move(colors)),
      depth_(depth),
      pass_(size_of(colors_, depth_).width, size_of(colors_, depth_).height, color_targets(colors_), depth_target_of(depth_)) {}

void TwinStage::add_to_mesa(const char* vertex_glsl, const char* fragment_glsl, const VertexView& vertices,
                            const std::vector<uint32_t>& indices, const std::function<void(const UniformSetter&)>& set,
                            const DrawState& state) {
  static constexpr const char* kNothingShared = "";
  mesa_draws_.push_back({kNothingShared, vertex_glsl, fragment_glsl, set, vertices, indices, state});
  std::vector<uint32_t>& list = mesa_draws_.back().indices;
  if (list.empty()) {
    for (std::size_t i = 0; i < vertices.vertex_count; ++i) list.push_back(static_cast<uint32_t>(i));
  }
}

void TwinStage::run() {
  pass_.run(Workers(1));

  GLuint framebuffer = 0;
  glCreateFramebuffers(1, &framebuffer);
  const auto attach = [&](GLenum place, const TwinTarget& t) {
    if (t.texture.ours().kind() == TextureKind::two_d) {
      glNamedFramebufferTexture(framebuffer, place, t.texture.mesa(), 0);
    } else {
      glNamedFramebufferTextureLayer(framebuffer, place, t.texture.mesa(), 0, t.layer);
    }
  };
  std::vector<GLenum> places;
  for (const TwinTarget& t : colors_) {
    places.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(places.size()));
    attach(places.back(), t);
  }
  if (depth_) attach(GL_DEPTH_ATTACHMENT, *depth_);
  glNamedFramebufferDrawBuffers(framebuffer, static_cast<GLsizei>(places.size()), places.data());
  if (glCheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("the framebuffer is incomplete");
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_DITHER);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  for (std::size_t i = 0; i < colors_.size(); ++i) glClearBufferfv(GL_COLOR, static_cast<GLint>(i), &colors_[i].clear.x);
  if (depth_) glClearBufferfv(GL_DEPTH, 0, &depth_->clear.x);
  const TextureSize size = size_of(colors_, depth_);
  const TargetSpec target{.width = size.width, .height = size.height};
  MesaPrograms programs;
  for (const MesaDraw& draw : mesa_draws_) test::run(draw, target, programs);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &framebuffer);
  expect_no_error();
}

void expect_same_picture(TwinTexture& texture, const PictureTolerance& tolerance, std::size_t colors) {
  ASSERT_EQ(texture.format(), TexelFormat::rgba8);
  const auto [width, height, depth] = texture.size();
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  std::vector<glm::u8vec4> mesa(pixels), ours(pixels);
  glGetTextureImage(texture.mesa(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(pixels * sizeof(glm::u8vec4)), mesa.data());
  expect_no_error();
  const TexelView view = texture.ours().level();
  for (int y = 0; y < height; ++y)
    std::memcpy(&ours[static_cast<std::size_t>(y * width)], view.at(0, y), static_cast<std::size_t>(width) * sizeof(glm::u8vec4));

  std::set<uint32_t> our_colors, mesa_colors;
  int64_t beyond = 0, differing = 0;
  int worst = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    int d = 0;
    for (int k = 0; k < 4; ++k) d = std::max(d, std::abs(int{ours[i][k]} - int{mesa[i][k]}));
    differing += d > 0;
    beyond += d > tolerance.codes;
    if (d > tolerance.codes && std::getenv("HALFSPACE_MESA_PIXELS") != nullptr)
      std::printf("    x %zu y %zu: Halfspace %d,%d,%d  Mesa %d,%d,%d\n", i % static_cast<std::size_t>(width),
                  i / static_cast<std::size_t>(width), ours[i].x, ours[i].y, ours[i].z, mesa[i].x, mesa[i].y, mesa[i].z);
    worst = std::max(worst, d);
    const auto code = [](const glm::u8vec4& c) { return c.x | uint32_t{c.y} << 8 | uint32_t{c.z} << 16; };
    our_colors.insert(code(ours[i]));
    mesa_colors.insert(code(mesa[i]));
  }
  const double share = static_cast<double>(beyond) / static_cast<double>(pixels);
  std::printf(
      "  %zu colors, %zu by Mesa; %lld of %zu pixels differ, %lld (%.3f%%) by more than %d codes, at most by %d; bound %.3f%%: %s\n",
      our_colors.size(), mesa_colors.size(), static_cast<long long>(differing), pixels, static_cast<long long>(beyond), 100.0 * share,
      tolerance.codes, worst, 100.0 * tolerance.share, tolerance.reason);
  EXPECT_GE(our_colors.size(), colors);
  EXPECT_GE(mesa_colors.size(), colors);
  EXPECT_LE(share, tolerance.share);
}

}  // namespace halfspace::test
