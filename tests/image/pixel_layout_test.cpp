// SPDX-License-Identifier: Apache-2.0
//
// How formats store pixels: premultiplied and straight alpha, the order of rows and columns, and windows that differ from the picture. Each
// test builds the files that a format's text describes and compares the result with the picture that they mean.
#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "halfspace/image/image_io.h"
#include "image/image_files.h"
#include "image/image_fixture.h"

namespace halfspace {
namespace {

using Pixels = std::vector<glm::u8vec4>;

class PixelLayout : public ImageToolTest {
 protected:
  Pixels codes(const std::string& name, const std::string& file) const {
    const Image<glm::u8vec4> image = read_image(put(name, file));
    return {image.texels().begin(), image.texels().end()};
  }
};

std::string little_endian(uint32_t number, int bytes) {
  std::string text = big_endian(number, bytes);
  std::ranges::reverse(text);
  return text;
}

// ---- alpha ------------------------------------------------------------------------------------------------------

// Values of TIFF's ExtraSamples tag.
enum class TiffAlpha : uint16_t { unspecified = 0, associated = 1, unassociated = 2 };

// Builds a TIFF with one row of RGBA samples.
template <class T>
std::string rgba_tiff_row(const std::vector<T>& samples, TiffAlpha alpha) {
  TiffLayout layout{.width = static_cast<uint32_t>(samples.size() / 4), .channels = 4, .photometric = 2};
  if constexpr (std::is_floating_point_v<T>) layout.format = TiffSampleFormat::floating_point;
  layout.more = {{338, static_cast<uint32_t>(alpha)}};
  return tiff(layout, samples);
}

TEST_F(PixelLayout, AssociatedAlphaOfTiffIsDividedOut) {
  const std::vector<uint8_t> stored = {50, 25, 10, 64, 255, 0, 0, 255, 10, 20, 30, 0, 1, 0, 1, 1};
  EXPECT_EQ(codes("a.tif", rgba_tiff_row(stored, TiffAlpha::associated)),
            (Pixels{{199, 100, 40, 64}, {255, 0, 0, 255}, {10, 20, 30, 0}, {255, 0, 255, 1}}));
  EXPECT_EQ(codes("b.tif", rgba_tiff_row(stored, TiffAlpha::unassociated)),
            (Pixels{{50, 25, 10, 64}, {255, 0, 0, 255}, {10, 20, 30, 0}, {1, 0, 1, 1}}));
  EXPECT_EQ(codes("c.tif", rgba_tiff_row(stored, TiffAlpha::unspecified)),
            (Pixels{{50, 25, 10, 255}, {255, 0, 0, 255}, {10, 20, 30, 255}, {1, 0, 1, 255}}))
      << "the fourth channel is not alpha";
  EXPECT_EQ(read_gray(put("a.tif", rgba_tiff_row(stored, TiffAlpha::associated))).at(0, 0), 199.0f / 255.0f);
}

TEST_F(PixelLayout, AssociatedAlphaOfWideTiffIsDividedOut) {
  const std::vector<uint16_t> wide = {12850, 6425, 2570, 16448};
  EXPECT_EQ(codes("16.tif", rgba_tiff_row(wide, TiffAlpha::associated)), (Pixels{{199, 100, 40, 64}}));
  const std::vector<float> numbers = {0.25f, 3.0f, -0.5f, 0.5f, 7.0f, 0.0f, 0.0f, 0.0f};
  const Image<glm::vec4> light = read_linear(put("f.tif", rgba_tiff_row(numbers, TiffAlpha::associated)));
  EXPECT_EQ(light.at(0, 0), glm::vec4(0.5f, 6.0f, -1.0f, 0.5f));
  EXPECT_EQ(light.at(1, 0), glm::vec4(7.0f, 0.0f, 0.0f, 0.0f)) << "light without opacity";
}

TEST_F(PixelLayout, ColorsOfWebpAreStraight) {
  // A lossless file with the pixels (200, 100, 40, alpha 64) and (10, 20, 30, alpha 0).
  const std::string file("RIFF\x22\0\0\0WEBPVP8L\x15\0\0\0\x2f\x01\0\0\x10\x0f\x70\x0a\xa8\x2b\xf8\x5e\xc1\x63\x80\x82\x16\x19\xd1\xff\0\0",
                         42);
  EXPECT_EQ(codes("a.webp", file), (Pixels{{200, 100, 40, 64}, {10, 20, 30, 0}}));
  EXPECT_EQ(read_gray(put("a.webp", file)).at(0, 0), 200.0f / 255.0f);
  EXPECT_EQ(input_error([&] { read_image(put("b.webp", file.substr(0, 30))); }).find((directory / "b.webp").string() + ": "), 0u);
}

// Builds a GIF of 3x1 pixels: red, green, and a color that is transparent.
std::string gif() {
  const std::string screen = little_endian(3, 2) + little_endian(1, 2) + std::string{'\x81', 0, 0};
  const std::string colors("\xff\0\0\0\xff\0\1\2\3\0\0\0", 12);
  const std::string transparent("\x21\xf9\x04\x01\0\0\x02\0", 8);
  const std::string image = ',' + std::string(4, '\0') + little_endian(3, 2) + little_endian(1, 2) + '\0';
  const std::string codes("\x02\x02\x44\x54\0", 5);  // LZW, 3 bits each: clear, 0, 1, 2, end
  return "GIF89a" + screen + colors + transparent + image + codes + ";";
}

TEST_F(PixelLayout, GifIsOpaqueExceptForItsTransparentColor) {
  EXPECT_EQ(codes("a.gif", gif()), (Pixels{{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 0, 0}}));
}

// Builds a TGA of 2x1 pixels with 32 bits. attributes: the type of alpha in the extension area; negative: no such area.
std::string targa(const Pixels& pixels, int attributes = -1, int descriptor = 0x28) {
  std::string file = std::string{0, 0, 2} + std::string(9, '\0') + little_endian(2, 2) +
                     little_endian(static_cast<uint32_t>(pixels.size() / 2), 2) + std::string{32, static_cast<char>(descriptor)};
  for (const glm::u8vec4& p : pixels)
    file += {static_cast<char>(p.z), static_cast<char>(p.y), static_cast<char>(p.x), static_cast<char>(p.w)};
  if (attributes < 0) return file;
  const auto extension = static_cast<uint32_t>(file.size());
  file += little_endian(495, 2) + std::string(492, '\0') + static_cast<char>(attributes);
  return file + little_endian(extension, 4) + little_endian(0, 4) + "TRUEVISION-XFILE." + '\0';
}

TEST_F(PixelLayout, TargaStatesTheMeaningOfAlpha) {
  const Pixels stored = {{50, 25, 10, 64}, {255, 0, 0, 255}}, opaque = {{50, 25, 10, 255}, {255, 0, 0, 255}};
  EXPECT_EQ(codes("a.tga", targa(stored)), stored);
  EXPECT_EQ(codes("1.tga", targa(stored, 1)), opaque) << "undefined";
  EXPECT_EQ(codes("2.tga", targa(stored, 2)), opaque) << "undefined, but to be kept";
  EXPECT_EQ(codes("3.tga", targa(stored, 3)), stored);
  EXPECT_EQ(codes("4.tga", targa(stored, 4)), (Pixels{{199, 100, 40, 64}, {255, 0, 0, 255}})) << "premultiplied";
  EXPECT_EQ(codes("0.tga", targa({{9, 8, 7, 0}, {6, 5, 4, 0}})), (Pixels{{9, 8, 7, 255}, {6, 5, 4, 255}})) << "no pixel has alpha";
}

TEST_F(PixelLayout, TargaStartsAtTheCornerThatItStates) {
  const Pixels stored = {{1, 0, 0, 255}, {2, 0, 0, 255}, {3, 0, 0, 255}, {4, 0, 0, 255}};
  const auto order = [&](int descriptor) {
    std::array<int, 4> reds{};
    const Pixels pixels = codes("a.tga", targa(stored, -1, descriptor));
    std::ranges::transform(pixels, reds.begin(), [](const glm::u8vec4& p) { return int{p.x}; });
    return reds;
  };
  EXPECT_EQ(order(0x28), (std::array{1, 2, 3, 4})) << "top left";
  EXPECT_EQ(order(0x38), (std::array{2, 1, 4, 3})) << "top right";
  EXPECT_EQ(order(0x08), (std::array{3, 4, 1, 2})) << "bottom left";
  EXPECT_EQ(order(0x18), (std::array{4, 3, 2, 1})) << "bottom right";
}

// Builds a BMP of 2x2 pixels with 32 bits. A negative height stores the top row first.
std::string bmp(int height, const std::string& bgra) {
  const std::string header = little_endian(40, 4) + little_endian(2, 4) + little_endian(static_cast<uint32_t>(height), 4) +
                             little_endian(1, 2) + little_endian(32, 2) + std::string(24, '\0');
  return "BM" + little_endian(54 + 16, 4) + std::string(4, '\0') + little_endian(54, 4) + header + bgra;
}

TEST_F(PixelLayout, BmpOrdersRowsAndMayLackAlpha) {
  const std::string bgra("\x03\x02\x01\0\x06\x05\x04\0\x09\x08\x07\0\x0c\x0b\x0a\0", 16);
  const Pixels top_first = {{1, 2, 3, 255}, {4, 5, 6, 255}, {7, 8, 9, 255}, {10, 11, 12, 255}};
  EXPECT_EQ(codes("a.bmp", bmp(-2, bgra)), top_first) << "the fourth byte is unused";
  EXPECT_EQ(codes("b.bmp", bmp(2, bgra)), (Pixels{{7, 8, 9, 255}, {10, 11, 12, 255}, {1, 2, 3, 255}, {4, 5, 6, 255}}));
}

// ---- orientation --------------------------------------------------------------------------------------------------

// A picture of 3x2 pixels with the values 10 to 60.
constexpr int kWidth = 3, kHeight = 2;
constexpr int value_at(int x, int y) { return 10 * (y * kWidth + x + 1); }

// The values in the order in which a file stores them if its first row is the given edge of the picture, and each row starts at the other.
struct Order {
  bool columns, from_right, from_bottom;

