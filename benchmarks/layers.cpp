// SPDX-License-Identifier: Apache-2.0
//
// layers_b2f, layers_f2b: ten quads behind each other that all fill the picture; what overdraw costs, in the worst and the
// best order.
#include <array>

#include "families.h"
#include "workload_canvas.h"
#include "workload_layers.h"

namespace halfspace {

namespace {

using Vertex = LayerShader::Attributes<float>;
constexpr int kLayers = 10;

void add_layer(int k, double aspect, std::vector<Vertex>& to) {
  const double z = -(2.0 + 0.5 * k), h = 1.05 * -z * kTanHalfAngle, w = h * aspect;
  const glm::vec3 base(glm::dvec3(0.1 * (k + 1), 0.5, 1.0 - 0.1 * k));
  const std::array<glm::dvec2, 6> corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}}};
  for (const glm::dvec2& c : corners) to.push_back({glm::vec3(glm::dvec3(c.x * w, c.y * h, z)), {0, 0, 1}, base});
}

std::unique_ptr<Workload> prepare_layers(WorkloadSize size, bool front_to_back) {
  auto mesh = std::make_shared<std::vector<Vertex>>();
  const double aspect = static_cast<double>(size.width) / size.height;
  for (int i = 0; i < kLayers; ++i) add_layer(front_to_back ? i : kLayers - 1 - i, aspect, *mesh);
  const LayerShader shader{.clip_from_eye = glm::mat4(workload_projection(size, 0.5, 10.0))};
  return std::make_unique<SingleDraw<LayerShader>>(size, shader, vertices(stream(*mesh)), Indices::sequential(mesh->size()),
                                                   workload_state(), mesh);
}

}  // namespace

std::unique_ptr<Workload> prepare_layers_b2f(WorkloadSize size, WorkloadAssets&) { return prepare_layers(size, false); }
std::unique_ptr<Workload> prepare_layers_f2b(WorkloadSize size, WorkloadAssets&) { return prepare_layers(size, true); }

}  // namespace halfspace
