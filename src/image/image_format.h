// SPDX-License-Identifier: Apache-2.0
//
// Detects the formats that halfspace-image-tool reads, by the first bytes of a file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace halfspace {

/// Lists for messages: formats that store 8- or 16-bit codes, and all formats.
inline constexpr const char* kCodeFormats = "PNG, JPEG, TIFF, TGA, BMP, GIF, WebP, PNM, PSD or DDS";
inline constexpr const char* kAllFormats = "PNG, JPEG, TIFF, TGA, BMP, GIF, WebP, PNM, PSD, DDS, OpenEXR, HDR or PFM";

struct ToolFormat {
  /// OpenImageIO's name for the format.
  const char* name = nullptr;
  /// Display name if the format stores only linear values; nullptr for formats of codes.
  const char* linear_name = nullptr;
};

/// Returns the format of a file that begins with head (16 bytes are sufficient), or nothing if it is unknown. TGA has no
/// signature and is recognized by the extension of path.
std::optional<ToolFormat> find_tool_format(const std::filesystem::path& path, std::string_view head);

/// Returns the extension of path in ASCII lower case, including the dot.
std::string small_extension(const std::filesystem::path& path);

}  // namespace halfspace