  std::vector<uint8_t> stored() const {
    std::vector<uint8_t> values;
    const int rows = columns ? kWidth : kHeight, row_length = columns ? kHeight : kWidth;
    for (int row = 0; row < rows; ++row) {
      for (int i = 0; i < row_length; ++i) {
        const int x = columns ? row : i, y = columns ? i : row;
        values.push_back(static_cast<uint8_t>(value_at(from_right ? kWidth - 1 - x : x, from_bottom ? kHeight - 1 - y : y)));
      }
    }
    return values;
  }
};

Pixels upright_pixels() {
  Pixels pixels;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const auto value = static_cast<uint8_t>(value_at(i % kWidth, i / kWidth));
    pixels.emplace_back(value, value, value, 255);
  }
  return pixels;
}

TEST_F(PixelLayout, RadianceFilesAreUprightInAllEightOrders) {
  const struct {
    const char* resolution;
    Order order;
  } cases[] = {{"-Y 2 +X 3", {false, false, false}}, {"-Y 2 -X 3", {false, true, false}}, {"+Y 2 -X 3", {false, true, true}},
               {"+Y 2 +X 3", {false, false, true}},  {"+X 3 -Y 2", {true, false, false}}, {"-X 3 -Y 2", {true, true, false}},
               {"-X 3 +Y 2", {true, true, true}},    {"+X 3 +Y 2", {true, false, true}}};
  for (const auto& c : cases) {
    std::string file = std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n") + c.resolution + "\n";
    for (const uint8_t value : c.order.stored()) file += std::string(3, static_cast<char>(value)) + '\x88';  // exponent 8: value · 2^0
    const Image<glm::vec4> image = read_linear(put("a.hdr", file));
    ASSERT_EQ(image.width(), kWidth) << c.resolution;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x)
        EXPECT_EQ(image.at(x, y), glm::vec4(glm::vec3(static_cast<float>(value_at(x, y))), 1.0f))
            << c.resolution << " at " << x << ' ' << y;
    }
    EXPECT_EQ(read_gray(directory / "a.hdr").at(2, 1), 60.0f) << c.resolution;
  }
}

