// SPDX-License-Identifier: Apache-2.0
//
// A running decoder program.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <string>

#include "halfspace/core/namespace.h"

namespace halfspace::HS_LANES {

/// Owns a process and the channels to and from it.
class ToolProcess {
 public:
  ToolProcess() = default;
  ~ToolProcess() { stop(); }
  ToolProcess(const ToolProcess&) = delete;
  ToolProcess& operator=(const ToolProcess&) = delete;

  /// Starts `program serve`. Returns 0, or the errno of the failure. Must not be running.
  int start(const std::filesystem::path& program);

  bool running() const { return child_ > 0; }

  /// Sends all bytes to the tool's standard input. Returns false if the tool has ended; no signal is raised.
  bool send(const void* memory, std::size_t bytes);

  /// Like send(), but also passes the tool a copy of a file descriptor.
  bool send_with_descriptor(const void* memory, std::size_t bytes, int descriptor);

  /// Fills the memory from the tool's standard output. Returns false if the tool ended before the memory was full.
  bool receive(void* memory, std::size_t bytes);

  /// Waits for the tool to exit and returns the signal that terminated it, or 0.
  int wait();

  /// Closes the channels and kills the tool, if it is running.
  void stop();

  /// Closes the channels but leaves the tool running. Called in a child process, which has copies of the channels of its parent's tools.
  void abandon();

 private:
  int to_ = -1;
  int from_ = -1;
  pid_t child_ = -1;
};

}  // namespace halfspace::HS_LANES
