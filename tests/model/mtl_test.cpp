// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "halfspace/model/obj/read_mtl.h"
#include "model/obj_reading.h"

namespace halfspace {
namespace {

double decoded(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

class Mtl : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_.path() / "maps");
    for (const char* name : {"a.png", "b.png", "c c.png", "maps/d.png"}) write_bytes(folder_.path() / name, name);
  }

  // Returns the material of a library with these statements.
  ModelMaterial material(const std::string& statements) {
    model_ = read_mtl_text(folder_, "newmtl m\n" + statements);
    EXPECT_EQ(model_.materials.size(), 1u);
    return model_.materials.at(0);
  }

  std::string file_of(const TextureUse& use) const {
    if (use.texture < 0) return "";
    const ModelTexture& texture = model_.textures.at(static_cast<std::size_t>(use.texture));
    return model_.images.at(static_cast<std::size_t>(texture.image)).file.filename().string();
  }
  const Sampler& sampler_of(const TextureUse& use) const { return model_.textures.at(static_cast<std::size_t>(use.texture)).sampler; }

  TemporaryFolder folder_;
  Model model_;
};

TEST_F(Mtl, DecodesDiffuseAndEmissiveColors) {
  const ModelMaterial m = material("Kd 0.5 0.25 1 # comment\nKe 0.1\n");
  EXPECT_EQ(m.name, "m");
  EXPECT_NEAR(m.base_color.x, decoded(0.5), 1e-5);
  EXPECT_NEAR(m.base_color.y, decoded(0.25), 1e-5);
  EXPECT_EQ(m.base_color.z, 1.0f);
  EXPECT_EQ(m.base_color.w, 1.0f);
  EXPECT_NEAR(m.emissive.x, decoded(0.1), 1e-5);
  EXPECT_EQ(m.emissive, glm::vec3(m.emissive.x));
  EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
  EXPECT_TRUE(m.double_sided);
  EXPECT_FALSE(m.unlit);
  const glm::vec3 bright = material("Ke 20 10 0\n").emissive;
  EXPECT_NEAR(bright.x, 20.0, 1e-4);
  EXPECT_NEAR(bright.y, 20.0 * decoded(0.5), 1e-3);
  EXPECT_EQ(bright.z, 0.0f);
}

TEST_F(Mtl, ConvertsTheHighlightExponent) {
  for (const double ns : {0.0, 10.0, 96.078431, 1000.0}) {
    const double roughness = material("Ns " + std::to_string(ns) + "\n").roughness;
    EXPECT_NEAR(roughness * roughness, std::sqrt(2.0 / (ns + 2.0)), 1e-6) << ns;
  }
  EXPECT_EQ(material("Ns -5\n").roughness, 1.0f);
  EXPECT_EQ(material("").roughness, 0.6f);
}

TEST_F(Mtl, ConvertsOpacity) {
  const auto check = [&](const char* text, float opacity, AlphaMode mode) {
    const ModelMaterial m = material(text);
    EXPECT_EQ(m.base_color.w, opacity) << text;
    EXPECT_EQ(m.alpha_mode, mode) << text;
  };
  check("d 0.25\n", 0.25f, AlphaMode::blend);
  check("d -halo 0.25\n", 0.25f, AlphaMode::blend);
  check("Tr 0.25\n", 0.75f, AlphaMode::blend);
  check("d 1\nTr 1\n", 1.0f, AlphaMode::opaque);
  check("Tr 1\n", 1.0f, AlphaMode::opaque);
  check("Tr 0\n", 1.0f, AlphaMode::opaque);
  check("d 7\n", 1.0f, AlphaMode::opaque);
  check("map_d a.png\n", 1.0f, AlphaMode::mask);
  check("d 0\nmap_d a.png\n", 1.0f, AlphaMode::mask);
  check("d 0.5\nmap_d a.png\n", 0.5f, AlphaMode::blend);
  check("map_d missing.png\n", 1.0f, AlphaMode::opaque);
  EXPECT_TRUE(material("map_d a.png\n").mask_unless_soft);
}

TEST_F(Mtl, UsesTheAlphaChannelOfTheDiffuseMap) {
  ModelMaterial m = material("map_Kd a.png\nmap_d a.png\n");
  EXPECT_EQ(file_of(m.opacity_map), "");
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  m = material("map_Kd a.png\nmap_d b.png\n");
  EXPECT_EQ(file_of(m.opacity_map), "b.png");
  EXPECT_EQ(m.opacity_map.channel, Channel::luminance);
}

