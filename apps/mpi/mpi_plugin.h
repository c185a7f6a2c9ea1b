// SPDX-License-Identifier: Apache-2.0
//
// The functions of halfspace-mpi.so, which `halfspace render --mpi` loads. Linking MPI would add its libraries to the start of every run.
//
// Work consists of the numbers 0 … total − 1. Rank 0 hands them out in order, one at a time, from a thread of its own, so that a rank that
// is slow, or whose pictures take long, gets fewer of them.
#pragma once

#include <cstddef>

#include "command_line/picture_counts.h"

namespace halfspace {

struct MpiPlace {
  int rank = 0;
  int threads = 1;  ///< for this rank (threads_of_rank())
  int cpus = 1;     ///< CPUs to which this rank is bound
};

/// Functions of the plugin. They are called by one thread.
struct MpiFunctions {
  /// Initializes MPI. quota: the CPUs that the control groups of this process allow, or 0 if there is no quota.
  MpiPlace (*start)(int quota);
  /// Begins to hand out work. Must be called by all ranks with the same total.
  void (*begin)(int total);
  /// Returns the next number, or −1 after the last one. own: what this rank has done, which it tells the others.
  int (*next)(PictureCounts own);
  /// Returns the counts that all other ranks sent with their last requests. Ranks other than 0 receive them with each number.
  PictureCounts (*others)();
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
