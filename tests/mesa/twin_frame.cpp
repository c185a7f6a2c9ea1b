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

// Format and type of texels in memory.
struct Layout {
  GLenum format, type;
};
Layout layout_of(TexelFormat f) {
  switch (f) {
    case TexelFormat::rgb565: return {GL_RGB, GL_UNSIGNED_SHORT_5_6_5};
    case TexelFormat::rgb5_a1: return {GL_RGBA, GL_UNSIGNED_SHORT_5_5_5_1};
    case TexelFormat::rgba4: return {GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4};
    case TexelFormat::rgb10_a2: return {GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV};
    case TexelFormat::rgb10_a2ui: return {GL_RGBA_INTEGER, GL_UNSIGNED_INT_2_10_10_10_REV};
    case TexelFormat::r11f_g11f_b10f: return {GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV};
    case TexelFormat::rgb9_e5: return {GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV};
    case TexelFormat::d16: return {GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT};
    case TexelFormat::d24: return {GL_DEPTH_COMPONENT, GL_UNSIGNED_INT};  // see row_of
    case TexelFormat::d32f: return {GL_DEPTH_COMPONENT, GL_FLOAT};
    case TexelFormat::d24s8: return {GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8};
    case TexelFormat::d32fs8: return {GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV};
    default: break;
  }
  const TexelInfo& info = texel_info(f);
  constexpr std::array<GLenum, 4> formats{GL_RED, GL_RG, GL_RGB, GL_RGBA},
      integer_formats{GL_RED_INTEGER, GL_RG_INTEGER, GL_RGB_INTEGER, GL_RGBA_INTEGER};
  const auto channels = static_cast<std::size_t>(info.channels - 1);
  const bool is_signed = info.kind == TexelKind::snorm || info.kind == TexelKind::sints, floats = info.kind == TexelKind::floats;
  const auto type = [&]() -> GLenum {
    if (floats) return info.bits == 16 ? GL_HALF_FLOAT : GL_FLOAT;
    if (info.bits == 8) return is_signed ? GL_BYTE : GL_UNSIGNED_BYTE;
    if (info.bits == 16) return is_signed ? GL_SHORT : GL_UNSIGNED_SHORT;
    return is_signed ? GL_INT : GL_UNSIGNED_INT;
  };
  return {(is_integer(f) ? integer_formats : formats)[channels], type()};
}
// Returns a row of texels as OpenGL expects them. Depths of 24 bits are the high bits of a word there, and the low bits here.
const void* row_of(const TexelView& level, int y, int layer, std::vector<uint32_t>& converted) {
  if (level.format != TexelFormat::d24) return level.at(0, y, layer);
  converted.resize(static_cast<std::size_t>(level.width));
  std::memcpy(converted.data(), level.at(0, y, layer), converted.size() * sizeof(uint32_t));
  for (uint32_t& word : converted) word = word << 8 | (word >> 16 & 255);
  return converted.data();
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
  glCreateTextures(test::gl(kind), 1, &id_);
  const GLenum f = test::gl(format);
  switch (kind) {
    case TextureKind::one_d: glTextureStorage1D(id_, levels, f, size.width); break;
    case TextureKind::two_d:
    case TextureKind::rectangle:
    case TextureKind::cube: glTextureStorage2D(id_, levels, f, size.width, size.height); break;
    case TextureKind::one_d_array: glTextureStorage2D(id_, levels, f, size.width, size.depth); break;
    case TextureKind::multisample: glTextureStorage2DMultisample(id_, size.depth, f, size.width, size.height, GL_TRUE); break;
    default: glTextureStorage3D(id_, levels, f, size.width, size.height, size.depth);
  }
  expect_no_error();
}

TwinTexture::~TwinTexture() { glDeleteTextures(1, &id_); }

