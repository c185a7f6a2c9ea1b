// SPDX-License-Identifier: Apache-2.0
//
// Writes models as glTF, OBJ, PLY and STL.
#pragma once

#include <filesystem>
#include <optional>

#include "halfspace/model/model.h"
#include "halfspace/model/written_model.h"

namespace halfspace::HS_LANES {

enum class ModelFormat : uint8_t { glb, gltf, obj, ply, stl };

/// Returns the format for the extension of a file name (case-insensitive), or nothing if it is not that of a model.
std::optional<ModelFormat> model_format_of(const std::filesystem::path& file);

/// Converts a model to files of the format. `file` gives their names. Images must be in memory (ModelImage::bytes) as PNG or JPEG; others
/// are omitted, with a warning if a material uses them.
///
/// glb, gltf: everything in Model. Positions are stored relative to ModelMesh::origin, which becomes the translation of a node. A model
///   with z up gets a node that rotates it. Texture channels that glTF does not permit are omitted with a warning.
/// obj: all meshes in world space, materials as .mtl, with PBR statements where metals or PBR maps need them, and textures. Numbers have
///   the shortest form that reads back as the same value.
/// ply: binary; all triangles in world space as one mesh, or all points if there are no triangles. Has normals, and colors and texture
///   coordinates if any mesh has them.
/// stl: the triangles in world space, binary, z up.
///
/// obj, ply and stl contain the default scene without animation. Throws InputError if the model contains nothing that the format can
/// store, and OutputError if it contains more than the format can address.
WrittenModel written_model(const Model& model, const std::filesystem::path& file, ModelFormat format);

}  // namespace halfspace::HS_LANES
