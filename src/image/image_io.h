// SPDX-License-Identifier: Apache-2.0
//
// Reads and writes image files. PNG is decoded in this process. All other formats are decoded in separate processes, so that a malicious
// file can only crash those: JPEG in halfspace-jpeg-tool, and the rest in halfspace-image-tool, which is the only user of OpenImageIO. The
// decoder processes are started when they are first needed and serve all later images of this process. PNG, JPEG and OpenEXR are encoded in
// this process.
//
// Images have straight alpha and store the top row first, however the file stores them: the tags of the file that state the order of rows
// and columns (TIFF, TGA, BMP, Radiance, KTX2), the display window (OpenEXR) and premultiplied alpha (TIFF, TGA, DDS, KTX2, OpenEXR) are
// applied. EXIF data is not: texture coordinates refer to the stored pixels. There are two kinds of files:
//   integers       PNG, JPEG, TIFF, TGA, BMP, GIF, WebP, PNM, PSD, DDS, KTX2: 8 or 16 bits per channel, sRGB-encoded if they are colors
//   linear values  OpenEXR, Radiance HDR, PFM, and TIFF, PSD, DDS or KTX2 with floats or signed numbers (BC6H, signed BC4 and BC5)
// Readers detect the format from the content of a file, writers from its name. A file can also be read from memory, for example if it is
// part of a model; `name` then takes the place of the path in messages. Readers throw InputError ("PATH: problem; expected ...") for files
// that are missing, damaged or too large (more than 2^28 pixels or 32768 pixels per side). Writers throw OutputError; an output file is
// either complete or not created. All functions are thread-safe, and up to 4 images are decoded in parallel. The functions may be called in
// a child process after fork().
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "halfspace/core/image.h"
#include "halfspace/core/tool_folder.h"

