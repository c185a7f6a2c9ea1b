// SPDX-License-Identifier: Apache-2.0
//
// Limits on the memory that files may make this process use, on the number of pixels of an image, and on the number of primitives that a
// model draws. Readers check the sizes in a file's header against these limits before they allocate memory.
#pragma once

#include <cstdint>
#include <string>

#include "halfspace/core/check.h"

namespace halfspace::HS_LANES {

/// A file needs more than a limit permits. Programs end with this error even where they tolerate other invalid files.
class LimitError : public InputError {
 public:
  using InputError::InputError;
};

/// Limits of this process.
struct ResourceLimits {
  uint64_t max_memory = default_max_memory();  ///< bytes, for all files together
  uint64_t max_pixels = kMaxPixels;            ///< in one image
  /// Triangles, lines and points that one model draws; each placed copy counts. Unlimited unless the program sets it.
  uint64_t max_primitives = UINT64_MAX;
  /// Whether max_memory also covers the resident memory of the process. Programs set this; in a library, most of that memory may belong to
  /// the host.
  bool counts_resident = false;

  static constexpr uint64_t kMaxPixels = uint64_t{1} << 28;
  /// Returns half of the memory of the machine, but at most 8 GiB.
  static uint64_t default_max_memory();
};

/// Returns the limits. Thread-safe.
ResourceLimits resource_limits();

/// Sets the limits for files that are read from now on. max_pixels must be at most kMaxPixels. Thread-safe.
void set_resource_limits(const ResourceLimits& limits);

/// Returns how many bytes may still be allocated: max_memory minus the claims of all threads and, with counts_resident, the resident memory
/// of the process.
uint64_t memory_left();

/// Returns the claims of all threads plus, with counts_resident, the resident memory of the process, in bytes.
uint64_t memory_in_use();

/// Returns the text of an error about a limit: "needs 52 MiB of memory in addition to 16 MiB in use; expected at most 40 MiB
/// (--max-memory)". All arguments are in bytes.
std::string memory_problem(uint64_t needed, uint64_t in_use, uint64_t limit);

/// Reserves memory that is about to be allocated and filled, so that threads that load files in parallel do not exceed the limit together.
/// Release the claim once the memory has been filled and therefore counts as resident.
class MemoryClaim {
 public:
  /// Throws LimitError, whose message begins with `place`, if the memory is not available.
  MemoryClaim(uint64_t bytes, const std::string& place);
  ~MemoryClaim();
  MemoryClaim(const MemoryClaim&) = delete;
  MemoryClaim& operator=(const MemoryClaim&) = delete;

 private:
  uint64_t bytes_;
};

/// Throws LimitError, whose message begins with `place`, if an image has more pixels than permitted.
void check_pixel_limit(uint64_t width, uint64_t height, const std::string& place);

/// Throws LimitError, whose message begins with `place`, if a model draws more primitives than permitted. A small file can place a mesh
/// many times, so its size does not limit the rendering time.
void check_primitive_limit(uint64_t primitives, const std::string& place);

}  // namespace halfspace::HS_LANES
