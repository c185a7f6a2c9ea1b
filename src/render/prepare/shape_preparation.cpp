// SPDX-License-Identifier: Apache-2.0
#include "halfspace/render/prepare/shape_preparation.h"

#include "halfspace/render/prepare/normal_lines.h"
#include "halfspace/render/prepare/scene_places.h"
#include "halfspace/render/prepare/surface_draw.h"

namespace halfspace::HS_LANES {

std::shared_ptr<const MeshAsset> ShapePreparation::mesh_of(int object, const std::string& path, const ObjectDescription& o,
                                                           const Relief& relief, const std::vector<glm::dmat4>& places) {
  if (o.mesh_error == 0.0) return meshes_.mesh_of(o, relief);
  const bool casts = o.casts_shadow && scene_.shadow.method != ShadowMethod::none;
  const std::shared_ptr<const FittedMesh> fitted = adaptive_.mesh_of(o, relief, places, casts, path);
  draws_.simplified.push_back(fitted->report);
  draws_.simplified.back().object = object;
  return {fitted, &fitted->asset};
}

void ShapePreparation::add(int object, const std::string& path, const ObjectDescription& o) {
  const Relief relief = meshes_.relief_of(o, path);
  const std::vector<glm::dmat4> places = places_of(scene_, o);
  const std::shared_ptr<const MeshAsset> mesh = mesh_of(object, path, o, relief, places);
  const std::shared_ptr<const Indices> indices(mesh, &mesh->indices);
  if (o.shape == Shape::plane && o.shadow_only) return add_shadow_catcher(object, o, *mesh, indices);
  LitSurface surface = surfaces_.surface_of(o, path);
  const NormalDetail detail = details_.add_detail(surface, o, relief, path);
  const MeshStreams streams{mesh->mesh.positions, mesh->mesh.normals, mesh->mesh.tangents, {}, mesh->mesh.uvs, {}};
  const Clusters* const clusters = clusters_.of(indices, mesh->mesh.positions);
  int copy = 0;
  for (const glm::dmat4& world : places) {
    place_surface(surface, view_, world);
    PreparedDraw draw = surface_draw(surface, o.surface.shading, detail, streams, indices);
    draw.source = {object, copy++, streams, world};
    if (clusters != nullptr) draw.state.clusters = ClusterCulling{clusters, surface.clip_from_object};
    if (o.normal_lines > 0.0) draws_.normals.push_back(normal_lines(draw.source, indices, view_, o.normal_lines));
    draws_.add(std::move(draw));
    draws_.meshes.push_back({mesh->mesh.positions, mesh->mesh.normals, indices, world, surface.two_sided, o.casts_shadow, o.receives_shadow,
                             object, shadow_opacity(surface)});
    draws_.meshes.back().clusters = clusters;
  }
}

void ShapePreparation::add_shadow_catcher(int object, const ObjectDescription& o, const MeshAsset& mesh,
                                          const std::shared_ptr<const Indices>& indices) {
  ShadowCatcher catcher;
  catcher.to_eye_ws = glm::vec3(view_.to_eye_ws);
  catcher.lights = lights_.of_surface(true);
  catcher.inverse_radius = static_cast<float>(2.0 / o.size);
  int copy = 0;
  for (const glm::dmat4& world : places_of(scene_, o)) {
    place_surface(catcher, view_, world);
    DrawState state = opaque_state(CullMode::none, false);
    state.order_independent = true;
    state.depth.write = false;
    draws_.blended.push_back({catcher, make_vertex_view(stream(mesh.mesh.positions)), indices, state});
    draws_.blended.back().source = {object, copy++, {mesh.mesh.positions, mesh.mesh.normals, {}, {}, {}, {}}, world};
    draws_.meshes.push_back({mesh.mesh.positions, mesh.mesh.normals, indices, world, true, false, true, object});
  }
}

}  // namespace halfspace::HS_LANES
