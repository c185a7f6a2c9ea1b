// SPDX-License-Identifier: Apache-2.0
//
// Images in memory, and formats that are recognized by their contents.
#include <gtest/gtest.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "halfspace/image/image_io.h"
#include "halfspace/image/image_tool.h"
#include "image/image_files.h"
#include "image/image_fixture.h"

namespace halfspace {
namespace {

namespace fs = std::filesystem;

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

// A TGA with 2x1 pixels and alpha, and a Radiance HDR file of the same size.
const std::string kTga("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x20\x28\x1e\x14\x0a\x4d\1\2\3\4", 26);
const std::string kHdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + std::string("\x80\x40\x20\x81\xff\x00\x01\x90", 8);

class ImageMemory : public ImageToolTest {
 protected:
  // Returns files of many formats.
  std::vector<fs::path> files() const {
    const Image<glm::u8vec4> codes = test_picture(true);
    for (const char* name : {"a.png", "a.jpg", "a.tif"}) write_image(directory / name, codes);
    write_image(directory / "a.exr", Image<glm::vec4>(7, 5));
    return {directory / "a.png",
            directory / "a.jpg",
            directory / "a.tif",
            directory / "a.exr",
            put("a.hdr", kHdr),
            put("a.tga", kTga),
            put("a.ppm", "P6 2 1 255\n\x01\x02\x03\xff\xfe\xfd"),
            put("a.pfm", pfm(1, 2, {1.0f, 2.0f, 3.0f, -4.0f, 5.5f, 6.0f}))};
  }
};

TEST_F(ImageMemory, GivesTheSamePixelsAsAPath) {
  for (const fs::path& path : files()) {
    const std::string bytes = read_bytes(path);
    EXPECT_TRUE(read_linear(bytes_of(bytes), "memory") == read_linear(path)) << path;
    EXPECT_TRUE(read_gray(bytes_of(bytes), "memory") == read_gray(path)) << path;
    EXPECT_EQ(holds_linear_numbers(bytes_of(bytes), "memory"), holds_linear_numbers(path)) << path;
    if (holds_linear_numbers(path)) continue;
    EXPECT_TRUE(read_image(bytes_of(bytes), "memory") == read_image(path)) << path;
  }
}

TEST_F(ImageMemory, ErrorsBeginWithTheName) {
  const std::string name = "car.glb: image 3";
  const std::string text = "This is not a picture.";
  EXPECT_TRUE(reports(input_error([&] { read_image(bytes_of(text), name); }), name + ": ", {"not a supported image", "PNG"}));
  EXPECT_EQ(input_error([&] { read_gray({}, name); }).substr(0, name.size() + 10), name + ": is empty");
  const std::string png = read_bytes(files()[0]).substr(0, 200), jpeg = "\xff\xd8\xff\xe0 nothing more", tiff = std::string("II*\0more", 8);
  EXPECT_TRUE(reports(input_error([&] { read_image(bytes_of(png), name); }), name + ": ", {"damaged PNG"}));
  EXPECT_TRUE(reports(input_error([&] { read_image(bytes_of(jpeg), name); }), name + ": ", {"cannot be read as jpeg"}));
  EXPECT_TRUE(reports(input_error([&] { read_linear(bytes_of(tiff), name); }), name + ": ", {"cannot be read as tiff"}));
  EXPECT_TRUE(reports(input_error([&] { read_image(bytes_of(kHdr), name); }), name + ": ", {"Radiance HDR", "linear values"}));
}

TEST_F(ImageMemory, ErrorsDoNotMentionInternalNames) {
  const std::string tiff = std::string("II*\0more", 8);
  const fs::path path = put("a.tif", tiff);
  for (const std::string& error : {input_error([&] { read_image(path); }), input_error([&] { read_image(bytes_of(tiff), "a"); })}) {
    EXPECT_EQ(error.find("/proc"), std::string::npos) << error;
  }
}

TEST_F(ImageMemory, ExtensionsDoNotMatter) {
  for (const fs::path& path : files()) {
    for (const char* other : {"b.png", "b.jpg", "b.exr", "b", "b.tga"}) {
      fs::copy_file(path, directory / other, fs::copy_options::overwrite_existing);
      EXPECT_TRUE(read_linear(directory / other) == read_linear(path)) << path << " as " << other;
    }
  }
}

TEST_F(ImageMemory, TgaIsRecognizedByItsHeader) {
  EXPECT_EQ(read_image(bytes_of(kTga), "memory").at(0, 0), glm::u8vec4(10, 20, 30, 77));
  std::string changed = kTga;
  changed[2] = 4;  // no such type of image
  EXPECT_TRUE(reports(input_error([&] { read_image(bytes_of(changed), "memory"); }), "memory: ", {"not a supported image"}));
  EXPECT_TRUE(reports(input_error([&] { read_image(bytes_of(changed), "a.tga"); }), "a.tga: ", {"cannot be read as targa"}));
}

}  // namespace
}  // namespace halfspace
