// SPDX-License-Identifier: Apache-2.0
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "halfspace/image/image_errors.h"
#include "halfspace/image/image_format.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_samples.h"
#include "halfspace/image/image_source.h"
#include "halfspace/image/image_tool.h"
#include "halfspace/image/png.h"

namespace halfspace::HS_LANES {

namespace {

[[noreturn]] void fail_linear(const std::string& name, const std::string& what) {
  fail_reading(name, what + "; expected 8- or 16-bit integer values: " + kCodeFormats);
}

const char* linear_name(const ImageSource& source) { return source.tool_format() ? source.tool_format()->linear_name : nullptr; }

ColorPicture read_color(ImageSource& source) {
  if (source.tool_format()) return read_color_by_tool(source);
  return decode_png(source.bytes(), source.name());
}

Image<glm::u8vec4> codes_of(ImageSource& source) {
  if (linear_name(source) != nullptr)
    fail_linear(source.name(), std::string("is ") + linear_name(source) + ", which contains linear values");
  ColorPicture picture = read_color(source);
  if (const auto* wide = std::get_if<Image<glm::u16vec4>>(&picture)) return round_to_8_bits(*wide);
  if (auto* codes = std::get_if<Image<glm::u8vec4>>(&picture)) return std::move(*codes);
  fail_linear(source.name(), "contains linear values");
}

Image<float> gray_of(ImageSource& source) {
  if (source.tool_format()) return to_numbers(read_gray_by_tool(source), source.name());
  return to_numbers(first_channel(read_color(source)), source.name());
}

bool is_premultiplied(const ImageSource& source) {
  return source.tool_format() && source.tool_format()->name == std::string_view("openexr");
}

Image<glm::vec4> linear_of(ImageSource& source) { return to_linear(read_color(source), is_premultiplied(source), source.name()); }

TextureImage texels_of(ImageSource& source, ImageUse use) {
  return to_texels(read_color(source), use, is_premultiplied(source), source.name());
}

// Calls decode(source) for a file on disk. `expected` lists formats for messages.
template <class F>
auto read_path(const std::filesystem::path& path, const char* expected, F&& decode) try {
  ImageSource source(path, expected);
  return decode(source);
} catch (const std::bad_alloc&) {
  fail_reading(path, "not enough memory; expected a smaller image");
}

// The same for a file in memory.
template <class F>
auto read_memory(std::span<const std::byte> file, const std::string& name, const char* expected, F&& decode) try {
  ImageSource source(file, name, expected);
  return decode(source);
} catch (const std::bad_alloc&) {
  fail_reading(name, "not enough memory; expected a smaller image");
}

}  // namespace

bool holds_linear_numbers(const std::filesystem::path& path) {
  return read_path(path, kAllFormats, [](const ImageSource& source) { return linear_name(source) != nullptr; });
}
bool holds_linear_numbers(std::span<const std::byte> file, const std::string& name) {
  return read_memory(file, name, kAllFormats, [](const ImageSource& source) { return linear_name(source) != nullptr; });
}

Image<glm::u8vec4> read_image(const std::filesystem::path& path) { return read_path(path, kCodeFormats, codes_of); }
Image<glm::u8vec4> read_image(std::span<const std::byte> file, const std::string& name) {
  return read_memory(file, name, kCodeFormats, codes_of);
}

Image<float> read_gray(const std::filesystem::path& path) { return read_path(path, kAllFormats, gray_of); }
Image<float> read_gray(std::span<const std::byte> file, const std::string& name) { return read_memory(file, name, kAllFormats, gray_of); }

Image<glm::vec4> read_linear(const std::filesystem::path& path) { return read_path(path, kAllFormats, linear_of); }
Image<glm::vec4> read_linear(std::span<const std::byte> file, const std::string& name) {
  return read_memory(file, name, kAllFormats, linear_of);
}

TextureImage read_texels(const std::filesystem::path& path, ImageUse use) {
  return read_path(path, kAllFormats, [use](ImageSource& source) { return texels_of(source, use); });
}
TextureImage read_texels(std::span<const std::byte> file, const std::string& name, ImageUse use) {
  return read_memory(file, name, kAllFormats, [use](ImageSource& source) { return texels_of(source, use); });
}

}  // namespace halfspace::HS_LANES
