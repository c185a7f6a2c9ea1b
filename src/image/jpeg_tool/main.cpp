// SPDX-License-Identifier: Apache-2.0
//
// halfspace-jpeg-tool decodes JPEG files with libjpeg-turbo, on behalf of halfspace (see tool/protocol.h). It is a separate program
// because input files are untrusted. It is not part of halfspace-image-tool because it starts in 2 ms, and OpenImageIO needs 200 ms.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "halfspace/image/jpeg_tool/decode.h"

int main(int argc, char** argv) {
  if (argc != 2 || argv[1] != std::string_view("serve")) {
    std::fputs("halfspace-jpeg-tool is started by halfspace; usage: halfspace-jpeg-tool serve\n", stderr);
    return 2;
  }
  std::_Exit(halfspace::serve_requests({halfspace::decode_and_answer, nullptr}));
}
