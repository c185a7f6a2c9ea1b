// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "workloads/workload.h"

namespace halfspace {

/// The rows of scene_workloads(), drawn by the current OpenGL context.
std::span<const WorkloadKind> gl_scene_workloads();
/// The rows of view_workloads().
std::span<const WorkloadKind> gl_view_workloads();

}  // namespace halfspace
