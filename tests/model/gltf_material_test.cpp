// SPDX-License-Identifier: Apache-2.0
//
// Materials and textures of glTF files.
#include <gtest/gtest.h>

#include <numbers>

#include "halfspace/model/gltf/specular_glossiness.h"
#include "model/gltf_builder.h"
#include "support/files.h"
#include "support/temporary_folder.h"

namespace halfspace {
namespace {

// Returns a file with one texture. Its image is the text "image" in a buffer view.
GltfBuilder file_with_texture() {
  GltfBuilder file;
  file.add("images", {{"bufferView", file.view(std::vector<char>{'i', 'm', 'a', 'g', 'e'})}, {"mimeType", "image/png"}});
  file.add("textures", {{"source", 0}});
  return file;
}

Model read_material(GltfBuilder file, GltfJson material) {
  file.add("materials", std::move(material));
  return file.read();
}
ModelMaterial material_of(GltfJson json) { return read_material(file_with_texture(), std::move(json)).materials.at(0); }

GltfJson extension(const char* name, GltfJson value) { return {{"extensions", {{name, std::move(value)}}}}; }

TEST(GltfMaterial, HasTheDefaultsOfTheSpecification) {
  const ModelMaterial m = material_of({{"name", "plain"}});
  EXPECT_EQ(m.name, "plain");
  EXPECT_EQ(m.base_color, glm::vec4(1.0f));
  EXPECT_EQ(m.metallic, 1.0f);
  EXPECT_EQ(m.roughness, 1.0f);
  EXPECT_EQ(m.emissive, glm::vec3(0.0f));
  EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(m.alpha_cutoff, 0.5f);
  EXPECT_FALSE(m.double_sided);
  EXPECT_FALSE(m.unlit);
  EXPECT_EQ(m.ior, 1.5f);
  EXPECT_EQ(m.base_color_map.texture, -1);
}

TEST(GltfMaterial, ReadsFactorsAndChannels) {
  const GltfJson texture = {{"index", 0}};
  const Model model = read_material(file_with_texture(), {{"pbrMetallicRoughness",
                                                           {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                                                            {"metallicFactor", 0.5},
                                                            {"roughnessFactor", 0.25},
                                                            {"metallicRoughnessTexture", texture}}},
                                                          {"normalTexture", {{"index", 0}, {"texCoord", 1}, {"scale", -2}}},
                                                          {"occlusionTexture", {{"index", 0}, {"strength", 0.75}}},
                                                          {"emissiveFactor", {0, 1, 0.5}},
                                                          {"alphaMode", "MASK"},
                                                          {"alphaCutoff", 0.3},
                                                          {"doubleSided", true}});
  const ModelMaterial& m = model.materials.at(0);
  EXPECT_EQ(m.base_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.roughness, 0.25f);
  EXPECT_EQ(m.metallic_map.channel, Channel::blue);
  EXPECT_EQ(m.roughness_map.channel, Channel::green);
  EXPECT_EQ(m.roughness_map.texture, 0);
  EXPECT_EQ(m.normal_map.uv_set, 1);
  EXPECT_EQ(m.normal_scale, -2.0f);
  EXPECT_EQ(m.occlusion_map.channel, Channel::red);
  EXPECT_EQ(m.occlusion_strength, 0.75f);
  EXPECT_EQ(m.emissive, glm::vec3(0.0f, 1.0f, 0.5f));
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.3f);
  EXPECT_TRUE(m.double_sided);
  ASSERT_NE(model.images.at(0).bytes, nullptr);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(model.images[0].bytes->data()), model.images[0].bytes->size()), "image");
}

