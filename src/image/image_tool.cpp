// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/image_tool.h"

#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>

#include "halfspace/image/image_errors.h"
#include "halfspace/image/image_limits.h"
#include "halfspace/image/tool_process.h"

namespace halfspace {

namespace {

constexpr const char* kOtherVersion = " has a different version than this program";

[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& what) {
  fail_writing(path, "cannot write (" + what + ")");
}

std::optional<std::string> receive_message(ToolProcess& tool, uint32_t bytes) {
  std::string message(std::min<std::size_t>(bytes, 1000), '\0');
  if (!tool.receive(message.data(), message.size())) return std::nullopt;
  return message;
}

template <class Picture, std::size_t kSample>
std::optional<Picture> receive_pixels(ToolProcess& tool, int width, int height) {
  std::variant_alternative_t<kSample, Picture> image(width, height);
  if (!tool.receive(image.data(), image.texels().size_bytes())) return std::nullopt;
  return image;
}

// Receives the decoder's answer. Returns nothing if the decoder ended before the answer was complete.
template <class Picture>
std::optional<Picture> receive_picture(ToolProcess& tool, uint32_t channels, const std::filesystem::path& path) {
  PictureHeader h;
  if (!tool.receive(&h, sizeof h)) return std::nullopt;
  const std::string other_version = std::string("cannot be read: ") + kImageToolName + kOtherVersion;
  if (h.magic != kImageToolMagic) fail_reading(path, other_version);
  if (h.width == 0) {
    const std::optional<std::string> message = receive_message(tool, h.message_bytes);
    if (!message) return std::nullopt;
    fail_reading(path, *message);
  }
  check_image_size(static_cast<uint64_t>(h.width), static_cast<uint64_t>(h.height), path.string());
  if (h.channels != channels) fail_reading(path, other_version);
  switch (h.sample) {
    case Sample::code8: return receive_pixels<Picture, 0>(tool, h.width, h.height);
    case Sample::code16: return receive_pixels<Picture, 1>(tool, h.width, h.height);
    case Sample::number: return receive_pixels<Picture, 2>(tool, h.width, h.height);
    case Sample::half: break;
  }
  fail_reading(path, other_version);
}

template <class Picture>
Picture read_by_tool(const std::filesystem::path& path, const char* format, uint64_t file_bytes, uint32_t channels) {
  const std::filesystem::path program = find_image_tool();
  if (program.empty()) {
    fail_reading(path, std::string("is ") + format + ", and " + kImageToolName +
                           " is not installed; expected PNG, or that program (it is built if OpenImageIO is available)");
  }
  ToolProcess tool;
  // The "./" keeps a name that begins with a dash from being taken for an option.
  const std::string name = path.is_absolute() ? path.string() : "./" + path.string();
  const int error = tool.start(
      program, {"read", name, format, channels == 1 ? "gray" : "rgba", std::to_string(file_bytes), std::to_string(kMaxImagePixels)});
  if (error != 0) fail_reading(path, "cannot be read: " + program.string() + " does not start (" + std::strerror(error) + ")");
  tool.end_sending();
  if (std::optional<Picture> picture = receive_picture<Picture>(tool, channels, path)) return *std::move(picture);
  fail_reading(path,
               std::string("cannot be read as ") + format + " (the decoder " + tool.how_it_ended() + "); expected a complete image file");
}

// Returns false if the encoder has ended.
bool send_rows(ToolProcess& tool, const PictureHeader& header, const std::function<void(int y, std::span<std::byte> row)>& fill_row) {
  std::vector<std::byte> row(row_bytes(header));
  for (int y = 0; y < header.height; ++y) {
    fill_row(y, row);
    if (!tool.send(row.data(), row.size())) return false;
  }
  return true;
}

// Receives the encoder's answer. Returns nothing if the encoder ended before the answer was complete.
std::optional<std::vector<std::byte>> receive_file(ToolProcess& tool, uint64_t max_bytes, const std::filesystem::path& path) {
  FileHeader h;
  if (!tool.receive(&h, sizeof h)) return std::nullopt;
  if (h.magic != kImageToolMagic || h.file_bytes > max_bytes) cannot_write(path, std::string(kImageToolName) + kOtherVersion);
  if (h.file_bytes == 0) {
    const std::optional<std::string> message = receive_message(tool, h.message_bytes);
    if (!message) return std::nullopt;
    cannot_write(path, *message);
  }
  std::vector<std::byte> bytes(h.file_bytes);
  if (!tool.receive(bytes.data(), bytes.size())) return std::nullopt;
  return bytes;
}

}  // namespace

ColorPicture read_color_by_tool(const std::filesystem::path& path, const char* format, uint64_t file_bytes) {
  return read_by_tool<ColorPicture>(path, format, file_bytes, 4);
}

GrayPicture read_gray_by_tool(const std::filesystem::path& path, const char* format, uint64_t file_bytes) {
  return read_by_tool<GrayPicture>(path, format, file_bytes, 1);
}

std::vector<std::byte> encode_by_tool(const std::filesystem::path& path, const char* format, const PictureHeader& header,
                                      const std::function<void(int y, std::span<std::byte> row)>& fill_row) {
  const std::filesystem::path program = find_image_tool();
  if (program.empty()) {
    cannot_write(path, std::string(kImageToolName) + " is not installed; expected a file name ending in .png, or that program");
  }
  ToolProcess tool;
  const int error = tool.start(program, {"write", format});
  if (error != 0) cannot_write(path, program.string() + " does not start: " + std::strerror(error));
  // An encoder that reports an error ends before it has received all rows; its answer contains the reason.
  const bool sent = tool.send(&header, sizeof header) && send_rows(tool, header, fill_row);
  tool.end_sending();
  const uint64_t max_bytes = 2 * row_bytes(header) * static_cast<uint64_t>(header.height) + (1 << 20);
  std::optional<std::vector<std::byte>> file = receive_file(tool, max_bytes, path);
  if (sent && file) return *std::move(file);
  cannot_write(path, std::string("the ") + format + " encoder " + tool.how_it_ended());
}

std::filesystem::path find_image_tool() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const std::filesystem::path directory = program.parent_path();
  for (const std::filesystem::path& place : {directory, directory / "../lib/halfspace"}) {
    const std::filesystem::path candidate = (place / kImageToolName).lexically_normal();
    if (::access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return {};
}

}  // namespace halfspace
