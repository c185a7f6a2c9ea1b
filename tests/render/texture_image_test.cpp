// SPDX-License-Identifier: Apache-2.0
//
// Textures keep the values of their images: formats, normal maps, memory limits, and image files of models and scenes.
#include "halfspace/render/assets/texture_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "halfspace/core/resource_limits.h"
#include "halfspace/core/srgb.h"
#include "halfspace/image/png.h"
#include "halfspace/render/export/embed_images.h"
#include "halfspace/render/export/scene_model.h"
#include "halfspace/render/prepared_scene.h"
#include "halfspace/render/scene_assets.h"
#include "halfspace/scene/scene_file.h"
#include "image/image_fixture.h"
#include "image/texture_files.h"
#include "model/gltf_builder.h"
#include "render/naive_picture.h"
#include "support/errors.h"
#include "support/folder_test.h"

namespace halfspace::texture_image_test {
namespace {

using TextureFiles = FolderTest;
using ToolTextureFiles = ImageToolTest;

template <class Texel>
Image<Texel> one(const Texel& texel) {
  Image<Texel> image(1, 1);
  image.at(0, 0) = texel;
  return image;
}

double decoded(double code) { return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4); }

Texture2D texture_with(const glm::vec4& texel, TextureRole role = TextureRole::data) { return texture_of(one(texel), role, "numbers"); }

// ---- formats ----------------------------------------------------------------------------------------------------

TEST(TextureImages, Of8BitsHave8BitFormats) {
  const glm::u8vec4 texel(1, 100, 200, 50);
  const Texture2D colors = texture_of(one(texel), TextureRole::colors, "codes"), data = texture_of(one(texel), TextureRole::data, "codes");
  EXPECT_EQ(colors.format(), TexelFormat::srgb8a8);
  EXPECT_EQ(data.format(), TexelFormat::rgba8);
  EXPECT_EQ(texture_of(one(texel), TextureRole::normals, "codes").format(), TexelFormat::rgba8);
  EXPECT_EQ(colors.texel(0, 0, 0), texel);
  EXPECT_EQ(data.texel(0, 0, 0), texel);
}

TEST(TextureImages, OfNumbersHaveTheSmallestFormatThatKeepsThem) {
  const glm::vec4 halfs(0.5f, -1024.0f, 65504.0f, 0x1p-24f), floats(0.1f, 1e6f, -1e-9f, 1.0f);
  EXPECT_EQ(texture_with(halfs).format(), TexelFormat::rgba16f);
  EXPECT_EQ(texture_with(halfs).value(0, 0, 0), halfs);
  EXPECT_EQ(texture_with(floats).format(), TexelFormat::rgba32f);
  EXPECT_EQ(texture_with(floats).value(0, 0, 0), floats);
}

TEST(TextureImages, AreReturnedAsImages) {
  const Image<glm::u8vec4> codes = test_picture(false);
  EXPECT_EQ(std::get<Image<glm::u8vec4>>(image_of(texture_of(codes, TextureRole::colors, "codes"))), codes);
  const glm::vec4 number(0.1f, 2, 3, 4);
  EXPECT_EQ(std::get<Image<glm::vec4>>(image_of(texture_with(number))), one(number));
}

TEST(TextureImages, OfNumbersCountTowardsTheMemoryLimit) {
  ResourceLimits limits;
  limits.max_memory = 1000;
  set_resource_limits(limits);
  const Image<glm::vec4> numbers(16, 16);
  const std::string message = message_of<LimitError>([&] { texture_of(numbers, TextureRole::data, "a.exr"); });
  set_resource_limits({});
  EXPECT_TRUE(reports(message, "a.exr", {"of memory", "expected at most"})) << message;
}

// ---- normal maps ------------------------------------------------------------------------------------------------

template <class Texel>
Texel normal_of(const Texel& texel) {
  TextureImage image = one(texel);
  complete_normals(image);
  return std::get<Image<Texel>>(image).at(0, 0);
}

TEST(NormalMaps, ThatAreCompleteAreUnchanged) {
  EXPECT_EQ(normal_of(glm::u8vec4(10, 20, 1, 40)), glm::u8vec4(10, 20, 1, 40));
  EXPECT_EQ(normal_of(glm::vec4(0.25f, 0.5f, 0.75f, 0.1f)), glm::vec4(0.25f, 0.5f, 0.75f, 0.1f));
}

TEST(NormalMaps, WithoutZGetIt) {
  // x = 0.6 and y = 0 give z = 0.8, which is stored as 0.9.
  EXPECT_NEAR(normal_of(glm::vec4(0.8f, 0.5f, 0, 1)).z, 0.9f, 1e-6f);
  EXPECT_EQ(normal_of(glm::u8vec4(204, 128, 0, 255)), glm::u8vec4(204, 128, 229, 255));
  EXPECT_EQ(normal_of(glm::vec4(1, 1, 0, 1)).z, 0.5f) << "x and y are too long";
}

TEST(NormalMaps, WithNegativeValuesStoreTheNormalItself) {
  const glm::vec4 normal = normal_of(glm::vec4(-0.6f, 0, 0.8f, 0.3f));
  EXPECT_NEAR(glm::distance(normal, glm::vec4(0.2f, 0.5f, 0.9f, 0.3f)), 0, 1e-6);
  const glm::vec4 without_z = normal_of(glm::vec4(-0.6f, 0, 0, 1));
  EXPECT_NEAR(glm::distance(without_z, glm::vec4(0.2f, 0.5f, 0.9f, 1)), 0, 1e-6);
  EXPECT_EQ(normal_of(glm::vec4(0, 0, 0, 1)), glm::vec4(0.5f, 0.5f, 1, 1)) << "a flat map without z";
}

TEST(NormalMaps, OfUnitVectorsAreRecognizedWithoutNegativeValues) {
  EXPECT_EQ(normal_of(glm::vec4(0, 0, 1, 1)), glm::vec4(0.5f, 0.5f, 1, 1)) << "flat";
  const glm::vec4 tilted = normal_of(glm::vec4(0.6f, 0, 0.8f, 1));
  EXPECT_NEAR(glm::distance(tilted, glm::vec4(0.8f, 0.5f, 0.9f, 1)), 0, 1e-6);  // one rounding of each number
  EXPECT_EQ(normal_of(glm::vec4(0.5f, 0.5f, 1, 1)), glm::vec4(0.5f, 0.5f, 1, 1)) << "flat, mapped to 0 to 1";
  EXPECT_EQ(normal_of(glm::vec4(0.5f, 0.5f, 0.75f, 1)), glm::vec4(0.5f, 0.5f, 0.75f, 1)) << "the same, with half the length";
}

// Filters that sharpen can make single values negative.
TEST(NormalMaps, MappedToZeroToOneStaySoWithANegativeValue) {
  Image<glm::vec4> image(4, 4);
  std::fill_n(image.data(), 16, glm::vec4(0.8f, 0.5f, 0.9f, 1));
  image.at(1, 2) = glm::vec4(0.8f, -0.001f, 0.9f, 1);
  TextureImage map = image;
  complete_normals(map);
  EXPECT_EQ(std::get<Image<glm::vec4>>(map), image);
}

TEST(TextureImages, DataAreLimitedToZeroToOne) {
  const Image<glm::vec4> numbers = one(glm::vec4(-2, 0.5f, 7, 1));
  EXPECT_EQ(std::get<Image<glm::vec4>>(texels_of(ColorPicture(numbers), TextureRole::data, "a")).at(0, 0), glm::vec4(0, 0.5f, 1, 1));
  EXPECT_EQ(std::get<Image<glm::vec4>>(texels_of(ColorPicture(numbers), TextureRole::colors, "a")).at(0, 0), numbers.at(0, 0));
}

// ---- models -----------------------------------------------------------------------------------------------------

// A square whose material has one texture. Its image is stored in the file.
GltfBuilder square(const std::string& image, GltfJson material) {
  GltfBuilder file;
  file.add("images", {{"bufferView", file.view(std::vector<char>(image.begin(), image.end()))}, {"mimeType", "image/png"}});
  file.add("textures", {{"source", 0}});
  file.add("materials", std::move(material));
  GltfJson attributes = {{"POSITION", file.accessor<float>({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, 3)},
                         {"NORMAL", file.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3)},
                         {"TEXCOORD_0", file.accessor<float>({0, 1, 1, 1, 1, 0, 0, 0}, 2)}};
  file.mesh_node({{"attributes", std::move(attributes)}, {"indices", file.accessor<uint16_t>({0, 1, 2, 0, 2, 3}, 1)}, {"material", 0}});
  file.add("scenes", {{"nodes", {0}}});
  return file;
}

GltfJson colored_by(int texture) {
  return {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}},
          {"extensions", {{"KHR_materials_unlit", GltfJson::object()}}}};
}

