// SPDX-License-Identifier: Apache-2.0
//
// The running decoder programs of this process. They are started on demand, reused until they end, and stopped at exit.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <vector>

#include "halfspace/core/tool_process.h"

namespace halfspace::HS_LANES {

/// The tools of one kind. There is one per image that is being decoded, but at most min(cores, 4). Thread-safe.
class ToolPool {
 public:
  ToolPool();

  /// Lends a tool to one request.
  class Lease {
   public:
    /// Waits until a tool is free. Prefers one that is running.
    explicit Lease(ToolPool& pool) : pool_(pool), slot_(pool.take()) {}
    /// Gives the tool back. Stops it unless keep() was called.
    ~Lease() { pool_.give_back(slot_, kept_); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;

    /// Returns the tool, which may not be running.
    ToolProcess& tool() { return pool_.slots_[slot_].process; }
    /// Leaves the tool running for further requests.
    void keep() { kept_ = true; }

   private:
    ToolPool& pool_;
    std::size_t slot_;
    bool kept_ = false;
  };

  /// Stops the tools that are not lent.
  void stop_idle();

  /// Called before fork(): waits until no other thread changes the pool.
  void lock() { mutex_.lock(); }
  /// Called in the parent after fork().
  void unlock() { mutex_.unlock(); }
  /// Must be called in the child after fork(). Forgets the running tools, which belong to the parent.
  void abandon();

 private:
  struct Slot {
    ToolProcess process;
    bool lent = false;
  };

  std::size_t take();
  void give_back(std::size_t slot, bool keep);

  std::mutex mutex_;
  std::condition_variable given_back_;
  std::vector<Slot> slots_;
};

/// Return the pools of halfspace-image-tool and halfspace-jpeg-tool of this process.
ToolPool& image_tool_pool();
ToolPool& jpeg_tool_pool();

}  // namespace halfspace::HS_LANES
