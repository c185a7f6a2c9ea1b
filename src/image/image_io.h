// SPDX-License-Identifier: Apache-2.0
//
// Pictures and maps as files. PNG is read and written here; the other formats go through a program of its own,
// halfspace-image-tool (the only user of OpenImageIO), in a process that a hostile file may kill.
//
// Pictures hold straight alpha and their top row first. What is read and written:
//   codes    PNG, JPEG, TIFF, TGA, BMP, GIF, WebP, PNM, PSD, DDS: 8 or 16 bits a channel, sRGB where it is colour
//   numbers  OpenEXR, Radiance HDR, PFM, and TIFF, PSD or DDS of floats: linear
// The format of a file that is read is told by its content, of one that is written by its name. Readers throw InputError
// ("PATH: what is wrong; what would be right") for what is missing, damaged or too large (more than 2^28 pixels or
// 32768 on an edge), writers OutputError; a file appears whole or not at all. All functions are thread-safe.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>

#include "halfspace/core/image.h"

namespace halfspace {

/// A format that pictures are written in.
enum class ImageFile { png, jpeg, tiff, exr, hdr };

/// The format that the extension of path asks for (.png, .jpg or .jpeg, .tif or .tiff, .exr, .hdr, small or capital),
/// or nothing where it is another or there is none.
std::optional<ImageFile> image_file_of(const std::filesystem::path& path);

/// Does the format hold linear numbers (exr, hdr), not 8-bit codes?
bool is_linear(ImageFile file);

/// Does the file hold linear numbers by its format (OpenEXR, Radiance HDR, PFM)? Throws InputError as readers do.
bool holds_linear_numbers(const std::filesystem::path& path);

/// Reads a file of codes as 8-bit codes: grey is repeated, absent alpha is 255, 16 bits are rounded to 8. No colour
/// conversion, no turning by EXIF; the first picture of several. A file of numbers is refused.
Image<glm::u8vec4> read_image(const std::filesystem::path& path);

/// Reads the first channel (the only one of a grey file, red of a colour file) of any file, such as a map of heights:
/// 8-bit codes over 255, 16-bit codes over 65535, numbers as they are, no sRGB decoding. Every result is finite: an
/// infinity or NaN in the file is an InputError that names its pixel.
Image<float> read_gray(const std::filesystem::path& path);

/// Reads any file as linear light with straight alpha: codes are decoded from sRGB (alpha: over 255 or 65535), numbers
/// are taken as they are, but that OpenEXR's colours are divided by their alpha where it is not 0. Infinities are held
/// to ±65504; NaN is an InputError that names its pixel.
Image<glm::vec4> read_linear(const std::filesystem::path& path);

/// Writes 8-bit sRGB codes with straight alpha as PNG (without alpha where all are 255), whatever the name of the file.
void write_png(const std::filesystem::path& path, const Image<glm::u8vec4>& image);

/// Writes codes that are numbers, no colours, such as a normal map, as PNG that does not say sRGB.
void write_data_png(const std::filesystem::path& path, const Image<glm::u8vec4>& image);

/// Writes 8-bit sRGB codes with straight alpha by the extension of path: .png and .tif (deflate) exactly, without alpha
/// where all are 255; .jpg at quality 95 with colour at full resolution, alpha dropped. The image must not be empty.
void write_image(const std::filesystem::path& path, const Image<glm::u8vec4>& image);

/// Writes linear light with straight alpha by the extension of path. NaN is written as 0. The image must not be empty.
///   .exr  channels R, G, B, and A where some alpha is not 1; the nearest half, at most ±65504, ZIP; colours multiplied
///         by alpha, as OpenEXR has it: they are lost where alpha is 0
///   .hdr  RGBE (8 bits and an exponent that the pixel shares): the error is at most 1/256 of the pixel's largest channel;
///         alpha dropped, negative numbers 0, infinities 65504
void write_image(const std::filesystem::path& path, const Image<glm::vec4>& image);

/// Writes one channel Z of 32-bit floats as OpenEXR (ZIP), bit for bit, whatever the name of the file. The image must
/// not be empty.
void write_depth_exr(const std::filesystem::path& path, const Image<float>& depth);

}  // namespace halfspace