TEST_F(PixelLayout, TiffIsUprightInAllEightOrientations) {
  const Order orders[] = {{false, false, false}, {false, true, false}, {false, true, true}, {false, false, true},
                          {true, false, false},  {true, true, false},  {true, true, true},  {true, false, true}};
  for (uint32_t i = 0; i < 8; ++i) {
    TiffLayout layout{.width = orders[i].columns ? uint32_t{kHeight} : uint32_t{kWidth}};
    layout.more = {{274, i + 1}};
    EXPECT_EQ(codes("a.tif", tiff(layout, orders[i].stored())), upright_pixels()) << "orientation " << i + 1;
  }
}

// ---- OpenEXR windows ----------------------------------------------------------------------------------------------

struct Box {
  int x0, y0, x1, y1;
};

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
  return name + '\0' + type + '\0' + little_endian(static_cast<uint32_t>(value.size()), 4) + value;
}

// Builds an RGB OpenEXR file without compression. All channels have the value of the pixel's number, counted from 1 in the data window.
std::string exr(const Box& data, const Box& display, bool bottom_first) {
  const auto box = [](const Box& b) { return memory_of<int>({b.x0, b.y0, b.x1, b.y1}); };
  const std::string channel = memory_of<int>({2, 0, 1, 1});  // float, not subsampled
  std::string file = "\x76\x2f\x31\x01" + little_endian(2, 4);
  file += attribute("channels", "chlist",
                    std::string("B\0", 2) + channel + std::string("G\0", 2) + channel + std::string("R\0", 2) + channel + '\0');
  file += attribute("compression", "compression", std::string(1, '\0')) + attribute("dataWindow", "box2i", box(data));
  file += attribute("displayWindow", "box2i", box(display)) + attribute("lineOrder", "lineOrder", std::string(1, bottom_first ? 1 : 0));
  file += attribute("pixelAspectRatio", "float", memory_of<float>({1.0f})) +
          attribute("screenWindowCenter", "v2f", memory_of<float>({0.0f, 0.0f}));
  file += attribute("screenWindowWidth", "float", memory_of<float>({1.0f})) + '\0';
  const int width = data.x1 - data.x0 + 1, height = data.y1 - data.y0 + 1;
  const std::size_t first = file.size() + 8 * static_cast<std::size_t>(height);
  const std::size_t line_bytes = 8 + 12 * static_cast<std::size_t>(width);
  std::string lines;
  for (int i = 0; i < height; ++i) {
    const int y = bottom_first ? height - 1 - i : i;
    lines += memory_of<int>({data.y0 + y, 12 * width});
    for (int c = 0; c < 3; ++c) {
      for (int x = 0; x < width; ++x) lines += memory_of<float>({static_cast<float>(y * width + x + 1)});
    }
    const int place = bottom_first ? height - 1 - i : i;  // of line i of the picture
    file += little_endian(static_cast<uint32_t>(first + static_cast<std::size_t>(place) * line_bytes), 4) + std::string(4, '\0');
  }
  return file + lines;
}

