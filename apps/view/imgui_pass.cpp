// SPDX-License-Identifier: Apache-2.0
#include "view/imgui_pass.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace halfspace {

namespace {

struct ImGuiShader {
  glm::vec2 scale, offset;  // from pixels to NDC
  const Texture2D* texture;

  template <class R>
  struct Attributes {
    vec2<R> position, uv;
    vec4<R> color;
  };
  template <class R>
  struct Varyings {
    vec2<R> uv;
    vec4<R> color;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv = in.uv;
    out.color = in.color;
    return vec4<R>(in.position.x * R(scale.x) + R(offset.x), in.position.y * R(scale.y) + R(offset.y), R(0), R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    constexpr Sampler kSampler{.mag = Filter::bilinear, .min = Filter::bilinear, .wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp};
    return {in.color * texture->template sample_level<R>(kSampler, in.uv, R(0))};
  }
};

Texture2D font_texture(ImFontAtlas& fonts) {
  unsigned char* texels = nullptr;
  int width = 0, height = 0;
  fonts.GetTexDataAsRGBA32(&texels, &width, &height);
  Image<glm::u8vec4> image(width, height);
  std::copy_n(reinterpret_cast<const glm::u8vec4*>(texels), image.texels().size(), image.data());
  return Texture2D(std::span<const Image<glm::u8vec4>>(&image, 1), TexelFormat::rgba8);
}

// Returns the scissor of a command in window coordinates, which have their origin at the lower left.
Rect scissor_of(const ImDrawCmd& command, const ImVec2& origin, int height) {
  const ImVec4& clip = command.ClipRect;
  const auto x0 = static_cast<int>(std::max(clip.x - origin.x, 0.0f)), y0 = static_cast<int>(std::max(clip.y - origin.y, 0.0f));
  const auto x1 = static_cast<int>(std::ceil(clip.z - origin.x)), y1 = static_cast<int>(std::ceil(clip.w - origin.y));
  return {x0, height - y1, x1 - x0, y1 - y0};
}

}  // namespace

ImGuiPass::ImGuiPass(ImFontAtlas& fonts) : fonts_(font_texture(fonts)) {}

void ImGuiPass::add_list(Pass& pass, const ImDrawList& list, const ImDrawData& data, std::span<const Vertex> vertices, int height) const {
  const ImGuiShader shader{{2.0f / data.DisplaySize.x, -2.0f / data.DisplaySize.y},
                           {-1.0f - 2.0f * data.DisplayPos.x / data.DisplaySize.x, 1.0f + 2.0f * data.DisplayPos.y / data.DisplaySize.y},
                           &fonts_};
  DrawState state;
  state.depth.test = state.depth.write = false;
  state.blend = kAlphaBlend;
  for (const ImDrawCmd& command : list.CmdBuffer) {
    state.scissor = scissor_of(command, data.DisplayPos, height);
    if (command.UserCallback != nullptr || command.ElemCount == 0 || state.scissor->width <= 0 || state.scissor->height <= 0) continue;
    state.base_vertex = static_cast<int32_t>(command.VtxOffset);
    const std::span<const ImDrawIdx> indices(list.IdxBuffer.Data + command.IdxOffset, command.ElemCount);
    pass.draw(shader,
              make_vertex_view(stream(vertices, &Vertex::position), stream(vertices, &Vertex::uv), stream(vertices, &Vertex::color)),
              indices, state);
  }
}

void ImGuiPass::draw(const ImDrawData& data, Image<glm::u8vec4>& frame, const Workers& workers) {
  if (data.TotalVtxCount == 0) return;
  vertices_.clear();
  vertices_.reserve(static_cast<std::size_t>(data.TotalVtxCount));
  for (int i = 0; i < data.CmdListsCount; ++i) {
    for (const ImDrawVert& v : data.CmdLists[i]->VtxBuffer) {
      const glm::vec4 color(v.col & 255u, v.col >> 8 & 255u, v.col >> 16 & 255u, v.col >> 24);
      vertices_.push_back({{v.pos.x, v.pos.y}, {v.uv.x, v.uv.y}, color * (1.0f / 255.0f)});
    }
  }
  ColorTarget target = rgba8_target(frame);
  target.load = LoadOp::load;
  Pass pass(frame.width(), frame.height(), target, {});
  std::size_t first = 0;
  for (int i = 0; i < data.CmdListsCount; ++i) {
    const auto count = static_cast<std::size_t>(data.CmdLists[i]->VtxBuffer.Size);
    add_list(pass, *data.CmdLists[i], data, std::span<const Vertex>(vertices_).subspan(first, count), frame.height());
    first += count;
  }
  pass.run(workers);
}

}  // namespace halfspace
