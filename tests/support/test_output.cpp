// SPDX-License-Identifier: Apache-2.0
#include "support/test_output.h"

#include <cctype>

#include "halfspace/image/image_difference.h"
#include "halfspace/image/image_io.h"

namespace halfspace {

namespace {

std::filesystem::path program_path() { return std::filesystem::read_symlink("/proc/self/exe"); }

}  // namespace

std::string test_program() {
  const std::string name = program_path().filename().string();
  return name.starts_with("test-") ? name.substr(5) : name;
}

std::filesystem::path write_test_picture(const std::string& name, const Image<glm::u8vec4>& picture) {
  std::string file = test_program() + "-" + name + ".png";
  for (char& c : file) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-') c = '_';
  }
  const std::filesystem::path folder = program_path().parent_path().parent_path() / "test-output";  // programs are in BUILD/bin
  std::filesystem::create_directories(folder);
  write_png(folder / file, picture);
  return folder / file;
}

std::string write_failed_picture(const std::string& name, const Image<glm::u8vec4>& picture, const Image<glm::u8vec4>& expected) {
  std::string text = "picture: " + write_test_picture(name, picture).string();
  if (expected.width() != picture.width() || expected.height() != picture.height()) return text;
  const Image<glm::u8vec4> difference = difference_colors(difference_map(picture, expected));
  return text + "\ndifference: " + write_test_picture(name + "-difference", difference).string();
}

}  // namespace halfspace