std::vector<float> reds(const Image<glm::vec4>& image) {
  std::vector<float> values;
  for (const glm::vec4& t : image.texels()) values.push_back(t.x);
  return values;
}

TEST_F(PixelLayout, ExrShowsItsDisplayWindow) {
  const Box picture{0, 0, 3, 2};
  for (const bool bottom_first : {false, true}) {
    EXPECT_EQ(reds(read_linear(put("same.exr", exr({0, 0, 1, 1}, {0, 0, 1, 1}, bottom_first)))), (std::vector<float>{1, 2, 3, 4}));
    EXPECT_EQ(reds(read_linear(put("part.exr", exr({1, 1, 2, 2}, picture, bottom_first)))),
              (std::vector<float>{0, 0, 0, 0, 0, 1, 2, 0, 0, 3, 4, 0}));
    EXPECT_EQ(reds(read_linear(put("beyond.exr", exr({-1, -1, 1, 0}, {0, 0, 1, 1}, bottom_first)))), (std::vector<float>{5, 6, 0, 0}));
    EXPECT_EQ(reds(read_linear(put("moved.exr", exr({5, 6, 6, 7}, {5, 6, 6, 7}, bottom_first)))), (std::vector<float>{1, 2, 3, 4}));
    EXPECT_EQ(reds(read_linear(put("apart.exr", exr({9, 9, 9, 9}, {0, 0, 1, 0}, bottom_first)))), (std::vector<float>{0, 0}));
  }
  EXPECT_EQ(read_gray(put("gray.exr", exr({1, 1, 2, 2}, picture, false))).at(2, 2), 4.0f);
}

// ---- other layouts ------------------------------------------------------------------------------------------------

TEST_F(PixelLayout, PnmValuesAreFractionsOfTheirMaximum) {
  const auto first = [&](const std::string& file) { return read_gray(put("a.pnm", file)).at(0, 0); };
  EXPECT_EQ(first("P2\n1 1\n15\n5\n"), 85.0f / 255.0f);
  EXPECT_EQ(first("P5\n1 1\n51\n\x11"), 85.0f / 255.0f);
  EXPECT_EQ(first("P2\n1 1\n257\n1\n"), 255.0f / 65535.0f);
  EXPECT_EQ(first("P1\n1 1\n0\n"), 1.0f) << "0 is white in bitmaps";
}

}  // namespace
}  // namespace halfspace