std::string read_square(const std::filesystem::path& file) {
  return R"({"version": 1, "cameras": {"c": {"type": "orthographic", "position": [0, 0, 5], "height": 2, "far": 9}}, "objects": {"a":
      {"shape": "file", "file": ")" +
         file.string() + R"("}}})";
}

SceneDescription description_of(const std::string& text) { return SceneFile::parse(text, "test.json", "/").description(); }

// Returns a map of the first draw of a scene, or calls check with it.
template <class F>
void with_map(const std::string& scene, MetallicMap map, const F& check) {
  const Workers workers(1);
  SceneAssets assets(workers);
  const PreparedScene prepared = assets.prepare(description_of(scene), 8, 8);
  int draws = 0;
  for (const PreparedDraw& draw : prepared.draws) {
    std::visit(
        [&]<class S>(const S& shader) {
          if constexpr (std::is_base_of_v<MetallicMaterial, S>) {
            ++draws;
            ASSERT_NE(shader.maps[map].map, nullptr);
            check(*shader.maps[map].map);
          }
        },
        draw.shader);
  }
  EXPECT_EQ(draws, 1);
}

TEST_F(TextureFiles, OfModelsKeep16Bits) {
  const auto file = put("a.gltf", square(png16_row({32800, 32960, 257, 65535}, 1, 6), colored_by(0)).text());
  with_map(read_square(file), kBaseColorMap, [&](const Texture2D& map) {
    EXPECT_EQ(map.format(), TexelFormat::rgba32f);
    EXPECT_NEAR(map.value(0, 0, 0).x, decoded(32800 / 65535.0), 1e-7);
  });
  // Both channels would be 128 with 8 bits. The surface shows its texture without light.
  const glm::vec4 pixel = light_of(description_of(read_square(file)), 8, 8).at(4, 4);
  EXPECT_NEAR(pixel.x, decoded(32800 / 65535.0), 1e-6);
  EXPECT_NEAR(pixel.y, decoded(32960 / 65535.0), 1e-6);
  EXPECT_NEAR(pixel.z, decoded(1 / 255.0), 1e-7);
  EXPECT_GT(pixel.y - pixel.x, 0.002f);
}

