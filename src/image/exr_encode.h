// SPDX-License-Identifier: Apache-2.0
//
// OpenEXR encoding in memory. The build chooses exr_encode.cpp, which uses OpenEXR, or exr_encode_by_tool.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "halfspace/image/image_io.h"

namespace halfspace::HS_LANES {

inline constexpr std::size_t sample_bytes(ExrSample s) { return s == ExrSample::float16 ? 2 : 4; }

/// Encodes a single-part scanline file with ZIP compression. The output depends only on the arguments, so equal samples give equal bytes.
/// Throws OutputError, with a message that begins with path. Nothing is written to path.
std::vector<std::byte> encode_exr(const std::filesystem::path& path, int width, int height, std::span<const ExrChannel> channels,
                                  const ImageText& text);

}  // namespace halfspace::HS_LANES
