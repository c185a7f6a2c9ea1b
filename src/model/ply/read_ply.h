// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Reads a PLY file whose contents are `bytes`; `file` is for messages and for the texture, if a comment names one. The result has one
/// mesh: the faces as triangles; without faces, the edges as lines; without edges, the vertices as points. Vertices that are not finite,
/// and their faces, are skipped with a warning. Throws InputError "FILE: PLACE: problem; expected ..." if the file is not valid.
Model read_ply(const std::filesystem::path& file, std::span<const std::byte> bytes, const ReadModelOptions& options);

}  // namespace halfspace::HS_LANES
