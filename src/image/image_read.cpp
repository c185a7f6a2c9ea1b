// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/image/image_errors.h"
#include "halfspace/image/image_format.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_samples.h"
#include "halfspace/image/image_tool.h"
#include "halfspace/image/png.h"

namespace halfspace {

namespace {

[[noreturn]] void fail_without_memory(const std::filesystem::path& path) {
  fail_reading(path, "not enough memory; expected a smaller image");
}

[[noreturn]] void fail_linear(const std::filesystem::path& path, const std::string& what) {
  fail_reading(path, what + "; expected 8- or 16-bit codes: " + kCodeFormats);
}

uint64_t checked_file_size(const std::filesystem::path& path, const char* expected) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) fail_reading(path, "no such file; expected an image");
  if (error) fail_reading(path, "cannot be read (" + error.message() + "); expected an image");
  // A pipe or device could be endless.
  if (status.type() == std::filesystem::file_type::directory) fail_reading(path, "is a directory; expected an image file");
  if (status.type() != std::filesystem::file_type::regular) fail_reading(path, "is not a regular file; expected an image file");
  const uint64_t size = std::filesystem::file_size(path, error);
  if (error) fail_reading(path, "cannot be read (" + error.message() + "); expected an image");
  if (size == 0) fail_reading(path, std::string("is empty; expected ") + expected);
  if (size > uint64_t{1} << 31) fail_reading(path, "is larger than 2 GiB; expected a smaller image");
  return size;
}

std::vector<std::byte> read_bytes(const std::filesystem::path& path, uint64_t count) {
  std::ifstream file(path, std::ios::binary);
  if (!file) fail_reading(path, std::string("cannot be read (") + std::strerror(errno) + "); expected an image");
  std::vector<std::byte> bytes(count);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

// A file that exists and begins like an image.
struct Source {
  uint64_t bytes = 0;
  /// Empty for PNG.
  std::optional<ToolFormat> tool_format;
};

Source open_source(const std::filesystem::path& path, const char* expected) {
  Source source{checked_file_size(path, expected), {}};
  const std::vector<std::byte> start = read_bytes(path, std::min<uint64_t>(source.bytes, 16));
  if (is_png(start)) return source;
  source.tool_format = find_tool_format(path, std::string_view(reinterpret_cast<const char*>(start.data()), start.size()));
  if (!source.tool_format) fail_reading(path, std::string("is not a supported image; expected ") + expected);
  return source;
}

ColorPicture read_color(const std::filesystem::path& path, const Source& source) {
  if (source.tool_format) return read_color_by_tool(path, source.tool_format->name, source.bytes);
  return decode_png(read_bytes(path, source.bytes), path.string());
}

}  // namespace

bool holds_linear_numbers(const std::filesystem::path& path) {
  const Source source = open_source(path, kAllFormats);
  return source.tool_format && source.tool_format->linear_name != nullptr;
}

Image<glm::u8vec4> read_image(const std::filesystem::path& path) try {
  const Source source = open_source(path, kCodeFormats);
  if (source.tool_format && source.tool_format->linear_name != nullptr) {
    fail_linear(path, std::string("is ") + source.tool_format->linear_name + ", which contains linear values");
  }
  ColorPicture picture = read_color(path, source);
  if (const auto* wide = std::get_if<Image<glm::u16vec4>>(&picture)) return round_to_8_bits(*wide);
  if (auto* codes = std::get_if<Image<glm::u8vec4>>(&picture)) return std::move(*codes);
  fail_linear(path, "contains linear values");
} catch (const std::bad_alloc&) {
  fail_without_memory(path);
}

namespace {

// A copy of bytes that other processes can open as a file.
class MemoryFile {
 public:
  explicit MemoryFile(std::span<const std::byte> bytes) : fd_(::memfd_create("image", MFD_CLOEXEC)) {
    while (fd_ >= 0 && !bytes.empty()) {
      const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
      if (written <= 0) break;
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    complete_ = fd_ >= 0 && bytes.empty();
  }
  ~MemoryFile() {
    if (fd_ >= 0) ::close(fd_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  bool complete() const { return complete_; }
  std::filesystem::path path() const { return fmt::format("/proc/{}/fd/{}", ::getpid(), fd_); }

 private:
  int fd_;
  bool complete_ = false;
};

}  // namespace

Image<glm::u8vec4> read_image(std::span<const std::byte> bytes, const std::string& name) try {
  if (is_png(bytes)) {
    const ColorPicture picture = decode_png(bytes, name);
    if (const auto* wide = std::get_if<Image<glm::u16vec4>>(&picture)) return round_to_8_bits(*wide);
    return std::get<Image<glm::u8vec4>>(picture);
  }
  const MemoryFile file(bytes);
  if (!file.complete()) fail_without_memory(name);
  try {
    return read_image(file.path());
  } catch (const InputError& e) {
    const std::string message = e.what(), path = file.path().string();
    throw InputError(message.starts_with(path) ? name + message.substr(path.size()) : name + ": " + message);
  }
} catch (const std::bad_alloc&) {
  fail_without_memory(name);
}

Image<float> read_gray(const std::filesystem::path& path) try {
  const Source source = open_source(path, kAllFormats);
  if (source.tool_format) return to_numbers(read_gray_by_tool(path, source.tool_format->name, source.bytes), path.string());
  return to_numbers(first_channel(read_color(path, source)), path.string());
} catch (const std::bad_alloc&) {
  fail_without_memory(path);
}

Image<glm::vec4> read_linear(const std::filesystem::path& path) try {
  const Source source = open_source(path, kAllFormats);
  const bool premultiplied = source.tool_format && source.tool_format->name == std::string_view("openexr");
  return to_linear(read_color(path, source), premultiplied, path.string());
} catch (const std::bad_alloc&) {
  fail_without_memory(path);
}

}  // namespace halfspace