TEST(GltfMaterial, ReadsExtensions) {
  EXPECT_TRUE(material_of(extension("KHR_materials_unlit", GltfJson::object())).unlit);
  EXPECT_EQ(material_of(extension("KHR_materials_ior", {{"ior", 1.3}})).ior, 1.3f);
  GltfJson glowing = extension("KHR_materials_emissive_strength", {{"emissiveStrength", 8}});
  glowing["emissiveFactor"] = {1, 0.5, 0};
  EXPECT_EQ(material_of(glowing).emissive, glm::vec3(8, 4, 0));
  const ModelMaterial specular = material_of(extension(
      "KHR_materials_specular", {{"specularFactor", 0.5}, {"specularTexture", {{"index", 0}}}, {"specularColorFactor", {2, 1, 0}}}));
  EXPECT_EQ(specular.specular, 0.5f);
  EXPECT_EQ(specular.specular_map.channel, Channel::alpha);
  EXPECT_EQ(specular.specular_color, glm::vec3(2, 1, 0));
  const ModelMaterial coat =
      material_of(extension("KHR_materials_clearcoat",
                            {{"clearcoatFactor", 1}, {"clearcoatRoughnessFactor", 0.5}, {"clearcoatRoughnessTexture", {{"index", 0}}}}));
  EXPECT_EQ(coat.clearcoat, 1.0f);
  EXPECT_EQ(coat.clearcoat_roughness, 0.5f);
  EXPECT_EQ(coat.clearcoat_roughness_map.channel, Channel::green);
  const ModelMaterial cloth = material_of(
      extension("KHR_materials_sheen",
                {{"sheenColorFactor", {1, 0.5, 0}}, {"sheenRoughnessFactor", 0.25}, {"sheenRoughnessTexture", {{"index", 0}}}}));
  EXPECT_EQ(cloth.sheen, 1.0f);
  EXPECT_EQ(cloth.sheen_color, glm::vec3(1, 0.5f, 0));
  EXPECT_EQ(cloth.sheen_roughness, 0.25f);
  EXPECT_EQ(cloth.sheen_roughness_map.channel, Channel::alpha);
  EXPECT_EQ(material_of(extension("KHR_materials_sheen", GltfJson::object())).sheen, 0.0f);
}

TEST(GltfMaterial, ApproximatesTransmissionByBlending) {
  GltfJson json = extension("KHR_materials_transmission", {{"transmissionFactor", 0.75}});
  json["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.5};
  const Model model = read_material(file_with_texture(), json);
  EXPECT_EQ(model.materials[0].alpha_mode, AlphaMode::blend);
  EXPECT_EQ(model.materials[0].base_color.w, 0.125f);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("KHR_materials_transmission"), std::string::npos);
}

TEST(GltfMaterial, ConvertsSpecularGlossiness) {
  const auto converted = [](GltfJson json) { return material_of(extension("KHR_materials_pbrSpecularGlossiness", std::move(json))); };
  // A specular color of 0.04 is that of a dielectric.
  const ModelMaterial plastic =
      converted({{"diffuseFactor", {0.48, 0.24, 0, 0.5}}, {"specularFactor", {0.04, 0.04, 0.04}}, {"glossinessFactor", 0.75}});
  EXPECT_NEAR(plastic.metallic, 0.0f, 1e-6f);
  EXPECT_EQ(plastic.roughness, 0.25f);
  EXPECT_NEAR(plastic.base_color.x, 0.48f, 1e-6f);
  EXPECT_NEAR(plastic.base_color.y, 0.24f, 1e-6f);
  EXPECT_EQ(plastic.base_color.w, 0.5f);
  // Without diffuse reflection, the material is a metal with this specular color.
  const ModelMaterial gold = converted({{"diffuseFactor", {0, 0, 0, 1}}, {"specularFactor", {1.0, 0.7, 0.3}}});
  EXPECT_EQ(gold.metallic, 1.0f);
  EXPECT_NEAR(gold.base_color.y, 0.7f, 1e-6f);
  // Without specular reflection, the base color is proportional to the diffuse color, so the texture need not be converted.
  const ModelMaterial cloth = converted({{"diffuseFactor", {0.5, 0.5, 0.5, 0.25}},
                                         {"specularFactor", {0, 0, 0}},
                                         {"glossinessFactor", 0},
                                         {"diffuseTexture", {{"index", 0}}}});
  EXPECT_EQ(cloth.base_color_map.texture, 0);
  EXPECT_NEAR(cloth.base_color.x, 0.5f / 0.96f, 1e-6f);
  EXPECT_EQ(cloth.base_color.w, 0.25f);
  EXPECT_EQ(cloth.metallic, 0.0f);
  EXPECT_EQ(cloth.roughness, 1.0f);
}

// Also without textures, which would be multiplied and clamped texel by texel.
TEST(GltfMaterial, ClampsSpecularGlossinessFactors) {
  const Model model = read_material(file_with_texture(), extension("KHR_materials_pbrSpecularGlossiness",
                                                                   {{"diffuseFactor", {0.5, 3, -1, 2}}, {"specularFactor", {0.5, 9, 0}}}));
  const MetallicColor expected = metallic_color({0.5, 1, 0}, {0.5, 1, 0});
  EXPECT_EQ(model.materials[0].base_color, glm::vec4(glm::vec3(expected.base), 1.0f));
  EXPECT_EQ(model.materials[0].metallic, static_cast<float>(expected.metallic));
  ASSERT_EQ(model.warnings.size(), 2u);
  EXPECT_NE(model.warnings[0].find("diffuseFactor: (0.5, 3, -1, 2) is out of range; using (0.5, 1, 0, 1)"), std::string::npos)
      << model.warnings[0];
  EXPECT_NE(model.warnings[1].find("specularFactor: (0.5, 9, 0) is out of range"), std::string::npos) << model.warnings[1];
}

