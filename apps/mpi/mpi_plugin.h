// SPDX-License-Identifier: Apache-2.0
//
// The functions of halfspace-mpi.so, which `halfspace render --mpi` loads. Linking MPI would add its libraries to the start of every run.
//
// Work consists of the numbers 0 … total − 1. Rank 0 hands them out in order, one at a time, from a thread of its own, so that a rank that
// is slow, or whose pictures take long, gets fewer of them.
#pragma once

#include <cstddef>

namespace halfspace {

struct MpiPlace {
  int rank = 0;
  /// Threads for this rank: the CPUs that its node allows, divided among the ranks of the node that share them.
  int threads = 1;
  int cpus = 1;  ///< CPUs to which this rank is bound
};

/// Functions of the plugin. They are called by one thread.
struct MpiFunctions {
  /// Initializes MPI. cpu_limit: the number of CPUs that this process may use, at least 1.
  MpiPlace (*start)(int cpu_limit);
  /// Begins to hand out work. Must be called by all ranks with the same total.
  void (*begin)(int total);
  /// Returns the next number, or −1 after the last one.
  int (*next)();
  /// On rank 0, returns how many numbers the other ranks have finished. A rank that asks for its next number early counts as one further.
  int (*others_done)();
  /// Sends a text to rank 0, and there waits for the texts of all other ranks and passes each to receive(context, text, size).
  void (*finish)(const char* text, std::size_t size, void (*receive)(void*, const char*, std::size_t), void* context);
  /// Ends MPI. Must be called by all ranks.
  void (*end)();
  /// Ends the processes of all ranks, after an error of this one.
  void (*abort)(int exit_code);
};

}  // namespace halfspace

/// The only exported symbol.
extern "C" const halfspace::MpiFunctions halfspace_mpi_functions;