namespace halfspace::HS_LANES {

/// Formats in which images can be written.
enum class ImageFile { png, jpeg, tiff, exr, hdr };

/// Returns the format for the extension of path (.png, .jpg or .jpeg, .tif or .tiff, .exr, .hdr; case-insensitive), or nothing
/// for any other name.
std::optional<ImageFile> image_file_of(const std::filesystem::path& path);

/// Returns whether the format stores linear values (exr, hdr) instead of 8-bit values.
bool is_linear(ImageFile file);

/// Returns whether the format of the file implies linear values (OpenEXR, Radiance HDR, PFM). Throws InputError like the readers.
bool holds_linear_numbers(const std::filesystem::path& path);
bool holds_linear_numbers(std::span<const std::byte> file, const std::string& name);

/// Reads an image with 8-bit or 16-bit values as 8-bit RGBA. Gray is replicated to all color channels, alpha is 255 if the file has none,
/// and 16-bit values are rounded to 8 bits. Color profiles, gamma values and EXIF data are ignored; only the first image of a file is
/// read. Throws InputError if the format implies linear values.
Image<glm::u8vec4> read_image(const std::filesystem::path& path);
Image<glm::u8vec4> read_image(std::span<const std::byte> file, const std::string& name);

/// Reads the first channel (gray or red) of any file, such as a height map. 8-bit values are divided by 255 and 16-bit values by 65535,
/// without sRGB decoding; linear values are unchanged. All results are finite: an infinity or NaN in the file throws an InputError that
/// names the pixel.
Image<float> read_gray(const std::filesystem::path& path);
Image<float> read_gray(std::span<const std::byte> file, const std::string& name);

/// Reads any file as linear light with straight alpha. Integer colors are decoded from sRGB; integer alpha is divided by 255 or 65535.
/// Linear values are unchanged, except that premultiplied colors are divided by alpha where it is positive; EXPOSURE and COLORCORR lines of
/// Radiance files are ignored. Infinities are clamped to ±65504; NaN throws an InputError that names the pixel.
Image<glm::vec4> read_linear(const std::filesystem::path& path);
Image<glm::vec4> read_linear(std::span<const std::byte> file, const std::string& name);

/// What the values of an image stand for.
enum class ImageUse { colors, data };

/// 8-bit values, in which colors are sRGB-encoded, or numbers, in which colors are linear.
using TextureImage = std::variant<Image<glm::u8vec4>, Image<glm::vec4>>;

/// Reads any file without loss. 8-bit values are returned as they are, and all others as numbers: colors like those of read_linear, and
/// data like those of read_gray, but with infinities clamped to ±65504.
TextureImage read_texels(const std::filesystem::path& path, ImageUse use);
TextureImage read_texels(std::span<const std::byte> file, const std::string& name, ImageUse use);

/// Text in image files: lines of UTF-8. Nothing is stored for empty text.
struct ImageText {
  std::string software{};     ///< name and version of the program; "Software" in PNG, "software" in OpenEXR
  std::string comment{};      ///< how the image was made; "Comment" in PNG, "comments" in OpenEXR
  std::string fingerprint{};  ///< identifies what the image was made from; "Fingerprint" in PNG, "fingerprint" in OpenEXR
};

/// Writes 8-bit or 16-bit sRGB values with straight alpha as PNG, regardless of the file name. Opaque images are written without alpha.
void write_png(const std::filesystem::path& path, const Image<glm::u8vec4>& image, const ImageText& text = {});
void write_png(const std::filesystem::path& path, const Image<glm::u16vec4>& image, const ImageText& text = {});

/// Writes 8-bit values that are data rather than colors, such as a normal map, as PNG without the sRGB marker.
void write_data_png(const std::filesystem::path& path, const Image<glm::u8vec4>& image);

/// Writes 8-bit sRGB values with straight alpha, in the format given by the extension of path. PNG and TIFF (deflate) are lossless, and
/// omit alpha if the image is opaque. JPEG uses quality 95 without chroma subsampling, and drops alpha. The image must not be empty.
void write_image(const std::filesystem::path& path, const Image<glm::u8vec4>& image, const ImageText& text = {});

/// Writes linear light with straight alpha, in the format given by the extension of path. NaN is written as 0. The image must
/// not be empty.
///   .exr  Channels R, G, B, and A unless the image is opaque, as half floats with ZIP compression. Values are rounded to the
///         nearest half and clamped to ±65504. Colors are multiplied by alpha, as OpenEXR requires, and are lost where it is 0.
///   .hdr  RGBE: 8 bits per channel and a shared exponent per pixel. The error is at most 1/256 of the pixel's largest channel.
///         Alpha is dropped, negative values become 0, and infinities become 65504.
void write_image(const std::filesystem::path& path, const Image<glm::vec4>& image, const ImageText& text = {});

/// Encode an image as write_image() stores it, and return the bytes of the file. The format must match the type of the image (is_linear).
/// name: begins error messages.
std::vector<std::byte> encode_image(const Image<glm::u8vec4>& image, ImageFile format, const std::string& name, const ImageText& text = {});
std::vector<std::byte> encode_image(const Image<glm::vec4>& image, ImageFile format, const std::string& name, const ImageText& text = {});

struct ExrChannel;
/// Returns the channels that write_image() stores for .exr. The image is not copied and must outlive them.
std::vector<ExrChannel> color_channels(const Image<glm::vec4>& image);

/// Writes a single 32-bit float channel Z as OpenEXR (ZIP), regardless of the file name. Values are stored exactly. The image
/// must not be empty.
void write_depth_exr(const std::filesystem::path& path, const Image<float>& depth);

/// Types of OpenEXR samples: a 16-bit or 32-bit float, or a 32-bit unsigned integer (OpenEXR's HALF, FLOAT and UINT).
enum class ExrSample { float16, float32, uint32 };

struct ExrChannel {
  /// For example "R" or "normal.X".
  std::string name;
  ExrSample sample = ExrSample::float32;
  /// Writes the samples of row y, counted from the top, into row, which is aligned for the type. May be called several times per row.
  std::function<void(int y, std::span<std::byte> row)> fill_row;
};

/// Writes the channels into one OpenEXR file (ZIP), regardless of the file name. Samples are stored exactly. width, height and the number
/// of channels must be positive, and names must be distinct and not empty. A build without OpenEXR throws OutputError unless the channels
/// are R, G, B and possibly A as half floats, or Z as floats.
void write_exr(const std::filesystem::path& path, int width, int height, std::span<const ExrChannel> channels, const ImageText& text = {});

}  // namespace halfspace::HS_LANES
