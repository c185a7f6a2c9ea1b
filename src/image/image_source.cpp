// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/image_source.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "halfspace/image/image_errors.h"
#include "halfspace/image/png.h"

namespace halfspace::HS_LANES {

namespace {

constexpr uint64_t kMaxFileBytes = uint64_t{1} << 31;

void check_file_size(uint64_t size, const std::string& name, const char* expected) {
  if (size == 0) fail_reading(name, std::string("is empty; expected ") + expected);
  if (size > kMaxFileBytes) fail_reading(name, "is larger than 2 GiB; expected a smaller image");
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
  check_file_size(size, path.string(), expected);
  return size;
}

[[noreturn]] void fail_errno_reading(const std::string& name) {
  fail_reading(name, std::string("cannot be read (") + std::strerror(errno) + "); expected an image");
}

bool write_to_memory_file(int file, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace

ImageSource::ImageSource(const std::filesystem::path& path, const char* expected)
    : name_(path.string()), size_(checked_file_size(path, expected)), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0) fail_errno_reading(name_);
  try {
    find_format(expected);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

ImageSource::ImageSource(std::span<const std::byte> bytes, const std::string& name, const char* expected)
    : name_(name), size_(bytes.size()), bytes_(bytes) {
  check_file_size(size_, name_, expected);
  find_format(expected);
}

ImageSource::~ImageSource() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void ImageSource::find_format(const char* expected) {
  const std::vector<std::byte> start = read(std::min(size_, kFormatBytes));
  if (is_png(start)) return;
  const std::string_view head(reinterpret_cast<const char*>(start.data()), start.size());
  tool_format_ = find_tool_format(name_, head);
  if (!tool_format_) fail_reading(name_, "is not a supported image (" + describe_contents(head) + "); expected " + expected);
}

// Returns the first bytes, fewer than count if the file has been truncated.
std::vector<std::byte> ImageSource::read(std::size_t count) const {
  if (!bytes_.empty()) return {bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(count)};
  std::vector<std::byte> bytes(count);
  std::size_t done = 0;
  while (done < count) {
    const ssize_t n = ::pread(descriptor_, bytes.data() + done, count - done, static_cast<off_t>(done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_errno_reading(name_);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  bytes.resize(done);
  return bytes;
}

std::span<const std::byte> ImageSource::bytes() {
  if (bytes_.empty()) bytes_ = read_bytes_ = read(size_);
  return bytes_;
}

int ImageSource::descriptor() {
  if (descriptor_ < 0) {
    descriptor_ = ::memfd_create("halfspace", MFD_CLOEXEC);
    if (descriptor_ < 0 || !write_to_memory_file(descriptor_, bytes_)) fail_errno_reading(name_);
  }
  return descriptor_;
}

}  // namespace halfspace::HS_LANES
