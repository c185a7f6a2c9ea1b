// SPDX-License-Identifier: Apache-2.0
//
// Unlit surfaces show their colors exactly, whatever the scene does with light. The camera looks along -z at the square [-8, 8]²; a unit is
// one pixel.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>

#include "cli/cli_run.h"
#include "halfspace/image/image_io.h"
#include "model/gltf_builder.h"

namespace halfspace {
namespace {

constexpr const char* kToneCurve = R"("hdr": true, "exposure": 0.62)";  // aces, as in the scenes that are generated for models

class Unlit : public Cli {
 protected:
  // A square of the given size at depth z with a material.
  static void add_square(GltfBuilder& file, double left, double right, double z, GltfJson material) {
    const auto x0 = static_cast<float>(left), x1 = static_cast<float>(right), d = static_cast<float>(z);
    const int positions = file.accessor<float>({x0, -8, d, x1, -8, d, x1, 8, d, x0, 8, d}, 3);
    const int uvs = file.accessor<float>({0, 1, 1, 1, 1, 0, 0, 0}, 2);
    file.mesh_node({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}},
                    {"indices", file.accessor<uint16_t>({0, 1, 2, 0, 2, 3}, 1)},
                    {"material", file.add("materials", std::move(material))}});
  }
  static GltfJson unlit(GltfJson color, const char* mode = "OPAQUE") {
    return {{"extensions", {{"KHR_materials_unlit", GltfJson::object()}}},
            {"alphaMode", mode},
            {"pbrMetallicRoughness", {{"baseColorFactor", std::move(color)}}}};
  }
  static GltfJson lit(GltfJson color, const char* mode = "OPAQUE") {
    GltfJson material = unlit(std::move(color), mode);
    material.erase("extensions");
    return material;
  }

  Image<glm::u8vec4> picture(const GltfBuilder& file, const std::string& post, const std::string& keys = "") const {
    std::ofstream(directory / "a.gltf") << file.text();
    std::ofstream(directory / "scene.json") << R"({"version": 1, "samples": 4, "ambient": 0.7, "cameras": {"c": {"type": "orthographic",
      "height": 16}}, "objects": {"model": {"shape": "file", "file": "a.gltf"}}, "post": {)"
                                            << post << "}" << keys << "}";
    const Outcome o = run({"render", "scene.json", "--size", "16x16", "-o", "a.png"});
    EXPECT_EQ(o.exit_code, 0) << o.err;
    return read_image(directory / "a.png");
  }

  // A texture in which every code occurs in every channel.
  Image<glm::u8vec4> all_codes(GltfBuilder& file) const {
    Image<glm::u8vec4> codes(16, 16);
    for (int i = 0; i < 256; ++i) codes.at(i % 16, i / 16) = glm::u8vec4(i, 255 - i, i * 7 % 256, 255);
    write_png(directory / "codes.png", codes);
    file.add("images", {{"uri", "codes.png"}});
    file.add("samplers", {{"magFilter", 9728}, {"minFilter", 9728}});
    file.add("textures", {{"source", 0}, {"sampler", 0}});
    GltfJson material = unlit({1, 1, 1, 1});
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    add_square(file, -8, 8, 0, material);
    return codes;
  }
};

