// SPDX-License-Identifier: Apache-2.0
//
// The functions that prepare the workloads, for the table in workloads.cpp.
#pragma once

#include "workloads/sphere_camera.h"
#include "workloads/workload.h"

namespace halfspace {

std::unique_ptr<Workload> prepare_clear(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_fill(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_layers_b2f(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_layers_f2b(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_sphere_phong(SphereDetail detail, WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_sphere_gouraud(SphereDetail detail, WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_sphere_flat(SphereDetail detail, WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_tiny_1m(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_shadow_200k(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_points_100k(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_hdr_200k(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_tonemap(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_draws_10k(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_blend_10(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_msaa4_200k(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_alpha_test(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_aniso_floor(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_near_clip(WorkloadSize size, WorkloadAssets& assets);
std::unique_ptr<Workload> prepare_depth_prepass(WorkloadSize size, WorkloadAssets& assets);

}  // namespace halfspace
