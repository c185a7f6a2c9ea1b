// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/core/half.h"
#include "halfspace/image/atomic_output.h"
#include "halfspace/image/exr_encode.h"
#include "halfspace/image/image_errors.h"
#include "halfspace/image/image_format.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_text.h"
#include "halfspace/image/image_tool.h"
#include "halfspace/image/jpeg_encode.h"
#include "halfspace/image/png.h"

namespace halfspace::HS_LANES {

namespace {

ImageFile checked_image_file(const std::filesystem::path& path, bool linear) {
  const char* expected = linear ? "a file name ending in .exr or .hdr" : "a file name ending in .png, .jpg or .tif";
  const std::optional<ImageFile> file = image_file_of(path);
  if (!file) fail_writing(path, std::string("unknown image format; expected ") + expected);
  if (is_linear(*file) != linear)
    fail_writing(path, std::string("this format stores ") + (linear ? "8-bit values" : "linear values") + "; expected " + expected);
  return *file;
}

float number_or_0(float x) { return std::isnan(x) ? 0.0f : x; }

// Premultiplies by alpha. An infinity times an alpha of 0 is NaN, which becomes 0 too.
int exr_sample(const glm::vec4& t, int channel) {
  const float alpha = number_or_0(t.w);
  return float_to_finite_half(channel == 3 ? alpha : number_or_0(t[channel] * alpha));
}

ExrChannel exr_channel(const Image<glm::vec4>& image, int channel) {
  constexpr const char* kNames[] = {"R", "G", "B", "A"};
  return {kNames[channel], ExrSample::float16, [&image, channel](int y, std::span<std::byte> row) {
            std::byte* to = row.data();
            for (const glm::vec4& texel : image.row(y)) {
              const uint16_t half = static_cast<uint16_t>(exr_sample(texel, channel));
              std::memcpy(to, &half, sizeof half);
              to += sizeof half;
            }
          }};
}

// Rounds to the nearest values that RGBE can represent: integer multiples, up to 255, of 2^(e − 8), where 2^(e − 1) <= largest < 2^e.
// OpenImageIO would truncate, with an error of up to 1/128 of the largest channel; after this rounding it has nothing to truncate. The
// rounding error is half a step, 2^(e − 9), which is at most 1/256 of the largest channel.
glm::vec3 rgbe_texel(const glm::vec4& t) {
  constexpr float kLargest = 0x1p126f;    // limited by the exponent byte
  constexpr float kSmallest = 0x1p-105f;  // OpenImageIO writes 0 for values below 1e-32
  glm::vec3 color;
  for (int c = 0; c < 3; ++c) {
    const float x = t[c] == std::numeric_limits<float>::infinity() ? kMaxHalf : number_or_0(t[c]);
    color[c] = std::clamp(x, 0.0f, kLargest);
  }
  const float largest = std::max({color.x, color.y, color.z});
  if (largest < kSmallest) return glm::vec3(0.0f);
  int exponent = 0;
  std::frexp(largest, &exponent);
  float step = std::ldexp(1.0f, exponent - 8);
  if (std::floor(largest / step + 0.5f) > 255.0f) step *= 2.0f;  // the largest channel rounds up to a power of two
  for (int c = 0; c < 3; ++c) color[c] = std::floor(color[c] / step + 0.5f) * step;
  return color;
}

std::vector<std::byte> encode_hdr(const std::string& name, const Image<glm::vec4>& image, const ImageText& text) {
  PictureHeader header;
  header.width = image.width();
  header.height = image.height();
  header.channels = 3;
  header.sample = Sample::float32;
  std::vector<std::byte> file = encode_by_tool(name, "hdr", header, {}, [&](int y, std::span<std::byte> row) {
    std::byte* to = row.data();
    for (const glm::vec4& texel : image.row(y)) {
      const glm::vec3 color = rgbe_texel(texel);
      std::memcpy(to, &color, sizeof color);
      to += sizeof color;
    }
  });
  insert_radiance_text(file, text);  // OpenImageIO stores no text in this format
  return file;
}

std::vector<std::byte> encode_tiff(const std::string& name, const Image<glm::u8vec4>& image, const ImageText& text) {
  const bool opaque = std::ranges::all_of(image.texels(), [](const glm::u8vec4& t) { return t.w == 255; });
  return encode_codes_by_tool(name, "tiff", image, opaque ? 3 : 4, text);
}

[[noreturn]] void fail_for_memory(const std::filesystem::path& path) {
  fail_writing(path, "cannot write (not enough memory); expected a smaller image");
}

}  // namespace

std::optional<ImageFile> image_file_of(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".png") return ImageFile::png;
  if (extension == ".jpg" || extension == ".jpeg") return ImageFile::jpeg;
  if (extension == ".tif" || extension == ".tiff") return ImageFile::tiff;
  if (extension == ".exr") return ImageFile::exr;
  if (extension == ".hdr") return ImageFile::hdr;
  return std::nullopt;
}

