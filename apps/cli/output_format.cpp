// SPDX-License-Identifier: Apache-2.0
#include "cli/output_format.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

#include "command_line/arguments.h"
#include "command_line/errors.h"
#include "halfspace/image/image_format.h"

namespace halfspace {

namespace {

constexpr const char* kExtensions = ".png, .jpg, .tif, .exr or .hdr";

OutputFormat stream_format(const std::string& format) {
  constexpr std::array<std::pair<std::string_view, RawStream>, 4> kStreams{
      {{"y4m", RawStream::y4m}, {"rgb24", RawStream::rgb24}, {"rgba", RawStream::rgba}, {"rgbaf32", RawStream::rgbaf32}}};
  OutputFormat result{.to_standard_output = true};
  if (format.empty() || format == "png") return result;
  for (const auto& [name, stream] : kStreams) {
    if (format == name) return result.stream = stream, result;
  }
  throw UsageError(fmt::format("--format is '{}'; expected png, y4m, rgb24, rgba or rgbaf32", format));
}

std::optional<Animation> animation_of(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".webp") return Animation::webp;
  return extension == ".gif" ? std::optional(Animation::gif) : std::nullopt;
}

}  // namespace

bool OutputFormat::stores_alpha() const {
  if (stream) return stream == RawStream::rgba || stream == RawStream::rgbaf32;
  if (animation) return animation == Animation::webp;
  return picture == ImageFile::png || picture == ImageFile::tiff || picture == ImageFile::exr;
}

OutputFormat parse_output_format(const std::string& out, const std::string& format, bool has_frames) {
  if (out == "-") return stream_format(format);
  if (!format.empty()) throw UsageError("--format applies only to standard output; expected -o - as well");
  if (const std::optional<ImageFile> picture = image_file_of(out)) return {.picture = *picture};
  const std::optional<Animation> animation = animation_of(out);
  if (animation && has_frames) return {.animation = animation};
  if (animation) throw UsageError(fmt::format("-o is '{}', an animation; expected --frames or --turntable as well", out));
  const std::filesystem::path path = out;
  if (!has_frames && is_stream(path) && !path.has_extension()) return {};
  throw UsageError(fmt::format("-o is '{}'; expected{} a file name ending in {}{}, or - for standard output", out,
                               has_frames ? ", with --frames," : "", kExtensions, has_frames ? ", .webp or .gif" : ""));
}

}  // namespace halfspace
