// SPDX-License-Identifier: Apache-2.0
//
// Objects of a scene: surface, place, and the shader that draws them.
#include <algorithm>

#include "scene/displaced_sphere.h"
#include "scene/preparation.h"

namespace halfspace {

namespace {

bool is_displaced(const ObjectDescription& o) { return !std::holds_alternative<Color>(o.height); }

DrawState state_of(const ObjectDescription& o, const glm::dmat4& world) {
  DrawState state;
  state.cull = o.shape == Shape::plane ? CullMode::none : CullMode::back;
  if (glm::determinant(glm::dmat3(world)) < 0) state.front = Winding::clockwise;  // mirrored
  state.depth.clip = ClipDepth::zero_to_one;
  state.depth.compare = CompareOp::greater;
  return state;
}

}  // namespace

std::vector<glm::dmat4> places_of(const ObjectDescription& o) {
  const glm::dmat4 whole = world_from_object(o.placement);
  if (o.instances.empty()) return {whole};
  std::vector<glm::dmat4> places;
  for (const Placement& p : o.instances) places.push_back(whole * world_from_object(p));
  return places;
}

// What all copies of an object share.
LitSurface ScenePreparation::surface_of(const ObjectDescription& o, const std::string& path) {
  LitSurface s;
  s.to_eye_ws = glm::vec3(view_.to_eye_ws);
  s.lights = *lights_;
  s.two_sided = o.shape == Shape::plane;
  s.surface = {glm::vec3(o.surface.ambient.linear * scene_.head.ambient.linear), glm::vec3(o.surface.diffuse.linear),
               glm::vec3(o.surface.specular.linear), static_cast<float>(o.surface.shininess)};
  if (const auto* color = std::get_if<Color>(&o.surface.color)) {
    s.color = glm::vec3(color->linear);
  } else {
    const MapUse use = use_of(o.surface.color, o);
    s.map = color_texture(use, path).get();
    s.sampler = make_sampler(use.texture);
  }
  return s;
}

void ScenePreparation::place(LitSurface& s, glm::dmat4 world) const {
  s.clip_from_object = glm::mat4(view_.clip_from_world * world);
  world[3] -= glm::dvec4(view_.eye_ws, 0.0);
  s.world_from_object = glm::mat4(world);
  s.normal_from_object = glm::mat3(glm::transpose(glm::inverse(glm::dmat3(world))));
}

ScenePreparation::Relief ScenePreparation::relief_of(const ObjectDescription& o, const std::string& path) {
  if (!is_displaced(o)) return {};
  const MapUse use = use_of(o.height, o);
  Relief r;
  r.field = height_field(use, o, path);
  r.recipe = recipe(static_cast<int>(use.texture.source), use.texture.file.path.string(), use.width, o.height_smoothing, o.height_scale,
                    o.height_zero);
  if (o.shape != Shape::uv_sphere || o.normals != NormalSource::pixel) return r;
  const int width = std::min(width_for(o), r.field->width());
  r.slopes = asset<Texture2D>(recipe("slopes", r.recipe, width, o.radius), [&] {
    const HeightField filtered = r.field->filtered(width, assets_.workers_);
    return Texture2D(slope_map(filtered, width, std::max(1, width / 2), o.radius, o.height_scale, o.height_zero, assets_.workers_),
                     TexelFormat::rgba16f);
  });
  r.sampler = make_sampler(use.texture);
  r.sampler.wrap_t = Wrap::clamp;
  return r;
}

void ScenePreparation::add_object(const std::string& path, const ObjectDescription& o) {
  const Relief relief = relief_of(o, path);
  const std::shared_ptr<const MeshAsset> asset = mesh_of(o, relief);
  const Mesh& mesh = asset->mesh;
  const std::shared_ptr<const Indices> indices(asset, &asset->indices);
  LitSurface surface = surface_of(o, path);
  for (const glm::dmat4& world : places_of(o)) {
    place(surface, world);
    if (relief.slopes != nullptr) {
      const DisplacedSphere shader{surface, relief.slopes.get(), relief.sampler};
      out_.draws.push_back({shader, vertices(stream(mesh.positions), stream(mesh.uvs)), indices, state_of(o, world)});
    } else {
      const BlinnPhong shader{surface};
      out_.draws.push_back({shader, vertices(stream(mesh.positions), stream(mesh.normals), stream(mesh.uvs)), indices, state_of(o, world)});
    }
  }
}

}  // namespace halfspace
