// SPDX-License-Identifier: Apache-2.0
#include "memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "halfspace/core/resource_limits.h"
#include "messages.h"

namespace halfspace::python {

namespace {

struct MemoryLimit {
  uint64_t bytes, in_use;
};

// Returns the limit of the process's address space if there is one, otherwise the memory of the machine.
MemoryLimit memory_limit() {
  const auto page = static_cast<uint64_t>(::sysconf(_SC_PAGESIZE)), machine = static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES)) * page;
  std::ifstream file("/proc/self/statm");
  uint64_t size = 0, resident = 0;  // pages
  file >> size >> resident;
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY && space.rlim_cur < machine + (size - resident) * page)
    return {space.rlim_cur, size * page};
  return {machine, resident * page};
}

std::string shortage(const std::string& place, uint64_t needed) {
  const MemoryLimit limit = memory_limit();
  return in_python_terms(place + ": " + memory_problem(needed, limit.in_use, limit.bytes));
}

}  // namespace

MemoryShortage::MemoryShortage(const std::string& place, uint64_t needed) : message_(shortage(place, needed)) {}

std::string allocation_problem() {
  const MemoryLimit limit = memory_limit();
  return "not enough memory: " + std::to_string(limit.in_use >> 20) + " MiB are in use; expected at most " +
         std::to_string(limit.bytes >> 20) + " MiB";
}

void check_memory(const std::string& place, uint64_t needed) {
  constexpr uint64_t kSmall = uint64_t{64} << 20;
  if (needed < kSmall) return;  // not worth reading the limits
  const MemoryLimit limit = memory_limit();
  if (needed > limit.bytes - std::min(limit.in_use, limit.bytes)) throw MemoryShortage(place, needed);
}

}  // namespace halfspace::python
