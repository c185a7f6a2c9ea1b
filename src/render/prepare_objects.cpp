// SPDX-License-Identifier: Apache-2.0
//
// Prepares the objects of a scene: their surfaces, transforms and shaders.
#include <algorithm>

#include "halfspace/core/check.h"
#include "halfspace/geometry/camera.h"
#include "halfspace/geometry/displaced_sphere.h"
#include "halfspace/render/preparation.h"
#include "halfspace/scene/scene_paths.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

namespace {

bool is_displaced(const ObjectDescription& o) { return is_map(o.height); }

}  // namespace

std::vector<glm::dmat4> places_of(const SceneDescription& scene, const ObjectDescription& o) {
  glm::dmat4 whole = world_from_object(o.placement);
  for (const ObjectDescription* p = find_named(scene.objects, o.parent); p != nullptr; p = find_named(scene.objects, p->parent))
    whole = world_from_object(p->placement) * whole;
  if (o.instances.empty()) return {whole};
  std::vector<glm::dmat4> places;
  for (const Placement& p : o.instances) places.push_back(whole * world_from_object(p));
  return places;
}

void ScenePreparation::place(PlacedSurface& s, glm::dmat4 world) const {
  s.clip_from_object = glm::mat4(view_.clip_from_world * world);
  world[3] -= glm::dvec4(view_.eye_ws, 0.0);
  s.world_from_object = glm::mat4(world);
  s.normal_from_object = normal_matrix(world);
  s.handedness = glm::determinant(glm::dmat3(world)) < 0 ? -1.0f : 1.0f;
}

ScenePreparation::Relief ScenePreparation::relief_of(const ObjectDescription& o, const std::string& path) {
  if (!is_displaced(o)) return {};
  const MapUse use = maps_.use_of(o.height, o);
  Relief r;
  r.field = maps_.height_field(use, o, path + ".height");
  r.recipe = recipe(static_cast<int>(use.texture.source), use.texture.file.path.string(), use.width, o.height_smoothing, o.height_scale,
                    o.height_zero);
  return r;
}

// Returns the slopes of a displaced sphere for per-pixel normals. The map is null if the mesh has the final normals.
DetailMap ScenePreparation::slopes_of(const Relief& relief, const ObjectDescription& o) {
  DetailMap d;
  if (relief.field == nullptr || o.shape != Shape::uv_sphere || o.normals != NormalSource::pixel) return d;
  const int width = std::min(maps_.width_for(o), relief.field->width());
  const auto map = used_.asset<Texture2D>(recipe("slopes", relief.recipe, width, o.radius), [&] {
    const HeightField filtered = relief.field->filtered(width, workers_);
    return Texture2D(slope_map(filtered, width, std::max(1, width / 2), o.radius, o.height_scale, o.height_zero, workers_),
                     TexelFormat::rgba16f, &workers_);
  });
  d.map = map.get();
  d.sampler = make_sampler(maps_.use_of(o.height, o).texture);
  d.sampler.wrap_t = Wrap::clamp;
  return d;
}

namespace {

// Returns the mesh's streams in the order of the shader's attributes.
template <class S>
VertexView view_of(const SurfaceStreams& m) {
  if constexpr (S::kTangents) return make_vertex_view(stream(m.positions), stream(m.normals), stream(m.tangents), stream(m.uvs));
  if constexpr (S::kNormals && S::kMapped) return make_vertex_view(stream(m.positions), stream(m.normals), stream(m.uvs));
  if constexpr (S::kNormals) return make_vertex_view(stream(m.positions), stream(m.normals));
  if constexpr (S::kMapped) return make_vertex_view(stream(m.positions), stream(m.uvs));
  return make_vertex_view(stream(m.positions));
}

template <ShadingRate rate, bool mapped, NormalDetail detail = NormalDetail::none, bool highlight = true>
PreparedDraw draw_of(const LitSurface& surface, const SurfaceStreams& mesh, const std::shared_ptr<const Indices>& indices) {
  using S = SurfaceShader<rate, mapped, detail, highlight>;
  return {S{surface}, view_of<S>(mesh), indices,
          opaque_state(surface.two_sided ? CullMode::none : CullMode::back, surface.handedness < 0.0f)};
}

}  // namespace

PreparedDraw surface_draw(const LitSurface& s, ShadingRate rate, NormalDetail detail, const SurfaceStreams& mesh,
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

// Sets the map that provides an object's per-pixel normals, if there is one.
NormalDetail ScenePreparation::add_detail(LitSurface& s, const ObjectDescription& o, const Relief& relief, const std::string& path) {
  const SurfaceDescription& d = o.surface;
  if (d.shading != ShadingRate::phong) return NormalDetail::none;
  const bool automatic = d.normal == DetailChoice::automatic;
  if (d.normal == DetailChoice::map || (automatic && is_map(d.normal_map))) {
    if (!is_map(d.normal_map))
      throw InputError(path + ".normal: is map, but there is no normal_map; expected a texture or an image file as normal_map");
    s.detail = normal_map(o, path + ".normal_map");
    return NormalDetail::map;
  }
  if (d.normal == DetailChoice::bump || (automatic && is_map(d.bump_map))) {
    if (!is_map(d.bump_map))
      throw InputError(path + ".normal: is bump, but there is no bump_map; expected a texture or an image file as bump_map");
    s.detail = bump_map(o, path + ".bump_map");
    return NormalDetail::bump;
  }
  s.detail = slopes_of(relief, o);
  return s.detail.map != nullptr ? NormalDetail::slopes : NormalDetail::none;
}

void ScenePreparation::add_object(int object) {
  const auto& [name, o] = scene_.objects[static_cast<std::size_t>(object)];
  const std::string path = "objects." + name;
  if (o.shape == Shape::sphere) return add_exact_spheres(object, path, o);
  if (o.shape == Shape::file) return add_model(object, path, o);
  const Relief relief = relief_of(o, path);
  const std::shared_ptr<const MeshAsset> mesh = mesh_of(o, relief);
  const std::shared_ptr<const Indices> indices(mesh, &mesh->indices);
  if (o.shape == Shape::plane && o.shadow_only) return add_shadow_catcher(o, *mesh, indices, object);
  LitSurface surface = surface_of(o, path);
  const NormalDetail detail = add_detail(surface, o, relief, path);
  const SurfaceStreams streams{mesh->mesh.positions, mesh->mesh.normals, mesh->mesh.tangents, mesh->mesh.uvs};
  const MeshStreams all_streams{streams.positions, streams.normals, streams.tangents, {}, streams.uvs, {}};
  int copy = 0;
  for (const glm::dmat4& world : places_of(scene_, o)) {
    place(surface, world);
    out_.draws.push_back(surface_draw(surface, o.surface.shading, detail, streams, indices));
    out_.draws.back().source = {object, copy++, all_streams, world};
    out_.meshes.push_back(
        {mesh->mesh.positions, mesh->mesh.normals, indices, world, surface.two_sided, o.casts_shadow, o.receives_shadow, object});
  }
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
