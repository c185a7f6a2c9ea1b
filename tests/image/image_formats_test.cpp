// SPDX-License-Identifier: Apache-2.0
//
// Writes images in every format, reads them back, and checks the files with ImageMagick.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>
#include <limits>
#include <sstream>
#include <vector>

#include "halfspace/core/half.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_tool.h"
#include "image/image_fixture.h"
#include "support/program.h"

namespace halfspace {
namespace {

using ImageFormats = FolderTest;

class ToolFormats : public ImageToolTest {
 protected:
  Image<glm::vec4> write_and_read(const char* name, const Image<glm::vec4>& image) const {
    write_image(directory / name, image);
    return read_linear(directory / name);
  }
};

Image<glm::vec4> one_texel(const glm::vec4& texel) {
  Image<glm::vec4> image(1, 1);
  image.at(0, 0) = texel;
  return image;
}

// Linear values of both signs with magnitudes from 2^-20 to 2^15; the channels of a pixel differ by up to a factor of 2^8. The image has
// more rows than the tool processes at once.
Image<glm::vec4> test_light(bool opaque) {
  Image<glm::vec4> image(37, 150);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const float scale = std::ldexp(1.0f + static_cast<float>(x) / 37.0f, y % 28 - 20);
      image.at(x, y) = glm::vec4(scale, scale * static_cast<float>(1 + (x * y) % 255), -scale * 3.0f,
                                 opaque ? 1.0f : 0.25f * static_cast<float>(1 + x % 4));
    }
  }
  return image;
}

float as_half(float x) { return half_to_float(float_to_half(x)); }

// Returns the output of ImageMagick's identify for a file, or an empty string if it is not installed.
std::string identify(const std::filesystem::path& path, const std::string& format) {
  const ProgramOutput output = run_command("identify -format '" + format + "' '" + path.string() + "' 2>/dev/null");
  return output.exit_code == 0 ? output.text : "";
}

std::vector<double> numbers_in(const std::string& text) {
  std::istringstream words(text);
  std::vector<double> numbers;
  for (double n = 0; words >> n;) numbers.push_back(n);
  return numbers;
}

TEST_F(ImageFormats, AreRecognizedByExtension) {
  EXPECT_EQ(image_file_of("a.png"), ImageFile::png);
  EXPECT_EQ(image_file_of("dir.exr/a.PNG"), ImageFile::png);
  EXPECT_EQ(image_file_of("a.jpg"), ImageFile::jpeg);
  EXPECT_EQ(image_file_of("a.JPEG"), ImageFile::jpeg);
  EXPECT_EQ(image_file_of("a.tif"), ImageFile::tiff);
  EXPECT_EQ(image_file_of("a.Tiff"), ImageFile::tiff);
  EXPECT_EQ(image_file_of("a.png.exr"), ImageFile::exr);
  EXPECT_EQ(image_file_of("a.HDR"), ImageFile::hdr);
  for (const char* name : {"", "a", "png", ".png", "a.", "a.bmp", "a.exr/b"}) EXPECT_EQ(image_file_of(name), std::nullopt) << name;
  EXPECT_TRUE(is_linear(ImageFile::exr) && is_linear(ImageFile::hdr));
  EXPECT_FALSE(is_linear(ImageFile::png) || is_linear(ImageFile::jpeg) || is_linear(ImageFile::tiff));
}

TEST_F(ImageFormats, RejectImagesOfTheWrongKind) {
  const Image<glm::u8vec4> codes(1, 1);
  const Image<glm::vec4> light(1, 1);
  EXPECT_TRUE(reports(output_error([&] { write_image("a.bmp", codes); }), "a.bmp", {"name", ".png", ".tif"}));
  EXPECT_TRUE(reports(output_error([&] { write_image("a", light); }), "a", {"name", ".exr or .hdr"}));
  EXPECT_TRUE(reports(output_error([&] { write_image("a.exr", codes); }), "a.exr", {"linear", ".png", ".tif"}));
  EXPECT_TRUE(reports(output_error([&] { write_image("a.tif", light); }), "a.tif", {"8-bit", ".exr or .hdr"}));
}

TEST_F(ImageFormats, PngIsExact) {
  write_image(directory / "a.PNG", test_picture(false));
  EXPECT_TRUE(read_image(directory / "a.PNG") == test_picture(false));
}

TEST_F(ToolFormats, TiffIsExact) {
  for (const bool opaque : {true, false}) {
    write_image(directory / "a.tif", test_picture(opaque));
    EXPECT_TRUE(read_image(directory / "a.tif") == test_picture(opaque)) << (opaque ? "RGB" : "RGBA, straight alpha");
  }
  EXPECT_EQ(file_count(), 1u) << "no other file is left behind";
}

