// SPDX-License-Identifier: Apache-2.0
#include "halfspace/raster/detail/clear_draw.h"

#include "halfspace/raster/vertex_input.h"

namespace halfspace::HS_LANES::detail {

namespace {

// A clear is a draw of one triangle that covers the target, so it has its place in the order of the draws.
constexpr std::array kCorners{glm::vec4(-1, -1, 0, 1), glm::vec4(3, -1, 0, 1), glm::vec4(-1, 3, 0, 1)};

struct ClearShader {
  template <class R>
  struct Attributes {
    vec4<R> position;
  };
  template <class R>
  struct Varyings {};

  std::array<glm::vec4, kMaxColorTargets> colors{};

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>&) const {
    return in.position;
  }
  template <class R>
  FragmentMRT<R, kMaxColorTargets> fragment(const Varyings<R>&) const {
    FragmentMRT<R, kMaxColorTargets> out;
    for (std::size_t n = 0; n < colors.size(); ++n) {
      const glm::vec4& c = colors[n];
      out.color[n] = {spread<R>(c.x), spread<R>(c.y), spread<R>(c.z), spread<R>(c.w)};
    }
    return out;
  }
};

// The colors of a clear are bits of the type of each attachment.
constexpr ShaderKernels kClearKernels = [] {
  ShaderKernels kernels = kKernels<ClearShader, DrawKind::color>;
  kernels.color_types = nullptr;
  return kernels;
}();

// The rectangle is checked as the scissor of the draw.
void check_clear(const ClearValues& values, const Attachments& attachments) {
  if (values.depth) {
    HS_CHECK(*values.depth >= 0.0f && *values.depth <= 1.0f, "Pass::clear: the depth is outside of its range; expected 0 to 1");
  }
  HS_CHECK(!values.depth || attachments.depth.format != DepthFormat::none, "Pass::clear: the pass has no depth target; expected no depth");
  HS_CHECK(!values.stencil || has_stencil(attachments.depth.format), "Pass::clear: the pass has no stencil; expected no stencil");
  for (std::size_t i = attachments.colors.size(); i < values.colors.size(); ++i)
    HS_CHECK(!values.colors[i], "Pass::clear: there is a color for an attachment that the pass does not have; expected no color");
}

// All depths of the depth range are the depth of the clear, so the triangle has exactly that.
DrawState state_of(const ClearValues& values, std::size_t attachment_count) {
  DrawState state;
  state.scissor = values.rect;
  state.depth = {.test = values.depth.has_value(),
                 .write = values.depth.has_value(),
                 .compare = CompareOp::always,
                 .range_near = values.depth.value_or(0.0f),
                 .range_far = values.depth.value_or(0.0f)};
  state.condition = values.condition;
  if (values.stencil) {
    const StencilFace face{.pass = StencilOp::replace, .reference = *values.stencil, .write_mask = values.stencil_mask};
    state.stencil = StencilState{face, face};
  }
  constexpr ColorMask kNothing{false, false, false, false};
  for (std::size_t i = 0; i < attachment_count; ++i)
    state.attachments[i] = AttachmentState{.mask = values.colors[i] ? values.mask : kNothing};
  return state;
}

}  // namespace

void add_clear(PassState& state, const Attachments& attachments, const ClearValues& values) {
  check_clear(values, attachments);
  ClearShader shader;
  bool has_color = false;
  for (std::size_t i = 0; i < values.colors.size(); ++i) {
    shader.colors[i] = values.colors[i].value_or(glm::vec4(0.0f));
    has_color |= values.colors[i].has_value();
  }
  const VertexView corners = make_vertex_view(stream(std::span<const glm::vec4>(kCorners)));
  add_draw(state, has_color ? kClearKernels : kKernels<ClearShader, DrawKind::depth_only>, keep_shader(shader, memory_of(state)), corners,
           std::make_shared<const Indices>(Indices::sequential(corners.vertex_count)), state_of(values, attachments.colors.size()));
}

}  // namespace halfspace::HS_LANES::detail
