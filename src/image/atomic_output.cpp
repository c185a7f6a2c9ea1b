// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/atomic_output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "halfspace/core/check.h"
#include "halfspace/image/image_errors.h"

namespace halfspace::HS_LANES {

namespace {

// Name of the temporary file being written, for the signal handler. The flag is set while the name is valid.
char unfinished_name[4096];
std::atomic<bool> unfinished = false;
static_assert(std::atomic<bool>::is_always_lock_free);
std::mutex writing;  // only one file is written at a time

[[noreturn]] void fail_errno(const std::filesystem::path& path, int error) {
  fail_writing(path, std::string("cannot write (") + std::strerror(error) + ")");
}

// Returns the status of the file at path, following symbolic links, or nothing if it does not exist.
std::optional<struct stat> status_of(const std::filesystem::path& path) {
  struct stat s = {};
  if (::stat(path.c_str(), &s) == 0) return s;
  if (errno != ENOENT && errno != ENOTDIR) fail_errno(path, errno);
  return std::nullopt;
}

// Returns the path of the file to replace. If path is a symbolic link, that is its target, not the link itself.
std::filesystem::path real_path(const std::filesystem::path& path, bool exists) {
  if (!exists) return path;
  char* resolved = ::realpath(path.c_str(), nullptr);
  if (resolved == nullptr) fail_errno(path, errno);
  std::filesystem::path result = resolved;
  std::free(resolved);
  return result;
}

std::filesystem::path directory_of(const std::filesystem::path& path) {
  const std::filesystem::path parent = path.parent_path();
  return parent.empty() ? "." : parent;
}

// Returns the directory or its nearest existing ancestor, in which the missing directories will be created.
std::filesystem::path existing_part(std::filesystem::path directory) {
  std::error_code error;
  while (!std::filesystem::exists(directory, error)) {
    const std::filesystem::path above = directory_of(directory);
    if (above == directory) break;
    directory = above;
  }
  return directory;
}

// Owns an open file descriptor.
struct Descriptor {
  int fd;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

// Returns 0, or the errno of the first failed write. Writes in pieces, because a signal cannot interrupt a write to a disk until it is
// complete.
int write_all(int fd, std::span<const std::byte> bytes) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), std::min(bytes.size(), kPiece));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return 0;
}

constexpr std::string_view kPrefix = ".halfspace-", kSuffix = ".part";

// A process holds a lock on its temporary file until it has renamed it. The number of a process would not show whether it still runs: in a
// container, it is usually 1.
bool lock(int fd) { return ::flock(fd, LOCK_EX | LOCK_NB) == 0; }

// Creates a temporary file with a unique name in the directory of path, and stores its name in unfinished_name.
int create_temporary_file(const std::filesystem::path& path) {
  static std::atomic<unsigned> counter = 0;
  for (int attempt = 0; attempt < 100; ++attempt) {
    const std::string name = fmt::format("{}{}-{}{}", kPrefix, ::getpid(), counter++, kSuffix);
    const std::string full = (directory_of(path) / name).string();
    if (full.size() >= sizeof unfinished_name) return errno = ENAMETOOLONG, -1;
    std::memcpy(unfinished_name, full.c_str(), full.size() + 1);
    unfinished = true;  // set before the file exists: a signal in between finds nothing to remove
    const int fd = ::open(unfinished_name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    struct stat status = {};
    // Another process can remove the file before it is locked.
    if (fd >= 0 && (!lock(fd) || ::fstat(fd, &status) != 0 || status.st_nlink > 0)) return fd;
    if (fd >= 0) ::close(fd);
    unfinished = false;
    if (fd < 0 && errno != EEXIST) return -1;
  }
  return -1;
}

// Opens with O_NONBLOCK, because a blocking open of a pipe without a reader would wait forever. The writes themselves block.
void write_in_place(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const Descriptor file{::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.fd < 0 && errno == ENXIO) fail_writing(path, "no process is reading from it; expected a pipe with a reader, or a file name");
  if (file.fd < 0) fail_errno(path, errno);
  const int flags = ::fcntl(file.fd, F_GETFL);
  if (flags < 0 || ::fcntl(file.fd, F_SETFL, flags & ~O_NONBLOCK) != 0) fail_errno(path, errno);
  if (const int error = write_all(file.fd, bytes); error != 0) fail_errno(path, error);
}

}  // namespace

bool is_standard_output(const std::filesystem::path& path) {
  struct stat file = {}, out = {};
  return ::stat(path.c_str(), &file) == 0 && ::fstat(STDOUT_FILENO, &out) == 0 && file.st_dev == out.st_dev && file.st_ino == out.st_ino;
}

void make_directory(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) fail_writing(path, "cannot create the directory (" + error.message() + ")");
}

void check_writable(const std::filesystem::path& path) {
  if (path.empty()) throw OutputError("the name of the output file is empty; expected a file name");
  const auto status = status_of(path);
  if (!path.has_filename() || (status && S_ISDIR(status->st_mode))) fail_writing(path, "is a directory; expected a file name");
  if (status && ::access(path.c_str(), W_OK) != 0) fail_errno(path, errno);
  if (status && !S_ISREG(status->st_mode)) return;
  const std::filesystem::path directory = existing_part(directory_of(real_path(path, status.has_value())));
  std::error_code error;
  if (!std::filesystem::is_directory(directory, error)) fail_writing(path, "cannot write (" + directory.string() + " is not a directory)");
  if (::access(directory.c_str(), W_OK | X_OK) != 0)
    fail_writing(path, "cannot write to directory " + directory.string() + " (" + std::strerror(errno) + ")");
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  const std::lock_guard lock(writing);
  check_writable(path);
  if (is_standard_output(path)) {
    if (const int error = write_all(STDOUT_FILENO, bytes); error != 0) fail_errno(path, error);
    return;
  }
  const auto status = status_of(path);
  if (status && !S_ISREG(status->st_mode)) return write_in_place(path, bytes);

  const std::filesystem::path target = real_path(path, status.has_value());
  make_directory(directory_of(target));
  const int fd = create_temporary_file(target);
  if (fd < 0) fail_errno(path, errno);
  int error = write_all(fd, bytes);
  if (error == 0 && status && ::fchmod(fd, status->st_mode & 07777) != 0) error = errno;
  // Keeps the lock until the file has its name: other processes remove files that are not locked.
  const Descriptor locked{::fcntl(fd, F_DUPFD_CLOEXEC, 0)};
  if (::close(fd) != 0 && error == 0) error = errno;  // some file systems report a full disk only here
  if (error == 0 && ::rename(unfinished_name, target.c_str()) != 0) error = errno;
  if (error != 0) ::unlink(unfinished_name);
  unfinished = false;
  if (error != 0) fail_errno(path, error);
}

void remove_abandoned_output(const std::filesystem::path& directory) {
  std::error_code error;
  for (std::filesystem::directory_iterator entry(directory.empty() ? "." : directory, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) continue;
    const Descriptor file{::open(entry->path().c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)};
    if (file.fd >= 0 && lock(file.fd)) ::unlink(entry->path().c_str());
  }
}

void write_standard_output(std::span<const std::byte> bytes) {
  if (const int error = write_all(STDOUT_FILENO, bytes); error != 0)
    throw OutputError(std::string("standard output: cannot write (") + std::strerror(error) + ")");
}

void remove_unfinished_output() noexcept {
  if (unfinished) ::unlink(unfinished_name);
}

}  // namespace halfspace::HS_LANES