TEST_F(ToolFormats, JpegIsCloseAndOpaque) {
  // A smooth image: at quality 95, the error is at most 4/255, and 1/255 on average.
  Image<glm::u8vec4> image(64, 48);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) image.at(x, y) = glm::u8vec4(4 * x, 5 * y, 255 - 2 * (x + y), 128);
  }
  write_image(directory / "a.jpg", image);
  const Image<glm::u8vec4> again = read_image(directory / "a.jpg");
  ASSERT_EQ(again.width(), 64);
  ASSERT_EQ(again.height(), 48);
  int largest = 0, sum = 0;
  for (std::size_t i = 0; i < image.texels().size(); ++i) {
    EXPECT_EQ(again.data()[i].w, 255);
    for (int c = 0; c < 3; ++c) {
      const int error = std::abs(int{again.data()[i][c]} - int{image.data()[i][c]});
      largest = std::max(largest, error);
      sum += error;
    }
  }
  EXPECT_LE(largest, 4);
  EXPECT_LE(sum, 3 * 64 * 48);
}

TEST_F(ToolFormats, ExrStoresTheNearestHalfFloats) {
  const Image<glm::vec4> light = test_light(true);
  const Image<glm::vec4> again = write_and_read("a.exr", light);
  for (std::size_t i = 0; i < light.texels().size(); ++i) {
    for (int c = 0; c < 3; ++c) ASSERT_EQ(again.data()[i][c], as_half(light.data()[i][c])) << i;
    ASSERT_EQ(again.data()[i].w, 1.0f);
  }
}

TEST_F(ToolFormats, ExrStoresPremultipliedAlpha) {
  const Image<glm::vec4> light = test_light(false);
  const Image<glm::vec4> again = write_and_read("a.exr", light);
  for (std::size_t i = 0; i < light.texels().size(); ++i) {
    const glm::vec4 t = light.data()[i];
    ASSERT_EQ(again.data()[i].w, t.w);
    for (int c = 0; c < 3; ++c) ASSERT_EQ(again.data()[i][c], as_half(t[c] * t.w) / t.w) << i;
  }
  // read_gray returns the stored first channel, without dividing by alpha.
  EXPECT_EQ(read_gray(directory / "a.exr").at(0, 0), as_half(light.at(0, 0).x * 0.25f));
}

TEST_F(ToolFormats, ExrOmitsAlphaOfOpaqueImages) {
  EXPECT_EQ(write_and_read("a.exr", one_texel({0.5f, 2.0f, 8.0f, 0.0f})).at(0, 0), glm::vec4(0.0f))
      << "premultiplication loses the color where alpha is 0";
  write_image(directory / "b.exr", one_texel({0.5f, 2.0f, 8.0f, 1.0f}));
  const auto has_alpha = [&](const char* name) {
    const std::string text = read_bytes(directory / name);
    // An entry of the channel list is a zero-terminated name and 16 bytes, the first of which is the type (1: half).
    return text.find(std::string("A\0\1\0\0\0", 6)) != std::string::npos;
  };
  EXPECT_TRUE(has_alpha("a.exr"));
  EXPECT_FALSE(has_alpha("b.exr"));
}

TEST_F(ToolFormats, ExrClampsInfinitiesAndReplacesNaN) {
  EXPECT_EQ(write_and_read("a.exr", one_texel({kInf, -kInf, kNaN, 1.0f})).at(0, 0), glm::vec4(kMaxHalf, -kMaxHalf, 0.0f, 1.0f));
  EXPECT_EQ(write_and_read("a.exr", one_texel({1e9f, 65520.0f, 1e-9f, 1.0f})).at(0, 0), glm::vec4(kMaxHalf, kMaxHalf, 0.0f, 1.0f));
  EXPECT_EQ(write_and_read("a.exr", one_texel({kInf, 1.0f, 1.0f, 0.0f})).at(0, 0), glm::vec4(0.0f));
  EXPECT_EQ(write_and_read("a.exr", one_texel({1.0f, 1.0f, 1.0f, kNaN})).at(0, 0), glm::vec4(0.0f));
}

TEST_F(ToolFormats, SamePixelsGiveIdenticalFiles) {
  for (const char* extension : {".exr", ".hdr"}) {
    std::string files[2];
    for (std::string& text : files) {
      write_image(directory / (std::string("a") + extension), test_light(false));
      text = read_bytes(directory / (std::string("a") + extension));
    }
    EXPECT_TRUE(files[0] == files[1]) << extension;
  }
}

// RGBE stores 8 bits per channel and the exponent of the largest channel. A step is between 1/256 and 1/128 of the largest channel; the
// error is at most half a step.
TEST_F(ToolFormats, HdrErrorIsBoundedByTheLargestChannel) {
  const Image<glm::vec4> light = test_light(false);
  const Image<glm::vec4> again = write_and_read("a.hdr", light);
  for (std::size_t i = 0; i < light.texels().size(); ++i) {
    const glm::vec4 t = light.data()[i];
    const float largest = std::max(t.x, t.y);
    EXPECT_LE(std::abs(again.data()[i].x - t.x), largest / 256.0f) << i;
    EXPECT_LE(std::abs(again.data()[i].y - t.y), largest / 256.0f) << i;
    EXPECT_EQ(again.data()[i].z, 0.0f) << "negative values become 0";
    EXPECT_EQ(again.data()[i].w, 1.0f);
  }
}

