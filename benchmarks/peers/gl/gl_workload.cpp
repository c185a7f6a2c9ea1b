// SPDX-License-Identifier: Apache-2.0
#include "peers/gl/gl_workload.h"

#include <functional>
#include <map>

#include "peers/gl/gl_families.h"
#include "workloads/layer_mesh.h"

namespace halfspace {

namespace {

using Prepare = std::function<std::unique_ptr<Workload>(const GlInput&)>;

Prepare sphere(gl::Light light, SphereDetail detail) {
  return [=](const GlInput& in) { return gl::sphere(in, light, detail); };
}
Prepare layers(gl::Layers kind, bool front_to_back, int count = kLayers) {
  return [=](const GlInput& in) { return gl::layers(in, kind, front_to_back, count); };
}
Prepare triangles(int count, double area) {
  return [=](const GlInput& in) { return gl::triangles(in, count, area); };
}

const std::map<std::string, Prepare>& preparations() {
  using enum gl::Light;
  using gl::Layers;
  static const std::map<std::string, Prepare> table{
      {"clear", gl::clear},
      {"fill", gl::fill},
      {"layers_b2f", layers(Layers::plain, false)},
      {"layers_f2b", layers(Layers::plain, true)},
      {"sphere_phong_20k", sphere(pixel, k20k)},
      {"sphere_phong_200k", sphere(pixel, k200k)},
      {"sphere_phong_2m", sphere(pixel, k2m)},
      {"sphere_gouraud_20k", sphere(vertex, k20k)},
      {"sphere_gouraud_200k", sphere(vertex, k200k)},
      {"sphere_gouraud_2m", sphere(vertex, k2m)},
      {"sphere_flat_20k", sphere(flat, k20k)},
      {"sphere_flat_200k", sphere(flat, k200k)},
      {"sphere_flat_2m", sphere(flat, k2m)},
      {"tiny_1m", triangles(1'000'000, 1.0)},
      {"shadow_200k", gl::shadow},
      {"points_100k", gl::points},
      {"hdr_200k", gl::hdr},
      {"tonemap", gl::tonemap},
      {"draws_10k", gl::draws},
      {"blend_10", layers(Layers::blended, false)},
      {"msaa4_200k", gl::multisampled_sphere},
      {"alpha_test", layers(Layers::perforated, true)},
      {"aniso_floor", gl::floor},
      {"near_clip", gl::near_clip},
      {"depth_prepass", layers(Layers::prepass, false)},
  };
  return table;
}

WorkloadKind kind_of(const WorkloadKind& twin, const Prepare& prepare) {
  return {twin.name, twin.what, [&twin, prepare](WorkloadSize size, WorkloadAssets& assets) { return prepare({twin, size, assets}); }};
}

std::vector<WorkloadKind> all_workloads() {
  std::vector<WorkloadKind> kinds;
  for (const WorkloadKind& twin : workloads()) kinds.push_back(kind_of(twin, preparations().at(twin.name)));
  return kinds;
}

// Returns a series with one workload for each number, in the same order.
template <class Numbers, class PrepareOf>
Sweep sweep(std::size_t index, const Numbers& numbers, PrepareOf prepare_of) {
  const Sweep& twin = sweeps()[index];
  Sweep out{twin.name, {}};
  for (std::size_t i = 0; i < numbers.size(); ++i) out.kinds.push_back(kind_of(twin.kinds[i], prepare_of(numbers[i])));
  return out;
}

std::vector<Sweep> all_sweeps() {
  return {sweep(0, kTriangleSizes, [](double area) { return triangles(triangles_of_size(area), area); }),
          sweep(1, kTriangleCounts, [](SphereDetail detail) { return sphere(gl::Light::pixel, detail); }),
          sweep(2, kOverdraws, [](int count) { return layers(gl::Layers::plain, false, count); }),
          sweep(3, kVaryings, [](int count) { return [=](const GlInput& in) { return gl::varyings(in, count); }; })};
}

}  // namespace

void GlWorkload::frame(const Workers&) {
  draw();
  glFinish();
}

WorkloadPicture GlWorkload::picture() const {
  color_ = target_.read_color();
  if (!target_.has_depth()) return {&color_, nullptr};
  depth_ = target_.read_depth();
  return {&color_, &depth_};
}

std::span<const WorkloadKind> gl_workloads() {
  static const std::vector<WorkloadKind> kinds = all_workloads();
  return kinds;
}

std::span<const Sweep> gl_sweeps() {
  static const std::vector<Sweep> all = all_sweeps();
  return all;
}

}  // namespace halfspace
