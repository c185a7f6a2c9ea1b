// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <string>

namespace halfspace {

/// What a program said, and how it ended.
struct ProgramOutput {
  int exit_code = -1;  ///< -1: it did not start, or a signal ended it
  std::string text;    ///< standard output, and what the command redirects there
};

/// Runs a command of the shell.
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

/// Does the command succeed? What it prints is dropped.
inline bool command_works(const std::string& command) { return run_command(command + " > /dev/null 2>&1").exit_code == 0; }

}  // namespace halfspace
