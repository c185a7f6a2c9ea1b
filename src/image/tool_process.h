// SPDX-License-Identifier: Apache-2.0
//
// halfspace-image-tool as a running process.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace halfspace {

/// The running tool and the pipes to and from it. When this is gone, so are they: a tool that still runs is killed.
class ToolProcess {
 public:
  ToolProcess() = default;
  ~ToolProcess();
  ToolProcess(const ToolProcess&) = delete;
  ToolProcess& operator=(const ToolProcess&) = delete;

  /// Starts the program; words are what follows its name. The errno of the failure, or 0. Once only.
  int start(const std::filesystem::path& program, std::vector<std::string> words);

  /// Sends all of the memory to the tool's standard input; false where the tool has ended (no signal is raised).
  bool send(const void* memory, std::size_t bytes);

  /// Ends the tool's standard input.
  void end_sending();

  /// Fills all of the memory from the tool's standard output; false where the tool ended before.
  bool receive(void* memory, std::size_t bytes);

  /// Waits for the end: "died: ..." with the signal's name, or "ended early".
  std::string how_it_ended();

 private:
  int wait();

  int to_ = -1;
  int from_ = -1;
  pid_t child_ = -1;
};

}  // namespace halfspace
