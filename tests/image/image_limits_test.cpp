// SPDX-License-Identifier: Apache-2.0
//
// Images whose headers claim more than the limits of the process allow. They are rejected before their pixels are decoded.
#include <gtest/gtest.h>

#include "halfspace/image/image_io.h"
#include "halfspace/image/image_limits.h"
#include "image/image_files.h"
#include "image/image_fixture.h"
#include "support/errors.h"

namespace halfspace {
namespace {

class ImageLimits : public FolderTest {
 protected:
  ~ImageLimits() override { set_resource_limits({}); }

  static void limit(uint64_t memory, uint64_t pixels) {
    ResourceLimits limits;
    limits.max_memory = memory;
    limits.max_pixels = pixels;
    set_resource_limits(limits);
  }
  std::string limit_error(const std::string& name) const {
    return message_of<LimitError>([&] { read_image(directory / name); });
  }
};

std::string png_of_size(uint32_t width, uint32_t height) {
  const std::string header = big_endian(width, 4) + big_endian(height, 4) + std::string{8, 6, 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", stored_zlib("")) + png_chunk("IEND", "");
}

// An OpenEXR file that consists of a header with one half channel.
std::string exr_header(int32_t width, int32_t height) {
  const auto text = [](std::string_view s) { return std::string(s) + '\0'; };
  const auto attribute = [&](std::string_view name, std::string_view type, const std::string& value) {
    return text(name) + text(type) + memory_of<int32_t>({static_cast<int32_t>(value.size())}) + value;
  };
  const std::string box = memory_of<int32_t>({0, 0, width - 1, height - 1});
  const std::string channel = text("Y") + memory_of<int32_t>({1, 0, 1, 1}) + std::string(1, '\0');
  return memory_of<int32_t>({20000630, 2}) + attribute("channels", "chlist", channel) +
         attribute("compression", "compression", std::string(1, '\3')) + attribute("dataWindow", "box2i", box) +
         attribute("displayWindow", "box2i", box) + attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         attribute("pixelAspectRatio", "float", memory_of<float>({1.0f})) +
         attribute("screenWindowCenter", "v2f", memory_of<float>({0.0f, 0.0f})) +
         attribute("screenWindowWidth", "float", memory_of<float>({1.0f})) + std::string(1, '\0');
}

TEST_F(ImageLimits, PngOfSixtyThousandPixelsPerSideIsRejected) {
  put("a.png", png_of_size(60000, 60000));
  EXPECT_TRUE(reports(limit_error("a.png"), (directory / "a.png").string(), {"claims 60000x60000", "2^28"}));
}

TEST_F(ImageLimits, PngPixelsAreLimited) {
  write_image(directory / "a.png", test_picture(true));
  limit(resource_limits().max_memory, 67 * 41 - 1);
  EXPECT_TRUE(reports(limit_error("a.png"), (directory / "a.png").string(), {"67x41", "at most 2746", "--max-pixels"}));
  limit(resource_limits().max_memory, 67 * 41);
  EXPECT_NO_THROW(read_image(directory / "a.png"));
}

// All pixels of the PNG are 0, so that the file is small. The limit is below what the decoded pixels need.
TEST_F(ImageLimits, MemoryOfPngIsLimited) {
  write_image(directory / "a.png", Image<glm::u8vec4>(8192, 8192));
  limit(resource_limits().max_memory - memory_left() + (uint64_t{200} << 20), kMaxImagePixels);
  EXPECT_TRUE(reports(limit_error("a.png"), (directory / "a.png").string(), {"832 MiB", "--max-memory"}));
}

class ToolImageLimits : public ImageLimits {
 protected:
  void SetUp() override {
    if (find_image_tool().empty()) GTEST_SKIP() << kNoImageTool;
  }
};

TEST_F(ToolImageLimits, ExrBombIsRejected) {
  put("a.exr", exr_header(2000000, 2000000));
  const std::string error = message_of<InputError>([&] { read_linear(directory / "a.exr"); });
  EXPECT_TRUE(reports(error, (directory / "a.exr").string(), {"expected"}));
  put("b.exr", exr_header(30000, 8000) + std::string(40000, '\0'));
  const std::string other = message_of<LimitError>([&] {
    limit(resource_limits().max_memory, 1000000);
    read_linear(directory / "b.exr");
  });
  EXPECT_TRUE(reports(other, (directory / "b.exr").string(), {"30000x8000", "at most 1000000", "--max-pixels"}));
}

TEST_F(ToolImageLimits, MemoryOfToolFormatsIsLimited) {
  write_image(directory / "a.tif", Image<glm::u8vec4>(4096, 4096));
  limit(resource_limits().max_memory - memory_left() + (uint64_t{20} << 20), kMaxImagePixels);
  EXPECT_TRUE(reports(limit_error("a.tif"), (directory / "a.tif").string(), {"4096x4096", "--max-memory"}));
}

}  // namespace
}  // namespace halfspace
