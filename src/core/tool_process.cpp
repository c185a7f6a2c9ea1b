// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/tool_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

extern char** environ;

namespace halfspace::HS_LANES {

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

// Creates the channels to and from the child; [0] and [2] are our ends. Returns 0, or the errno of the failure. The channel to the child is
// a socket pair: unlike a pipe, it can be written to without raising SIGPIPE after the reader has exited.
int open_ends(int (&ends)[4]) {
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, &ends[0]) != 0 || ::pipe2(&ends[2], O_CLOEXEC) != 0) return errno;
  for (int& fd : ends) {
    if (!move_above_streams(fd)) return errno;
  }
  return 0;
}

int spawn(const std::filesystem::path& program, int input, int output, pid_t& child) {
  std::string words[] = {program.string(), "serve"};
  char* argv[] = {words[0].data(), words[1].data(), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  // Decoders print warnings, but standard error is reserved for this program's own one-line message.
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const int error = ::posix_spawn(&child, program.c_str(), &actions, nullptr, argv, environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) child = -1;
  return error;
}

}  // namespace

int ToolProcess::start(const std::filesystem::path& program) {
  int ends[4] = {-1, -1, -1, -1};
  int error = open_ends(ends);
  to_ = ends[0];
  from_ = ends[2];
  if (error == 0) error = spawn(program, ends[1], ends[3], child_);
  close_if_open(ends[1]);
  close_if_open(ends[3]);
  if (error != 0) abandon();
  return error;
}

void ToolProcess::stop() {
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    wait();
  }
  abandon();
}

void ToolProcess::abandon() {
  close_if_open(to_);
  close_if_open(from_);
  to_ = from_ = -1;
  child_ = -1;
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

bool ToolProcess::send_with_descriptor(const void* memory, std::size_t bytes, int descriptor) {
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof descriptor)] = {};
  iovec part = {const_cast<void*>(memory), bytes};
  msghdr message = {};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control;
  message.msg_controllen = sizeof control;
  cmsghdr* rights = CMSG_FIRSTHDR(&message);
  rights->cmsg_level = SOL_SOCKET;
  rights->cmsg_type = SCM_RIGHTS;
  rights->cmsg_len = CMSG_LEN(sizeof descriptor);
  std::memcpy(CMSG_DATA(rights), &descriptor, sizeof descriptor);
  ssize_t n = 0;
  while ((n = ::sendmsg(to_, &message, MSG_NOSIGNAL)) < 0 && errno == EINTR) {
  }
  if (n <= 0) return false;
  return send(static_cast<const char*>(memory) + n, bytes - static_cast<std::size_t>(n));
}

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

int ToolProcess::wait() {
  ::shutdown(to_, SHUT_RDWR);  // ends a tool that still waits for input
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0) {
    if (errno != EINTR) break;
  }
  child_ = -1;
  return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

}  // namespace halfspace::HS_LANES
