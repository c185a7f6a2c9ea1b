// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Reads an OBJ file whose contents are `bytes`, its material libraries, and the paths of their textures, which are relative to `file`. The
/// result has one node with all meshes; see obj_meshes.h for the meshes and mtl_materials.h for the materials. A file without elements
/// is drawn as points. Throws InputError "FILE:LINE: problem; expected ..." if nothing sensible can be drawn.
Model read_obj(const std::filesystem::path& file, std::span<const std::byte> bytes, const ReadModelOptions& options);

}  // namespace halfspace::HS_LANES
