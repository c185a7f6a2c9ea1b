// SPDX-License-Identifier: Apache-2.0
//
// Reads DDS and KTX2 files that the tests build: formats, tags, supercompression, and damaged files.
#include <gtest/gtest.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "halfspace/image/image_io.h"
#include "image/image_fixture.h"
#include "image/texture_files.h"
#include "support/errors.h"
#include "support/long_tests.h"

namespace halfspace::texture_file_test {
namespace {

using TextureFiles = ImageToolTest;

std::span<const std::byte> bytes_of(const std::string& file) { return std::as_bytes(std::span(file)); }

Image<glm::u8vec4> codes_of(const std::string& file) { return read_image(bytes_of(file), "codes"); }

// Returns the texels of a file as numbers, without the decoding of sRGB.
Image<glm::vec4> numbers_of(const std::string& file) {
  const auto texels = read_texels(bytes_of(file), "numbers", ImageUse::data);
  if (const auto* numbers = std::get_if<Image<glm::vec4>>(&texels)) return *numbers;
  const auto& codes = std::get<Image<glm::u8vec4>>(texels);
  Image<glm::vec4> numbers(codes.width(), codes.height());
  for (std::size_t i = 0; i < codes.texels().size(); ++i) numbers.data()[i] = glm::vec4(codes.data()[i]) / 255.0f;
  return numbers;
}

std::string error_of(const std::string& file) {
  return input_error([&] { read_linear(bytes_of(file), "file"); });
}

std::string text_of(const char* bytes, std::size_t count) { return {bytes, count}; }

constexpr uint16_t kOne = 0x3c00, kMinusTwo = 0xc000, kHalf = 0x3800, kQuarter = 0x3400;  // as halfs

// A format, a texel, and its value.
struct FormatCase {
  uint32_t format;
  std::string texel;
  glm::vec4 value;
};

const std::vector<FormatCase> kVulkanCases = {
    {2, memory_of<uint16_t>({0x1fc3}), glm::vec4(1, 15, 12, 3) / 15.0f},
    {3, memory_of<uint16_t>({0x1fc3}), glm::vec4(12, 15, 1, 3) / 15.0f},
    {4, memory_of<uint16_t>({0xf81f}), {1, 0, 1, 1}},
    {5, memory_of<uint16_t>({0x07ff}), {1, 1, 0, 1}},
    {6, memory_of<uint16_t>({0xf801}), {1, 0, 0, 1}},
    {7, memory_of<uint16_t>({0xf83e}), {1, 0, 1, 0}},
    {8, memory_of<uint16_t>({0x7c1f}), {1, 0, 1, 0}},
    {9, "\x33", glm::vec4(0.2f, 0.2f, 0.2f, 1)},
    {15, "\x33", glm::vec4(0.2f, 0.2f, 0.2f, 1)},
    {10, "\x81", {-1, -1, -1, 1}},
    {16, "\x33\xff", {0.2f, 1, 0, 1}},
    {17, "\x7f\x80", {1, -1, 0, 1}},
    {23, "\x33\x66\x99", glm::vec4(0.2f, 0.4f, 0.6f, 1)},
    {30, "\x99\x66\x33", glm::vec4(0.2f, 0.4f, 0.6f, 1)},
    {24, "\x7f\x81\x7f", {1, -1, 1, 1}},
    {37, "\x33\x66\x99\xcc", glm::vec4(0.2f, 0.4f, 0.6f, 0.8f)},
    {43, "\x33\x66\x99\xcc", glm::vec4(0.2f, 0.4f, 0.6f, 0.8f)},
    {38, "\x7f\x81\x7f\x81", {1, -1, 1, -1}},
    {44, "\x99\x66\x33\xcc", glm::vec4(0.2f, 0.4f, 0.6f, 0.8f)},
    {50, "\x99\x66\x33\xcc", glm::vec4(0.2f, 0.4f, 0.6f, 0.8f)},
    {58, memory_of<uint32_t>({0xfff00000}), {1, 0, 0, 1}},
    {64, memory_of<uint32_t>({0x400003ff}), {1, 0, 0, 21845.0f / 65535.0f}},
    {70, memory_of<uint16_t>({13107}), glm::vec4(0.2f, 0.2f, 0.2f, 1)},
    {71, memory_of<uint16_t>({0x7fff}), glm::vec4(1)},
    {76, memory_of<uint16_t>({kMinusTwo}), {-2, -2, -2, 1}},
    {77, memory_of<uint16_t>({1, 65535}), {1.0f / 65535.0f, 1, 0, 1}},
    {78, memory_of<uint16_t>({0x7fff, 0x8000}), {1, -1, 0, 1}},
    {83, memory_of<uint16_t>({kOne, kHalf}), {1, 0.5f, 0, 1}},
    {84, memory_of<uint16_t>({1, 2, 65534}), glm::vec4(1, 2, 65534, 65535) / 65535.0f},
    {85, memory_of<uint16_t>({0x7fff, 0, 0x8001}), {1, 0, -1, 1}},
    {90, memory_of<uint16_t>({kOne, kHalf, kMinusTwo}), {1, 0.5f, -2, 1}},
    {91, memory_of<uint16_t>({1, 2, 3, 4}), glm::vec4(1, 2, 3, 4) / 65535.0f},
    {92, memory_of<uint16_t>({0x7fff, 0, 0x8001, 0x8000}), {1, 0, -1, -1}},
    {97, memory_of<uint16_t>({kOne, kHalf, kMinusTwo, kQuarter}), {1, 0.5f, -2, 0.25f}},
    {100, memory_of<float>({1e9f}), {1e9f, 1e9f, 1e9f, 1}},
    {103, memory_of<float>({1e9f, -3}), {1e9f, -3, 0, 1}},
    {106, memory_of<float>({1, 2, 1e-9f}), {1, 2, 1e-9f, 1}},
    {109, memory_of<float>({1, 2, 3, 0.1f}), {1, 2, 3, 0.1f}},
    {122, memory_of<uint32_t>({0x3c0u | 0x380u << 11 | 0x200u << 22}), {1, 0.5f, 2, 1}},
    {123, memory_of<uint32_t>({256u | 128u << 9 | 511u << 18 | 16u << 27}), {1, 0.5f, 511.0f / 256.0f, 1}},
};

const std::vector<FormatCase> kDxgiCases = {
    {2, memory_of<float>({1, 2, 3, 0.1f}), {1, 2, 3, 0.1f}},
    {6, memory_of<float>({1, 2, 1e-9f}), {1, 2, 1e-9f, 1}},
    {10, memory_of<uint16_t>({kOne, kHalf, kMinusTwo, kQuarter}), {1, 0.5f, -2, 0.25f}},
    {11, memory_of<uint16_t>({1, 2, 3, 4}), glm::vec4(1, 2, 3, 4) / 65535.0f},
    {13, memory_of<uint16_t>({0x7fff, 0, 0x8001, 0x8000}), {1, 0, -1, -1}},
    {16, memory_of<float>({1e9f, -3}), {1e9f, -3, 0, 1}},
    {24, memory_of<uint32_t>({0x400003ff}), {1, 0, 0, 21845.0f / 65535.0f}},
    {26, memory_of<uint32_t>({0x3c0u | 0x380u << 11 | 0x200u << 22}), {1, 0.5f, 2, 1}},
    {28, "\x33\x66\x99\xcc", glm::vec4(0.2f, 0.4f, 0.6f, 0.8f)},
    {29, "\x33\x66\x99\xcc", glm::vec4(0.2f, 0.4f, 0.6f, 0.8f)},
    {31, "\x7f\x81\x7f\x81", {1, -1, 1, -1}},
    {34, memory_of<uint16_t>({kOne, kHalf}), {1, 0.5f, 0, 1}},
    {35, memory_of<uint16_t>({1, 65535}), {1.0f / 65535.0f, 1, 0, 1}},
    {37, memory_of<uint16_t>({0x7fff, 0x8000}), {1, -1, 0, 1}},
    {41, memory_of<float>({1e9f}), {1e9f, 1e9f, 1e9f, 1}},
    {49, "\x33\xff", {0.2f, 1, 0, 1}},
    {51, "\x7f\x80", {1, -1, 0, 1}},
    {54, memory_of<uint16_t>({kMinusTwo}), {-2, -2, -2, 1}},
    {56, memory_of<uint16_t>({13107}), glm::vec4(0.2f, 0.2f, 0.2f, 1)},
    {58, memory_of<uint16_t>({0x7fff}), glm::vec4(1)},
    {61, "\x33", glm::vec4(0.2f, 0.2f, 0.2f, 1)},
    {63, "\x81", {-1, -1, -1, 1}},
    {67, memory_of<uint32_t>({256u | 128u << 9 | 511u << 18 | 16u << 27}), {1, 0.5f, 511.0f / 256.0f, 1}},
    {85, memory_of<uint16_t>({0xf81f}), {1, 0, 1, 1}},
    {86, memory_of<uint16_t>({0x7c1f}), {1, 0, 1, 0}},
    {87, "\x99\x66\x33\xcc", glm::vec4(0.2f, 0.4f, 0.6f, 0.8f)},
    {88, "\x99\x66\x33\xcc", glm::vec4(0.2f, 0.4f, 0.6f, 1)},
    {91, "\x99\x66\x33\xcc", glm::vec4(0.2f, 0.4f, 0.6f, 0.8f)},
    {93, "\x99\x66\x33\xcc", glm::vec4(0.2f, 0.4f, 0.6f, 1)},
    {115, memory_of<uint16_t>({0x31fc}), glm::vec4(1, 15, 12, 3) / 15.0f},
};

TEST_F(TextureFiles, Ktx2HasTheFormatsOfVulkan) {
  for (const FormatCase& c : kVulkanCases) EXPECT_EQ(numbers_of(ktx2({.format = c.format}, c.texel)).at(0, 0), c.value) << c.format;
}

TEST_F(TextureFiles, DdsHasTheFormatsOfDxgi) {
  for (const FormatCase& c : kDxgiCases) EXPECT_EQ(numbers_of(dxgi_dds(c.format, 1, 1, c.texel)).at(0, 0), c.value) << c.format;
}

// The formats that Direct3D 9 identifies by a number.
TEST_F(TextureFiles, DdsHasNumberedFormats) {
  const std::vector<FormatCase> cases = {
      {36, memory_of<uint16_t>({1, 2, 3, 4}), glm::vec4(1, 2, 3, 4) / 65535.0f},
      {110, memory_of<uint16_t>({0x7fff, 0, 0x8001, 0x8000}), {1, 0, -1, -1}},
      {111, memory_of<uint16_t>({kMinusTwo}), {-2, -2, -2, 1}},
      {112, memory_of<uint16_t>({kOne, kHalf}), {1, 0.5f, 0, 1}},
      {113, memory_of<uint16_t>({kOne, kHalf, kMinusTwo, kQuarter}), {1, 0.5f, -2, 0.25f}},
      {114, memory_of<float>({1e9f}), {1e9f, 1e9f, 1e9f, 1}},
      {115, memory_of<float>({1e9f, -3}), {1e9f, -3, 0, 1}},
      {116, memory_of<float>({1, 2, 3, 0.1f}), {1, 2, 3, 0.1f}},
  };
  for (const FormatCase& c : cases)
    EXPECT_EQ(numbers_of(dds({.width = 1, .height = 1, .code = memory_of<uint32_t>({c.format})}, c.texel)).at(0, 0), c.value) << c.format;
}

DdsHeader masked(uint32_t flags, uint32_t bits, const std::vector<uint32_t>& masks) {
  return {.width = 2, .height = 1, .flags = flags, .code = std::string(4, '\0'), .bits = bits, .masks = masks};
}

TEST_F(TextureFiles, DdsHasMaskedPixels) {
  constexpr uint32_t kRgb = 0x40, kRgba = 0x41, kGray = 0x20000, kGrayAlpha = 0x20001;
  const std::string bgr = text_of("\x01\x02\x03\x04\x05\x06", 6);
  EXPECT_EQ(codes_of(dds(masked(kRgb, 24, {0xff0000, 0xff00, 0xff, 0}), bgr)).at(1, 0), glm::u8vec4(6, 5, 4, 255));
  const std::string bgra = text_of("\x01\x02\x03\x04\x05\x06\x07\x08", 8);
  EXPECT_EQ(codes_of(dds(masked(kRgba, 32, {0xff0000, 0xff00, 0xff, 0xff000000}), bgra)).at(1, 0), glm::u8vec4(7, 6, 5, 8));
  EXPECT_EQ(codes_of(dds(masked(kRgb, 32, {0xff0000, 0xff00, 0xff, 0xff000000}), bgra)).at(1, 0), glm::u8vec4(7, 6, 5, 255));
  EXPECT_EQ(codes_of(dds(masked(kGray, 8, {0xff, 0, 0, 0}), "\x07\x09")).at(1, 0), glm::u8vec4(9, 9, 9, 255));
  EXPECT_EQ(codes_of(dds(masked(kGrayAlpha, 16, {0xff, 0, 0, 0xff00}), "\x01\x02\x03\x04")).at(1, 0), glm::u8vec4(3, 3, 3, 4));
  const std::string error = error_of(dds(masked(kRgb, 32, {0xff00ff, 0xff00, 0, 0}), bgra));
  EXPECT_TRUE(reports(error, "file: ", {"mask", "consecutive"}));
}

TEST_F(TextureFiles, PremultipliedColorsAreDivided) {
  const std::string texel = "\x20\x40\x80\x80";
  const glm::u8vec4 straight(64, 128, 255, 128);
  EXPECT_EQ(codes_of(ktx2({.flags = 1}, texel)).at(0, 0), straight);
  EXPECT_EQ(codes_of(dds({.width = 1, .height = 1, .extended = {28, 3, 0, 1, 2}}, texel)).at(0, 0), straight);
  const std::string half_alpha(8, '\x88'), red = memory_of<uint32_t>({0x80008000, 0});
  EXPECT_EQ(codes_of(dds({.code = "DXT2"}, half_alpha + red)).at(0, 0), glm::u8vec4(248, 0, 0, 136));
  EXPECT_EQ(codes_of(dds({.code = "DXT3"}, half_alpha + red)).at(0, 0), glm::u8vec4(132, 0, 0, 136));
}

TEST_F(TextureFiles, DdsHasCodesForBlocks) {
  const std::string one = memory_of<uint32_t>({0x8000f800, 0}), eight(8, '\0');
  EXPECT_EQ(codes_of(dds({.code = "DXT1"}, one)).at(3, 3), glm::u8vec4(255, 0, 0, 255));
  EXPECT_EQ(codes_of(dds({.code = "DXT4"}, eight + one)).at(3, 3), glm::u8vec4(255, 0, 0, 0));
  EXPECT_EQ(codes_of(dds({.code = "DXT5"}, eight + one)).at(3, 3), glm::u8vec4(255, 0, 0, 0));
  const std::string channel = text_of("\x66\0\0\0\0\0\0\0", 8);
  for (const char* code : {"ATI1", "BC4U"})
    EXPECT_EQ(codes_of(dds({.code = code}, channel)).at(3, 3), glm::u8vec4(102, 102, 102, 255)) << code;
  for (const char* code : {"ATI2", "BC5U"})
    EXPECT_EQ(codes_of(dds({.code = code}, channel + eight)).at(3, 3), glm::u8vec4(102, 0, 0, 255)) << code;
  const std::string one_signed = text_of("\x7f\0\0\0\0\0\0\0", 8);
  EXPECT_EQ(numbers_of(dds({.code = "BC4S"}, one_signed)).at(3, 3), glm::vec4(1));
  EXPECT_EQ(numbers_of(dds({.code = "BC5S"}, one_signed + eight)).at(3, 3), glm::vec4(1, 0, 0, 1));
}

TEST_F(TextureFiles, Ktx2StatesItsOrientation) {
  const auto first = [](const std::string& orientation) {
    return codes_of(ktx2({.format = 9, .width = 2, .height = 2, .orientation = orientation}, "\x01\x02\x03\x04")).at(0, 0).x;
  };
  EXPECT_EQ(first(""), 1);
  EXPECT_EQ(first("rd"), 1);
  EXPECT_EQ(first("ld"), 2);
  EXPECT_EQ(first("ru"), 3);
  EXPECT_EQ(first("lu"), 4);
  const std::string error = error_of(ktx2({.format = 9, .orientation = "xy"}, "\x01"));
  EXPECT_TRUE(reports(error, "file: ", {"orientation \"xy\"", "expected rd"}));
}

TEST_F(TextureFiles, Ktx2ChannelsAreNotExchanged) {
  EXPECT_EQ(error_of(ktx2({.swizzle = "rgb1"}, "\x01\x02\x03\x04")), "(no error)");
  const std::string error = error_of(ktx2({.orientation = "rd", .swizzle = "bgra"}, "\x01\x02\x03\x04"));
  EXPECT_TRUE(reports(error, "file: ", {"swizzle \"bgra\"", "expected none"}));
}

constexpr uint32_t kZstandard = 2, kZlib = 3;

TEST_F(TextureFiles, Ktx2IsUncompressed) {
  const std::string texels = "\x01\x02\x03\x04\x05\x06\x07\x08";
  for (const auto& [scheme, level] : {std::pair(kZstandard, stored_zstd(texels)), std::pair(kZlib, stored_zlib(texels))}) {
    const Ktx2Header header{.width = 2, .scheme = scheme, .content_bytes = texels.size()};
    EXPECT_EQ(codes_of(ktx2(header, level)).at(1, 0), glm::u8vec4(5, 6, 7, 8)) << scheme;
    std::string damaged = level;
    damaged[0] = '\0';
    EXPECT_TRUE(reports(error_of(ktx2(header, damaged)), "file: ", {"level 0", "damaged", "expected 8 bytes"})) << scheme;
    const Ktx2Header wider{.width = 3, .scheme = scheme, .content_bytes = 12};
    EXPECT_TRUE(reports(error_of(ktx2(wider, level)), "file: ", {"level 0", "damaged", "expected 12 bytes"})) << scheme;
    const Ktx2Header narrower{.width = 1, .scheme = scheme, .content_bytes = 4};
    EXPECT_TRUE(reports(error_of(ktx2(narrower, level)), "file: ", {"level 0", "damaged", "expected 4 bytes"})) << scheme;
  }
}

TEST_F(TextureFiles, UnsupportedTexturesAreNamed) {
  const std::string texel(64, '\0');
  EXPECT_TRUE(reports(error_of(ktx2({.faces = 6}, texel)), "file: ", {"cube map", "expected a two-dimensional"}));
  EXPECT_TRUE(reports(error_of(ktx2({.layers = 3}, texel)), "file: ", {"array of 3", "expected a two-dimensional"}));
  EXPECT_TRUE(reports(error_of(ktx2({.depth = 2}, texel)), "file: ", {"volume", "expected a two-dimensional"}));
  EXPECT_TRUE(reports(error_of(ktx2({.height = 0}, texel)), "file: ", {"one-dimensional", "expected two"}));
  EXPECT_TRUE(reports(error_of(ktx2({.width = 0}, texel)), "file: ", {"0x1 pixels", "expected"}));
  EXPECT_TRUE(reports(error_of(ktx2({.scheme = 4}, texel)), "file: ", {"scheme 4", "expected 0, 2"}));
  EXPECT_TRUE(reports(error_of(ktx2({.format = 0, .model = 166}, texel)), "file: ", {"Basis Universal (UASTC)", "expected BC1"}));
  EXPECT_TRUE(
      reports(error_of(ktx2({.format = 0, .scheme = 1, .model = 163}, texel)), "file: ", {"Basis Universal (ETC1S)", "expected BC1"}));
  EXPECT_TRUE(reports(error_of(ktx2({.format = 147}, texel)), "file: ", {"Vulkan format 147", "expected BC1"}));
  EXPECT_TRUE(reports(error_of(dds({.caps2 = 0xfe00}, texel)), "file: ", {"cube map", "expected a two-dimensional"}));
  EXPECT_TRUE(reports(error_of(dds({.depth = 4, .caps2 = 0x200000}, texel)), "file: ", {"volume", "expected a two-dimensional"}));
  EXPECT_TRUE(reports(error_of(dds({.extended = {28, 3, 4, 1, 0}}, texel)), "file: ", {"cube map", "expected a two-dimensional"}));
  EXPECT_TRUE(reports(error_of(dds({.extended = {28, 3, 0, 7, 0}}, texel)), "file: ", {"array of 7", "expected a two-dimensional"}));
  EXPECT_TRUE(reports(error_of(dds({.extended = {28, 4, 0, 1, 0}}, texel)), "file: ", {"volume", "expected a two-dimensional"}));
  EXPECT_TRUE(reports(error_of(dxgi_dds(30, 4, 4, texel)), "file: ", {"DXGI format 30", "expected BC1"}));
  EXPECT_TRUE(reports(error_of(dds({.code = "ETC2"}, texel)), "file: ", {"format ETC2", "expected BC1"}));
  EXPECT_TRUE(reports(error_of(dds(masked(0x20, 8, {0, 0, 0, 0}), texel)), "file: ", {"uncompressed pixels", "expected BC1"}));
}

TEST_F(TextureFiles, LinearValuesAreNotReadAsCodes) {
  const std::string file = ktx2({.format = 109}, memory_of<float>({1, 2, 3, 4}));
  EXPECT_TRUE(reports(input_error([&] { read_image(bytes_of(file), "file"); }), "file: ", {"linear values", "expected 8- or 16-bit"}));
}

// The size in a header must not make the reader allocate memory that the file cannot fill.
TEST_F(TextureFiles, HugeSizesAreRejected) {
  const std::string level(64, '\0');
  for (const auto& [width, height] : {std::pair(0xffffffffu, 0xffffffffu), std::pair(32768u, 32768u), std::pair(16384u, 16384u)}) {
    EXPECT_TRUE(reports(error_of(ktx2({.width = width, .height = height}, level)), "file: ", {"claims", "expected"}));
    EXPECT_TRUE(reports(error_of(dxgi_dds(98, width, height, level)), "file: ", {"claims", "expected"}));
  }
  EXPECT_TRUE(reports(error_of(dxgi_dds(98, 40000, 1, std::string(160000, '\0'))), "file: ", {"40000x1", "32768"}));
  EXPECT_TRUE(reports(error_of(dxgi_dds(28, 5, 4, level)), "file: ", {"level 0", "80 bytes", "byte 148", "212 bytes", "complete DDS"}));
  EXPECT_TRUE(reports(error_of(ktx2({.width = 17}, level)), "file: ", {"level 0", "68 bytes", "byte 132", "196 bytes", "complete KTX2"}));
}

// Small files of all kinds of texels and containers.
std::vector<std::string> small_files() {
  const std::string texel = "\x01\x02\x03\x04";
  return {ktx2({.orientation = "ru"}, texel),
          ktx2({.format = 145, .width = 4, .height = 4}, std::string(16, '\x5a')),
          ktx2({.scheme = kZstandard, .content_bytes = 4}, stored_zstd(texel)),
          ktx2({.scheme = kZlib, .content_bytes = 4}, stored_zlib(texel)),
          dxgi_dds(96, 4, 4, std::string(16, '\x5a')),
          dds({.code = "DXT1"}, "\x12\x34\x56\x78" + texel),
          dds(masked(0x41, 16, {0xf00, 0xf0, 0xf, 0xf000}), texel)};
}

TEST_F(TextureFiles, EveryTruncationIsReported) {
  for (const std::string& file : small_files()) {
    EXPECT_EQ(error_of(file), "(no error)");
    for (std::size_t size = 0; size < file.size(); ++size)
      ASSERT_TRUE(reports(error_of(file.substr(0, size)), "file: ", {"expected"})) << size << " of " << file.size() << " bytes";
  }
}

// Each byte (every fifth in short runs) with one bit changed: the file has a picture, or one line states what is wrong.
TEST_F(TextureFiles, EveryDamagedByteIsReportedOrReadable) {
  for (const std::string& file : small_files()) {
    for (std::size_t at = 0; at < file.size(); at += runs_long_tests() ? 1 : 5) {
      std::string damaged = file;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
      const std::string error = error_of(damaged);
      ASSERT_TRUE(error == "(no error)" || reports(error, "file: ", {"expected"})) << at << ": " << error;
      ASSERT_EQ(error.find("decoder"), std::string::npos) << "the decoder ended: " << error;
    }
  }
}

}  // namespace
}  // namespace halfspace::texture_file_test
