// SPDX-License-Identifier: Apache-2.0
//
// The formats that halfspace-image-tool reads, told by what files begin with.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace halfspace {

/// For messages: the formats of 8- or 16-bit codes, and all formats.
inline constexpr const char* kCodeFormats = "PNG, JPEG, TIFF, TGA, BMP, GIF, WebP, PNM, PSD or DDS";
inline constexpr const char* kAllFormats = "PNG, JPEG, TIFF, TGA, BMP, GIF, WebP, PNM, PSD, DDS, OpenEXR, HDR or PFM";

struct ToolFormat {
  /// OpenImageIO's name.
  const char* name = nullptr;
  /// The format's own name where it holds linear numbers only; nullptr for a format of codes.
  const char* linear_name = nullptr;
};

/// The format of a file that begins with head (16 bytes are enough), or nothing. TGA has no signature: there the
/// extension of path decides.
std::optional<ToolFormat> find_tool_format(const std::filesystem::path& path, std::string_view head);

/// The extension of path in small letters (ASCII), with its dot.
std::string small_extension(const std::filesystem::path& path);

}  // namespace halfspace
