// SPDX-License-Identifier: Apache-2.0
#include "halfspace/image/tool_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

extern char** environ;

namespace halfspace {

namespace {

void close_if_open(int fd) {
  if (fd >= 0) ::close(fd);
}

// If this program runs without standard streams, new descriptors could be 0 to 2, which the child process replaces.
bool move_above_streams(int& fd) {
  if (fd > STDERR_FILENO) return true;
  const int moved = ::fcntl(fd, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  if (moved < 0) return false;
  ::close(fd);
  fd = moved;
  return true;
}

// Creates the channels to and from the child; [0] and [2] are our ends. Returns 0, or the errno of the failure. The channel to
// the child is a socket pair, because unlike a pipe it can be written without SIGPIPE after the reader has exited.
int open_ends(int (&ends)[4]) {
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, &ends[0]) != 0 || ::pipe2(&ends[2], O_CLOEXEC) != 0) return errno;
  for (int& fd : ends) {
    if (!move_above_streams(fd)) return errno;
  }
  return 0;
}

int spawn(const std::filesystem::path& program, std::vector<std::string> words, int input, int output, pid_t& child) {
  words.insert(words.begin(), program.string());
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  // Decoders print warnings, but standard error is reserved for this program's own one-line message.
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const int error = ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) child = -1;
  return error;
}

}  // namespace

ToolProcess::~ToolProcess() {
  close_if_open(to_);
  close_if_open(from_);
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    wait();
  }
}

int ToolProcess::start(const std::filesystem::path& program, std::vector<std::string> words) {
  int ends[4] = {-1, -1, -1, -1};
  int error = open_ends(ends);
  to_ = ends[0];
  from_ = ends[2];
  if (error == 0) error = spawn(program, std::move(words), ends[1], ends[3], child_);
  close_if_open(ends[1]);
  close_if_open(ends[3]);
  return error;
}

bool ToolProcess::send(const void* memory, std::size_t bytes) {
  for (const char* from = static_cast<const char*>(memory); bytes > 0;) {
    const ssize_t n = ::send(to_, from, bytes, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    from += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

void ToolProcess::end_sending() { ::shutdown(to_, SHUT_WR); }

bool ToolProcess::receive(void* memory, std::size_t bytes) {
  for (char* to = static_cast<char*>(memory); bytes > 0;) {
    const ssize_t n = ::read(from_, to, bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    to += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

std::string ToolProcess::how_it_ended() {
  const int signal = wait();
  return signal == 0 ? "ended early" : std::string("died: ") + ::strsignal(signal);
}

// Returns the signal that terminated the tool, or 0.
int ToolProcess::wait() {
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0) {
    if (errno != EINTR) break;
  }
  child_ = -1;
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

}  // namespace halfspace
