// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/image_format.h"

#include <algorithm>

namespace halfspace {

namespace {

// A file signature and the format it identifies.
struct Signature {
  std::string_view magic;
  ToolFormat format;
};
using namespace std::string_view_literals;
constexpr Signature kSignatures[] = {
    {"\xff\xd8\xff"sv, {"jpeg"}},
    {"II*\0"sv, {"tiff"}},
    {"MM\0*"sv, {"tiff"}},
    {"II+\0"sv, {"tiff"}},
    {"MM\0+"sv, {"tiff"}},
    {"BM"sv, {"bmp"}},
    {"GIF8"sv, {"gif"}},
    {"P1"sv, {"pnm"}},
    {"P2"sv, {"pnm"}},
    {"P3"sv, {"pnm"}},
    {"P4"sv, {"pnm"}},
    {"P5"sv, {"pnm"}},
    {"P6"sv, {"pnm"}},
    {"8BPS"sv, {"psd"}},
    {"DDS "sv, {"dds"}},
    {"\x76\x2f\x31\x01"sv, {"openexr", "OpenEXR"}},
    {"#?RADIANCE"sv, {"hdr", "Radiance HDR"}},
    {"#?RGBE"sv, {"hdr", "Radiance HDR"}},
    {"PF"sv, {"pnm", "PFM"}},
    {"Pf"sv, {"pnm", "PFM"}},
};

}  // namespace

std::string small_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension;
}

std::optional<ToolFormat> find_tool_format(const std::filesystem::path& path, std::string_view head) {
  const auto found = std::ranges::find_if(kSignatures, [&](const Signature& s) { return head.starts_with(s.magic); });
  if (found != std::end(kSignatures)) return found->format;
  if (head.starts_with("RIFF") && head.substr(std::min<std::size_t>(8, head.size())).starts_with("WEBP")) return ToolFormat{"webp"};
  if (small_extension(path) == ".tga") return ToolFormat{"targa"};
  return std::nullopt;
}

}  // namespace halfspace
