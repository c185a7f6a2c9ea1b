// SPDX-License-Identifier: Apache-2.0
//
// Exits with an error message, instead of crashing with an illegal instruction, on a CPU that lacks features used by this build.
//
// A check in main would be too late: static objects of the program, such as CLI11's, are initialized before main, by code compiled for
// HALFSPACE_ARCH. A constructor function with priority 101, the first that is not reserved, runs before all of them. Only shared libraries
// are initialized earlier. They come from the distribution and are compiled for the baseline.
//
// This file and core/cpu.cpp are compiled for the baseline, too. They must not use templates or inline functions: the linker keeps
// only one copy of such a function, possibly one that was compiled for HALFSPACE_ARCH.
#include <string.h>
#include <unistd.h>

#include "halfspace/core/cpu.h"

namespace {

void write_error(const char* text) {
  if (write(STDERR_FILENO, text, strlen(text)) < 0) _exit(1);
}

__attribute__((constructor(101))) void exit_on_unsupported_processor() {
  const char* missing = halfspace::missing_cpu_features();
  if (missing[0] == '\0') return;
  write_error("halfspace: ");
  write_error(missing);
  write_error("\n");
  _exit(1);
}

}  // namespace
