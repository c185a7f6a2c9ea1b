// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/image_format.h"

#include <algorithm>

namespace halfspace::HS_LANES {

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
    {"\xabKTX 20\xbb\r\n\x1a\n"sv, {"ktx2"}},
    {"\x76\x2f\x31\x01"sv, {"openexr", "OpenEXR"}},
    {"#?RADIANCE"sv, {"hdr", "Radiance HDR"}},
    {"#?RGBE"sv, {"hdr", "Radiance HDR"}},
    {"PF"sv, {"pnm", "PFM"}},
    {"Pf"sv, {"pnm", "PFM"}},
};

// Types of files that users mistake for supported images.
struct OtherType {
  std::size_t offset;
  std::string_view magic;
  const char* name;
};
constexpr OtherType kOtherTypes[] = {
    {4, "ftypavif"sv, "AVIF"},    {4, "ftypheic"sv, "HEIF"},  {4, "ftypmif1"sv, "HEIF"},  {4, "jP  "sv, "JPEG 2000"},
    {0, "\xff\x0a"sv, "JPEG XL"}, {4, "JXL "sv, "JPEG XL"},   {1, "KTX 11"sv, "KTX 1"},   {0, "sB"sv, "Basis Universal"},
    {0, "<svg"sv, "SVG"},         {0, "<?xml"sv, "XML"},      {0, "<!DOCTYPE"sv, "HTML"}, {0, "<html"sv, "HTML"},
    {0, "%PDF"sv, "PDF"},         {0, "PK\x03\x04"sv, "ZIP"}, {0, "\x1f\x8b"sv, "gzip"},  {0, "glTF"sv, "binary glTF"},
};

std::string_view text_from(std::string_view text, std::size_t offset) { return text.substr(std::min(offset, text.size())); }

// Returns whether the bytes are a possible TGA header: an image of a known type, with a color map if and only if the type needs one, of
// at least 1x1 pixels of a known size, and without reserved bits.
bool is_tga_header(std::string_view head) {
  if (head.size() < 18) return false;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(head[i]); };
  const int map = byte(1), type = byte(2) & ~8, bits = byte(16);  // 8: run-length encoded
  const bool known_type =
      byte(2) < 16 && ((type == 1 && map == 1 && bits == 8) || (type == 2 && map == 0 && bits >= 15) || (type == 3 && map == 0));
  const bool known_bits = bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32;
  const bool some_pixels = (byte(12) | byte(13)) != 0 && (byte(14) | byte(15)) != 0;
  return known_type && known_bits && some_pixels && (byte(17) & 0xc0) == 0;
}

}  // namespace

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return extension;
}

std::optional<ToolFormat> find_tool_format(const std::filesystem::path& path, std::string_view head) {
  const auto found = std::ranges::find_if(kSignatures, [&](const Signature& s) { return head.starts_with(s.magic); });
  if (found != std::end(kSignatures)) return found->format;
  if (head.starts_with("RIFF") && text_from(head, 8).starts_with("WEBP")) return ToolFormat{"webp"};
  if (is_tga_header(head) || lower_case_extension(path) == ".tga") return ToolFormat{"targa"};
  return std::nullopt;
}

std::string describe_contents(std::string_view head) {
  const auto found = std::ranges::find_if(kOtherTypes, [&](const OtherType& t) { return text_from(head, t.offset).starts_with(t.magic); });
  if (found != std::end(kOtherTypes)) return std::string("found ") + found->name;
  const std::string_view start = head.substr(0, 8);
  if (std::ranges::all_of(start, [](char c) { return c >= ' ' && c <= '~'; })) return "it begins with \"" + std::string(start) + '"';
  std::string bytes;
  for (const char c : start) {
    constexpr const char* kDigits = "0123456789abcdef";
    const unsigned char byte = static_cast<unsigned char>(c);
    bytes += {' ', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return "it begins with the bytes" + bytes;
}

}  // namespace halfspace::HS_LANES