TEST_F(ToolFormats, HdrRoundsAndClampsExtremeValues) {
  EXPECT_EQ(write_and_read("a.hdr", one_texel({kInf, -kInf, kNaN, 1.0f})).at(0, 0), glm::vec4(65536.0f, 0.0f, 0.0f, 1.0f))
      << "65504 rounded to 8 bits";
  EXPECT_EQ(write_and_read("a.hdr", one_texel({255.75f, 3.0f, 1.0f, 0.5f})).at(0, 0), glm::vec4(256.0f, 4.0f, 2.0f, 1.0f))
      << "the largest channel rounds up to a power of two, which doubles the step";
  EXPECT_EQ(write_and_read("a.hdr", one_texel({3e38f, 0.0f, 0.0f, 1.0f})).at(0, 0), glm::vec4(0x1p126f, 0.0f, 0.0f, 1.0f));
  EXPECT_EQ(write_and_read("a.hdr", one_texel({1e-35f, 0.0f, 0.0f, 1.0f})).at(0, 0), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
}

TEST_F(ToolFormats, DepthIsBitIdentical) {
  Image<float> depth(5, 70);
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 5; ++x) depth.at(x, y) = std::ldexp(1.0f + static_cast<float>(x) / 7.0f, -y);
  }
  write_depth_exr(directory / "a.exr", depth);
  EXPECT_TRUE(read_gray(directory / "a.exr") == depth);
}

TEST_F(ToolFormats, TopRowComesFirst) {
  Image<glm::vec4> image(1, 2);
  image.at(0, 0) = glm::vec4(1.0f, 0.0f, 0.0f, 1.0f);
  image.at(0, 1) = glm::vec4(0.0f, 0.0f, 1.0f, 1.0f);
  EXPECT_TRUE(write_and_read("a.exr", image) == image);
  EXPECT_TRUE(write_and_read("a.hdr", image) == image);
}

TEST_F(ToolFormats, ImagesCanBeOnePixelWideOrHigh) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 200), std::pair(200, 1)}) {
    const Image<glm::u8vec4> codes(width, height);
    write_image(directory / "a.tif", codes);
    EXPECT_TRUE(read_image(directory / "a.tif") == codes);
    write_image(directory / "a.jpg", codes);
    EXPECT_EQ(read_image(directory / "a.jpg").height(), height);
    const Image<glm::vec4> light(width, height);
    EXPECT_TRUE(write_and_read("a.exr", light) == light);
    EXPECT_EQ(write_and_read("a.hdr", light).width(), width);
  }
}

TEST_F(ToolFormats, ImageMagickReadsTheSamePixels) {
  Image<glm::vec4> light(9, 5);
  light.at(3, 2) = glm::vec4(0.75f, 0.5f, 0.25f, 1.0f);
  Image<glm::u8vec4> codes(9, 5);
  codes.at(3, 2) = glm::u8vec4(191, 128, 64, 255);
  write_image(directory / "a.exr", light);
  write_image(directory / "a.hdr", light);
  write_image(directory / "a.tif", codes);
  write_image(directory / "a.jpg", codes);
  if (identify(directory / "a.jpg", "%m") != "JPEG") GTEST_SKIP() << "ImageMagick's identify is absent or reads no JPEG";
  const bool reads_exr = identify(directory / "a.exr", "%m") == "EXR";
  if (reads_exr) {
    EXPECT_EQ(identify(directory / "a.exr", "%m %w %h"), "EXR 9 5");
  }
  EXPECT_EQ(identify(directory / "a.hdr", "%m %w %h"), "HDR 9 5");
  EXPECT_EQ(identify(directory / "a.tif", "%m %w %h %C %z"), "TIFF 9 5 Zip 8");
  EXPECT_EQ(identify(directory / "a.jpg", "%m %w %h %Q"), "JPEG 9 5 95");
  const double expected[] = {0.75, 0.5, 0.25};
  for (const std::string name : {"a.exr", "a.hdr", "a.tif"}) {
    if (name == "a.exr" && !reads_exr) continue;  // some builds of ImageMagick lack OpenEXR
    const std::vector<double> numbers = numbers_in(identify(directory / name, "%[fx:p{3,2}.r] %[fx:p{3,2}.g] %[fx:p{3,2}.b]"));
    ASSERT_EQ(numbers.size(), 3u) << name;
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(numbers[c], expected[c], 0.003) << name;
  }
}

}  // namespace
}  // namespace halfspace