TEST(GltfMaterial, ConvertsSpecularGlossinessTextures) {
  GltfBuilder file = file_with_texture();
  file.add("samplers", {{"magFilter", 9728}, {"wrapS", 33071}});
  file.add("textures", {{"source", 0}, {"sampler", 0}});
  const GltfJson maps = {{"diffuseFactor", {0.5, 0.6, 0.7, 0.25}},
                         {"specularFactor", {0.1, 0.2, 0.3}},
                         {"glossinessFactor", 0.75},
                         {"diffuseTexture", {{"index", 0}}},
                         {"specularGlossinessTexture", {{"index", 1}}}};
  const auto add = [&](const GltfJson& json) { file.add("materials", extension("KHR_materials_pbrSpecularGlossiness", json)); };
  add(maps);
  add(maps);
  GltfJson only_specular = maps;
  only_specular.erase("diffuseTexture");
  add(only_specular);
  GltfJson apart = maps;
  apart["diffuseTexture"]["texCoord"] = 1;
  add(apart);
  const Model model = file.read();
  const ModelMaterial& m = model.materials.at(0);
  EXPECT_EQ(m.base_color, glm::vec4(1.0f, 1.0f, 1.0f, 0.25f));  // the other factors are applied to the texels
  EXPECT_EQ(m.metallic, 1.0f);
  EXPECT_EQ(m.roughness, 1.0f);
  EXPECT_EQ(m.base_color_map.texture, 2);
  EXPECT_EQ(m.metallic_map.texture, 3);
  EXPECT_EQ(m.metallic_map.channel, Channel::blue);
  EXPECT_EQ(m.roughness_map.texture, 3);
  EXPECT_EQ(m.roughness_map.channel, Channel::green);
  const ModelImage& color = model.images.at(static_cast<std::size_t>(model.textures.at(2).image));
  const ModelImage& data = model.images.at(static_cast<std::size_t>(model.textures.at(3).image));
  ASSERT_TRUE(color.converted && data.converted);
  EXPECT_TRUE(color.converted->same_sources(*data.converted));
  EXPECT_EQ(color.converted->result, SpecularGlossiness::Result::base_color);
  EXPECT_EQ(data.converted->result, SpecularGlossiness::Result::metallic_roughness);
  EXPECT_EQ(data.converted->diffuse_texture, 0);
  EXPECT_EQ(data.converted->specular_texture, 1);
  EXPECT_EQ(data.converted->diffuse, glm::vec3(0.5f, 0.6f, 0.7f));
  EXPECT_EQ(data.converted->specular, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(data.converted->glossiness, 0.75f);
  EXPECT_EQ(model.textures[2].sampler.mag, Filter::bilinear) << "the sampler of the diffuse texture";
  EXPECT_EQ(model.textures[3].sampler.mag, Filter::nearest) << "the sampler of the specular-glossiness texture";
  EXPECT_EQ(model.materials.at(1).base_color_map.texture, 2) << "the same conversion is done once";
  EXPECT_EQ(model.materials.at(2).base_color_map.texture, 4);
  EXPECT_EQ(model.textures.at(4).sampler.mag, Filter::nearest);
  // Textures with different coordinates cannot be combined. The result is a dielectric whose reflectance is the texture.
  const ModelMaterial& dielectric = model.materials.at(3);
  EXPECT_EQ(dielectric.base_color_map.texture, 0);
  EXPECT_EQ(dielectric.base_color_map.uv_set, 1);
  EXPECT_EQ(dielectric.metallic, 0.0f);
  EXPECT_EQ(dielectric.metallic_map.texture, -1);
  EXPECT_EQ(dielectric.specular_color_map.texture, 1);
  EXPECT_NEAR(dielectric.specular_color.y, 0.2f / 0.04f, 1e-6f);
  EXPECT_EQ(dielectric.roughness_map.texture, 5);
  EXPECT_EQ(dielectric.roughness_map.uv_set, 0);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("texture coordinates"), std::string::npos) << model.warnings[0];
  // Meshes that cannot be textured have the material that the factors describe.
  const ModelMaterial plain = without_converted_maps(model, m);
  const MetallicColor color_of_factors = metallic_color(glm::dvec3(data.converted->diffuse), glm::dvec3(data.converted->specular));
  EXPECT_EQ(plain.base_color, glm::vec4(glm::vec3(color_of_factors.base), 0.25f));
  EXPECT_EQ(plain.metallic, static_cast<float>(color_of_factors.metallic));
  EXPECT_EQ(plain.roughness, 0.25f);
  for (const TextureUse* map : {&plain.base_color_map, &plain.metallic_map, &plain.roughness_map}) EXPECT_EQ(map->texture, -1);
  const ModelMaterial plain_dielectric = without_converted_maps(model, dielectric);
  EXPECT_EQ(plain_dielectric.base_color, dielectric.base_color);
  EXPECT_EQ(plain_dielectric.base_color_map.texture, 0) << "this image is not converted";
  EXPECT_EQ(plain_dielectric.roughness, 0.25f);
  // The textures that the reader adds cannot be used by their numbers.
  add({{"diffuseTexture", {{"index", 2}}}});
  EXPECT_THROW(file.read(), InputError);
}