TEST_F(TextureFiles, OfModelsKeep8Bits) {
  const std::vector<std::byte> png = encode_png(one(glm::u8vec4(128, 1, 2, 255)));
  const std::string image(reinterpret_cast<const char*>(png.data()), png.size());
  with_map(read_square(put("a.gltf", square(image, colored_by(0)).text())), kBaseColorMap, [](const Texture2D& map) {
    EXPECT_EQ(map.format(), TexelFormat::srgb8a8);
    EXPECT_EQ(map.texel(0, 0, 0), glm::u8vec4(128, 1, 2, 255));
  });
}

TEST_F(TextureFiles, OfNormalsKeep16Bits) {
  const auto file = put("a.gltf", square(png16_row({32800, 32960, 65535}, 1, 2), {{"normalTexture", {{"index", 0}}}}).text());
  with_map(read_square(file), kNormalMap,
           [](const Texture2D& map) { EXPECT_EQ(map.value(0, 0, 0), glm::vec4(glm::vec3(32800, 32960, 65535) / 65535.0f, 1)); });
}

// An image that is a normal map in one place and data in another has two textures.
TEST_F(TextureFiles, OfNormalsAndDataAreSeparate) {
  const std::string image = png16_row({52428, 32768, 0}, 1, 2);
  const auto file = put("a.gltf", square(image, {{"normalTexture", {{"index", 0}}}, {"occlusionTexture", {{"index", 0}}}}).text());
  with_map(read_square(file), kNormalMap, [](const Texture2D& map) { EXPECT_NEAR(map.value(0, 0, 0).z, 0.9f, 1e-4f); });
  with_map(read_square(file), kOcclusionMap, [](const Texture2D& map) { EXPECT_EQ(map.value(0, 0, 0).z, 0); });
}

