// SPDX-License-Identifier: Apache-2.0
//
// The sphere workloads, drawn by ray casting.
#pragma once

#include <span>

#include "workloads/sweeps.h"
#include "workloads/workload.h"

namespace halfspace {

/// The nine sphere workloads, drawn with one ray per pixel. Names and order are the same as in workloads(). Embree's acceleration structure
/// is built when a workload is prepared and is not part of the frame time. Vertex lighting (gouraud, flat) is computed in every frame.
std::span<const WorkloadKind> embree_workloads();
/// Returns only the series triangle_count.
std::span<const Sweep> embree_sweeps();

}  // namespace halfspace
