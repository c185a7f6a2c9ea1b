// SPDX-License-Identifier: Apache-2.0
//
// Detects the formats that the decoder programs read, from the first bytes of a file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Lists for messages: formats that store 8- or 16-bit integers, and all formats.
inline constexpr const char* kCodeFormats = "PNG, JPEG, TIFF, TGA, BMP, GIF, WebP, PNM, PSD, DDS or KTX2";
inline constexpr const char* kAllFormats = "PNG, JPEG, TIFF, TGA, BMP, GIF, WebP, PNM, PSD, DDS, KTX2, OpenEXR, HDR or PFM";

struct ToolFormat {
  /// The name of the format: OpenImageIO's, or "ktx2".
  const char* name = nullptr;
  /// Display name if the format stores only linear values; nullptr for formats that store integers.
  const char* linear_name = nullptr;
};

/// Number of bytes at the start of a file that the functions below examine.
inline constexpr std::size_t kFormatBytes = 32;

/// Returns the format of a file that begins with head, or nothing if it is unknown. TGA has no signature: it is recognized by a plausible
/// header, or by the extension of path.
std::optional<ToolFormat> find_tool_format(const std::filesystem::path& path, std::string_view head);

/// Describes a file of an unknown format for a message: its type, for example "found PDF", or else its first characters or bytes.
std::string describe_contents(std::string_view head);

/// Returns the extension of path in ASCII lower case, including the dot.
std::string lower_case_extension(const std::filesystem::path& path);

}  // namespace halfspace::HS_LANES