void TwinTexture::upload() {
  const auto [format, type] = layout_of(format_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  std::vector<uint32_t> converted;
  for (int k = 0; k < memory_.levels(); ++k) {
    const TexelView level = memory_.level(k);
    for (int layer = 0; layer < level.layers; ++layer) {
      for (int y = 0; y < level.height; ++y) {
        const void* row = row_of(level, y, layer, converted);
        switch (memory_.kind()) {
          case TextureKind::one_d: glTextureSubImage1D(id_, k, 0, level.width, format, type, row); break;
          case TextureKind::two_d:
          case TextureKind::rectangle: glTextureSubImage2D(id_, k, 0, y, level.width, 1, format, type, row); break;
          case TextureKind::one_d_array: glTextureSubImage2D(id_, k, 0, layer, level.width, 1, format, type, row); break;
          case TextureKind::multisample: throw std::runtime_error("TwinTexture: OpenGL has no upload of multisample textures");
          default: glTextureSubImage3D(id_, k, 0, y, layer, level.width, 1, 1, format, type, row);
        }
      }
    }
  }
  expect_no_error();
}

void TwinTexture::download(TextureMemory& texels) const {
  const auto [format, type] = layout_of(format_);
  const TexelView level = texels.level();
  const std::size_t row_bytes = static_cast<std::size_t>(level.width) * texel_info(format_).bytes;
  std::vector<std::byte> rows(row_bytes * static_cast<std::size_t>(level.height * level.layers));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureImage(id_, 0, format, type, static_cast<GLsizei>(rows.size()), rows.data());
  expect_no_error();
  const std::byte* row = rows.data();
  for (int layer = 0; layer < level.layers; ++layer) {
    for (int y = 0; y < level.height; ++y, row += row_bytes) {
      std::memcpy(level.at(0, y, layer), row, row_bytes);
      for (int x = 0; x < level.width && format_ == TexelFormat::d24; ++x) {  // see row_of
        uint32_t word = 0;
        std::memcpy(&word, level.at(x, y, layer), sizeof word);
        word >>= 8;
        std::memcpy(level.at(x, y, layer), &word, sizeof word);
      }
    }
  }
}

void TwinTexture::copy_samples(TwinTexture& layers) {
  for (int sample = 0; sample < size_.depth; ++sample) {
    for (int y = 0; y < size_.height; ++y)
      std::memcpy(memory_.level().at(0, y, sample), layers.ours().level().at(0, y, sample),
                  static_cast<std::size_t>(size_.width) * texel_info(format_).bytes);
  }
  // OpenGL has no upload of multisample textures, so a pass copies each sample from a layer.
  const std::string prefix = color_type(format_) == ColorType::signed_integer     ? "i"
                             : color_type(format_) == ColorType::unsigned_integer ? "u"
                                                                                  : "";
  const std::string source = "#version 450 core\n    uniform " + prefix + "sampler2DArray image;\n    out " + prefix +
                             "vec4 color;\n    void main() { color = texelFetch(image, ivec3(gl_FragCoord.xy, gl_SampleID), 0); }";
  static constexpr const char* kVertex = R"(#version 450 core
    layout(location = 0) in vec4 position;
    void main() { gl_Position = position; })";
  const std::vector<glm::vec4> triangle{{-1.0f, -1.0f, 0.0f, 1.0f}, {3.0f, -1.0f, 0.0f, 1.0f}, {-1.0f, 3.0f, 0.0f, 1.0f}};
  GLuint framebuffer = 0;
  glCreateFramebuffers(1, &framebuffer);
  glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, id_, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glEnable(GL_MULTISAMPLE);
  glEnable(GL_FRAMEBUFFER_SRGB);  // the shader reads linear colors
  MesaPrograms programs;
  const Sampler nearest{.mag = Filter::nearest, .min = Filter::nearest};  // with others, textures of integers are incomplete
  test::run({"",
             kVertex,
             source.c_str(),
             [&](const UniformSetter& set) { set("image", layers, nearest); },
             make_vertex_view(stream(triangle)),
             {0, 1, 2},
             {}},
            TargetSpec{.width = size_.width, .height = size_.height}, programs);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDeleteFramebuffers(1, &framebuffer);
  expect_no_error();
}

namespace {

void set_sampler(const TwinTexture& texture, const Sampler& sampler, bool compares) {
  const auto set = [&](GLenum what, GLint value) { glTextureParameteri(texture.mesa(), what, value); };
  const auto set_real = [&](GLenum what, float value) { glTextureParameterf(texture.mesa(), what, value); };
  set(GL_TEXTURE_MAG_FILTER, gl_filter(sampler.mag));
  set(GL_TEXTURE_MIN_FILTER, gl_filter(sampler.min));
  set(GL_TEXTURE_WRAP_S, gl_wrap(sampler.wrap_s));
  set(GL_TEXTURE_WRAP_T, gl_wrap(sampler.wrap_t));
  if (texture.kind() == TextureKind::three_d) set(GL_TEXTURE_WRAP_R, gl_wrap(sampler.wrap_r));
  glTextureParameterfv(texture.mesa(), GL_TEXTURE_BORDER_COLOR, &sampler.border_color.x);
  set_real(GL_TEXTURE_LOD_BIAS, sampler.lod.bias);
  set_real(GL_TEXTURE_MIN_LOD, sampler.lod.min);
  set_real(GL_TEXTURE_MAX_LOD, sampler.lod.max);
  set(GL_TEXTURE_COMPARE_MODE, compares ? GL_COMPARE_REF_TO_TEXTURE : GL_NONE);
  set(GL_TEXTURE_COMPARE_FUNC, static_cast<GLint>(halfspace::gl(sampler.compare)));
}

}  // namespace

void UniformSetter::operator()(const char* name, const TwinTexture& texture, const Sampler& sampler, bool compares) const {
  if (texture.kind() != TextureKind::multisample) set_sampler(texture, sampler, compares);
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
