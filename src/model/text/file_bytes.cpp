// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/text/file_bytes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "halfspace/core/resource_limits.h"

namespace halfspace::HS_LANES {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw InputError(fmt::format("{}: {}", file.string(), what));
}

[[noreturn]] void fail_with_errno(const std::filesystem::path& file) {
  fail(file, fmt::format("{}; expected a readable file", std::generic_category().message(errno)));
}

/// Closes a file descriptor at the end of its scope.
struct OpenFile {
  int descriptor;
  ~OpenFile() { ::close(descriptor); }
};

std::size_t size_of(const std::filesystem::path& file, int descriptor, std::size_t max_bytes) {
  struct stat status = {};
  if (::fstat(descriptor, &status) != 0) fail_with_errno(file);
  if (S_ISDIR(status.st_mode)) fail(file, "is a directory; expected a file");
  if (!S_ISREG(status.st_mode)) fail(file, "is a device, pipe or socket; expected a regular file");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > max_bytes)
    throw LimitError(fmt::format("{}: has {} bytes; expected at most {}, which the memory limit leaves for it (--max-memory)",
                                 file.string(), size, max_bytes));
  return size;
}

}  // namespace

std::vector<std::byte> file_bytes(const std::filesystem::path& file, std::size_t max_bytes) {
  // O_NONBLOCK: opening a pipe that nobody writes to must not block.
  const OpenFile open = {::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (open.descriptor < 0) fail_with_errno(file);
  const std::size_t size = size_of(file, open.descriptor, max_bytes);
  const MemoryClaim claim(size, file.string());
  std::vector<std::byte> bytes(size);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::read(open.descriptor, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_with_errno(file);
    if (n == 0) break;  // another process shortened the file
    done += static_cast<std::size_t>(n);
  }
  bytes.resize(done);
  return bytes;
}

std::span<const std::byte> without_byte_order_mark(std::span<const std::byte> bytes) {
  constexpr std::array kMark{std::byte{0xef}, std::byte{0xbb}, std::byte{0xbf}};
  const bool marked = bytes.size() >= kMark.size() && std::ranges::equal(bytes.first(kMark.size()), kMark);
  return marked ? bytes.subspan(kMark.size()) : bytes;
}

}  // namespace halfspace::HS_LANES
