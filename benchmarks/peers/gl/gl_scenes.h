// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "workloads/workload.h"

namespace halfspace {

/// The rows of scene_workloads(), drawn by the current OpenGL context.
std::span<const WorkloadKind> gl_scene_workloads();

}  // namespace halfspace
