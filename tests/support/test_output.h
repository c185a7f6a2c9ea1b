// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

#include "halfspace/core/image.h"

namespace halfspace {

/// The name of this test program without "test-", for example "render".
std::string test_program();

/// Writes a picture to BUILD/test-output/PROGRAM-NAME.png, for tests that fail, and returns its path. Characters of the name that
/// are no letters, digits, dots or dashes become underscores.
std::filesystem::path write_test_picture(const std::string& name, const Image<glm::u8vec4>& picture);

/// Writes the picture and, if `expected` is not empty, the colours of the differences from it (image_difference.h) with
/// "-difference" after the name. Returns what was written where, in words, for the message of a failed test.
std::string write_failed_picture(const std::string& name, const Image<glm::u8vec4>& picture, const Image<glm::u8vec4>& expected);

}  // namespace halfspace
