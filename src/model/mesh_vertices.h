// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "halfspace/model/model.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Replaces the vertices of a mesh: the new vertex i is a copy of the old vertex sources[i], with all its data. Indices are not changed.
void copy_vertices(ModelMesh& mesh, std::span<const uint32_t> sources);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
