// SPDX-License-Identifier: Apache-2.0
//
// Texels of images with more than 8 bits per channel: what read_texels returns, and their way back to a PNG file.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "halfspace/core/half.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_samples.h"
#include "halfspace/image/png.h"
#include "image/image_files.h"
#include "image/image_fixture.h"

namespace halfspace::texel_samples_test {
namespace {

using TexelFiles = ImageToolTest;

TextureImage texels_in(const std::string& file, ImageUse use) { return read_texels(std::as_bytes(std::span(file)), "file", use); }
Image<glm::vec4> numbers_in(const std::string& file, ImageUse use) { return std::get<Image<glm::vec4>>(texels_in(file, use)); }

double decoded(double code) { return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4); }

// All 16-bit values in the first three channels, in different orders.
Image<glm::u16vec4> all_codes() {
  Image<glm::u16vec4> image(256, 256);
  for (uint32_t i = 0; i < 65536; ++i)
    image.data()[i] = {static_cast<uint16_t>(i), static_cast<uint16_t>(65535 - i), static_cast<uint16_t>(i * 257),
                       static_cast<uint16_t>(i)};
  return image;
}

TEST(TexelSamples, Of8BitsAreKept) {
  const Image<glm::u8vec4> picture = test_picture(false);
  const std::vector<std::byte> file = encode_png(picture);
  for (const ImageUse use : {ImageUse::colors, ImageUse::data})
    EXPECT_EQ(std::get<Image<glm::u8vec4>>(read_texels(file, "file", use)), picture);
}

TEST(TexelSamples, Of16BitsAreNotRoundedTo8Bits) {
  // Both are nearest to the 8-bit value 128.
  const std::string file = png16_row({32800, 32960, 1, 32768}, 1, 6);
  const glm::vec4 data = numbers_in(file, ImageUse::data).at(0, 0);
  EXPECT_EQ(data, glm::vec4(32800, 32960, 1, 32768) / 65535.0f);
  const glm::vec4 color = numbers_in(file, ImageUse::colors).at(0, 0);
  EXPECT_NEAR(color.x, decoded(32800 / 65535.0), 1e-7);
  EXPECT_NEAR(color.y, decoded(32960 / 65535.0), 1e-7);
  EXPECT_NEAR(color.z, decoded(1 / 65535.0), 1e-12);
  EXPECT_EQ(color.w, 32768 / 65535.0f) << "alpha is linear";
  EXPECT_EQ(read_image(std::as_bytes(std::span(file)), "file").at(0, 0), glm::u8vec4(128, 128, 0, 128));
}

TEST(TexelSamples, ThatAre8BitValuesIn16BitsEqualThem) {
  const std::string file = png16_row({257, 257 * 100, 65535}, 1, 2);
  const glm::vec4 color = numbers_in(file, ImageUse::colors).at(0, 0);
  Image<glm::u8vec4> codes(1, 1);
  codes.at(0, 0) = {1, 100, 255, 255};
  EXPECT_EQ(color, to_linear(codes, false, "codes").at(0, 0));
}

TEST(TexelSamples, Of16BitsAreRestoredExactly) {
  const Image<glm::u16vec4> codes = all_codes();
  for (const ImageUse use : {ImageUse::colors, ImageUse::data}) {
    const TextureImage texels = to_texels(codes, use, false, "codes");
    EXPECT_EQ(to_codes16(std::get<Image<glm::vec4>>(texels), use), codes);
    EXPECT_EQ(std::get<Image<glm::u16vec4>>(decode_png(encode_png(texels, use), "file")), codes);
  }
}

TEST(TexelSamples, BeyondOneAreClampedInPngFiles) {
  Image<glm::vec4> numbers(1, 1);
  numbers.at(0, 0) = {-1, 2, 0.5f, 1e9f};
  EXPECT_EQ(to_codes16(numbers, ImageUse::data).at(0, 0), glm::u16vec4(0, 65535, 32768, 65535));
  const ColorPicture file = decode_png(encode_png(numbers, ImageUse::data), "file");
  EXPECT_EQ(std::get<Image<glm::u16vec4>>(file).at(0, 0), glm::u16vec4(0, 65535, 32768, 65535));
}

TEST_F(TexelFiles, OfTiffFilesHave16Bits) {
  const std::string file = gray_tiff_row<uint16_t>({32800, 3}, TiffSampleFormat::unsigned_integer);
  const Image<glm::vec4> numbers = numbers_in(file, ImageUse::data);
  EXPECT_EQ(numbers.at(0, 0), glm::vec4(glm::vec3(32800 / 65535.0f), 1));
  EXPECT_EQ(numbers.at(1, 0).x, 3 / 65535.0f);
}

TEST_F(TexelFiles, OfLinearFilesAreUnchanged) {
  const std::string file = pfm(1, 1, {-0.3f, 7.1f, 1e-7f});
  for (const ImageUse use : {ImageUse::colors, ImageUse::data}) EXPECT_EQ(numbers_in(file, use).at(0, 0), glm::vec4(-0.3f, 7.1f, 1e-7f, 1));
  Image<glm::vec4> light(1, 1);
  light.at(0, 0) = {0.1f, 40.0f, 0.0f, 1.0f};
  const std::vector<std::byte> exr = encode_image(light, ImageFile::exr, "light.exr");
  const glm::vec4 half = std::get<Image<glm::vec4>>(read_texels(exr, "light.exr", ImageUse::colors)).at(0, 0);
  EXPECT_EQ(half, glm::vec4(half_to_float(float_to_half(0.1f)), 40, 0, 1));
}

}  // namespace
}  // namespace halfspace::texel_samples_test
