// SPDX-License-Identifier: Apache-2.0
//
// What models of all formats share: positions, the default material, limits of memory. Models of one mesh, as PLY and STL files contain
// them.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

bool is_finite(const glm::dvec3& v);

/// Sets the origin of the mesh to the center of the bounds of the finite positions. Stores the positions relative to it, rounded to float.
/// Positions that are not finite become the origin. Throws InputError without a place if no position is finite, or if the coordinates are
/// so large that squares of floats would overflow.
void set_positions(ModelMesh& mesh, std::span<const glm::dvec3> positions);

/// The color and roughness of materials that a file does not specify.
inline constexpr float kDefaultModelGray = 0.8f, kDefaultModelRoughness = 0.6f;

/// The material of elements without a material: roughness 0.6 and a gray of 0.8, or white if there are vertex colors.
ModelMaterial default_model_material(bool vertex_colors);

/// Returns a model with one node, which has the mesh and is named after the file. Its material is gray, or white if there are vertex
/// colors, and blended if a vertex color is not opaque.
Model single_mesh_model(std::string format, const std::filesystem::path& file, ModelMesh mesh);

/// Throws an InputError that does not name the file if `bytes` exceeds options.memory_left().
void check_memory(std::size_t bytes, const ReadModelOptions& options);

/// Upper bound on the memory per triangle while normals are computed, in bytes.
inline constexpr std::size_t kBytesPerTriangle = 200;

}  // namespace halfspace::HS_LANES
