// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "halfspace/model/model.h"

namespace halfspace::HS_LANES {

/// Returns whether a file with these contents is a binary STL file: its size matches the number of triangles that it declares.
bool is_binary_stl(std::span<const std::byte> bytes);

/// Reads an STL file, binary or text, whose contents are `bytes`; `file` is for messages. The result has one mesh with z up. Vertices
/// with equal positions are joined, and normals are computed from the triangles; those in the file are not used, because many programs
/// write wrong ones. Colors of binary files are 5 bits per channel. They follow the convention of Materialise Magics if the header has
/// "COLOR=": bit 15 selects the color in the header, and red is in the low bits. Otherwise they follow that of VisCAM and SolidView: bit 15
/// says that there is a color, and blue is in the low bits. Triangles that are not finite are skipped with a warning. Throws InputError
/// "FILE: PLACE: problem; expected ..." if the file is not valid.
Model read_stl(const std::filesystem::path& file, std::span<const std::byte> bytes, const ReadModelOptions& options);

}  // namespace halfspace::HS_LANES