TEST_F(Mtl, ConvertsSpecularReflection) {
  EXPECT_EQ(material("Ks 0.5 0.25 0\n").specular_color, glm::vec3(1.0f, 0.5f, 0.0f));
  EXPECT_EQ(material("Ks 0 0 0\n").specular, 0.0f);
  EXPECT_EQ(material("Ks 1 1 1\nillum 1\n").specular, 0.0f);
  EXPECT_EQ(material("").specular_color, glm::vec3(1.0f));
  EXPECT_TRUE(material("illum 0\n").unlit);
  EXPECT_EQ(material("Ni 2.5\n").ior, 2.5f);
  EXPECT_EQ(material("Ni 1\n").ior, 1.5f);
  const ModelMaterial mirror = material("Kd 0.01 0.01 0.01\nKs 1 1 1\nillum 5\n");
  EXPECT_EQ(mirror.metallic, 1.0f);
  EXPECT_EQ(mirror.base_color, glm::vec4(1.0f));
  const ModelMaterial mapped = material("Ks 0 0 0\nmap_Ks a.png\n");
  EXPECT_EQ(file_of(mapped.specular_map), "a.png");
  EXPECT_EQ(mapped.specular_map.channel, Channel::luminance);
  EXPECT_EQ(mapped.specular, 1.0f);
}

TEST_F(Mtl, ReadsTheMetallicRoughnessExtension) {
  ModelMaterial m = material("Kd 1 1 1\nKs 0 0 0\nNs 10\nillum 1\nPr 0.25\nPm 0.5\nPs 0.375\nPc 0.75\nPcr 0.125\n");
  EXPECT_EQ(m.roughness, 0.25f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.clearcoat, 0.75f);
  EXPECT_EQ(m.clearcoat_roughness, 0.125f);
  EXPECT_EQ(m.sheen, 0.375f);
  EXPECT_EQ(m.specular, 1.0f);
  m = material("map_Pr -imfchan g a.png\nmap_Pm -imfchan b a.png\nmap_Ps b.png\nmap_Pc b.png\nmap_Pcr b.png\nPm 0.5\n");
  EXPECT_EQ(m.roughness, 1.0f);
  EXPECT_EQ(m.roughness_map.channel, Channel::green);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.metallic_map.channel, Channel::blue);
  EXPECT_EQ(m.clearcoat, 1.0f);
  EXPECT_EQ(m.sheen, 1.0f);
  EXPECT_EQ(file_of(m.sheen_map), "b.png");
  EXPECT_EQ(file_of(m.clearcoat_map), "b.png");
  EXPECT_EQ(file_of(m.clearcoat_roughness_map), "b.png");
  EXPECT_EQ(model_.images.size(), 2u) << "an image is listed once";
  EXPECT_EQ(model_.textures.size(), 2u);
  m = material("Ns 10\nmap_Ns a.png\n");
  EXPECT_EQ(file_of(m.roughness_map), "a.png");
  EXPECT_EQ(m.roughness, 1.0f);
}

TEST_F(Mtl, ReadsReliefMaps) {
  for (const char* key : {"bump", "map_bump", "map_Bump", "MAP_BUMP"}) {
    const ModelMaterial m = material(std::string(key) + " -bm 2 a.png\nnorm b.png\n");
    EXPECT_EQ(file_of(m.bump_map), "a.png") << key;
    EXPECT_EQ(file_of(m.normal_map), "b.png") << key;
    EXPECT_FLOAT_EQ(m.bump_scale, 0.1f) << "2 times 1% of the diagonal, which is 5";
  }
  EXPECT_EQ(file_of(material("map_Kn a.png\n").normal_map), "a.png");
}

TEST_F(Mtl, ReadsFileNames) {
  for (const char* name :
       {"c c.png", "\"c c.png\"", "  c c.png\t", "-clamp off c c.png", "-bm 1.5 c c.png", "c c.png -bm 1.5", "C:\\art\\c c.png", "C c.PNG",
        "-s 1 1 -o 0 0 0 -t 1 -mm 0 1 -blendu on -blendv off -texres 64 -type sphere -boost 2 -cc on c c.png"}) {
    EXPECT_EQ(file_of(material(std::string("map_Kd ") + name + "\n").base_color_map), "c c.png") << name;
  }
  EXPECT_EQ(file_of(material("map_Kd maps\\d.png\n").base_color_map), "d.png");
}

