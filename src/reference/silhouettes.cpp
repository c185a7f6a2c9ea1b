// SPDX-License-Identifier: Apache-2.0
#include "reference/silhouettes.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "raster/pass.h"
#include "reference/numbered_mesh.h"
#include "scene/sphere_camera.h"

namespace halfspace {

Image<int> seen_objects(const PreparedScene& scene, int finer, const Workers& workers) {
  const View& view = scene.view;
  const int width = finer * view.width_px, height = finer * view.height_px;
  Image<glm::vec4> numbers(width, height);
  Pass pass(width, height, rgba32f_target(numbers), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  for (const PlacedMesh& m : scene.meshes) {
    pass.draw(NumberedMesh{{glm::mat4(view.clip_from_world * m.world_from_object)}, static_cast<float>(m.object + 1)},
              vertices(stream(m.mesh->positions)), *m.indices, opaque_state(m.two_sided ? CullMode::none : CullMode::back, m.mirrored()));
  }
  const SphereCamera camera(view.clip_from_world, view.near, view.far);
  std::deque<std::vector<glm::vec3>> centers_cs;  // the pass points into them
  for (const PlacedSpheres& s : scene.spheres) {
    if (s.object < 0) continue;
    const auto& centers = centers_cs.emplace_back(camera.centers_cs(*s.particles));
    DrawState state = opaque_state(CullMode::none, false);
    state.topology = Topology::points;
    pass.draw(NumberedSphere{{camera.lens({width, height})}, static_cast<float>(s.object + 1)},
              vertices(stream(centers), stream(s.particles->radii)), state);
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

}  // namespace halfspace