TEST(GltfMaterial, TransformsTextureCoordinates) {
  const GltfJson transform = {{"offset", {0.5, 0.25}}, {"rotation", std::numbers::pi / 2.0}, {"scale", {2, 3}}, {"texCoord", 1}};
  const ModelMaterial m = material_of({{"emissiveTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}});
  EXPECT_EQ(m.emissive_map.uv_set, 1);
  // A counter-clockwise quarter turn in an image with v pointing down: u becomes −v.
  const glm::vec2 uv = m.emissive_map.uv_transform * glm::vec3(1.0f, 0.0f, 1.0f);
  EXPECT_NEAR(uv.x, 0.5f, 1e-6f);
  EXPECT_NEAR(uv.y, 0.25f - 2.0f, 1e-6f);
  const glm::vec2 v = m.emissive_map.uv_transform * glm::vec3(0.0f, 1.0f, 1.0f);
  EXPECT_NEAR(v.x, 0.5f + 3.0f, 1e-6f);
  EXPECT_NEAR(v.y, 0.25f, 1e-6f);
}

// A mesh gets the two sets of texture coordinates that its material uses, regardless of their set numbers.
TEST(GltfMaterial, UsesAnyTwoSetsOfTextureCoordinates) {
  GltfBuilder file = file_with_texture();
  const auto texture = [](int set) { return GltfJson{{"index", 0}, {"texCoord", set}}; };
  file.add("materials", {{"emissiveTexture", texture(3)}, {"occlusionTexture", texture(1)}});
  file.add("materials", {{"emissiveTexture", texture(2)}});
  file.add("materials", {{"emissiveTexture", texture(3)}, {"occlusionTexture", texture(1)}, {"normalTexture", texture(4)}});
  GltfJson attributes = {{"POSITION", file.triangle()}};
  for (int set = 0; set < 4; ++set) {
    const auto u = 0.125f * static_cast<float>(set);
    attributes["TEXCOORD_" + std::to_string(set)] = file.accessor<float>({u, 0, u, 0, u, 0}, 2);
  }
  for (int material = 0; material < 3; ++material) file.mesh_node({{"attributes", attributes}, {"material", material}});
  const Model model = file.read();
  const auto u_of = [&](std::size_t mesh, const TextureUse& use) {
    return model.meshes.at(mesh).uvs[static_cast<std::size_t>(use.uv_set)].at(0).x;
  };
  EXPECT_EQ(u_of(0, model.materials[0].emissive_map), 0.375f);
  EXPECT_EQ(u_of(0, model.materials[0].occlusion_map), 0.125f);
  EXPECT_EQ(u_of(1, model.materials[1].emissive_map), 0.25f);
  EXPECT_TRUE(model.meshes[1].uvs[1].empty());
  EXPECT_EQ(u_of(2, model.materials[2].emissive_map), 0.375f);
  EXPECT_EQ(u_of(2, model.materials[2].normal_map), 0.125f);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_NE(model.warnings[0].find("uses 3 sets"), std::string::npos);
}

TEST(GltfMaterial, MapsSamplers) {
  GltfBuilder file = file_with_texture();
  file.add("samplers", {{"magFilter", 9728}, {"minFilter", 9729}, {"wrapS", 33071}, {"wrapT", 33648}});
  file.add("textures", {{"source", 0}, {"sampler", 0}});
  const Model model = file.read();
  const Sampler& standard = model.textures.at(0).sampler;
  EXPECT_EQ(standard.mag, Filter::bilinear);
  EXPECT_EQ(standard.min, Filter::trilinear);
  EXPECT_EQ(standard.anisotropy, 8);
  EXPECT_EQ(standard.wrap_s, Wrap::repeat);
  const Sampler& sampler = model.textures.at(1).sampler;
  EXPECT_EQ(sampler.mag, Filter::nearest);
  EXPECT_EQ(sampler.min, Filter::bilinear);
  EXPECT_EQ(sampler.anisotropy, 1);
  EXPECT_EQ(sampler.wrap_s, Wrap::clamp);
  EXPECT_EQ(sampler.wrap_t, Wrap::mirrored);
}

TEST(GltfMaterial, KeepsEveryMinificationFilter) {
  const std::pair<int, Filter> filters[] = {{9728, Filter::nearest},
                                            {9729, Filter::bilinear},
                                            {9984, Filter::nearest_mipmap_nearest},
                                            {9985, Filter::bilinear_mipmap_nearest},
                                            {9986, Filter::nearest_mipmap_linear},
                                            {9987, Filter::trilinear}};
  for (const auto& [number, filter] : filters) {
    GltfBuilder file = file_with_texture();
    file.add("samplers", {{"minFilter", number}});
    file.add("textures", {{"source", 0}, {"sampler", 0}});
    EXPECT_EQ(file.read().textures.at(1).sampler.min, filter) << number;
  }
}

TEST(GltfMaterial, LocatesImages) {
  const TemporaryFolder folder;
  write_bytes(folder.path() / "a b.png", "x");
  GltfBuilder file;
  for (const char* uri : {"a%20b.png", "missing.png", "data:image/png;base64,eHl6", "data:,%41b"}) {
    file.add("textures", {{"source", file.add("images", {{"uri", uri}})}});
  }
  file.add("textures", {{"source", 1}, {"extensions", {{"EXT_texture_webp", {{"source", 2}}}}}});
  for (int i = 0; i < 5; ++i) file.add("materials", {{"emissiveTexture", {{"index", i}}}});
  const Model model = GltfBuilder::read_text(file.text(), {}, folder.path() / "a.gltf");
  EXPECT_EQ(model.images[0].file.filename(), "a b.png");
  EXPECT_TRUE(model.images[1].file.empty());
  EXPECT_EQ(model.images[1].name, "missing.png");
  EXPECT_EQ(model.images[2].bytes->size(), 3u);
  EXPECT_EQ(static_cast<char>(model.images[3].bytes->at(0)), 'A');
  EXPECT_EQ(model.materials[0].emissive_map.texture, 0);
  EXPECT_EQ(model.materials[1].emissive_map.texture, -1);
  EXPECT_EQ(model.textures[4].image, 2);
  EXPECT_EQ(model.warnings.size(), 1u);
}

TEST(GltfMaterial, ReadsVariants) {
  GltfBuilder file;
  for (int i = 0; i < 3; ++i) file.add("materials", GltfJson::object());
  file.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}, {{"name", "green"}}, {{"name", "blue"}}};
  GltfJson primitive = extension("KHR_materials_variants", {{"mappings", {{{"material", 2}, {"variants", {0, 2}}}}}});
  primitive["attributes"]["POSITION"] = file.triangle();
  primitive["material"] = 1;
  file.mesh_node(primitive);
  const Model model = file.read();
  EXPECT_EQ(model.variants, (std::vector<std::string>{"red", "green", "blue"}));
  EXPECT_EQ(model.meshes[0].material, 1);
  EXPECT_EQ(model.meshes[0].variant_materials, (std::vector<int>{2, 1, 2}));
}

TEST(GltfMaterial, ComputesTangentsForNormalMaps) {
  for (const bool has_map : {false, true}) {
    GltfBuilder file = file_with_texture();
    file.add("materials", has_map ? GltfJson{{"normalTexture", {{"index", 0}}}} : GltfJson::object());
    const int uv = file.accessor<float>({0, 1, 1, 1, 0, 0}, 2);
    file.mesh_node({{"attributes", {{"POSITION", file.triangle()}, {"TEXCOORD_0", uv}}}, {"material", 0}});
    const ModelMesh mesh = file.read().meshes.at(0);
    EXPECT_EQ(mesh.tangents, std::vector<glm::vec4>(has_map ? 3 : 0, glm::vec4(1, 0, 0, 1)));
  }
}

TEST(GltfMaterial, ClampsFactors) {
  const Model model = read_material(file_with_texture(), {{"pbrMetallicRoughness", {{"metallicFactor", 1.5}, {"roughnessFactor", -1}}}});
  EXPECT_EQ(model.materials[0].metallic, 1.0f);
  EXPECT_EQ(model.materials[0].roughness, 0.0f);
  ASSERT_EQ(model.warnings.size(), 2u);
  EXPECT_EQ(model.warnings[0], "materials[0].pbrMetallicRoughness.metallicFactor: 1.5 is out of range; using 1");
}

}  // namespace
}  // namespace halfspace
