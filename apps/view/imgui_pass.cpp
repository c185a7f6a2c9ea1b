// SPDX-License-Identifier: Apache-2.0
#include "view/imgui_pass.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace halfspace {

namespace {

// Draws triangles with vertex colors, which cover most of the pixels.
struct SolidShader {
  glm::vec2 scale, offset;  // from pixels to NDC

  template <class R>
  struct Attributes {
    vec2<R> position;
    vec4<R> color;
  };
  template <class R>
  struct Varyings {
    NoPerspective<vec4<R>> color;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.color.value = in.color;
    return vec4<R>(in.position.x * R(scale.x) + R(offset.x), in.position.y * R(scale.y) + R(offset.y), R(0), R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    return {in.color.value};
  }
};

// Draws text: multiplies the color by the font texture.
struct TextShader {
  glm::vec2 scale, offset;
  const Texture2D* texture;

  template <class R>
  struct Attributes {
    vec2<R> position, uv;
    vec4<R> color;
  };
  template <class R>
  struct Varyings {
    NoPerspective<vec2<R>> uv;
    NoPerspective<vec4<R>> color;
  };

  template <class R>
  vec4<R> vertex(const Attributes<R>& in, Varyings<R>& out) const {
    out.uv.value = in.uv;
    out.color.value = in.color;
    return vec4<R>(in.position.x * R(scale.x) + R(offset.x), in.position.y * R(scale.y) + R(offset.y), R(0), R(1));
  }
  template <class R>
  Fragment<R> fragment(const Varyings<R>& in, const Pixel<R>&) const {
    constexpr Sampler kSampler{.wrap_s = Wrap::clamp, .wrap_t = Wrap::clamp};
    const vec2<R> no_change(R(0), R(0));  // the texture has one level
    return {in.color.value * texture->template sample<R>(kSampler, in.uv.value, no_change, no_change)};
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

ImGuiPass::ImGuiPass(ImFontAtlas& fonts) : fonts_(font_texture(fonts)), white_uv_(fonts.TexUvWhitePixel.x, fonts.TexUvWhitePixel.y) {}

void ImGuiPass::add_command(Pass& pass, std::span<const Vertex> vertices, std::span<const uint16_t> indices, const Placement& placement,
                            const DrawState& state) const {
  const auto is_solid = [&](std::size_t triangle) {
    const auto white = [&](std::size_t i) { return vertices[indices[i] + static_cast<std::size_t>(state.base_vertex)].uv == white_uv_; };
    return white(triangle) && white(triangle + 1) && white(triangle + 2);
  };
  const auto position = stream(vertices, &Vertex::position);
  const auto color = stream(vertices, &Vertex::color);
  for (std::size_t begin = 0; begin + 2 < indices.size();) {
    const bool solid = is_solid(begin);
    std::size_t end = begin + 3;
    while (end + 2 < indices.size() && is_solid(end) == solid) end += 3;
    const std::span<const uint16_t> run = indices.subspan(begin, end - begin);
    if (solid) {
      pass.draw(SolidShader{placement.scale, placement.offset}, make_vertex_view(position, color), run, state);
    } else {
      pass.draw(TextShader{placement.scale, placement.offset, &fonts_}, make_vertex_view(position, stream(vertices, &Vertex::uv), color),
                run, state);
    }
    begin = end;
  }
}

void ImGuiPass::add_list(Pass& pass, const ImDrawList& list, const ImDrawData& data, std::span<const Vertex> vertices, int height) const {
  const ImVec2 &size = data.DisplaySize, &origin = data.DisplayPos;
  const Placement placement{{2.0f / size.x, -2.0f / size.y}, {-1.0f - 2.0f * origin.x / size.x, 1.0f + 2.0f * origin.y / size.y}};
  DrawState state;
  state.depth.test = state.depth.write = false;
  state.blend = kAlphaBlend;
  for (const ImDrawCmd& command : list.CmdBuffer) {
    state.scissor = scissor_of(command, origin, height);
    if (command.UserCallback != nullptr || state.scissor->width <= 0 || state.scissor->height <= 0) continue;
    state.base_vertex = static_cast<int32_t>(command.VtxOffset);
    add_command(pass, vertices, std::span<const uint16_t>(list.IdxBuffer.Data + command.IdxOffset, command.ElemCount), placement, state);
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
