// SPDX-License-Identifier: Apache-2.0
//
// Refuses to run on a processor that lacks what this build uses, in one line rather than by an illegal instruction.
//
// A check in main would come too late: the static objects of the program (those of CLI11 among them) are initialized
// before it, by code compiled for HALFSPACE_ARCH. A constructor function of priority 101, the first that is not
// reserved, runs before all of them; the shared libraries that are initialized earlier are the distribution's, for
// the baseline. This file and core/cpu.cpp are compiled for the baseline and use neither templates nor inline
// functions: the linker keeps one copy of those, perhaps one compiled for more.
#include <string.h>
#include <unistd.h>

#include "halfspace/core/cpu.h"

namespace {

void say(const char* text) {
  if (write(STDERR_FILENO, text, strlen(text)) < 0) _exit(1);
}

__attribute__((constructor(101))) void refuse_lesser_processor() {
  const char* missing = halfspace::missing_cpu_features();
  if (missing[0] == '\0') return;
  say("halfspace: ");
  say(missing);
  say("\n");
  _exit(1);
}

}  // namespace
