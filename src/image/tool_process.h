// SPDX-License-Identifier: Apache-2.0
//
// A running halfspace-image-tool process.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace halfspace {

/// Owns the running tool and the channels to and from it. The destructor closes them and kills the tool if it is still running.
class ToolProcess {
 public:
  ToolProcess() = default;
  ~ToolProcess();
  ToolProcess(const ToolProcess&) = delete;
  ToolProcess& operator=(const ToolProcess&) = delete;

  /// Starts the program with the given command-line arguments. Returns 0, or the errno of the failure. Call only once.
  int start(const std::filesystem::path& program, std::vector<std::string> words);

  /// Sends all bytes to the tool's standard input. Returns false if the tool has ended; no signal is raised.
  bool send(const void* memory, std::size_t bytes);

  /// Closes the tool's standard input.
  void end_sending();

  /// Fills the memory from the tool's standard output. Returns false if the tool ended before that.
  bool receive(void* memory, std::size_t bytes);

  /// Waits for the tool to exit. Returns "died: ..." with the name of the signal, or "ended early".
  std::string how_it_ended();

 private:
  int wait();

  int to_ = -1;
  int from_ = -1;
  pid_t child_ = -1;
};

}  // namespace halfspace
