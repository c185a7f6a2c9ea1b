// SPDX-License-Identifier: Apache-2.0
//
// Prepares the objects of a scene.
#include "halfspace/render/preparation.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

void ScenePreparation::add_object(int object) {
  const auto& [name, o] = scene_.objects[static_cast<std::size_t>(object)];
  const std::string path = "objects." + name;
  if (o.shape == Shape::sphere) return add_exact_spheres(object, path, o);
  if (o.shape == Shape::file) return add_model(object, path, o);
  const Relief relief = meshes_.relief_of(o, path);
  const std::shared_ptr<const MeshAsset> mesh = meshes_.mesh_of(o, relief);
  const std::shared_ptr<const Indices> indices(mesh, &mesh->indices);
  if (o.shape == Shape::plane && o.shadow_only) return add_shadow_catcher(o, *mesh, indices, object);
  LitSurface surface = surfaces_.surface_of(o, path);
  const NormalDetail detail = details_.add_detail(surface, o, relief, path);
  const SurfaceStreams streams{mesh->mesh.positions, mesh->mesh.normals, mesh->mesh.tangents, mesh->mesh.uvs};
  const MeshStreams all_streams{streams.positions, streams.normals, streams.tangents, {}, streams.uvs, {}};
  int copy = 0;
  for (const glm::dmat4& world : places_of(scene_, o)) {
    place_surface(surface, view_, world);
    out_.draws.push_back(surface_draw(surface, o.surface.shading, detail, streams, indices));
    out_.draws.back().source = {object, copy++, all_streams, world};
    out_.meshes.push_back(
        {mesh->mesh.positions, mesh->mesh.normals, indices, world, surface.two_sided, o.casts_shadow, o.receives_shadow, object});
  }
}

}  // namespace halfspace::inline HS_LANES_NAMESPACE
