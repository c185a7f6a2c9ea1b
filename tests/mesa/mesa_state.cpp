// SPDX-License-Identifier: Apache-2.0
#include "mesa/mesa_state.h"

#include <array>
#include <optional>
#include <utility>

namespace halfspace::test {

void enable(GLenum what, bool on) { (on ? glEnable : glDisable)(what); }

GLenum gl(ColorFormat f) {
  constexpr std::array<GLenum, 5> k{GL_NONE, GL_RGBA8, GL_SRGB8_ALPHA8, GL_RGBA16F, GL_RGBA32F};
  return k[static_cast<std::size_t>(f)];
}
GLenum gl(DepthFormat f) {
  constexpr std::array<GLenum, 6> k{
      GL_NONE, GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32F, GL_DEPTH24_STENCIL8, GL_DEPTH32F_STENCIL8};
  return k[static_cast<std::size_t>(f)];
}

namespace {

void set_stencil_state(const std::optional<StencilState>& s) {
  enable(GL_STENCIL_TEST, s.has_value());
  if (!s) return;
  for (const auto& [face, f] : {std::pair(GL_FRONT, s->front), std::pair(GL_BACK, s->back)}) {
    glStencilFuncSeparate(face, gl(f.compare), f.reference, f.read_mask);
    glStencilOpSeparate(face, gl(f.fail), gl(f.depth_fail), gl(f.pass));
    glStencilMaskSeparate(face, f.write_mask);
  }
}

void set_sample_state(const DrawState& s) {
  enable(GL_SAMPLE_MASK, s.sample_mask != ~0u);
  glSampleMaski(0, s.sample_mask);
  enable(GL_SAMPLE_ALPHA_TO_COVERAGE, s.alpha_to_coverage);
  enable(GL_SAMPLE_SHADING, s.sample_shading);
  glMinSampleShading(1.0f);
}

void set_depth_state(const DepthState& d) {
  enable(GL_DEPTH_TEST, d.test);
  glDepthFunc(gl(d.compare));
  glDepthMask(d.write);
  glClipControl(GL_LOWER_LEFT, d.clip == ClipDepth::zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  enable(GL_DEPTH_CLAMP, d.clamp);
  glDepthRangef(d.range_near, d.range_far);
}

void set_state(const DrawState& s, const TargetSpec& target) {
  const Rect v = s.viewport.value_or(Rect{0, 0, target.width, target.height});
  glViewport(v.x, v.y, v.width, v.height);
  enable(GL_SCISSOR_TEST, s.scissor.has_value());
  if (s.scissor) glScissor(s.scissor->x, s.scissor->y, s.scissor->width, s.scissor->height);
  enable(GL_CULL_FACE, s.cull != CullMode::none);
  if (s.cull != CullMode::none) glCullFace(s.cull == CullMode::front ? GL_FRONT : s.cull == CullMode::back ? GL_BACK : GL_FRONT_AND_BACK);
  glFrontFace(s.front == Winding::counter_clockwise ? GL_CCW : GL_CW);
  glProvokingVertex(s.provoking == ProvokingVertex::last ? GL_LAST_VERTEX_CONVENTION : GL_FIRST_VERTEX_CONVENTION);
  set_depth_state(s.depth);
  set_stencil_state(s.stencil);
  set_sample_state(s);
  enable(GL_POLYGON_OFFSET_FILL, s.offset.slope != 0.0f || s.offset.constant != 0.0f);
  glPolygonOffsetClamp(s.offset.slope, s.offset.constant, s.offset.clamp);
  glPointSize(s.point_size);
  glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, s.point_origin == PointOrigin::upper_left ? GL_UPPER_LEFT : GL_LOWER_LEFT);
  glLineWidth(s.line_width);
  glPolygonMode(GL_FRONT_AND_BACK, s.polygon_mode == PolygonMode::fill   ? GL_FILL
                                   : s.polygon_mode == PolygonMode::line ? GL_LINE
                                                                         : GL_POINT);
  glColorMask(s.color_mask.r, s.color_mask.g, s.color_mask.b, s.color_mask.a);
  if (s.blend) glBlendColor(s.blend->constant.x, s.blend->constant.y, s.blend->constant.z, s.blend->constant.w);
  enable(GL_BLEND, s.blend.has_value());
  if (s.blend) {
    glBlendEquationSeparate(gl(s.blend->color_equation), gl(s.blend->alpha_equation));
    glBlendFuncSeparate(gl(s.blend->source_color), gl(s.blend->destination_color), gl(s.blend->source_alpha),
                        gl(s.blend->destination_alpha));
  }
}

}  // namespace

void set_state(const MesaDraw& draw, const TargetSpec& target) {
  set_state(draw.state, target);
  enable(GL_PRIMITIVE_RESTART_FIXED_INDEX, draw.restart);
  enable(GL_PROGRAM_POINT_SIZE, draw.own_point_size);
  for (int i = 0; i < 8; ++i) enable(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i), i < draw.clip_distances);
}

}  // namespace halfspace::test
