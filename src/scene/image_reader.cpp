// SPDX-License-Identifier: Apache-2.0
#include "scene/image_reader.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/check.h"
#include "scene/image_limits.h"
#include "scene/image_reader/protocol.h"

extern char** environ;

namespace halfspace {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) { throw InputError(path.string() + ": " + what); }

// The running decoder and the end of the pipe that it writes to. Both are gone when this is: a decoder that still
// runs is killed.
class Reader {
 public:
  // errno of the failure, or 0.
  int start(const std::filesystem::path& program, const std::vector<std::string>& words) {
    int ends[2] = {};
    if (::pipe2(ends, O_CLOEXEC) != 0) return errno;
    from_ = ends[0];
    std::vector<char*> argv;
    for (const std::string& w : words) argv.push_back(const_cast<char*>(w.c_str()));  // posix_spawn does not write to them
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    // Decoders print warnings; this program's standard error is for its own one line.
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int error = ::posix_spawn(&child_, program.c_str(), &actions, nullptr, argv.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (error != 0) child_ = -1;
    return error;
  }

  ~Reader() {
    if (from_ >= 0) ::close(from_);
    if (child_ > 0) {
      ::kill(child_, SIGKILL);
      finish();
    }
  }

  // Fills all of the memory; false where the decoder ended before.
  bool receive(void* memory, std::size_t bytes) {
    for (char* to = static_cast<char*>(memory); bytes > 0;) {
      const ssize_t n = ::read(from_, to, bytes);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      to += n;
      bytes -= static_cast<std::size_t>(n);
    }
    return true;
  }

  // Waits for the end: the signal that it died of, or 0.
  int finish() {
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0) {
      if (errno != EINTR) break;
    }
    child_ = -1;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

 private:
  int from_ = -1;
  pid_t child_ = -1;
};

// The decoder's answer, or nothing where it ended before all was said.
std::optional<Image<glm::u8vec4>> receive_picture(Reader& reader, const std::filesystem::path& path) {
  ImageReaderHeader header;
  if (!reader.receive(&header, sizeof header)) return std::nullopt;
  if (header.magic != kImageReaderMagic)
    fail(path, std::string("cannot be read: ") + kImageReaderName + " is of another version than this program");
  if (header.width == 0) {
    std::string message(std::min<std::size_t>(header.message_bytes, 1000), '\0');
    if (!reader.receive(message.data(), message.size())) return std::nullopt;
    fail(path, message);
  }
  check_image_size(static_cast<uint64_t>(header.width), static_cast<uint64_t>(header.height), path.string());
  Image<glm::u8vec4> image(header.width, header.height);
  if (!reader.receive(image.data(), image.texels().size_bytes())) return std::nullopt;
  return image;
}

}  // namespace

Image<glm::u8vec4> read_by_reader(const std::filesystem::path& path, const char* format, uint64_t file_bytes) {
  const std::filesystem::path program = find_image_reader();
  if (program.empty()) {
    fail(path, std::string("is ") + format + ", and " + kImageReaderName +
                   " is not installed; expected PNG, or that program (built where OpenImageIO is)");
  }
  Reader reader;
  // "./": a name that begins with a dash stays a name.
  const std::string name = path.is_absolute() ? path.string() : "./" + path.string();
  const int error = reader.start(program, {program.string(), name, format, std::to_string(file_bytes), std::to_string(kMostImagePixels)});
  if (error != 0) fail(path, "cannot be read: " + program.string() + " does not start (" + std::strerror(error) + ")");
  if (std::optional<Image<glm::u8vec4>> image = receive_picture(reader, path)) return *std::move(image);
  const int signal = reader.finish();
  const std::string how = signal == 0 ? "ended early" : std::string("died: ") + ::strsignal(signal);
  fail(path, std::string("cannot be read as ") + format + " (the decoder " + how + "); expected a whole image file");
}

std::filesystem::path find_image_reader() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const std::filesystem::path directory = program.parent_path();
  for (const std::filesystem::path& place : {directory, directory / "../lib/halfspace"}) {
    const std::filesystem::path candidate = (place / kImageReaderName).lexically_normal();
    if (::access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return {};
}

}  // namespace halfspace
