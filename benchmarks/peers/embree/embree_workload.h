// SPDX-License-Identifier: Apache-2.0
//
// The sphere workloads by rays.
#pragma once

#include <span>

#include "sweeps.h"
#include "workload.h"

namespace halfspace {

/// The nine sphere workloads by a ray a pixel: same names, same order as in workloads(). Embree's tree is built when a workload
/// is prepared, and so is in no frame; the light of vertices (gouraud, flat) is computed anew in each.
std::span<const WorkloadKind> embree_workloads();
/// The series triangle_count.
std::span<const Sweep> embree_sweeps();

}  // namespace halfspace
