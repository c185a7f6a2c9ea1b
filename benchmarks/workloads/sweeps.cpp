// SPDX-License-Identifier: Apache-2.0
#include "workloads/sweeps.h"

#include <fmt/format.h>

#include <algorithm>

#include "workloads/families.h"
#include "workloads/layer_mesh.h"
#include "workloads/workload_constant.h"
#include "workloads/workload_geometry.h"
#include "workloads/workload_varyings.h"

namespace halfspace {

namespace {

WorkloadKind triangle_size(double area) {
  const int count = triangles_of_size(area);
  return {sweep_point("triangle_size", area), fmt::format("{} triangles", count), [=](WorkloadSize size, WorkloadAssets&) {
            auto corners = std::make_shared<const std::vector<glm::vec3>>(tiny_triangles(size, count, area));
            return std::make_unique<SingleDraw<ConstantShader>>(size, ConstantShader{kTinyColor}, make_vertex_view(stream(*corners)),
                                                                Indices::sequential(corners->size()), DrawState{}, corners);
          }};
}

WorkloadKind triangle_count(SphereDetail detail) {
  return {sweep_point("triangle_count", detail.triangles()), "sphere_phong",
          [=](WorkloadSize size, WorkloadAssets& assets) { return prepare_sphere_phong(detail, size, assets); }};
}

WorkloadKind overdraw(int layers) {
  return {sweep_point("overdraw", layers), "quads that cover the whole image, back to front", [=](WorkloadSize size, WorkloadAssets&) {
            auto mesh = std::make_shared<const LayerMesh>(layer_mesh(size, false, layers));
            return std::make_unique<SingleDraw<LayerShader>>(size, layer_shader(size), make_vertex_view(stream(*mesh)),
                                                             Indices::sequential(mesh->size()), workload_state(), mesh);
          }};
}

template <int N>
WorkloadKind varyings() {
  return {sweep_point("varyings", N), "float varyings", [](WorkloadSize size, WorkloadAssets& assets) {
            const std::shared_ptr<const SphereMesh> mesh = assets.sphere(k20k.rows, k20k.columns);
            const VaryingsShader<N> shader{sphere_uniforms(size, *assets.checker()).clip_from_world};
            return std::make_unique<SingleDraw<VaryingsShader<N>>>(size, shader,
                                                                   make_vertex_view(stream(mesh->vertices, &SphereVertex::position)),
                                                                   Indices(mesh->indices, mesh->vertices.size()), workload_state(), mesh);
          }};
}

template <class Numbers, class Make>
std::vector<WorkloadKind> each(const Numbers& numbers, Make make) {
  std::vector<WorkloadKind> kinds;
  for (const auto& n : numbers) kinds.push_back(make(n));
  return kinds;
}

}  // namespace

int triangles_of_size(double area) { return static_cast<int>(std::clamp(4e6 / area, 16.0, 1e6)); }

std::string sweep_point(std::string_view series, double number) { return fmt::format("{}={:.10g}", series, number); }

std::span<const Sweep> sweeps() {
  static const std::vector<Sweep> all{{"triangle_size", each(kTriangleSizes, triangle_size)},
                                      {"triangle_count", each(kTriangleCounts, triangle_count)},
                                      {"overdraw", each(kOverdraws, overdraw)},
                                      {"varyings", {varyings<0>(), varyings<4>(), varyings<8>(), varyings<16>(), varyings<32>()}}};
  return all;
}

}  // namespace halfspace
