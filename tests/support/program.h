// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace halfspace {

/// Output and exit code of a program.
struct ProgramOutput {
  int exit_code = -1;  ///< -1 if the program did not start or was terminated by a signal
  std::string text;    ///< standard output, including streams that the command redirects to it
};

/// Runs a shell command.
inline ProgramOutput run_command(const std::string& command) {
  ProgramOutput output;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  std::array<char, 4096> part;
  for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;) output.text.append(part.data(), n);
  const int status = ::pclose(pipe);
  if (WIFEXITED(status)) output.exit_code = WEXITSTATUS(status);
  return output;
}

/// Returns whether the command succeeds. Its output is discarded.
inline bool command_works(const std::string& command) { return run_command(command + " > /dev/null 2>&1").exit_code == 0; }

}  // namespace halfspace
