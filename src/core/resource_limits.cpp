// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/resource_limits.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <mutex>

namespace halfspace::HS_LANES {

namespace {

// Rounds up, so that a limit of less than a mebibyte does not read as 0.
std::string mebibytes(uint64_t bytes) { return std::to_string((bytes >> 20) + (bytes % (1u << 20) != 0 ? 1 : 0)) + " MiB"; }

struct LimitState {
  std::mutex mutex;
  ResourceLimits limits;
  uint64_t claimed = 0;  // bytes
};

LimitState& limit_state() {
  static LimitState state;
  return state;
}

// Returns the resident memory of this process in bytes. Returns 0 if it does not count towards the limit or the system does not report it.
uint64_t counted_resident_memory() {
  if (!resource_limits().counts_resident) return 0;
  std::ifstream file("/proc/self/statm");
  uint64_t size = 0, resident = 0;
  file >> size >> resident;
  return file ? resident * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

// The mutex must be locked.
uint64_t left(const LimitState& state, uint64_t resident) {
  const uint64_t used = resident + state.claimed;
  return used < state.limits.max_memory ? state.limits.max_memory - used : 0;
}

}  // namespace

uint64_t ResourceLimits::default_max_memory() {
  constexpr uint64_t kMaxDefault = uint64_t{8} << 30;
  const auto pages = ::sysconf(_SC_PHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
  if (pages <= 0 || size <= 0) return kMaxDefault;
  return std::min(static_cast<uint64_t>(pages) / 2 * static_cast<uint64_t>(size), kMaxDefault);
}

ResourceLimits resource_limits() {
  LimitState& state = limit_state();
  const std::lock_guard lock(state.mutex);
  return state.limits;
}

void set_resource_limits(const ResourceLimits& limits) {
  HS_CHECK_OP(limits.max_pixels, <=, ResourceLimits::kMaxPixels,
              "set_resource_limits: the number of pixels is too large; expected at most 2^28");
  LimitState& state = limit_state();
  const std::lock_guard lock(state.mutex);
  state.limits = limits;
}

uint64_t memory_left() {
  const uint64_t resident = counted_resident_memory();
  LimitState& state = limit_state();
  const std::lock_guard lock(state.mutex);
  return left(state, resident);
}

uint64_t memory_in_use() {
  const uint64_t resident = counted_resident_memory();
  LimitState& state = limit_state();
  const std::lock_guard lock(state.mutex);
  return resident + state.claimed;
}

std::string memory_problem(uint64_t needed, uint64_t in_use, uint64_t limit) {
  return "needs " + mebibytes(needed) + " of memory in addition to " + mebibytes(in_use) + " in use; expected at most " + mebibytes(limit) +
         " (--max-memory)";
}

MemoryClaim::MemoryClaim(uint64_t bytes, const std::string& place) : bytes_(bytes) {
  const uint64_t resident = counted_resident_memory();
  LimitState& state = limit_state();
  const std::lock_guard lock(state.mutex);
  if (bytes > left(state, resident)) {
    throw LimitError(place + ": " + memory_problem(bytes, resident + state.claimed, state.limits.max_memory));
  }
  state.claimed += bytes;
}

MemoryClaim::~MemoryClaim() {
  LimitState& state = limit_state();
  const std::lock_guard lock(state.mutex);
  state.claimed -= bytes_;
}

void check_pixel_limit(uint64_t width, uint64_t height, const std::string& place) {
  const uint64_t limit = resource_limits().max_pixels;
  if (width == 0 || height <= limit / width) return;
  throw LimitError(place + ": " + std::to_string(width) + "x" + std::to_string(height) + " pixels; expected at most " +
                   std::to_string(limit) + " pixels (--max-pixels)");
}

void check_primitive_limit(uint64_t primitives, const std::string& place) {
  const uint64_t limit = resource_limits().max_primitives;
  if (primitives <= limit) return;
  throw LimitError(place + ": draws " + std::to_string(primitives) + " triangles, lines and points; expected at most " +
                   std::to_string(limit) + " (--max-primitives)");
}

}  // namespace halfspace::HS_LANES
