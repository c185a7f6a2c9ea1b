// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Reads a glTF 2.0 file, text or binary, whose contents are `bytes`, and the buffers that it refers to. Images are located but not read.
/// Primitives without a material get the default material of glTF. Throws InputError "FILE: PLACE: problem; expected ...", where PLACE is
/// the path of the value in the file, for example "accessors[3].count".
Model read_gltf(const std::filesystem::path& file, std::span<const std::byte> bytes, const ReadModelOptions& options);

}  // namespace halfspace::HS_LANES