TEST_F(ToolTextureFiles, OfModelsAreReadFromDds) {
  const std::string png = png16_row({0, 0, 0}, 1, 2);
  GltfBuilder file = square(png, colored_by(1));
  const std::string image = dxgi_dds(2, 1, 1, memory_of<float>({0.3f, 4.0f, 0.1f, 1.0f}));  // R32G32B32A32_FLOAT
  file.add("images", {{"bufferView", file.view(std::vector<char>(image.begin(), image.end()))}, {"mimeType", "image/vnd-ms.dds"}});
  file.add("textures", {{"extensions", {{"MSFT_texture_dds", {{"source", 1}}}}}});
  file.json["extensionsUsed"] = {"MSFT_texture_dds", "KHR_materials_unlit"};
  file.json["extensionsRequired"] = {"MSFT_texture_dds"};
  const auto path = put("a.gltf", file.text());
  with_map(read_square(path), kBaseColorMap,
           [](const Texture2D& map) { EXPECT_EQ(map.value(0, 0, 0), glm::vec4(0.3f, 4.0f, 0.1f, 1.0f)); });
  EXPECT_TRUE(file.read().warnings.empty());
  file.json["textures"][1]["source"] = 0;  // the PNG
  with_map(read_square(put("b.gltf", file.text())), kBaseColorMap,
           [](const Texture2D& map) { EXPECT_EQ(map.value(0, 0, 0), glm::vec4(0, 0, 0, 1)); });
}

TEST_F(ToolTextureFiles, OfNormalsInBc5HaveZ) {
  // Red is 204 and green 128 in all texels: both endpoints are the same.
  const std::string block = std::string("\xcc\xcc\0\0\0\0\0\0", 8) + std::string("\x80\x80\0\0\0\0\0\0", 8);
  const auto file = put("a.gltf", square(dxgi_dds(83, 4, 4, block), {{"normalTexture", {{"index", 0}}}}).text());
  with_map(read_square(file), kNormalMap, [](const Texture2D& map) {
    const glm::vec4 t = map.value(0, 1, 1);
    EXPECT_NEAR(t.x, 0.8f, 1e-6f);
    EXPECT_NEAR(t.z, 0.9f, 1e-5f);
  });
}

TEST_F(ToolTextureFiles, OfModelsAreReadFromKtx2) {
  put("b.ktx2", ktx2({.format = 97}, memory_of<uint16_t>({0x3c00, 0x4000, 0x3800, 0x3c00})));  // R16G16B16A16_SFLOAT: 1, 2, 0.5, 1
  GltfBuilder file = square(png16_row({0, 0, 0}, 1, 2), colored_by(1));
  file.add("images", {{"uri", "b.ktx2"}});
  file.add("textures", {{"source", 1}});
  with_map(read_square(put("a.gltf", file.text())), kBaseColorMap, [](const Texture2D& map) {
    EXPECT_EQ(map.format(), TexelFormat::rgba16f);
    EXPECT_EQ(map.value(0, 0, 0), glm::vec4(1, 2, 0.5f, 1));
  });
}

// ---- scenes -----------------------------------------------------------------------------------------------------

// A plane that fills the view and shows its color map without light.
std::string plane_with(const std::string& keys) {
  return R"({"version": 1, "cameras": {"c": {"type": "orthographic", "position": [0, 5, 0], "target": [0, 0, 0], "up": [0, 0, -1],
      "height": 2, "far": 9}}, "objects": {"a": {"shape": "plane", "size": 4, )" +
         keys + "}}}";
}

