// SPDX-License-Identifier: Apache-2.0
//
// Models of one mesh, which is all that PLY and STL files have.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "halfspace/model/model.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

bool is_finite(const glm::dvec3& v);

/// Sets the origin of the mesh to the center of the bounds of the finite positions. Stores the positions relative to it, rounded to float.
/// Positions that are not finite become the origin. Throws InputError without a place if no position is finite, or if the coordinates are
/// so large that squares of floats would overflow.
void set_positions(ModelMesh& mesh, std::span<const glm::dvec3> positions);

/// Returns a model with one node, which has the mesh and is named after the file. Its material is gray, or white if there are vertex
/// colors, and blended if a vertex color is not opaque.
Model single_mesh_model(std::string format, const std::filesystem::path& file, ModelMesh mesh);

/// Throws an InputError that does not name the file if `bytes` exceeds options.memory_left().
void check_memory(std::size_t bytes, const ReadModelOptions& options);

/// Upper bound on the memory per triangle while normals are computed, in bytes.
inline constexpr std::size_t kBytesPerTriangle = 200;

}  // namespace halfspace::inline HS_LANES_NAMESPACE
