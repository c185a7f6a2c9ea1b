// SPDX-License-Identifier: Apache-2.0
//
// OpenEXR files with arbitrary channels.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "halfspace/core/half.h"
#include "halfspace/image/exr_header.h"
#include "halfspace/image/image_io.h"
#include "halfspace/image/image_tool.h"
#include "image/image_files.h"
#include "image/image_fixture.h"

namespace halfspace {
namespace {

class Exr : public ImageToolTest {
 protected:
  void SetUp() override {
    ImageToolTest::SetUp();
    const ExrChannel id = {"id", ExrSample::uint32, [](int, std::span<std::byte> row) { std::ranges::fill(row, std::byte{0}); }};
    try {
      write_exr(directory / "probe.exr", 1, 1, {&id, 1});
    } catch (const OutputError&) {
      GTEST_SKIP() << "this build has no OpenEXR";
    }
  }
};

// A channel whose rows are copied from samples, which must outlive it.
template <class T>
ExrChannel channel(const char* name, ExrSample sample, const std::vector<T>& samples) {
  return {name, sample, [&samples](int y, std::span<std::byte> row) {
            std::memcpy(row.data(), reinterpret_cast<const std::byte*>(samples.data()) + static_cast<std::size_t>(y) * row.size(),
                        row.size());
          }};
}

// Returns sample bits of all magnitudes: every finite half, and floats that no half can represent.
std::vector<uint16_t> finite_halves() {
  std::vector<uint16_t> halves;
  for (uint32_t h = 0; h < 0x10000; ++h) {
    if ((h & 0x7c00) != 0x7c00) halves.push_back(static_cast<uint16_t>(h));
  }
  return halves;
}

TEST_F(Exr, TextIsReadFromTheHeader) {
  const std::vector<float> zeros(6);
  const std::vector<ExrChannel> channels{channel("normal.X", ExrSample::float32, zeros), channel("depth.Z", ExrSample::float32, zeros)};
  write_exr(directory / "a.exr", 3, 2, channels, {.software = "test", .comment = "chlist", .fingerprint = "print"});
  EXPECT_EQ(exr_text(directory / "a.exr").comment, "chlist");
  const std::string whole = read_bytes(directory / "a.exr");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    std::ofstream(directory / "part.exr", std::ios::binary) << whole.substr(0, length);
    const std::string comment = exr_text(directory / "part.exr").comment;
    EXPECT_TRUE(comment.empty() || comment == "chlist") << length;
    EXPECT_FALSE(is_whole_exr(directory / "part.exr")) << length;
  }
  EXPECT_EQ(exr_text(directory / "missing.exr").comment, "");
  EXPECT_EQ(exr_text(directory).comment, "");
}

TEST_F(Exr, HalfsAreBitExact) {
  const std::vector<uint16_t> halves = finite_halves();
  const int width = 512, height = static_cast<int>(halves.size()) / width;
  const ExrChannel y = channel("Y", ExrSample::float16, halves);
  write_exr(directory / "a.exr", width, height, {&y, 1});
  const Image<float> again = read_gray(directory / "a.exr");
  ASSERT_EQ(again.height(), height);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    ASSERT_EQ(std::bit_cast<uint32_t>(again.data()[i]), std::bit_cast<uint32_t>(half_to_float(halves[i]))) << i;
  }
}

TEST_F(Exr, FloatsAreBitExact) {
  std::vector<float> floats;
  for (int i = 0; i < 300 * 7; ++i)
    floats.push_back(std::ldexp(1.0f + static_cast<float>(i) / 2100.0f, i % 250 - 130) * (i % 2 == 0 ? 1.0f : -1.0f));
  const ExrChannel z = channel("Z", ExrSample::float32, floats);
  write_exr(directory / "a.exr", 7, 300, {&z, 1});
  const Image<float> again = read_gray(directory / "a.exr");
  EXPECT_EQ(std::memcmp(again.data(), floats.data(), floats.size() * sizeof(float)), 0);
}

