// SPDX-License-Identifier: Apache-2.0
#include "peers/gl/gl_state.h"

#include <array>
#include <cstddef>

#include "peers/gl/gl_enums.h"

namespace halfspace {

namespace {

void enable(GLenum what, bool on) { (on ? glEnable : glDisable)(what); }

template <class E, std::size_t N>
GLenum at(const std::array<GLenum, N>& table, E value) {
  return table[static_cast<std::size_t>(value)];
}

void set_blend(const std::optional<BlendState>& blend) {
  enable(GL_BLEND, blend.has_value());
  if (!blend) return;
  glBlendEquationSeparate(gl(blend->color_equation), gl(blend->alpha_equation));
  glBlendFuncSeparate(gl(blend->source_color), gl(blend->destination_color), gl(blend->source_alpha), gl(blend->destination_alpha));
  glBlendColor(blend->constant.x, blend->constant.y, blend->constant.z, blend->constant.w);
}

void set_stencil(const std::optional<StencilState>& stencil) {
  enable(GL_STENCIL_TEST, stencil.has_value());
  if (!stencil) return;
  const auto face = [](GLenum side, const StencilFace& f) {
    glStencilFuncSeparate(side, gl(f.compare), f.reference, f.read_mask);
    glStencilOpSeparate(side, gl(f.fail), gl(f.depth_fail), gl(f.pass));
    glStencilMaskSeparate(side, f.write_mask);
  };
  face(GL_FRONT, stencil->front);
  face(GL_BACK, stencil->back);
}

}  // namespace

void set_gl_state(const DrawState& s, bool has_depth) {
  enable(GL_DEPTH_TEST, has_depth && s.depth.test);
  glDepthFunc(gl(s.depth.compare));
  glDepthMask(s.depth.write ? GL_TRUE : GL_FALSE);
  enable(GL_CULL_FACE, s.cull != CullMode::none);
  if (s.cull != CullMode::none) glCullFace(s.cull == CullMode::back ? GL_BACK : GL_FRONT);
  set_blend(s.blend);
  set_stencil(s.stencil);
  const auto flag = [](bool b) { return static_cast<GLboolean>(b ? GL_TRUE : GL_FALSE); };
  glColorMask(flag(s.color_mask.r), flag(s.color_mask.g), flag(s.color_mask.b), flag(s.color_mask.a));
  enable(GL_SCISSOR_TEST, s.scissor.has_value());
  if (s.scissor) glScissor(s.scissor->x, s.scissor->y, s.scissor->width, s.scissor->height);
  glPolygonMode(GL_FRONT_AND_BACK, s.polygon_mode == PolygonMode::line ? GL_LINE : GL_FILL);
  glPointSize(s.point_size);
  enable(GL_SAMPLE_ALPHA_TO_COVERAGE, s.alpha_to_coverage);
  enable(GL_SAMPLE_SHADING, s.sample_shading);
  if (s.sample_shading) glMinSampleShading(1.0f);
}

GLenum gl_color_format(ColorFormat f) {
  return f == ColorFormat::rgba16f ? GL_RGBA16F : f == ColorFormat::srgb8a8 ? GL_SRGB8_ALPHA8 : GL_RGBA8;
}
GLenum gl_depth_format(DepthFormat f) {
  return f == DepthFormat::none ? 0 : f == DepthFormat::d24s8 ? GL_DEPTH24_STENCIL8 : GL_DEPTH_COMPONENT32F;
}

void set_gl_sampler(const Sampler& s, bool has_levels) {
  static constexpr std::array<GLenum, 4> wraps{GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_BORDER};
  const auto set = [](GLenum name, GLenum value) { glTexParameteri(GL_TEXTURE_2D, name, static_cast<GLint>(value)); };
  const GLenum linear = has_levels && s.min == Filter::trilinear ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR;
  set(GL_TEXTURE_MIN_FILTER, s.min == Filter::nearest ? GL_NEAREST : linear);
  set(GL_TEXTURE_MAG_FILTER, s.mag == Filter::nearest ? GL_NEAREST : GL_LINEAR);
  set(GL_TEXTURE_WRAP_S, at(wraps, s.wrap_s));
  set(GL_TEXTURE_WRAP_T, at(wraps, s.wrap_t));
  glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, &s.border_color[0]);
  if (s.anisotropy > 1) glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, static_cast<float>(s.anisotropy));
}

}  // namespace halfspace
