// SPDX-License-Identifier: Apache-2.0
//
// The text in image files, and the detection of files that lack their end.
#include "halfspace/image/image_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "halfspace/image/image_tool.h"
#include "halfspace/image/png.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace halfspace {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNames[] = {"a.png", "a.jpg", "a.tif", "a.exr", "a.hdr"};

class ImageTextFiles : public testing::Test {
 protected:
  static bool can_write(const std::string& name) {
    return !find_image_tool().empty() || name == "a.png" || name == "a.jpg" || name == "a.exr";
  }
  // Writes an image of noise, because files of even colors are so short that everything is at their start.
  fs::path write(const std::string& name, const ImageText& text, int width = 70, int height = 50) const {
    const fs::path path = folder.path() / name;
    if (is_linear(image_file_of(path).value())) {
      Image<glm::vec4> image(width, height);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) image.at(x, y) = glm::vec4(x * y % 17, x * 3 % 5, y, 1);
      }
      write_image(path, image, text);
    } else {
      Image<glm::u8vec4> image(width, height);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) image.at(x, y) = glm::u8vec4(x * y * 37, x * 91, y * y * 13, 255);
      }
      write_image(path, image, text);
    }
    return path;
  }

  const TemporaryFolder folder;
};

TEST_F(ImageTextFiles, IsReadBackFromAllFormats) {
  const std::string long_text(3000, 'x');
  for (const char* name : kNames) {
    if (!can_write(name)) continue;
    for (const std::string& comment : {std::string("halfspace render a --set b=1"), std::string("caf\u00e9"), long_text, std::string()}) {
      const fs::path path = write(name, {"Program 1.0", comment, "build 0123 scene 4567"});
      const ImageText text = read_image_text(path);
      EXPECT_EQ(text.software, "Program 1.0") << name;
      EXPECT_EQ(text.comment, comment) << name;
      EXPECT_EQ(text.fingerprint, "build 0123 scene 4567") << name;
    }
  }
}

TEST_F(ImageTextFiles, DoesNotChangePixels) {
  for (const char* name : kNames) {
    if (!can_write(name)) continue;
    const auto pixels = [](const fs::path& path) { return read_linear(path); };
    const Image<glm::vec4> with = pixels(write(name, {"Program 1.0", "how", "print"})), without = pixels(write(name, {}));
    EXPECT_TRUE(std::ranges::equal(with.texels(), without.texels())) << name;
    EXPECT_EQ(read_image_text(folder.path() / name).comment, "") << name;
  }
}

TEST_F(ImageTextFiles, IsEmptyForOtherFiles) {
  std::ofstream(folder.path() / "part.png", std::ios::binary) << read_bytes(write("a.png", {"P", "c", "f"})).substr(0, 30);
  std::ofstream(folder.path() / "text.jpg") << "hello";
  std::ofstream(folder.path() / "empty.exr");
  for (const char* name : {"part.png", "text.jpg", "empty.exr", "missing.tif", "."}) {
    EXPECT_EQ(read_image_text(folder.path() / name).fingerprint, "") << name;
    EXPECT_FALSE(is_whole_image(folder.path() / name)) << name;
  }
}

// A text too long for a JPEG comment is cut, and the file stays valid.
TEST_F(ImageTextFiles, LongJpegCommentsAreCut) {
  const fs::path path = write("a.jpg", {"P", std::string(100000, 'x'), ""});
  EXPECT_EQ(read_image(path).width(), 70);
  EXPECT_GT(read_image_text(path).comment.size(), 60000u);
}

TEST_F(ImageTextFiles, FilesWithoutTheirEndAreNotWhole) {
  for (const char* name : kNames) {
    if (!can_write(name)) continue;
    for (const auto& [width, height] : {std::pair(70, 50), {1, 1}, {9, 16}, {300, 17}}) {
      const fs::path path = write(name, {"P", "c", "f"}, width, height);
      const std::string bytes = read_bytes(path);
      EXPECT_TRUE(is_whole_image(path)) << name << " " << width;
      // The last byte of some files pads a TIFF directory or repeats a zero, so cuts of one byte are tried as well as large ones.
      for (const std::size_t missing : {std::size_t{1}, std::size_t{5}, bytes.size() / 2, bytes.size() - 40, bytes.size()}) {
        std::ofstream(path, std::ios::binary) << bytes.substr(0, bytes.size() - missing);
        EXPECT_FALSE(is_whole_image(path)) << name << " " << width << " without " << missing << " bytes";
      }
    }
  }
}

// Every text is untrusted, because any file can be in the place of a picture.
TEST_F(ImageTextFiles, DamagedFilesAreReadWithoutHarm) {
  for (const char* name : kNames) {
    if (!can_write(name)) continue;
    const fs::path path = write(name, {"P", "c", "f"}, 9, 9);
    const std::string bytes = read_bytes(path);
    for (std::size_t i = 0; i < std::min<std::size_t>(bytes.size(), 600); ++i) {
      for (const char value : {'\0', '\x7f', '\xff'}) {
        std::string damaged = bytes;
        damaged[i] = value;
        std::ofstream(path, std::ios::binary) << damaged;
        (void)read_image_text(path);
        (void)is_whole_image(path);
      }
    }
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_EQ(read_image_text(path).fingerprint, "f") << name;
  }
}

}  // namespace
}  // namespace halfspace
