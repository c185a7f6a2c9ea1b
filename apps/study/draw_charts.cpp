// SPDX-License-Identifier: Apache-2.0
//
// Runs scripts/docs/draw_charts.py.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "halfspace/core/check.h"
#include "study/study_files.h"

extern char** environ;

namespace halfspace {

namespace {

constexpr int kNoMatplotlib = 69;  // exit code of the script

struct ScriptResult {
  int start_error;        // errno if the program did not start, otherwise 0
  int status;             // see waitpid()
  std::string last_line;  // last line of standard error
};

// Only the standard error of the program is kept. Its last line explains a failure.
int spawn_quietly(std::vector<std::string> words, int error_output, pid_t& child) {
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  // This is first, in case error_output is one of the descriptors that are replaced next.
  ::posix_spawn_file_actions_adddup2(&actions, error_output, STDERR_FILENO);
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  const int error = ::posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return error;
}

std::string read_last_line(int input) {
  constexpr std::size_t kMaxLine = 4096;
  std::string text;
  for (char part[1024];;) {
    const ssize_t n = ::read(input, part, sizeof part);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    text.append(part, static_cast<std::size_t>(n));
    if (text.size() > kMaxLine) text.erase(0, text.size() - kMaxLine);
  }
  while (text.ends_with('\n')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);  // npos + 1 is 0
}

ScriptResult run_script(std::vector<std::string> words) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return {errno, 0, ""};
  pid_t child = -1;
  ScriptResult result{spawn_quietly(std::move(words), ends[1], child), 0, ""};
  ::close(ends[1]);
  if (result.start_error == 0) result.last_line = read_last_line(ends[0]);
  ::close(ends[0]);
  while (result.start_error == 0 && ::waitpid(child, &result.status, 0) < 0) {
    if (errno != EINTR) result.start_error = errno;
  }
  return result;
}

// Returns the path of the script. The build creates a link to it at this path.
std::filesystem::path script_path() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / "../share/halfspace/draw_charts.py").lexically_normal();
}

}  // namespace

std::string draw_charts(const std::vector<std::string>& names, const std::filesystem::path& folder) {
  const std::filesystem::path script = script_path();
  if (::access(script.c_str(), R_OK) != 0) return "draw_charts.py is missing (expected: " + script.string() + ")";
  // An absolute path is never mistaken for an option.
  std::vector<std::string> words{"python3", script.string(), "studies", std::filesystem::absolute(folder).string()};
  words.insert(words.end(), names.begin(), names.end());
  const ScriptResult result = run_script(std::move(words));
  if (result.start_error == ENOENT) return "python3 is missing (Debian and Ubuntu: python3)";
  if (result.start_error != 0) throw OutputError(std::string("no charts were drawn: python3: ") + std::strerror(result.start_error));
  if (WIFEXITED(result.status) && WEXITSTATUS(result.status) == kNoMatplotlib)
    return "matplotlib is missing (Debian and Ubuntu: python3-matplotlib)";
  if (WIFSIGNALED(result.status))
    throw OutputError(std::string("no charts were drawn: python3 was terminated by a signal: ") + ::strsignal(WTERMSIG(result.status)));
  if (WEXITSTATUS(result.status) != 0) throw OutputError("no charts were drawn: " + result.last_line);
  return "";
}

}  // namespace halfspace
