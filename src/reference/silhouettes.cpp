// SPDX-License-Identifier: Apache-2.0
#include "reference/silhouettes.h"

#include <algorithm>
#include <cmath>

#include "raster/pass.h"
#include "reference/numbered_mesh.h"

namespace halfspace {

Image<int> seen_objects(const PreparedScene& scene, int finer, const Workers& workers) {
  const int width = finer * scene.view.width_px, height = finer * scene.view.height_px;
  Image<glm::vec4> numbers(width, height);
  Pass pass(width, height, rgba32f_target(numbers), {.format = DepthFormat::d32f, .clear_value = 0.0f});
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    const PlacedMesh& m = scene.meshes[i];
    pass.draw(NumberedMesh{{glm::mat4(scene.view.clip_from_world * m.world_from_object)}, static_cast<float>(i + 1)},
              vertices(stream(m.mesh->positions)), *m.indices, opaque_state(m.two_sided ? CullMode::none : CullMode::back, m.mirrored()));
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
