// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "mpi/mpi_plugin.h"

namespace halfspace {

/// The processes of `mpirun`, which share the work of a run. There can be only one object.
class MpiQueue {
 public:
  /// Starts MPI. Throws UsageError if this build has no MPI.
  MpiQueue();
  /// Ends MPI. If an exception ends the run, abort() must be called before.
  ~MpiQueue();
  MpiQueue(const MpiQueue&) = delete;
  MpiQueue& operator=(const MpiQueue&) = delete;

  const MpiPlace& place() const { return place_; }

  /// Begins to hand out 0 … total − 1.
  void begin(int total) { functions_->begin(total); }
  /// Returns the next number, or nothing after the last one. own: what this rank has done.
  std::optional<int> next(const PictureCounts& own);
  /// Returns what all other ranks have done (MpiFunctions::others).
  PictureCounts others() const { return functions_->others(); }
  /// Returns whether the results of all ranks have arrived.
  bool is_finished() const { return is_finished_; }
  /// Sends the result of this rank to rank 0, and there passes the results of all other ranks to `receive`.
  void finish(const std::string& result, const std::function<void(const std::string&)>& receive);

  /// Ends the processes of all ranks.
  void abort(int exit_code) { functions_->abort(exit_code); }

 private:
  const MpiFunctions* functions_;
  MpiPlace place_;
  bool is_finished_ = false;
};

}  // namespace halfspace
