// SPDX-License-Identifier: Apache-2.0
#include "halfspace/core/tool/limits.h"

#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <thread>

namespace halfspace::HS_LANES {

// PR_SET_PDEATHSIG would not work: it signals the end of the thread that started this process, which may be long before its program ends.
void exit_with_reader() {
  std::thread([] {
    pollfd output = {STDOUT_FILENO, 0, 0};
    while (::poll(&output, 1, -1) < 0 && errno == EINTR) {
    }
    ::_exit(0);
  }).detach();
}

void limit_memory(uint64_t bytes) {
  if (!HALFSPACE_SANITIZED) {  // sanitizers reserve terabytes of address space
    rlimit memory = {};
    ::getrlimit(RLIMIT_AS, &memory);
    memory.rlim_cur = std::min(static_cast<rlim_t>(bytes), memory.rlim_max);
    ::setrlimit(RLIMIT_AS, &memory);
  }
  const rlimit core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &core);
  ::signal(SIGXCPU, SIG_DFL);
  ::signal(SIGALRM, SIG_DFL);
}

// Only the soft limit of CPU time is set, because the next request raises it again. The limit on elapsed time stops decoders that wait for
// something that never happens.
void limit_time(unsigned seconds) {
  timespec used = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  rlimit cpu = {};
  ::getrlimit(RLIMIT_CPU, &cpu);
  cpu.rlim_cur = std::min(static_cast<rlim_t>(used.tv_sec) + seconds, cpu.rlim_max);
  ::setrlimit(RLIMIT_CPU, &cpu);
  ::alarm(5 * seconds);
}

}  // namespace halfspace::HS_LANES