// v = 0 is the bottom of the image in the file and the top in the model.
TEST_F(Mtl, ReadsTextureOptions) {
  const auto transformed = [&](const char* options, glm::vec2 uv) {
    const TextureUse use = material(std::string("map_Kd ") + options + " a.png\n").base_color_map;
    const glm::vec2 result = use.uv_transform * glm::vec3(uv.x, 1.0f - uv.y, 1.0f);
    return glm::vec2(result.x, 1.0f - result.y);
  };
  EXPECT_EQ(transformed("", {0.25f, 0.5f}), glm::vec2(0.25f, 0.5f));
  EXPECT_EQ(transformed("-s 2 4 1", {0.25f, 0.5f}), glm::vec2(0.5f, 2.0f));
  EXPECT_EQ(transformed("-o 0.5", {0.25f, 0.5f}), glm::vec2(0.75f, 0.5f));
  EXPECT_EQ(transformed("-s 2 2 -o 0.25 0.5 0", {0.25f, 0.5f}), glm::vec2(0.75f, 1.5f));
  EXPECT_EQ(transformed("-s 1.#QNAN 4 1 -bm nan", {0.25f, 0.5f}), glm::vec2(0.25f, 2.0f)) << "ignored, and not the file name";
  EXPECT_EQ(sampler_of(material("map_Kd -clamp on a.png\n").base_color_map).wrap_t, Wrap::clamp);
  EXPECT_EQ(sampler_of(material("map_Kd -clamp off a.png\n").base_color_map).wrap_s, Wrap::repeat);
  for (const auto& [letter, channel] : {std::pair{'r', Channel::red},
                                        {'g', Channel::green},
                                        {'b', Channel::blue},
                                        {'m', Channel::alpha},
                                        {'l', Channel::luminance},
                                        {'z', Channel::luminance}}) {
    EXPECT_EQ(material(std::string("map_d -imfchan ") + letter + " a.png\n").opacity_map.channel, channel) << letter;
  }
}

