// SPDX-License-Identifier: Apache-2.0
//
// What the tests of pictures in files share.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "halfspace/core/check.h"
#include "halfspace/core/image.h"

namespace halfspace {

// A directory of its own, gone when the test ends.
class ImageFixture : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "halfspace-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    directory = name;
  }
  void TearDown() override { std::filesystem::remove_all(directory); }

  std::size_t file_count() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(directory), std::filesystem::directory_iterator()));
  }
  std::filesystem::path put(const std::string& name, std::string_view bytes) const {
    std::ofstream(directory / name, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return directory / name;
  }

  std::filesystem::path directory;
};

// Every code occurs in every channel; alpha is 255 throughout if opaque.
inline Image<glm::u8vec4> test_picture(bool opaque) {
  Image<glm::u8vec4> image(67, 41);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) image.at(x, y) = glm::u8vec4(x * 7 + y, y * 5 + 3 * x, x * y, opaque ? 255 : x + y * 3);
  }
  return image;
}

template <class F>
std::string input_error(F&& f) {
  try {
    f();
  } catch (const InputError& e) {
    return e.what();
  }
  return "(no error)";
}
template <class F>
std::string output_error(F&& f) {
  try {
    f();
  } catch (const OutputError& e) {
    return e.what();
  }
  return "(no error)";
}

}  // namespace halfspace