// OpenEXR does not compress the block of a single pixel, so the file ends with its samples, in the order of the names.
TEST_F(Exr, StoresChannelsOfAllTypesInOneFile) {
  const std::vector<uint32_t> id = {0xfffffffeu}, depth = {0x7f800000u};  // the second-largest id; infinity
  const std::vector<uint16_t> alpha = {0x3c01};
  const ExrChannel channels[] = {channel("object", ExrSample::uint32, id), channel("Z", ExrSample::float32, depth),
                                 channel("normal.X", ExrSample::float16, alpha)};
  write_exr(directory / "a.exr", 1, 1, channels);
  const std::string file = read_bytes(directory / "a.exr");
  EXPECT_TRUE(file.ends_with(memory_of(depth) + memory_of(alpha) + memory_of(id)));
  // An entry of the channel list is a zero-terminated name and a type: 0 is UINT, 1 HALF, 2 FLOAT.
  for (const std::string& entry : {std::string("Z\0\2\0", 4), std::string("normal.X\0\1\0", 11), std::string("object\0\0\0", 9)}) {
    EXPECT_NE(file.find(entry), std::string::npos) << entry;
  }
}

TEST_F(Exr, HasOnlyTheRequiredAttributes) {
  const std::vector<float> sample = {1.0f};
  const ExrChannel z = channel("Z", ExrSample::float32, sample);
  write_exr(directory / "a.exr", 1, 1, {&z, 1});
  const std::string file = read_bytes(directory / "a.exr");
  for (const char* present : {"channels", "compression", "dataWindow", "displayWindow", "lineOrder", "pixelAspectRatio"}) {
    EXPECT_NE(file.find(present), std::string::npos) << present;
  }
  for (const char* absent_name : {"capDate", "Date", "owner", "host", "oftware"})
    EXPECT_EQ(file.find(absent_name), std::string::npos) << absent_name;
}

// Encodes the same halves with OpenImageIO. Only the header and the positions of blocks may differ.
TEST_F(Exr, StoresTheSameBlocksAsOpenImageIo) {
  Image<glm::vec4> light(37, 150);
  for (int y = 0; y < light.height(); ++y) {
    for (int x = 0; x < light.width(); ++x)
      light.at(x, y) = glm::vec4(std::ldexp(1.0f + static_cast<float>(x) / 37.0f, y % 28 - 20), 0.5f, static_cast<float>(y), 0.5f);
  }
  write_image(directory / "a.exr", light);
  PictureHeader header;
  header.width = light.width();
  header.height = light.height();
  header.channels = 4;
  header.sample = Sample::float16;
  const auto fill_row = [&](int y, std::span<std::byte> row) {
    for (std::size_t i = 0; i < 4 * static_cast<std::size_t>(light.width()); ++i) {
      const glm::vec4 t = light.at(static_cast<int>(i / 4), y);
      const int c = static_cast<int>(i % 4);
      const uint16_t half = static_cast<uint16_t>(float_to_half(c == 3 ? t.w : t[c] * t.w));
      std::memcpy(row.data() + 2 * i, &half, 2);
    }
  };
  const std::vector<std::byte> expected = encode_by_tool("b.exr", "openexr", header, {}, fill_row);
  const std::string other(reinterpret_cast<const char*>(expected.data()), expected.size());
  const auto blocks = [&](const std::string& file) {
    const std::string last = "screenWindowWidth";  // the last attribute: its name, "float", a size of 4 bytes, a float and the final zero
    const std::size_t table = file.find(last) + last.size() + 1 + 6 + 4 + 4 + 1;
    return file.substr(table + 8 * ((150 + 15) / 16));
  };
  EXPECT_TRUE(blocks(read_bytes(directory / "a.exr")) == blocks(other));
}

}  // namespace
}  // namespace halfspace
