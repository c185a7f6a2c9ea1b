// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "halfspace/model/model.h"

namespace halfspace::inline HS_LANES_NAMESPACE {

/// Returns whether a file with these contents is a binary STL file: its size matches the number of triangles that it declares.
bool is_binary_stl(std::span<const std::byte> bytes);

/// Returns whether the contents begin with the word "solid", in any case and possibly after blanks. This is also true for some binary
/// files.
bool is_text_stl(std::span<const std::byte> bytes);

/// Reads an STL file, binary or text, whose contents are `bytes`; `file` is for messages. The result has one mesh with z up. Vertices
/// with equal positions are joined, and normals are computed from the triangles; those in the file are not used, because many programs
/// write wrong ones. Colors of binary files follow the convention of VisCAM and SolidView: 5 bits each of red, green and blue if bit 15
/// is set. Triangles that are not finite are skipped with a warning. Throws InputError "FILE: PLACE: problem; expected ..." if the file
/// is not valid.
Model read_stl(const std::filesystem::path& file, std::span<const std::byte> bytes, const ReadModelOptions& options);

}  // namespace halfspace::inline HS_LANES_NAMESPACE
