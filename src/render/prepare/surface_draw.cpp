// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/surface_draw.h"

#include <algorithm>

namespace halfspace::HS_LANES {

namespace {

// Returns the mesh's streams in the order of the shader's attributes.
template <class S>
VertexView view_of(const MeshStreams& m) {
  if constexpr (S::kTangents) return make_vertex_view(m.position_stream(), m.normal_stream(), m.tangent_stream(), m.uv_stream());
  if constexpr (S::kNormals && S::kMapped) return make_vertex_view(m.position_stream(), m.normal_stream(), m.uv_stream());
  if constexpr (S::kNormals) return make_vertex_view(m.position_stream(), m.normal_stream());
  if constexpr (S::kMapped) return make_vertex_view(m.position_stream(), m.uv_stream());
  return make_vertex_view(m.position_stream());
}

template <ShadingRate rate, bool mapped, NormalDetail detail = NormalDetail::none, bool highlight = true>
PreparedDraw draw_of(const LitSurface& surface, const MeshStreams& mesh, const std::shared_ptr<const Indices>& indices) {
  using S = SurfaceShader<rate, mapped, detail, highlight>;
  DrawState state = opaque_state(surface.two_sided ? CullMode::none : CullMode::back, surface.handedness < 0.0f);
  if (surface.opacity < 1.0f) {
    state.order_independent = true;
    state.depth.write = false;
  }
  return {S{surface}, view_of<S>(mesh), indices, state};
}

}  // namespace

std::optional<OpacityTest> shadow_opacity(const LitSurface& s) {
  if (s.opacity == 1.0f) return std::nullopt;
  return OpacityTest{.maps = {}, .opacity = s.opacity, .dithered = true};
}

PreparedDraw surface_draw(const LitSurface& s, ShadingRate rate, NormalDetail detail, const MeshStreams& mesh,
                          const std::shared_ptr<const Indices>& indices) {
  const bool mapped = std::ranges::any_of(s.factors, [](const Factor& f) { return f.map != nullptr; });
  switch (rate) {
    case ShadingRate::none: return (mapped ? draw_of<ShadingRate::none, true> : draw_of<ShadingRate::none, false>)(s, mesh, indices);
    case ShadingRate::flat: return (mapped ? draw_of<ShadingRate::flat, true> : draw_of<ShadingRate::flat, false>)(s, mesh, indices);
    case ShadingRate::provoking:
      return (mapped ? draw_of<ShadingRate::provoking, true> : draw_of<ShadingRate::provoking, false>)(s, mesh, indices);
    case ShadingRate::gouraud:
      if (mapped && s.model == LightModel::lambert) return draw_of<ShadingRate::gouraud, true, NormalDetail::none, false>(s, mesh, indices);
      return (mapped ? draw_of<ShadingRate::gouraud, true> : draw_of<ShadingRate::gouraud, false>)(s, mesh, indices);
    case ShadingRate::phong: break;
  }
  switch (detail) {
    case NormalDetail::map: return draw_of<ShadingRate::phong, true, NormalDetail::map>(s, mesh, indices);
    case NormalDetail::bump: return draw_of<ShadingRate::phong, true, NormalDetail::bump>(s, mesh, indices);
    case NormalDetail::slopes: return draw_of<ShadingRate::phong, true, NormalDetail::slopes>(s, mesh, indices);
    case NormalDetail::none: break;
  }
  return (mapped ? draw_of<ShadingRate::phong, true> : draw_of<ShadingRate::phong, false>)(s, mesh, indices);
}

}  // namespace halfspace::HS_LANES
