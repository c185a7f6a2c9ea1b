// SPDX-License-Identifier: Apache-2.0
//
// The table of workloads.
#include <array>

#include "families.h"

namespace halfspace {

namespace {

using Prepare = std::unique_ptr<Workload> (*)(SphereDetail, WorkloadSize, WorkloadAssets&);

// A sphere workload at one level of detail.
template <Prepare prepare, const SphereDetail& detail>
std::unique_ptr<Workload> at(WorkloadSize size, WorkloadAssets& assets) {
  return prepare(detail, size, assets);
}

const std::array kWorkloads{
    WorkloadKind{"clear", "colour and depth cleared, nothing drawn", prepare_clear},
    WorkloadKind{"fill", "one quad of one colour over the whole picture", prepare_fill},
    WorkloadKind{"layers_b2f", "10 quads over the whole picture, Phong by pixel, back to front", prepare_layers_b2f},
    WorkloadKind{"layers_f2b", "the same, front to back", prepare_layers_f2b},
    WorkloadKind{"sphere_phong_20k", "textured sphere lit by pixel, 20,000 triangles", at<prepare_sphere_phong, k20k>},
    WorkloadKind{"sphere_phong_200k", "200,000 triangles", at<prepare_sphere_phong, k200k>},
    WorkloadKind{"sphere_phong_2m", "2,000,000 triangles", at<prepare_sphere_phong, k2m>},
    WorkloadKind{"sphere_gouraud_20k", "textured sphere lit by vertex, 20,000 triangles", at<prepare_sphere_gouraud, k20k>},
    WorkloadKind{"sphere_gouraud_200k", "200,000 triangles", at<prepare_sphere_gouraud, k200k>},
    WorkloadKind{"sphere_gouraud_2m", "2,000,000 triangles", at<prepare_sphere_gouraud, k2m>},
    WorkloadKind{"sphere_flat_20k", "textured sphere with the light of the last vertex, 20,000 triangles", at<prepare_sphere_flat, k20k>},
    WorkloadKind{"sphere_flat_200k", "200,000 triangles", at<prepare_sphere_flat, k200k>},
    WorkloadKind{"sphere_flat_2m", "2,000,000 triangles", at<prepare_sphere_flat, k2m>},
    WorkloadKind{"tiny_1m", "1,000,000 triangles of one square pixel", prepare_tiny_1m},
    WorkloadKind{"shadow_200k", "sphere and plane with a shadow map of 2048 x 2048 texels, 3 x 3 of them a pixel", prepare_shadow_200k},
    WorkloadKind{"points_100k", "100,000 points shaded as spheres that write depth", prepare_points_100k},
    WorkloadKind{"hdr_200k", "sphere_phong_200k in half floats, and tone mapping", prepare_hdr_200k},
    WorkloadKind{"tonemap", "tone mapping of that picture alone", prepare_tonemap},
    WorkloadKind{"draws_10k", "10,000 draws of one quad each", prepare_draws_10k},
    WorkloadKind{"blend_10", "the 10 quads half transparent, back to front", prepare_blend_10},
    WorkloadKind{"msaa4_200k", "sphere_phong_200k with four samples a pixel", prepare_msaa4_200k},
    WorkloadKind{"alpha_test", "the 10 quads with holes by a texture, front to back", prepare_alpha_test},
    WorkloadKind{"aniso_floor", "a textured plane almost to the horizon, anisotropy 16", prepare_aniso_floor},
    WorkloadKind{"near_clip", "sphere_phong_200k from just inside of its surface", prepare_near_clip},
    WorkloadKind{"depth_prepass", "layers_b2f after its depth alone", prepare_depth_prepass},
};

}  // namespace

std::span<const WorkloadKind> workloads() { return kWorkloads; }

}  // namespace halfspace