// Returns the code of a mixture, in linear light, of two codes.
double mixed(double part, double a, double b) {
  const auto linear = [](double c) { return c <= 0.04045 * 255 ? c / 255 / 12.92 : std::pow((c / 255 + 0.055) / 1.055, 2.4); };
  const double x = part * linear(a) + (1 - part) * linear(b);
  return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

TEST_F(Unlit, AllCodesAreExact) {
  GltfBuilder file;
  const Image<glm::u8vec4> codes = all_codes(file);
  for (const std::string post : {kToneCurve, R"("hdr": true)", R"("hdr": true, "tone": "reinhard", "exposure": 1e-3)",
                                 R"("hdr": true, "tone": "exponential", "tone_on": "luminance", "exposure": 40)",
                                 R"("hdr": true, "auto_exposure": true, "format": "rgba32f")", R"("hdr": true, "exposure": 0)",
                                 R"("hdr": true, "dither": true)", R"("hdr": false)"})
    EXPECT_TRUE(picture(file, post) == codes) << post;
  EXPECT_TRUE(picture(file, kToneCurve, R"(, "background": {"type": "transparent"})") == codes) << "a transparent background";
  EXPECT_FALSE(picture(file, std::string(kToneCurve) + R"(, "tone_unlit": true)") == codes);
  // Light of a surface behind it has no effect, even if it is also blended.
  add_square(file, -8, 8, -1, lit({1, 0.5, 0.2, 1}));
  add_square(file, -8, 8, -0.5, lit({0.2, 0.5, 1, 0.5}, "BLEND"));
  EXPECT_TRUE(picture(file, kToneCurve) == codes);
}

TEST_F(Unlit, GeneratedScenesShowAllCodes) {
  GltfBuilder file;
  const Image<glm::u8vec4> codes = all_codes(file);
  std::ofstream(directory / "a.gltf") << file.text();
  const Outcome o = run({"render", "a.gltf", "--size", "360x360", "--yaw", "0", "--pitch", "0", "-o", "a.png"});
  ASSERT_EQ(o.exit_code, 0) << o.err;
  const Image<glm::u8vec4> image = read_image(directory / "a.png");
  for (const glm::u8vec4& code : codes.texels())
    EXPECT_TRUE(std::ranges::find(image.texels(), code) != image.texels().end()) << int{code.x} << ' ' << int{code.y};
}

// Column 8 of the picture is half covered by the square in front.
TEST_F(Unlit, EdgesAreMixedInLinearLight) {
  const auto column = [&](GltfJson front, GltfJson behind) {
    GltfBuilder file;
    if (!front.is_null()) add_square(file, -8, 0.5, 0, std::move(front));
    add_square(file, -8, 8, -1, std::move(behind));
    const Image<glm::u8vec4> image = picture(file, kToneCurve);
    return std::array<int, 3>{image.at(4, 8).x, image.at(8, 8).x, image.at(12, 8).x};
  };
  const GltfJson black = unlit({0, 0, 0, 1}), white = unlit({1, 1, 1, 1}), wall = lit({0.8, 0.8, 0.8, 1});
  EXPECT_EQ(column(white, black), (std::array<int, 3>{255, 188, 0}));
  EXPECT_EQ(column(black, white), (std::array<int, 3>{0, 188, 255}));
  EXPECT_EQ(column(unlit({1, 1, 1, 0.5}, "BLEND"), black)[0], 188);
  const int toned = column(nullptr, wall)[2];
  for (const auto& [front, code] : {std::pair(white, 255), std::pair(black, 0)}) {
    const std::array<int, 3> codes = column(front, wall);
    EXPECT_EQ(codes[0], code);
    EXPECT_EQ(codes[2], toned);
    EXPECT_NEAR(codes[1], mixed(0.5, code, toned), 1.0);  // light is stored as half floats, and codes are rounded
  }
  // A lit surface that is half transparent lets half of the unlit color through and adds its own light.
  const int glass = column(lit({0, 0, 0, 0.5}, "BLEND"), white)[0];
  EXPECT_GE(glass, 187);
  EXPECT_LT(glass, 255);
}

TEST_F(Unlit, LinearFilesContainTheColor) {
  GltfBuilder file;
  add_square(file, -8, 8, 0, unlit({0.25, 0.5, 1, 1}));
  picture(file, kToneCurve);
  ASSERT_EQ(run({"render", "scene.json", "--size", "16x16", "-o", "a.exr"}).exit_code, 0);
  EXPECT_EQ(read_linear(directory / "a.exr").at(8, 8), glm::vec4(0.25f, 0.5f, 1.0f, 1.0f));
}

TEST_F(Unlit, ShadingNoneIsUnlit) {
  std::ofstream(directory / "scene.json") << R"({"version": 1, "cameras": {"c": {"type": "orthographic", "height": 16}},
    "objects": {"a": {"shape": "plane", "size": 40, "rotation": [90, 0, 0], "shading": "none", "color": "#c86428"}},
    "post": {"hdr": true}})";
  ASSERT_EQ(run({"render", "scene.json", "--size", "16x16", "-o", "a.png"}).exit_code, 0);
  EXPECT_EQ(read_image(directory / "a.png").at(8, 8), glm::u8vec4(0xc8, 0x64, 0x28, 255));
}

}  // namespace
}  // namespace halfspace
