// SPDX-License-Identifier: Apache-2.0
//
// halfspace-image-tool: decodes and encodes what is not PNG, through OpenImageIO, for halfspace (see protocol.h). It is
// a program of its own for two reasons. Files are not trusted, and decoders of many formats have many faults:
// OpenImageIO 2.4 dies on a public JPEG with a damaged colour profile. Here such a file ends this process and no other.
// And merely linking OpenImageIO costs a program 0.2 s of start-up, which most runs of halfspace need not pay.
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
constexpr rlim_t kWriteSeconds = 1200;             // the picture is ours, and 16384x16384 pixels of EXR take minutes
constexpr rlim_t kAddressSpace = rlim_t{6} << 30;  // 2^28 pixels of 16 bytes, and the libraries

// A decoder that loops ends after a minute, one that wants all memory is refused it; none leaves a core file; the
// program that asked takes this one with it.
void limit_this_process(rlim_t cpu_seconds) {
  const rlimit cpu = {cpu_seconds, cpu_seconds};
  ::setrlimit(RLIMIT_CPU, &cpu);
  if (!HALFSPACE_SANITIZED) {  // a sanitizer reserves terabytes of addresses
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
        "halfspace-image-tool serves halfspace; usage: halfspace-image-tool read PATH FORMAT gray|rgba FILE_BYTES MOST_PIXELS\n"
        "                                       or:    halfspace-image-tool write FORMAT\n",
        stderr);
    return 2;
  }
  std::fflush(stdout);
  std::_Exit(0);  // OpenImageIO's statics have nothing left to do
}