bool is_linear(ImageFile file) { return file == ImageFile::exr || file == ImageFile::hdr; }

void write_png(const std::filesystem::path& path, const Image<glm::u8vec4>& image, const ImageText& text) {
  write_file(path, encode_png(image, PngCodes::srgb, text));
}

void write_png(const std::filesystem::path& path, const Image<glm::u16vec4>& image, const ImageText& text) {
  write_file(path, encode_png(image, text));
}

void write_data_png(const std::filesystem::path& path, const Image<glm::u8vec4>& image) {
  write_file(path, encode_png(image, PngCodes::numbers));
}

std::vector<std::byte> encode_image(const Image<glm::u8vec4>& image, ImageFile format, const std::string& name, const ImageText& text) try {
  HS_CHECK(!image.empty() && !is_linear(format));
  if (format == ImageFile::png) return encode_png(image, PngCodes::srgb, text);
  return format == ImageFile::jpeg ? encode_jpeg(name, image, text) : encode_tiff(name, image, text);
} catch (const std::bad_alloc&) {
  fail_for_memory(name);
}

std::vector<std::byte> encode_image(const Image<glm::vec4>& image, ImageFile format, const std::string& name, const ImageText& text) try {
  HS_CHECK(!image.empty() && is_linear(format));
  if (format == ImageFile::hdr) return encode_hdr(name, image, text);
  return encode_exr(name, image.width(), image.height(), color_channels(image), text);
} catch (const std::bad_alloc&) {
  fail_for_memory(name);
}

void write_image(const std::filesystem::path& path, const Image<glm::u8vec4>& image, const ImageText& text) {
  const ImageFile format = checked_image_file(path, false);
  check_writable(path);
  write_file(path, encode_image(image, format, path.string(), text));
}

std::vector<ExrChannel> color_channels(const Image<glm::vec4>& image) {
  const bool opaque = std::ranges::all_of(image.texels(), [](const glm::vec4& t) { return t.w == 1.0f; });
  std::vector<ExrChannel> channels;
  for (int c = 0; c < (opaque ? 3 : 4); ++c) channels.push_back(exr_channel(image, c));
  return channels;
}

void write_image(const std::filesystem::path& path, const Image<glm::vec4>& image, const ImageText& text) {
  const ImageFile format = checked_image_file(path, true);
  check_writable(path);
  write_file(path, encode_image(image, format, path.string(), text));
}

void write_depth_exr(const std::filesystem::path& path, const Image<float>& depth) {
  const ExrChannel z = {"Z", ExrSample::float32,
                        [&](int y, std::span<std::byte> row) { std::ranges::copy(std::as_bytes(depth.row(y)), row.begin()); }};
  write_exr(path, depth.width(), depth.height(), {&z, 1});
}

void write_exr(const std::filesystem::path& path, int width, int height, std::span<const ExrChannel> channels, const ImageText& text) try {
  check_writable(path);
  write_file(path, encode_exr(path, width, height, channels, text));
} catch (const std::bad_alloc&) {
  fail_for_memory(path);
}

}  // namespace halfspace::HS_LANES