TEST_F(Mtl, TexturesReplaceBlackFactors) {
  EXPECT_EQ(material("Kd 0 0 0\nmap_Kd a.png\n").base_color, glm::vec4(1.0f));
  EXPECT_EQ(material("Ke 0 0 0\nmap_Ke a.png\n").emissive, glm::vec3(1.0f));
  EXPECT_EQ(material("Kd 0 0 0\n").base_color, glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(material("Kd 0 0 0\nmap_Kd missing.png\n").base_color, glm::vec4(0.8f, 0.8f, 0.8f, 1));
  EXPECT_EQ(material("").base_color, glm::vec4(0.8f, 0.8f, 0.8f, 1));
}

TEST_F(Mtl, NamesMissingTexturesOnce) {
  material("map_Kd missing.png\nmap_d missing.png\nmap_Ks missing.png\nmap_Ke other.png\n");
  ASSERT_EQ(model_.warnings.size(), 2u);
  EXPECT_NE(model_.warnings[0].find("'missing.png'"), std::string::npos);
  EXPECT_NE(model_.warnings[1].find("'other.png'"), std::string::npos);
  EXPECT_TRUE(model_.images.empty() && model_.textures.empty());
}

TEST_F(Mtl, WarnsOnceForEachKindOfUnusedStatement) {
  const ModelMaterial m = material(
      "Kd x 0 0\nKd 0 y 0\nNs z\ndisp a.png\ndisp a.png\nrefl -type sphere a.png\nfoo\nbar\nKa 1 1 1\nTf 1 1 1\nmap_Kd -mm 0 2 a.png\n");
  EXPECT_EQ(model_.warnings.size(), 6u) << "Kd, Ns, disp, refl, unknown, -mm";
  for (const std::string& warning : model_.warnings) EXPECT_TRUE(warning.starts_with("a.mtl:")) << warning;
  EXPECT_EQ(m.roughness, 0.6f);
}

TEST_F(Mtl, ConvertsOnlyMaterialsInUse) {
  const Model model = read_mtl_text(folder_, "newmtl other\nmap_Kd missing.png\nnewmtl m\nKd 1 1 1\nnewmtl m\nKd 0 0 0\n");
  ASSERT_EQ(model.materials.size(), 1u);
  EXPECT_EQ(model.materials[0].base_color, glm::vec4(1.0f)) << "the first definition of a name counts";
  EXPECT_TRUE(model.warnings.empty());
}

TEST_F(Mtl, FindsTexturesOfLibrariesInOtherFolders) {
  write_bytes(folder_.path() / "maps/x.mtl", "newmtl m\nmap_Kd d.png\nmap_Ks a.png\n");
  model_ = read_obj_text("mtllib maps/x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n", {}, folder_.path() / "a.obj");
  EXPECT_EQ(file_of(model_.materials[0].base_color_map), "d.png") << "relative to the library";
  EXPECT_EQ(file_of(model_.materials[0].specular_map), "a.png") << "relative to the model";
  EXPECT_TRUE(model_.warnings.empty());
}

TEST_F(Mtl, ReadsSeveralLibraries) {
  write_bytes(folder_.path() / "one.mtl", "newmtl a\nKd 1 1 1\n");
  write_bytes(folder_.path() / "two.mtl", "newmtl b\nKd 1 1 1\n");
  write_bytes(folder_.path() / "my three.mtl", "newmtl c\nKd 1 1 1\n");
  const auto read = [&](const std::string& libraries) {
    return read_obj_text(libraries + "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n", {},
                         folder_.path() / "a.obj");
  };
  EXPECT_EQ(read("mtllib one.mtl two.mtl\nmtllib my three.mtl\n").materials.size(), 3u);
  EXPECT_EQ(read("mtllib \"my three.mtl\"\nmtllib ONE.mtl\nmtllib two.mtl\n").warnings.size(), 1u);
  const Model missing = read("mtllib one.mtl none.mtl\n");
  ASSERT_EQ(missing.warnings.size(), 1u);
  EXPECT_NE(missing.warnings[0].find("'none.mtl'"), std::string::npos);
  EXPECT_EQ(missing.materials.size(), 2u) << "undefined materials are one gray material";
  EXPECT_EQ(read("mtllib my none.mtl\n").warnings.size(), 1u);
  EXPECT_EQ(read("").warnings.size(), 1u);
  const Model outside = read("mtllib ../one.mtl\nmtllib ../../etc/none.mtl\n");
  ASSERT_EQ(outside.warnings.size(), 2u);
  EXPECT_NE(outside.warnings[1].find("--allow-outside"), std::string::npos);
}

TEST_F(Mtl, ReadsDamagedLibraries) {
  for (const std::string& text :
       {std::string(), std::string("Kd 1 1 1\n"), std::string(1000, '\0'), std::string(100000, '\\'),
        "newmtl m\nmap_Kd " + std::string(100000, 'x'),
        std::string("newmtl m\nmap_Kd\nmap_Kd -s\nmap_Kd -bm -bm -bm\nbump -imfchan\nKd\nillum\nillum 1e18\nNs\nd -halo\nnewmtl\n"),
        std::string("newmtl m\nKd 1e17 -1e17 0\nKs 1e17 0 0\nKe 1e17 0 0\nNs 1e17\nPm -1\nPr 5\nillum -3\nNi -1\n")}) {
    const Model model = read_mtl_text(folder_, text);
    ASSERT_EQ(model.materials.size(), 1u);
    const ModelMaterial& m = model.materials[0];
    EXPECT_TRUE(m.roughness >= 0.0f && m.roughness <= 1.0f && m.metallic >= 0.0f && m.metallic <= 1.0f && m.ior == 1.5f);
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(m.base_color[i] >= 0.0f && m.base_color[i] <= 1.0f);
  }
}

TEST_F(Mtl, LimitsTheNumberOfMaterials) {
  std::string text;
  for (std::size_t i = 0; i < kMaxMtlMaterials + 10; ++i) text += "newmtl a\n";
  std::vector<std::string> warnings;
  EXPECT_EQ(parse_mtl("a.mtl", text, warnings).size(), kMaxMtlMaterials);
  EXPECT_EQ(warnings.size(), 1u);
}

// Each image is first searched in the folder of the library, without warnings. With AddressSanitizer, this also tests that no warning is
// changed after it has been dropped.
TEST_F(Mtl, ImagesOutsideOfTheFolderShareOneWarning) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "sub");
  write_bytes(folder.path() / "sub/a.mtl", "newmtl m\nmap_Kd ../../one.png\nmap_Ks ../../two.png\nmap_bump ../../three.png\n");
  const Model model = read_obj_text("mtllib sub/a.mtl\nv 0 0 0\nv 3 0 0\nv 0 4 0\nusemtl m\nf 1 2 3\n", {}, folder.path() / "a.obj");
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("and 2 more files are outside the folder"), std::string::npos) << model.warnings[0];
}

}  // namespace
}  // namespace halfspace
