// SPDX-License-Identifier: Apache-2.0
#include "halfspace/reference/silhouettes.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "halfspace/raster/pass.h"
#include "halfspace/reference/numbered_mesh.h"
#include "halfspace/render/shadow/sphere_camera.h"

namespace halfspace::HS_LANES {

namespace {

// Draws impostors at the resolution of `lens`, with the number of each sphere in the red channel. The pass keeps a pointer to `numbers`.
void draw_numbers(Pass& pass, const PreparedDraw& draw, SphereImpostor<false> sprite, const SphereIntersection& lens, int finer,
                  const std::vector<glm::vec3>& numbers) {
  sprite.lens = lens;
  sprite.point_scale *= static_cast<float>(finer);
  sprite.lights = {};
  sprite.ambient = glm::vec3(1.0f);
  VertexView vertices = draw.vertices;
  vertices.streams[2] = stream(numbers);
  pass.draw(sprite, vertices, *draw.indices, sprite_state());
}

}  // namespace

Image<int> seen_objects(const PreparedScene& scene, int finer, const Workers& workers) {
  const View& view = scene.view;
  const int width = finer * view.width_px, height = finer * view.height_px;
  Image<glm::vec4> numbers(width, height);
  Pass pass(width, height, rgba32f_target(numbers), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  for (const PlacedMesh& m : scene.meshes) {
    pass.draw(NumberedMesh{{glm::mat4(view.clip_from_world * m.world_from_object)}, static_cast<float>(m.object + 1)},
              make_vertex_view(stream(m.positions)), *m.indices, opaque_state(m.two_sided ? CullMode::none : CullMode::back, m.mirrored()));
  }
  const SphereCamera camera(view.clip_from_world, view.near, view.far);
  std::deque<std::vector<glm::vec3>> centers_cs;  // the pass keeps pointers to the elements
  const SphereIntersection lens = camera.lens({width, height});
  for (const PlacedSpheres& s : scene.spheres) {
    const auto& centers = centers_cs.emplace_back(camera.centers_cs(*s.particles));
    const auto number = static_cast<float>(s.object < 0 ? kParticlesSeen : s.object + 1);
    pass.draw(NumberedSphere{{lens}, number}, make_vertex_view(stream(centers), stream(s.particles->radii)), sprite_state());
  }
  std::vector<glm::vec3> particle_numbers;
  for (const PreparedDraw& draw : scene.draws) {
    const auto* sprite = std::get_if<SphereImpostor<false>>(&draw.shader);
    if (sprite == nullptr) continue;
    particle_numbers.assign(draw.indices->size(), glm::vec3(static_cast<float>(kParticlesSeen)));
    draw_numbers(pass, draw, *sprite, lens, finer, particle_numbers);
  }
  pass.run(workers);
  Image<int> objects(width, height);
  std::ranges::transform(numbers.texels(), objects.data(), [](const glm::vec4& t) { return static_cast<int>(std::lround(t.x)); });
  return objects;
}

EdgeDistance silhouette_distance(const Image<int>& picture, const Image<int>& truth, int finer) {
  Image<uint8_t> wrong(picture.width(), picture.height());
  std::ranges::transform(picture.texels(), truth.texels(), wrong.data(), [](int a, int b) { return static_cast<uint8_t>(a != b); });
  return wrong_band_width(wrong, finer);
}

}  // namespace halfspace::HS_LANES
