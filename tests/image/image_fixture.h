// SPDX-License-Identifier: Apache-2.0
//
// Shared by the tests of image files.
#pragma once

#include <glm/glm.hpp>

#include "halfspace/core/image.h"
#include "halfspace/image/image_tool.h"
#include "support/constants.h"
#include "support/folder_test.h"

namespace halfspace {

inline constexpr const char* kNoImageTool = "halfspace-image-tool is not built here (OpenImageIO is absent)";

// Fixture for tests that need halfspace-image-tool; skips them if it is not built.
class ImageToolTest : public FolderTest {
 protected:
  void SetUp() override {
    if (find_image_tool().empty()) GTEST_SKIP() << kNoImageTool;
  }
};

// Returns an image in which every 8-bit value occurs in every channel. Alpha is 255 everywhere if opaque is set.
inline Image<glm::u8vec4> test_picture(bool opaque) {
  Image<glm::u8vec4> image(67, 41);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) image.at(x, y) = glm::u8vec4(x * 7 + y, y * 5 + 3 * x, x * y, opaque ? 255 : x + y * 3);
  }
  return image;
}

}  // namespace halfspace