TEST_F(ToolTextureFiles, OfScenesKeepLight) {
  write_image(directory / "a.exr", one(glm::vec4(0.5f, 7.0f, 0.25f, 1.0f)));
  const std::string scene = plane_with(R"("shading": "none", "color": ")" + (directory / "a.exr").string() + "\"");
  const glm::vec4 pixel = light_of(description_of(scene), 8, 8).at(4, 4);
  EXPECT_EQ(glm::vec3(pixel), glm::vec3(0.5f, 7.0f, 0.25f));
}

TEST_F(TextureFiles, OfScenesKeep16Bits) {
  const auto image = put("a.png", png16_row({32800, 32960, 65535}, 1, 2));
  const std::string scene = plane_with(R"("shading": "none", "color": ")" + image.string() + "\"");
  const glm::vec4 pixel = light_of(description_of(scene), 8, 8).at(4, 4);
  EXPECT_NEAR(pixel.x, decoded(32800 / 65535.0), 1e-6);
  EXPECT_NEAR(pixel.y, decoded(32960 / 65535.0), 1e-6);
}

TEST_F(ToolTextureFiles, OfScenesAreReadFromKtx2) {
  const auto image = put("a.ktx2", ktx2({.format = 43}, "\x33\x66\x99\xff"));  // R8G8B8A8_SRGB
  const std::string scene = plane_with(R"("shading": "none", "color": ")" + image.string() + "\"");
  EXPECT_EQ(picture_of(description_of(scene), 8, 8).at(4, 4), glm::u8vec4(0x33, 0x66, 0x99, 255));
}

TEST_F(ToolTextureFiles, OfScenesThatCannotBeReadAreReported) {
  const auto image = put("a.exr", "v/1\x01 and no more");
  const std::string message = input_error([&] { light_of(description_of(plane_with(R"("color": ")" + image.string() + "\"")), 8, 8); });
  EXPECT_TRUE(reports(message, "objects.a.color", {"a.exr", "expected"})) << message;
}

// ---- export -----------------------------------------------------------------------------------------------------

Image<glm::u16vec4> codes_of(const ModelImage& image) { return std::get<Image<glm::u16vec4>>(decode_png(*image.bytes, image.name)); }

TEST_F(TextureFiles, OfExportedScenesKeep16Bits) {
  const auto color = put("a.png", png16_row({32800, 32960, 5, 65535}, 1, 6)), normal = put("b.png", png16_row({32800, 40000, 60000}, 1, 2));
  const Workers workers(1);
  SceneAssets assets(workers);
  const Model model =
      scene_model(description_of(plane_with(R"("color": ")" + color.string() + R"(", "normal_map": ")" + normal.string() + "\"")), assets);
  ASSERT_EQ(model.images.size(), 2u);
  EXPECT_EQ(codes_of(model.images[0]).at(0, 0), glm::u16vec4(32800, 32960, 5, 65535));
  const glm::u16vec4 n = codes_of(model.images[1]).at(0, 0);
  EXPECT_EQ(glm::u16vec3(n), glm::u16vec3(32800, 40000, 60000));
}

TEST_F(ToolTextureFiles, OfExportedModelsKeep16Bits) {
  Model model = GltfBuilder::read_text(square("x", colored_by(0)).text());
  const std::string image = gray_tiff_row<uint16_t>({32800}, TiffSampleFormat::unsigned_integer);
  const auto bytes = std::as_bytes(std::span(image));
  model.images[0].bytes = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
  embed_images(model, "a.gltf");
  EXPECT_EQ(codes_of(model.images[0]).at(0, 0), glm::u16vec4(32800, 32800, 32800, 65535));
  EXPECT_TRUE(model.warnings.empty());
}

TEST_F(TextureFiles, OfExportedModelsWarnAboutLight) {
  Model model = GltfBuilder::read_text(square("x", colored_by(0)).text());
  model.images[0].bytes = nullptr;
  model.images[0].pixels = std::make_shared<const ColorPicture>(one(glm::vec4(0.5f, 3.0f, 0.0f, 1.0f)));
  embed_images(model, "a.gltf");
  EXPECT_EQ(codes_of(model.images[0]).at(0, 0).y, 65535);
  EXPECT_EQ(model.warnings, std::vector<std::string>{"texels below 0 or above 1 are clamped"});
}

}  // namespace
}  // namespace halfspace::texture_image_test
