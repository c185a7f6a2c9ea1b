// SPDX-License-Identifier: Apache-2.0
#include "gl_workload.h"

#include <algorithm>

#include "core/check.h"
#include "gl_families.h"

namespace halfspace {

namespace {

using Prepare = std::function<std::unique_ptr<Workload>(std::string_view, WorkloadSize, WorkloadAssets&)>;

Prepare sphere(gl::Light light, SphereDetail detail) {
  return [=](std::string_view name, WorkloadSize size, WorkloadAssets& assets) { return gl::sphere(name, size, assets, light, detail); };
}
Prepare layers(gl::Layers kind, bool front_to_back) {
  return
      [=](std::string_view name, WorkloadSize size, WorkloadAssets& assets) { return gl::layers(name, size, assets, kind, front_to_back); };
}

Prepare preparation_of(std::string_view name) {
  using enum gl::Light;
  using gl::Layers;
  const std::pair<std::string_view, Prepare> table[] = {
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
      {"tiny_1m", gl::tiny},
      {"shadow_200k", gl::shadow},
      {"points_100k", gl::points},
      {"hdr_200k", gl::hdr},
      {"tonemap", gl::tonemap},
      {"draws_10k", gl::draws},
      {"blend_10", layers(Layers::blended, false)},
      {"alpha_test", layers(Layers::perforated, true)},
      {"aniso_floor", gl::floor},
      {"near_clip", gl::near_clip},
      {"depth_prepass", layers(Layers::prepass, false)},
  };
  for (const auto& [known, prepare] : table) {
    if (known == name) return prepare;
  }
  throw InputError("no OpenGL program draws the workload " + std::string(name));
}

std::vector<WorkloadKind> all_kinds() {
  std::vector<WorkloadKind> kinds;
  for (const WorkloadKind& kind : workloads()) {
    kinds.push_back(
        {kind.name, kind.what, [name = kind.name, prepare = preparation_of(kind.name)](WorkloadSize size, WorkloadAssets& assets) {
           return prepare(name, size, assets);
         }});
  }
  return kinds;
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

WorkloadTruth GlWorkload::truth() const {
  return std::ranges::find(workloads(), name_, &WorkloadKind::name)->prepare(size_, assets_)->truth();
}

std::span<const WorkloadKind> gl_workloads() {
  static const std::vector<WorkloadKind> kinds = all_kinds();
  return kinds;
}

}  // namespace halfspace
