// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "workloads/workload.h"

namespace halfspace {

/// The workloads of model_workloads(), drawn by the current OpenGL context. Preparing one throws InputError if the model has textures,
/// vertex colors, transparency, clearcoat, sheen, or lights that are not directional.
std::vector<WorkloadKind> gl_model_workloads(const std::string& file);

}  // namespace halfspace
