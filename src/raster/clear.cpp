// SPDX-License-Identifier: Apache-2.0
//
// A clear is a draw of one triangle that covers the target, so it has its place in the order of the draws.
#include "halfspace/raster/clear.h"

#include <utility>

#include "halfspace/raster/pass.h"

namespace halfspace::HS_LANES {

namespace {

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
    for (std::size_t n = 0; n < colors.size(); ++n) out.color[n] = {R(colors[n].x), R(colors[n].y), R(colors[n].z), R(colors[n].w)};
    return out;
  }
};

// All depths of the depth range are the depth of the clear, so the triangle has exactly that.
DrawState state_of(const Clear& clear) {
  DrawState state;
  state.scissor = clear.rect;
  state.depth = {.test = clear.depth.has_value(),
                 .write = clear.depth.has_value(),
                 .compare = CompareOp::always,
                 .range_near = clear.depth.value_or(0.0f),
                 .range_far = clear.depth.value_or(0.0f)};
  if (clear.stencil) {
    const StencilFace face{.pass = StencilOp::replace, .reference = *clear.stencil, .write_mask = clear.stencil_mask};
    state.stencil = StencilState{face, face};
  }
  constexpr ColorMask kNothing{false, false, false, false};
  for (std::size_t i = 0; i < clear.colors.size(); ++i)
    state.attachments[i] = AttachmentState{.mask = clear.colors[i] ? clear.mask : kNothing};
  return state;
}

}  // namespace

void Pass::clear(const Clear& clear) {
  ClearShader shader;
  bool has_color = false;
  for (std::size_t i = 0; i < clear.colors.size(); ++i) {
    shader.colors[i] = clear.colors[i].value_or(glm::vec4(0.0f));
    has_color |= clear.colors[i].has_value();
  }
  const VertexView corners = make_vertex_view(stream(std::span<const glm::vec4>(kCorners)));
  if (has_color) return draw(shader, corners, state_of(clear));
  draw_depth(shader, corners, state_of(clear));
}

}  // namespace halfspace::HS_LANES
