// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

#include "halfspace/core/image.h"

namespace halfspace {

/// Returns the name of this test program without "test-", for example "render".
std::string test_program();

/// Writes a picture of a failed test to BUILD/test-output/PROGRAM-NAME.png and returns its path. Characters of the name other than letters,
/// digits, dots and dashes are replaced by underscores.
std::filesystem::path write_test_picture(const std::string& name, const Image<glm::u8vec4>& picture);

/// Writes the picture. If `expected` is not empty, also writes a picture of the difference (image_difference.h), with "-difference"
/// appended to the name. Returns a text with the paths, for the message of the failed test.
std::string write_failed_picture(const std::string& name, const Image<glm::u8vec4>& picture, const Image<glm::u8vec4>& expected);

}  // namespace halfspace
