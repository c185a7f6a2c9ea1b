// SPDX-License-Identifier: Apache-2.0
//
// halfspace-image-tool uses OpenImageIO to decode and encode the formats that no other part of Halfspace handles, on behalf of halfspace
// (see protocol.h). It is a separate program for two reasons. Input files are untrusted, and decoders for many formats have many bugs:
// OpenImageIO 2.4 crashes on a public JPEG with a damaged color profile. Such a file only crashes this process. Also, merely linking
// OpenImageIO adds 0.2 s to the startup of a program, and most runs of halfspace do not need it.
#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "halfspace/image/tool/read.h"
#include "halfspace/image/tool/service.h"
#include "halfspace/image/tool/write.h"

int main(int argc, char** argv) {
  if (argc != 2 || argv[1] != std::string_view("serve")) {
    std::fputs("halfspace-image-tool is started by halfspace; usage: halfspace-image-tool serve\n", stderr);
    return 2;
  }
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  OIIO::attribute("limits:channels", halfspace::kMaxChannels);
  OIIO::attribute("limits:imagesize_MB", 4096);
  std::_Exit(halfspace::serve_requests({halfspace::read_and_answer, halfspace::write_and_answer}));  // skips the destructors of statics
}
