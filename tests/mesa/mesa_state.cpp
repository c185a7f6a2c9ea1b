// SPDX-License-Identifier: Apache-2.0
#include "mesa/mesa_state.h"

#include <array>
#include <optional>
#include <stdexcept>
#include <utility>

namespace halfspace::test {

void enable(GLenum what, bool on) { (on ? glEnable : glDisable)(what); }

// Internal formats, in the order of TexelFormat.
GLenum gl(TexelFormat f) {
  constexpr std::array<GLenum, kTexelFormats> k{GL_NONE,
                                                GL_R8,
                                                GL_RG8,
                                                GL_RGB8,
                                                GL_RGBA8,
                                                GL_SRGB8,
                                                GL_SRGB8_ALPHA8,
                                                GL_R8_SNORM,
                                                GL_RG8_SNORM,
                                                GL_RGB8_SNORM,
                                                GL_RGBA8_SNORM,
                                                GL_R16,
                                                GL_RG16,
                                                GL_RGB16,
                                                GL_RGBA16,
                                                GL_R16_SNORM,
                                                GL_RG16_SNORM,
                                                GL_RGB16_SNORM,
                                                GL_RGBA16_SNORM,
                                                GL_R16F,
                                                GL_RG16F,
                                                GL_RGB16F,
                                                GL_RGBA16F,
                                                GL_R32F,
                                                GL_RG32F,
                                                GL_RGB32F,
                                                GL_RGBA32F,
                                                GL_R8I,
                                                GL_RG8I,
                                                GL_RGB8I,
                                                GL_RGBA8I,
                                                GL_R8UI,
                                                GL_RG8UI,
                                                GL_RGB8UI,
                                                GL_RGBA8UI,
                                                GL_R16I,
                                                GL_RG16I,
                                                GL_RGB16I,
                                                GL_RGBA16I,
                                                GL_R16UI,
                                                GL_RG16UI,
                                                GL_RGB16UI,
                                                GL_RGBA16UI,
                                                GL_R32I,
                                                GL_RG32I,
                                                GL_RGB32I,
                                                GL_RGBA32I,
                                                GL_R32UI,
                                                GL_RG32UI,
                                                GL_RGB32UI,
                                                GL_RGBA32UI,
                                                GL_RGB565,
                                                GL_RGB5_A1,
                                                GL_RGBA4,
                                                GL_RGB10_A2,
                                                GL_RGB10_A2UI,
                                                GL_R11F_G11F_B10F,
                                                GL_RGB9_E5,
                                                GL_DEPTH_COMPONENT16,
                                                GL_DEPTH_COMPONENT24,
                                                GL_DEPTH_COMPONENT32F,
                                                GL_DEPTH24_STENCIL8,
                                                GL_DEPTH32F_STENCIL8};
  return k[static_cast<std::size_t>(f)];
}

GLenum gl(TextureKind kind) {
  constexpr std::array<GLenum, 9> names{GL_TEXTURE_1D,
                                        GL_TEXTURE_2D,
                                        GL_TEXTURE_RECTANGLE,
                                        GL_TEXTURE_3D,
                                        GL_TEXTURE_1D_ARRAY,
                                        GL_TEXTURE_2D_ARRAY,
                                        GL_TEXTURE_CUBE_MAP,
                                        GL_TEXTURE_CUBE_MAP_ARRAY,
                                        GL_TEXTURE_2D_MULTISAMPLE};
  return names[static_cast<std::size_t>(kind)];
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
  enable(GL_DEPTH_CLAMP, d.clamp);
  glDepthRangef(d.range_near, d.range_far);
}

// Sets the viewports with their scissors and depth ranges. Must be called after the functions that set these for all viewports.
void set_viewports(const DrawState& s, const TargetSpec& target) {
  const ViewportRect all = Rect{0, 0, target.width, target.height};
  if (s.viewports == nullptr) {
    const ViewportRect v = s.viewport.value_or(all);
    return glViewportIndexedf(0, v.x, v.y, v.width, v.height);
  }
  for (GLuint i = 0; i < s.viewports->size(); ++i) {
    const IndexedViewport& indexed = (*s.viewports)[i];
    const ViewportRect v = indexed.viewport.value_or(all);
    glViewportIndexedf(i, v.x, v.y, v.width, v.height);
    glDepthRangeIndexed(i, static_cast<double>(indexed.range_near), static_cast<double>(indexed.range_far));
    if (!indexed.scissor) continue;
    glEnablei(GL_SCISSOR_TEST, i);
    glScissorIndexed(i, indexed.scissor->x, indexed.scissor->y, indexed.scissor->width, indexed.scissor->height);
  }
}

void set_state(const DrawState& s, const TargetSpec& target) {
  glClipControl(s.clip_origin == ClipOrigin::upper_left ? GL_UPPER_LEFT : GL_LOWER_LEFT,
                s.depth.clip == ClipDepth::zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  enable(GL_SCISSOR_TEST, s.scissor.has_value());
  if (s.scissor) glScissor(s.scissor->x, s.scissor->y, s.scissor->width, s.scissor->height);
  enable(GL_CULL_FACE, s.cull != CullMode::none);
  if (s.cull != CullMode::none) glCullFace(s.cull == CullMode::front ? GL_FRONT : s.cull == CullMode::back ? GL_BACK : GL_FRONT_AND_BACK);
  glFrontFace(s.front == Winding::counter_clockwise ? GL_CCW : GL_CW);
  glProvokingVertex(s.provoking == ProvokingVertex::last ? GL_LAST_VERTEX_CONVENTION : GL_FIRST_VERTEX_CONVENTION);
  set_depth_state(s.depth);
  set_viewports(s, target);
  set_stencil_state(s.stencil);
  set_sample_state(s);
  enable(GL_POLYGON_OFFSET_FILL, s.offset.slope != 0.0f || s.offset.constant != 0.0f);
  glPolygonOffsetClamp(s.offset.slope, s.offset.constant, s.offset.clamp);
  glPointSize(s.point_size);
  glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, s.point_origin == PointOrigin::upper_left ? GL_UPPER_LEFT : GL_LOWER_LEFT);
  glLineWidth(s.line_width);
  enable(GL_LINE_SMOOTH, s.line_smooth);
  enable(GL_POLYGON_SMOOTH, s.polygon_smooth);
  glPolygonMode(GL_FRONT_AND_BACK, s.polygon_mode == PolygonMode::fill   ? GL_FILL
                                   : s.polygon_mode == PolygonMode::line ? GL_LINE
                                                                         : GL_POINT);
  glColorMask(s.color_mask.r, s.color_mask.g, s.color_mask.b, s.color_mask.a);
  enable(GL_COLOR_LOGIC_OP, s.logic_op.has_value());
  if (s.logic_op) glLogicOp(GL_CLEAR + static_cast<GLenum>(*s.logic_op));  // the constants are consecutive
  enable(GL_BLEND, s.blend.has_value());
  const BlendState blend = s.blend.value_or(BlendState{});  // Mesa refuses two sources with several attachments even without blending
  glBlendColor(blend.constant.x, blend.constant.y, blend.constant.z, blend.constant.w);
  glBlendEquationSeparate(gl(blend.color_equation), gl(blend.alpha_equation));
  glBlendFuncSeparate(gl(blend.source_color), gl(blend.destination_color), gl(blend.source_alpha), gl(blend.destination_alpha));
  for (GLuint i = 0; i < s.attachments.size(); ++i) {
    const std::optional<AttachmentState>& own = s.attachments[i];
    if (!own) continue;
    if (own->blend) throw std::invalid_argument("an attachment with a blend state of its own");
    glDisablei(GL_BLEND, i);
    glColorMaski(i, own->mask.r, own->mask.g, own->mask.b, own->mask.a);
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
