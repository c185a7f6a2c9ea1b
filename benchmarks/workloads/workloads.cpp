// SPDX-License-Identifier: Apache-2.0
//
// The table of workloads.
#include <array>

#include "workloads/families.h"

namespace halfspace {

namespace {

using Prepare = std::unique_ptr<Workload> (*)(SphereDetail, WorkloadSize, WorkloadAssets&);

// A sphere workload at one level of detail.
template <Prepare prepare, const SphereDetail& detail>
std::unique_ptr<Workload> at(WorkloadSize size, WorkloadAssets& assets) {
  return prepare(detail, size, assets);
}

const std::array kWorkloads{
    WorkloadKind{"clear", "color and depth are cleared; nothing is drawn", prepare_clear},
    WorkloadKind{"fill", "one single-color quad over the whole image", prepare_fill},
    WorkloadKind{"layers_b2f", "10 full-screen quads with per-pixel Phong shading, back to front", prepare_layers_b2f},
    WorkloadKind{"layers_f2b", "layers_b2f, front to back", prepare_layers_f2b},
    WorkloadKind{"sphere_phong_20k", "textured sphere lit per pixel, 20,000 triangles", at<prepare_sphere_phong, k20k>},
    WorkloadKind{"sphere_phong_200k", "sphere_phong_20k with 200,000 triangles", at<prepare_sphere_phong, k200k>},
    WorkloadKind{"sphere_phong_2m", "sphere_phong_20k with 2,000,000 triangles", at<prepare_sphere_phong, k2m>},
    WorkloadKind{"sphere_gouraud_20k", "textured sphere lit per vertex, 20,000 triangles", at<prepare_sphere_gouraud, k20k>},
    WorkloadKind{"sphere_gouraud_200k", "sphere_gouraud_20k with 200,000 triangles", at<prepare_sphere_gouraud, k200k>},
    WorkloadKind{"sphere_gouraud_2m", "sphere_gouraud_20k with 2,000,000 triangles", at<prepare_sphere_gouraud, k2m>},
    WorkloadKind{"sphere_flat_20k", "textured sphere lit at each triangle's last vertex, 20,000 triangles", at<prepare_sphere_flat, k20k>},
    WorkloadKind{"sphere_flat_200k", "sphere_flat_20k with 200,000 triangles", at<prepare_sphere_flat, k200k>},
    WorkloadKind{"sphere_flat_2m", "sphere_flat_20k with 2,000,000 triangles", at<prepare_sphere_flat, k2m>},
    WorkloadKind{"tiny_1m", "1,000,000 triangles with an area of one pixel", prepare_tiny_1m},
    WorkloadKind{"shadow_200k", "sphere and plane with a 2048 x 2048 shadow map, read with 3 x 3 texels per pixel", prepare_shadow_200k},
    WorkloadKind{"points_100k", "100,000 points that are shaded as spheres and write depth", prepare_points_100k},
    WorkloadKind{"hdr_200k", "sphere_phong_200k in half floats, with tone mapping", prepare_hdr_200k},
    WorkloadKind{"tonemap", "only the tone mapping of the hdr_200k picture", prepare_tonemap},
    WorkloadKind{"draws_10k", "10,000 draw calls of one quad each", prepare_draws_10k},
    WorkloadKind{"blend_10", "layers_b2f with quads of 50% opacity", prepare_blend_10},
    WorkloadKind{"msaa4_200k", "sphere_phong_200k with four samples per pixel", prepare_msaa4_200k},
    WorkloadKind{"alpha_test", "layers_f2b with holes from a texture", prepare_alpha_test},
    WorkloadKind{"aniso_floor", "a textured plane that reaches almost to the horizon, with 16x anisotropic filtering", prepare_aniso_floor},
    WorkloadKind{"near_clip", "sphere_phong_200k seen from just inside its surface", prepare_near_clip},
    WorkloadKind{"depth_prepass", "layers_b2f with a depth prepass", prepare_depth_prepass},
};

}  // namespace

std::span<const WorkloadKind> workloads() { return kWorkloads; }

}  // namespace halfspace
