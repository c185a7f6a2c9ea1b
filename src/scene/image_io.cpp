// SPDX-License-Identifier: Apache-2.0
#include "scene/image_io.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <string_view>
#include <vector>

#include "core/check.h"
#include "scene/image_reader.h"
#include "scene/output_file.h"
#include "scene/png.h"

namespace halfspace {

namespace {

constexpr const char* kFormats = "PNG, JPEG, TIFF, TGA, BMP, GIF, WebP, PNM, PSD or DDS";

/// A format that halfspace-read-image reads: OpenImageIO's name, and the bytes that it begins with.
struct Format {
  const char* name;
  std::string_view magic;
};
using namespace std::string_view_literals;
constexpr Format kReaderFormats[] = {
    {"jpeg", "\xff\xd8\xff"sv},
    {"tiff", "II*\0"sv},
    {"tiff", "MM\0*"sv},
    {"tiff", "II+\0"sv},
    {"tiff", "MM\0+"sv},
    {"bmp", "BM"sv},
    {"gif", "GIF8"sv},
    {"pnm", "P1"sv},
    {"pnm", "P2"sv},
    {"pnm", "P3"sv},
    {"pnm", "P4"sv},
    {"pnm", "P5"sv},
    {"pnm", "P6"sv},
    {"psd", "8BPS"sv},
    {"dds", "DDS "sv},
};
constexpr Format kFloatFormats[] = {
    {"OpenEXR", "\x76\x2f\x31\x01"sv}, {"Radiance HDR", "#?RADIANCE"sv}, {"Radiance HDR", "#?RGBE"sv}, {"PFM", "PF"sv}, {"PFM", "Pf"sv}};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) { throw InputError(path.string() + ": " + what); }

uint64_t checked_file_size(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) fail(path, "no such file; expected an image");
  if (error) fail(path, "cannot be read (" + error.message() + "); expected an image");
  // A pipe or device could go on for ever.
  if (status.type() == std::filesystem::file_type::directory) fail(path, "is a directory; expected an image file");
  if (status.type() != std::filesystem::file_type::regular) fail(path, "is no regular file; expected an image file");
  const uint64_t size = std::filesystem::file_size(path, error);
  if (error) fail(path, "cannot be read (" + error.message() + "); expected an image");
  if (size == 0) fail(path, std::string("is empty; expected ") + kFormats);
  if (size > uint64_t{1} << 31) fail(path, "has more than 2 GiB; expected a smaller image");
  return size;
}

std::vector<std::byte> read_bytes(const std::filesystem::path& path, uint64_t count) {
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path, std::string("cannot be read (") + std::strerror(errno) + "); expected an image");
  std::vector<std::byte> bytes(count);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

const Format* find_format(std::span<const Format> formats, std::string_view head) {
  const auto found = std::ranges::find_if(formats, [&](const Format& f) { return head.starts_with(f.magic); });
  return found == formats.end() ? nullptr : &*found;
}

// OpenImageIO's name of the format. TGA has no signature: there the extension decides.
const char* reader_format(const std::filesystem::path& path, std::string_view head) {
  if (const Format* f = find_format(kReaderFormats, head)) return f->name;
  if (head.starts_with("RIFF") && head.substr(std::min<std::size_t>(8, head.size())).starts_with("WEBP")) return "webp";
  if (const Format* f = find_format(kFloatFormats, head)) {
    fail(path, std::string("is ") + f->name + ", which holds linear numbers; expected 8- or 16-bit codes: " + kFormats);
  }
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (extension == ".tga") return "targa";
  fail(path, std::string("is no image that can be read; expected ") + kFormats);
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image<glm::u8vec4>& image) { write_file(path, encode_png(image)); }

Image<glm::u8vec4> read_image(const std::filesystem::path& path) try {
  const uint64_t size = checked_file_size(path);
  const std::vector<std::byte> start = read_bytes(path, std::min<uint64_t>(size, 16));
  if (is_png(start)) return decode_png(read_bytes(path, size), path.string());
  const std::string_view head(reinterpret_cast<const char*>(start.data()), start.size());
  return read_by_reader(path, reader_format(path, head), size);
} catch (const std::bad_alloc&) {
  fail(path, "needs more memory than there is; expected a smaller picture");
}

}  // namespace halfspace
