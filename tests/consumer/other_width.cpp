// SPDX-License-Identifier: Apache-2.0
//
// This program is compiled for a different SIMD width from the library, so it must not link.
#include <halfspace/raster/pass.h>

int main() {
  using namespace halfspace;
  Image<glm::u8vec4> image(8, 8);
  Pass pass(8, 8, srgb8a8_target(image), {});
  pass.run(Workers(1));
}
