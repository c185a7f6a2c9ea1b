// SPDX-License-Identifier: Apache-2.0
//
// JPEG files of every color space, written by libjpeg.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "halfspace/image/image_io.h"
#include "halfspace/image/image_tool.h"
#include "halfspace/image/jpeg_errors.h"
#include "image/image_fixture.h"

namespace halfspace {
namespace {

namespace fs = std::filesystem;

constexpr int kEdge = 32;

// A single-color file. Components are in the color space `input`.
struct JpegFile {
  J_COLOR_SPACE input = JCS_RGB, stored = JCS_YCbCr;
  std::vector<uint8_t> color;
  bool progressive = false;
};

std::string encode(const JpegFile& file) {
  JpegErrors errors;
  jpeg_compress_struct codec = {};
  codec.err = errors.manager();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  std::vector<uint8_t> row;
  for (int x = 0; x < kEdge; ++x) row.insert(row.end(), file.color.begin(), file.color.end());
  const bool ok = errors.run([&] {
    jpeg_create_compress(&codec);
    jpeg_mem_dest(&codec, &bytes, &size);
    codec.image_width = codec.image_height = kEdge;
    codec.input_components = static_cast<int>(file.color.size());
    codec.in_color_space = file.input;
    jpeg_set_defaults(&codec);
    jpeg_set_colorspace(&codec, file.stored);
    jpeg_set_quality(&codec, 100, TRUE);
    if (file.progressive) jpeg_simple_progression(&codec);
    jpeg_start_compress(&codec, TRUE);
    JSAMPLE* samples = row.data();
    for (int y = 0; y < kEdge; ++y) jpeg_write_scanlines(&codec, &samples, 1);
    jpeg_finish_compress(&codec);
  });
  EXPECT_TRUE(ok) << errors.text();
  const std::string result(reinterpret_cast<const char*>(bytes), size);
  jpeg_destroy_compress(&codec);
  std::free(bytes);
  return result;
}

class Jpeg : public FolderTest {
 protected:
  void SetUp() override {
    if (find_jpeg_tool().empty()) GTEST_SKIP() << "halfspace-jpeg-tool is not built here (libjpeg is absent)";
  }
  glm::ivec4 center(const JpegFile& file) const { return glm::ivec4(read_image(put("a.jpg", encode(file))).at(kEdge / 2, kEdge / 2)); }
};

void expect_near(const glm::ivec4& color, const glm::ivec4& expected) {
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(color[c], expected[c], 1) << c;
}

TEST_F(Jpeg, ReadsEveryColorSpace) {
  expect_near(center({JCS_GRAYSCALE, JCS_GRAYSCALE, {77}}), {77, 77, 77, 255});
  expect_near(center({JCS_RGB, JCS_YCbCr, {200, 100, 50}}), {200, 100, 50, 255});
  expect_near(center({JCS_RGB, JCS_RGB, {200, 100, 50}}), {200, 100, 50, 255});
  expect_near(center({JCS_RGB, JCS_GRAYSCALE, {100, 100, 100}}), {100, 100, 100, 255});
  // Inverted inks: 255 is no ink. The light is the product of color and black.
  for (const J_COLOR_SPACE stored : {JCS_CMYK, JCS_YCCK}) {
    expect_near(center({JCS_CMYK, stored, {255, 255, 255, 255}}), {255, 255, 255, 255});
    expect_near(center({JCS_CMYK, stored, {200, 100, 50, 255}}), {200, 100, 50, 255});
    expect_near(center({JCS_CMYK, stored, {200, 100, 50, 128}}), {100, 50, 25, 255});
    expect_near(center({JCS_CMYK, stored, {200, 100, 50, 0}}), {0, 0, 0, 255});
  }
}

TEST_F(Jpeg, ReadsProgressiveFiles) { expect_near(center({JCS_RGB, JCS_YCbCr, {200, 100, 50}, true}), {200, 100, 50, 255}); }

TEST_F(Jpeg, GrayIsTheFirstChannel) {
  const Image<float> gray = read_gray(put("a.jpg", encode({JCS_RGB, JCS_YCbCr, {200, 100, 50}})));
  EXPECT_NEAR(gray.at(3, 3), 200.0f / 255.0f, 1.01f / 255.0f);
}

// Texture coordinates refer to the stored pixels.
TEST_F(Jpeg, ExifOrientationIsIgnored) {
  Image<glm::u8vec4> image(16, 8);
  for (int x = 0; x < 16; ++x) image.at(x, 0) = glm::u8vec4(16 * x, 0, 0, 255);
  write_image(directory / "a.jpg", image);
  const std::string file = read_bytes(directory / "a.jpg");
  // A TIFF directory whose only entry is Orientation (0x112): 6, turned by 90 degrees.
  const std::string exif("Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0", 32);
  const std::string segment = std::string("\xff\xe1\0", 3) + static_cast<char>(exif.size() + 2) + exif;
  EXPECT_TRUE(read_image(put("b.jpg", file.substr(0, 2) + segment + file.substr(2))) == read_image(directory / "a.jpg"));
}

TEST_F(Jpeg, RejectsTruncatedFiles) {
  for (const bool progressive : {false, true}) {
    const fs::path whole = directory / "whole.jpg";
    write_image(whole, test_picture(true));
    const std::string bytes = progressive ? encode({JCS_RGB, JCS_YCbCr, {1, 2, 3}, true}) : read_bytes(whole);
    for (std::size_t part = 1; part < 10; ++part) {
      const fs::path path = put("cut.jpg", bytes.substr(0, bytes.size() * part / 10));
      EXPECT_TRUE(reports(input_error([&] { read_image(path); }), path.string() + ": cannot be read as jpeg", {"complete image file"}))
          << part;
    }
  }
}

// A file of 500 bytes that claims 65500x65500 pixels, and one that claims 32000x8000.
TEST_F(Jpeg, RejectsFilesThatClaimMoreThanTheyHold) {
  std::string bytes = encode({JCS_GRAYSCALE, JCS_GRAYSCALE, {77}});
  const std::size_t frame = bytes.find("\xff\xc0");
  ASSERT_NE(frame, std::string::npos);
  bytes.replace(frame + 5, 4, "\xff\xdc\xff\xdc");
  EXPECT_TRUE(
      reports(input_error([&] { read_image(put("a.jpg", bytes)); }), (directory / "a.jpg").string(), {"claims 65500x65500", "2^28"}));
  bytes.replace(frame + 5, 4, std::string("\x1f\x40\x7d\x00", 4));
  EXPECT_TRUE(
      reports(input_error([&] { read_image(put("a.jpg", bytes)); }), (directory / "a.jpg").string(), {"claims 32000x8000", "has only"}));
}

TEST_F(Jpeg, MatchesOpenImageIo) {
  if (find_image_tool().empty()) GTEST_SKIP() << kNoImageTool;
  Image<glm::u8vec4> image = test_picture(true);
  write_image(directory / "a.jpg", image);
  // The file that halfspace-image-tool writes decodes to the same pixels.
  const std::vector<std::byte> other = encode_codes_by_tool("b.jpg", "jpeg", image, 3, {});
  EXPECT_TRUE(read_image(other, "b.jpg") == read_image(directory / "a.jpg"));
}

TEST_F(Jpeg, SamePixelsGiveIdenticalFiles) {
  write_image(directory / "a.jpg", test_picture(true));
  write_image(directory / "b.jpg", test_picture(true));
  EXPECT_TRUE(read_bytes(directory / "a.jpg") == read_bytes(directory / "b.jpg"));
}

TEST_F(Jpeg, ReportsImagesThatAreTooLarge) {
  const fs::path path = directory / "a.jpg";
  EXPECT_TRUE(reports(output_error([&] { write_image(path, Image<glm::u8vec4>(65501, 1)); }), path.string() + ": cannot write", {"65500"}));
  EXPECT_FALSE(fs::exists(path));
}

}  // namespace
}  // namespace halfspace
