// SPDX-License-Identifier: Apache-2.0
//
// halfspace-image-tool decodes and encodes all formats other than PNG with OpenImageIO, on behalf of halfspace (see
// protocol.h). It is a separate program for two reasons. Input files are untrusted, and decoders for many formats have many
// bugs: OpenImageIO 2.4 crashes on a public JPEG with a damaged color profile. Such a file only crashes this process. Also,
// merely linking OpenImageIO adds 0.2 s to the startup of a program, which most runs of halfspace should not pay.
#include <OpenImageIO/imageio.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "halfspace/image/tool/read.h"
#include "halfspace/image/tool/write.h"

namespace halfspace {

namespace {

constexpr int kMaxChannels = 64;
constexpr rlim_t kReadSeconds = 60;
constexpr rlim_t kWriteSeconds = 1200;             // images to write are our own, and 16384x16384 pixels of EXR take minutes
constexpr rlim_t kAddressSpace = rlim_t{6} << 30;  // 2^28 pixels of 16 bytes, plus the libraries

// Limits CPU time and memory, disables core files, and makes this process end together with the one that started it.
void limit_this_process(rlim_t cpu_seconds) {
  const rlimit cpu = {cpu_seconds, cpu_seconds};
  ::setrlimit(RLIMIT_CPU, &cpu);
  if (!HALFSPACE_SANITIZED) {  // sanitizers reserve terabytes of address space
    const rlimit memory = {kAddressSpace, kAddressSpace};
    ::setrlimit(RLIMIT_AS, &memory);
  }
  const rlimit core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &core);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  OIIO::attribute("limits:channels", kMaxChannels);
  OIIO::attribute("limits:imagesize_MB", 4096);
}

bool serve(int argc, char** argv) {
  const std::string_view task = argc > 1 ? argv[1] : "";
  if (task == "read" && argc == 7) {
    limit_this_process(kReadSeconds);
    const bool gray = argv[4] == std::string_view("gray");
    read_and_answer({argv[2], argv[3], gray, std::strtoull(argv[5], nullptr, 10), std::strtoull(argv[6], nullptr, 10)});
    return true;
  }
  if (task == "write" && argc == 3) {
    limit_this_process(kWriteSeconds);
    write_and_answer(argv[2]);
    return true;
  }
  return false;
}

}  // namespace

}  // namespace halfspace

int main(int argc, char** argv) {
  if (!halfspace::serve(argc, argv)) {
    std::fputs(
        "halfspace-image-tool is started by halfspace; usage: halfspace-image-tool read PATH FORMAT gray|rgba FILE_BYTES MAX_PIXELS\n"
        "                                               or:    halfspace-image-tool write FORMAT\n",
        stderr);
    return 2;
  }
  std::fflush(stdout);
  std::_Exit(0);  // skips the destructors of OpenImageIO's statics, which are not needed
}
