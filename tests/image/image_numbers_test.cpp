// SPDX-License-Identifier: Apache-2.0
//
// Reading at full precision: heights and linear radiance.
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "halfspace/core/half.h"
#include "halfspace/core/srgb.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_tool.h"
#include "image/image_files.h"
#include "image/image_fixture.h"

namespace halfspace {
namespace {

using ImageNumbers = FolderTest;

using ToolNumbers = ImageToolTest;

std::vector<float> texels_of(const Image<float>& image) { return {image.texels().begin(), image.texels().end()}; }

TEST_F(ImageNumbers, HeightsOfA16BitPngAreExact) {
  const std::vector<uint16_t> codes = {0, 1, 257, 32768, 65534, 65535};
  std::vector<float> expected;
  for (const uint16_t c : codes) expected.push_back(static_cast<float>(c) / 65535.0f);
  EXPECT_EQ(texels_of(read_gray(put("a.png", png16_row(codes, 6, 0)))), expected);
  EXPECT_EQ(texels_of(read_gray(put("rgb.png", png16_row(codes, 2, 2)))), (std::vector<float>{expected[0], expected[3]}))
      << "the first channel of a color file";
}

TEST_F(ImageNumbers, HeightsOfAn8BitPngAreValuesOver255) {
  Image<glm::u8vec4> image(256, 1);
  for (int i = 0; i < 256; ++i) image.at(i, 0) = glm::u8vec4(i, 7, 9, 255 - i);
  write_png(directory / "a.png", image);
  const Image<float> heights = read_gray(directory / "a.png");
  for (int i = 0; i < 256; ++i) EXPECT_EQ(heights.at(i, 0), static_cast<float>(i) / 255.0f);
}

TEST_F(ImageNumbers, PngColorsAreDecodedFromSrgbAndAlphaIsLinear) {
  Image<glm::u8vec4> image(256, 1);
  for (int i = 0; i < 256; ++i) image.at(i, 0) = glm::u8vec4(i, 255 - i, 0, i);
  write_png(directory / "a.png", image);
  const Image<glm::vec4> light = read_linear(directory / "a.png");
  for (std::size_t i = 0; i < 256; ++i) {
    EXPECT_EQ(light.data()[i], glm::vec4(kSrgbToLinear[i], kSrgbToLinear[255 - i], 0.0f, static_cast<float>(i) / 255.0f));
  }
}

TEST_F(ImageNumbers, SixteenBitValuesAreDecodedFromSrgb) {
  std::vector<uint16_t> codes;
  for (int c = 0; c <= 65535; c += 65) codes.insert(codes.end(), {static_cast<uint16_t>(c), static_cast<uint16_t>(c)});
  const int width = static_cast<int>(codes.size() / 2);
  const Image<glm::vec4> light = read_linear(put("a.png", png16_row(codes, width, 4)));
  for (int i = 0; i < width; ++i) {
    const double v = codes[2 * static_cast<std::size_t>(i)] / 65535.0;
    const double expected = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(light.at(i, 0).x, expected, 3e-7 * expected);
    EXPECT_EQ(light.at(i, 0).x, light.at(i, 0).z) << "gray is replicated to all channels";
    EXPECT_EQ(light.at(i, 0).w, static_cast<float>(codes[2 * static_cast<std::size_t>(i) + 1]) / 65535.0f);
  }
  const Image<glm::vec4> widened = read_linear(put("b.png", png16_row({0x8080, 0x0101, 0xffff}, 1, 2)));
  EXPECT_EQ(widened.at(0, 0), glm::vec4(kSrgbToLinear[0x80], kSrgbToLinear[1], 1.0f, 1.0f)) << "equal to the 8-bit values 128, 1, 255";
}

TEST_F(ToolNumbers, ReadsHeightsFromTiff) {
  EXPECT_EQ(texels_of(read_gray(put("8.tif", gray_tiff_row<uint8_t>({0, 51, 255}, TiffSampleFormat::unsigned_integer)))),
            (std::vector<float>{0.0f, 0.2f, 1.0f}));
  EXPECT_EQ(texels_of(read_gray(put("16.tif", gray_tiff_row<uint16_t>({0, 1, 65535}, TiffSampleFormat::unsigned_integer)))),
            (std::vector<float>{0.0f, 1.0f / 65535.0f, 1.0f}));
  const std::vector<float> numbers = {-10994.25f, 0.1f, 1e30f};
  EXPECT_EQ(texels_of(read_gray(put("float.tif", gray_tiff_row(numbers, TiffSampleFormat::floating_point)))), numbers);
  EXPECT_EQ(texels_of(read_gray(put("signed.tif", gray_tiff_row<int16_t>({-32767, 0, 32767}, TiffSampleFormat::signed_integer)))),
            (std::vector<float>{-1.0f, 0.0f, 1.0f}));
}

TEST_F(ToolNumbers, PfmStartsWithTheBottomRow) {
  const Image<glm::vec4> image = read_linear(put("a.pfm", pfm(1, 2, {1.0f, 2.0f, 3.0f, -4.0f, 5.5f, 6.0f})));
  ASSERT_EQ(image.height(), 2);
  EXPECT_EQ(image.at(0, 0), glm::vec4(-4.0f, 5.5f, 6.0f, 1.0f));
  EXPECT_EQ(image.at(0, 1), glm::vec4(1.0f, 2.0f, 3.0f, 1.0f));
  EXPECT_EQ(texels_of(read_gray(directory / "a.pfm")), (std::vector<float>{-4.0f, 1.0f}));
}

TEST_F(ToolNumbers, DecodesRgbe) {
  // Mantissas divided by 256, times 2^(exponent − 128).
  const std::string file = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + std::string("\x80\x40\x20\x81\xff\x00\x01\x90", 8);
  const Image<glm::vec4> image = read_linear(put("a.hdr", file));
  EXPECT_EQ(image.at(0, 0), glm::vec4(1.0f, 0.5f, 0.25f, 1.0f));
  EXPECT_EQ(image.at(1, 0), glm::vec4(65280.0f, 0.0f, 256.0f, 1.0f));
}

TEST_F(ToolNumbers, InfinitiesAreClampedInColorsAndRejectedInHeights) {
  const std::filesystem::path path = directory / "a.exr";
  Image<float> depth(3, 2);
  depth.at(1, 1) = kInf;
  write_depth_exr(path, depth);
  EXPECT_EQ(read_linear(path).at(1, 1), glm::vec4(kMaxHalf, kMaxHalf, kMaxHalf, 1.0f));
  EXPECT_TRUE(reports(input_error([&] { read_gray(path); }), path.string(), {"infinity", "(1, 1)"}));
  depth.at(1, 1) = -kInf;
  write_depth_exr(path, depth);
  EXPECT_EQ(read_linear(path).at(1, 1).x, -kMaxHalf);
}

TEST_F(ToolNumbers, RejectsNaNAndReportsThePixel) {
  const std::filesystem::path path = directory / "a.exr";
  Image<float> depth(3, 2);
  depth.at(2, 0) = kNaN;
  write_depth_exr(path, depth);
  for (const std::string& error : {input_error([&] { read_gray(path); }), input_error([&] { read_linear(path); })})
    EXPECT_TRUE(reports(error, path.string(), {"NaN", "(2, 0)"}));
}

TEST_F(ToolNumbers, RejectsFloatFilesAsEightBitImages) {
  const std::filesystem::path tiff = put("a.tif", gray_tiff_row<float>({1.0f, 2.0f}, TiffSampleFormat::floating_point));
  EXPECT_TRUE(reports(input_error([&] { read_image(tiff); }), tiff.string(), {"linear values", "16-bit integer", "PNG"}));
  const std::filesystem::path pfm_file = put("a.pfm", pfm(1, 1, {1.0f, 2.0f, 3.0f}));
  EXPECT_TRUE(reports(input_error([&] { read_image(pfm_file); }), pfm_file.string(), {"PFM", "linear values", "16-bit integer", "PNG"}));
}

// Checks the complete list of formats, because users choose from it.
TEST_F(ImageNumbers, ErrorListsReadableFormats) {
  const std::filesystem::path path = put("a.txt", "This is not a picture.");
  const std::string line = path.string() +
                           ": is not a supported image (it begins with \"This is \"); expected PNG, JPEG, TIFF, TGA, BMP, GIF, WebP, PNM, "
                           "PSD, DDS, KTX2, OpenEXR, HDR or PFM";
  EXPECT_EQ(input_error([&] { read_gray(path); }), line);
  EXPECT_TRUE(reports(input_error([&] { read_linear(path); }), path.string(), {"OpenEXR, HDR or PFM"}));
}

// ---- third-party files -----------------------------------------------------------------------------------------

TEST_F(ToolNumbers, ReadsMoonHeights) {
  const std::filesystem::path wide = shared_data("moon/ldem_1440x720_16bit_derived.png"), narrow = shared_data("moon/ldem_3_8bit.jpg");
  if (!std::filesystem::exists(wide)) GTEST_SKIP() << absent(wide);
  const Image<float> heights = read_gray(wide), codes = read_gray(narrow);
  ASSERT_EQ(heights.width(), 1440);
  ASSERT_EQ(heights.height(), 720);
  const auto mean = [](const Image<float>& image) {
    double sum = 0;
    for (const float h : image.texels()) sum += static_cast<double>(h);
    return sum / static_cast<double>(image.texels().size());
  };
  // Values computed by ImageMagick.
  EXPECT_NEAR(mean(heights), 0.433154, 1e-6);
  EXPECT_NEAR(heights.at(700, 300), 0.441428, 1e-6);
  EXPECT_NEAR(heights.at(10, 10), 0.439307, 1e-6);
  EXPECT_NEAR(mean(codes), mean(heights), 0.001) << "one was derived from the other";
}

TEST_F(ToolNumbers, ReadsEnvironmentMaps) {
  struct Case {
    const char* name;
    int width, height;
    glm::vec3 at_100_50;  // computed by ImageMagick
    float error;
  };
  const Case cases[] = {{"OrientationLatLong.exr", 1024, 512, glm::vec3(0.990723f), 1e-5f},
                        {"BrightRings.exr", 800, 800, glm::vec3(0.5f), 1e-5f},
                        {"venice_sunset_1k.hdr", 1024, 512, glm::vec3(0.226566f, 0.398444f, 0.792966f), 0.004f}};
  for (const Case& c : cases) {
    const std::filesystem::path path = shared_data("hdr") / c.name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << absent(path);
    const Image<glm::vec4> image = read_linear(path);
    ASSERT_EQ(image.width(), c.width) << c.name;
    ASSERT_EQ(image.height(), c.height) << c.name;
    const glm::vec4 texel = image.at(100, 50);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(texel[i], c.at_100_50[i], c.error) << c.name;
    EXPECT_EQ(texel.w, 1.0f) << c.name;
    EXPECT_EQ(read_gray(path).at(100, 50), texel.x) << c.name;
  }
}

}  // namespace
}  // namespace halfspace
