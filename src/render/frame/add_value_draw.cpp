// SPDX-License-Identifier: Apache-2.0
//
// Chooses and instantiates the shaders that compute the values of a frame other than its color.
#include "halfspace/render/frame/add_draw.h"
#include "halfspace/shading/sphere/sphere_values.h"
#include "halfspace/shading/surface/surface_values.h"

namespace halfspace::HS_LANES {

namespace {

using Wanted = std::array<bool, kFrameValues>;

bool wants(const Wanted& wanted, FrameValue value) { return wanted[static_cast<std::size_t>(value)]; }

VertexView vertices_of(const MeshStreams& s) {
  return make_vertex_view(s.position_stream(), s.normal_stream(), s.tangent_stream(), s.uv_stream(), s.second_uv_stream(),
                          s.color_stream());
}

// Which normals a surface shader uses.
template <class S>
struct NormalsOf;
template <ShadingRate rate, bool mapped, NormalDetail detail, bool highlight>
struct NormalsOf<SurfaceShader<rate, mapped, detail, highlight>> {
  static constexpr bool face = rate == ShadingRate::flat;
  static constexpr NormalDetail normal_detail = detail;
};

template <class S>
void set_material(SurfaceValueUniforms& u, const S& shader) {
  if constexpr (std::derived_from<S, LitSurface>) {
    const Factor& color = shader.factors[kColor];
    u.color = glm::vec4(color.constant, 1.0f);
    u.color_map.map = color.map;
    u.color_map.sampler = color.sampler;
    u.face_normal = NormalsOf<S>::face;
    u.normal_detail = NormalsOf<S>::normal_detail;
    u.detail = shader.detail;
  } else {
    u.color = shader.base_color;
    u.color_map = shader.maps[kBaseColorMap];
    u.opacity_map = shader.maps[kOpacityMap];
    u.opacity_cutoff = shader.alpha_cutoff;
    const MaterialMap& normal = shader.maps[kNormalMap];
    if (S::kTangents && normal.map != nullptr) {
      u.normal_detail = NormalDetail::map;
      u.detail = {.map = normal.map, .sampler = normal.sampler, .strength = shader.normal_scale};
      u.detail_coordinates = normal;
    }
  }
}

// Adds a draw that computes the values of a scene's draw.
struct Adder {
  Pass& pass;
  const PreparedDraw& draw;
  const FrameCamera& camera;
  const Wanted& wanted;
  const DrawState& state;

  template <class S>
  requires std::derived_from<S, LitSurface> || std::derived_from<S, MetallicMaterial>
  void operator()(const S& shader) const {
    SurfaceValueUniforms u{shader};
    set_material(u, shader);
    if constexpr (kDiscards<S>) {
      add<true>(u);
    } else {
      add<false>(u);
    }
  }
  template <bool exact>
  void operator()(const SphereImpostor<exact>& shader) const {
    pass.draw(SphereValueShader<exact>{shader, camera, draw.source.object}, draw.vertices, *draw.indices, state);
  }
  void operator()(const ColoredPrimitives& shader) const {
    SurfaceValueUniforms u{};
    glm::dmat4 world_rws = draw.source.world_from_object;
    world_rws[3] -= glm::dvec4(glm::dvec3(camera.eye_ws) + glm::dvec3(camera.eye_low_ws), 0.0);
    u.clip_from_object = shader.clip_from_object;
    u.world_from_object = glm::mat4(world_rws);
    u.normal_from_object = glm::mat3(1.0f);
    u.color = shader.color;
    add<false>(u);
  }
  // Skies are behind everything, floors that only show shadows are blended, and normals are not surfaces.
  void operator()(const NormalLines&) const {}
  void operator()(const StarSky&) const {}
  void operator()(const EnvironmentSky&) const {}
  void operator()(const ShadowCatcher&) const {}

 private:
  template <bool masked>
  void add(SurfaceValueUniforms& u) const {
    u.camera = camera;
    u.object = draw.source.object;
    u.instance = draw.source.instance;
    u.wants_albedo = wants(wanted, FrameValue::albedo);
    u.wants_normal = wants(wanted, FrameValue::normal) || wants(wanted, FrameValue::camera_normal);
    pass.draw(SurfaceValueShader<masked>{u}, vertices_of(draw.source.streams), *draw.indices, state);
  }
};

}  // namespace

void add_value_draw(Pass& pass, const PreparedDraw& draw, const FrameCamera& camera, const Wanted& wanted, const DrawState& state) {
  if (draw.source.object >= 0 && !draw.state.order_independent) std::visit(Adder{pass, draw, camera, wanted, state}, draw.shader);
}

}  // namespace halfspace::HS_LANES
