// SPDX-License-Identifier: Apache-2.0
//
// Damaged and hostile glTF files. Whatever a file contains, read_gltf must return a valid model or throw an InputError with a one-line
// message that names the place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "halfspace/core/check.h"
#include "halfspace/model/pose/pose.h"
#include "halfspace/model/text/file_bytes.h"
#include "model/gltf_builder.h"
#include "support/errors.h"
#include "support/files.h"

namespace halfspace {
namespace {

// A file with every kind of object: an indexed mesh with all attributes, a morph target, a skin, an animation, a camera and a material.
GltfBuilder rich_file() {
  GltfBuilder file;
  const int p = file.triangle(), n = file.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 3);
  const int uv = file.accessor<float>({0, 1, 1, 1, 0, 0}, 2), indices = file.accessor<uint16_t>({0, 1, 2}, 1);
  const int joints = file.accessor<uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 4);
  const int weights = file.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 4);
  const int times = file.accessor<float>({0, 1}, 1), values = file.accessor<float>({0, 0, 0, 1, 1, 1}, 3);
  file.add("images", {{"uri", "data:image/png;base64,AAAA"}});
  file.add("samplers", {{"magFilter", 9729}});
  file.add("textures", {{"source", 0}, {"sampler", 0}});
  file.add("materials", {{"normalTexture", {{"index", 0}}}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}}}});
  file.mesh_node({{"attributes", {{"POSITION", p}, {"NORMAL", n}, {"TEXCOORD_0", uv}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
                  {"indices", indices},
                  {"material", 0},
                  {"targets", {{{"POSITION", n}}}}});
  file.add("nodes", {{"children", GltfJson::array({0})}, {"camera", 0}, {"translation", {1, 2, 3}}});
  file.json["nodes"][0]["skin"] = 0;
  file.add("skins", {{"joints", {1}}});
  file.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
  file.add("animations", {{"samplers", {{{"input", times}, {"output", values}}}},
                          {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
  file.add("scenes", {{"nodes", {1}}});
  return file;
}

// Returns the message of the InputError, or "" if the file can be read.
std::string error_of(std::string_view text, const ReadModelOptions& options = {}, const std::filesystem::path& file = "/none/a.gltf") {
  try {
    const Model model = GltfBuilder::read_text(text, options, file);
    for (const ModelMesh& mesh : model.meshes) {
      for (const uint32_t i : mesh.indices) EXPECT_LT(i, mesh.positions.size());
      EXPECT_TRUE(mesh.topology != MeshTopology::triangles || mesh.normals.size() == mesh.positions.size());
      EXPECT_LT(static_cast<std::size_t>(mesh.material), model.materials.size());
    }
    for (const std::string& warning : model.warnings) EXPECT_EQ(warning.find('\n'), std::string::npos) << warning;
    const PosedModel posed = pose(model, {.animation = model.animations.empty() ? -1 : 0, .time = 0.5});
    EXPECT_FALSE(std::isnan(posed.low.x) || std::isnan(posed.high.x));
    return "";
  } catch (const InputError& e) {
    const std::string message = e.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find("; expected"), std::string::npos) << message;
    return message;
  }
}

struct HostileCase {
  const char* place;  // expected in the message
  std::function<void(GltfJson&)> damage;
};

TEST(GltfHostile, NamesThePlaceOfEveryProblem) {
  const HostileCase cases[] = {
      {"asset.version", [](GltfJson& j) { j.erase("asset"); }},
      {"asset.version", [](GltfJson& j) { j["asset"]["version"] = "1.0"; }},
      {"asset.minVersion", [](GltfJson& j) { j["asset"]["minVersion"] = "2.1"; }},
      {"accessors[0].count", [](GltfJson& j) { j["accessors"][0]["count"] = 4; }},
      {"accessors[0].count", [](GltfJson& j) { j["accessors"][0]["count"] = -1; }},
      {"accessors[0].count", [](GltfJson& j) { j["accessors"][0]["count"] = 2.5; }},
      {"accessors[0].count", [](GltfJson& j) { j["accessors"][0]["count"] = 18446744073709551615u; }},
      {"accessors[0].count", [](GltfJson& j) { j["accessors"][0]["count"] = 1e15; }},
      {"accessors[0].count", [](GltfJson& j) { j["accessors"][0].erase("count"); }},
      {"accessors[0].count", [](GltfJson& j) { j["accessors"][0]["byteOffset"] = 9007199254740992; }},
      {"accessors[0].type", [](GltfJson& j) { j["accessors"][0]["type"] = "VEC2"; }},
      {"accessors[0].type", [](GltfJson& j) { j["accessors"][0]["type"] = "MAT3"; }},
      {"accessors[0].componentType", [](GltfJson& j) { j["accessors"][0]["componentType"] = 5124; }},
      {"accessors[0].bufferView", [](GltfJson& j) { j["accessors"][0]["bufferView"] = 99; }},
      {"accessors[1].count", [](GltfJson& j) { j["accessors"][1]["count"] = 2; }},
      {"accessors[3].componentType", [](GltfJson& j) { j["accessors"][3]["componentType"] = 5122; }},
      {"meshes[0].primitives[0]: needs 15259 MiB of memory",
       [](GltfJson& j) {
         j["accessors"][0] = {{"componentType", 5126}, {"count", 4000000000}, {"type", "VEC3"}},
         j["meshes"][0]["primitives"][0].erase("indices");
       }},
      {"bufferViews[0]", [](GltfJson& j) { j["bufferViews"][0]["byteOffset"] = 9007199254740991; }},
      {"bufferViews[0].byteStride", [](GltfJson& j) { j["bufferViews"][0]["byteStride"] = 5; }},
      {"accessors[0]", [](GltfJson& j) { j["bufferViews"][0]["byteStride"] = 8; }},
      {"buffers[0].byteLength", [](GltfJson& j) { j["buffers"][0]["byteLength"] = 100000; }},
      {"buffers[0].uri", [](GltfJson& j) { j["buffers"][0]["uri"] = "data:;base64,####"; }},
      {"buffers[0].uri", [](GltfJson& j) { j["buffers"][0]["uri"] = "../../../etc/passwd"; }},
      {"buffers[0].uri", [](GltfJson& j) { j["buffers"][0].erase("uri"); }},
      {"nodes", [](GltfJson& j) { j["nodes"] = 3; }},
      {"nodes[0]", [](GltfJson& j) { j["nodes"][0] = nullptr; }},
      {"nodes[0].children", [](GltfJson& j) { j["nodes"][0]["children"] = {1}; }},
      {"nodes[1].children[0]", [](GltfJson& j) { j["nodes"][0]["children"] = {0}; }},
      {"nodes[1].children[1]",
       [](GltfJson& j) {
         j["nodes"][1]["children"] = {0, 0};
       }},
      {"nodes[0].mesh", [](GltfJson& j) { j["nodes"][0]["mesh"] = 1; }},
      {"nodes[0].weights",
       [](GltfJson& j) {
         j["nodes"][0]["weights"] = {1, 2};
       }},
      {"nodes[1].translation",
       [](GltfJson& j) {
         j["nodes"][1]["translation"] = {1, 2};
       }},
      {"nodes[1].translation[2]",
       [](GltfJson& j) {
         j["nodes"][1]["translation"] = {1, 2, "3"};
       }},
      {"nodes[1].translation[0]",
       [](GltfJson& j) {
         j["nodes"][1]["translation"] = {1e300, 2, 3};
       }},
      {"nodes[1]",
       [](GltfJson& j) {
         j["nodes"][1]["translation"] = {1e30, 2, 3};
       }},
      {"scenes[0].nodes[0]", [](GltfJson& j) { j["scenes"][0]["nodes"] = {0}; }},
      {"scene", [](GltfJson& j) { j["scene"] = 1; }},
      {"skins[0].joints", [](GltfJson& j) { j["skins"][0]["joints"] = GltfJson::array(); }},
      {"accessors[0].type", [](GltfJson& j) { j["skins"][0]["inverseBindMatrices"] = 0; }},
      {"cameras[0].perspective.yfov", [](GltfJson& j) { j["cameras"][0]["perspective"]["yfov"] = 4; }},
      {"cameras[0]", [](GltfJson& j) { j["cameras"][0]["perspective"]["zfar"] = 0.5; }},
      {"cameras[0].type", [](GltfJson& j) { j["cameras"][0]["type"] = "fisheye"; }},
      {"materials[0].alphaMode", [](GltfJson& j) { j["materials"][0]["alphaMode"] = "ADD"; }},
      {"materials[0].normalTexture.index", [](GltfJson& j) { j["materials"][0]["normalTexture"]["index"] = 1; }},
      {"materials[0].pbrMetallicRoughness.baseColorFactor",
       [](GltfJson& j) { j["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = 1; }},
      {"images[0].uri", [](GltfJson& j) { j["images"][0]["uri"] = "data:image/png"; }},
      {"samplers[0].magFilter", [](GltfJson& j) { j["samplers"][0]["magFilter"] = 9987; }},
      {"samplers[0].wrapS", [](GltfJson& j) { j["samplers"][0]["wrapS"] = 1; }},
      {"textures[0].sampler", [](GltfJson& j) { j["textures"][0]["sampler"] = -1; }},
      {"meshes[0].primitives[0].mode", [](GltfJson& j) { j["meshes"][0]["primitives"][0]["mode"] = 7; }},
      {"meshes[0].primitives[0].material", [](GltfJson& j) { j["meshes"][0]["primitives"][0]["material"] = 1; }},
      {"meshes[0].primitives[0].attributes.POSITION", [](GltfJson& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99; }},
      {"meshes[0].weights",
       [](GltfJson& j) {
         j["meshes"][0]["weights"] = {1, 2};
       }},
      {"animations[0].samplers[0].interpolation", [](GltfJson& j) { j["animations"][0]["samplers"][0]["interpolation"] = "CUBIC"; }},
      {"animations[0].channels[0].sampler", [](GltfJson& j) { j["animations"][0]["channels"][0]["sampler"] = 1; }},
      {"accessors[7].count", [](GltfJson& j) { j["accessors"][7]["count"] = 1; }},
      {"accessors[3]", [](GltfJson& j) { j["accessors"][0]["count"] = 2; }},
      {"extensionsRequired[0]", [](GltfJson& j) { j["extensionsRequired"] = {"ACME_geometry"}; }},
  };
  ASSERT_EQ(error_of(rich_file().text()), "");
  for (const HostileCase& c : cases) {
    GltfJson json = rich_file().finished();
    c.damage(json);
    const std::string message = error_of(json.dump());
    EXPECT_TRUE(message.starts_with(std::string("/none/a.gltf: ") + c.place)) << c.place << " in " << json.dump() << "\ngives: " << message;
  }
}

TEST(GltfHostile, RejectsPositionsAndTimesThatAreNotValid) {
  GltfBuilder far;
  far.mesh_node({{"attributes", {{"POSITION", far.accessor<float>({0, 0, 0, 1, 1e30f, 0, 0, 1, 0}, 3)}}}});
  EXPECT_NE(error_of(far.text()).find("accessors[0]: position 1"), std::string::npos);
  GltfBuilder file = rich_file();
  file.json["animations"][0]["samplers"][0]["input"] = file.accessor<float>({1, 1}, 1);
  EXPECT_NE(error_of(file.text()).find("time 1 is 1"), std::string::npos);
}

TEST(GltfHostile, RejectsIndicesAndJointsThatAreOutOfRange) {
  GltfBuilder file = rich_file();
  file.json["meshes"][0]["primitives"][0]["indices"] = file.accessor<uint16_t>({0, 1, 3}, 1);
  EXPECT_NE(error_of(file.text()).find("index 3 at 2 is out of range"), std::string::npos);
  file = rich_file();
  file.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = file.accessor<uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, 4);
  EXPECT_NE(error_of(file.text()).find("nodes[0].skin: a vertex of the mesh has joint 1"), std::string::npos);
}

TEST(GltfHostile, RejectsSparseIndicesThatAreNotIncreasing) {
  for (const std::vector<uint8_t>& indices : {std::vector<uint8_t>{1, 3}, {1, 1}, {2, 0}}) {
    GltfBuilder file;
    const GltfJson sparse = {{"count", 2},
                             {"indices", {{"bufferView", file.view(indices)}, {"componentType", 5121}}},
                             {"values", {{"bufferView", file.view(std::vector<float>(6, 1.0f))}}}};
    file.mesh_node(
        {{"attributes",
          {{"POSITION", file.add("accessors", {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}, {"sparse", sparse}})}}}});
    EXPECT_NE(error_of(file.text()).find("accessors[0].sparse.indices"), std::string::npos);
  }
}

TEST(GltfHostile, RejectsTextThatIsNotJson) {
  const std::string deep = R"({"asset":{"version":"2.0"},"extras":)" + std::string(1'000'000, '[');
  for (const std::string& text : {std::string(), std::string("\0\1", 2), std::string("{"), std::string("[]"), std::string("{\"a\":1e999}"),
                                  std::string("{\"a\":\"\xff\"}"), deep, deep + std::string(1'000'000, ']') + "}"}) {
    EXPECT_NE(error_of(text), "") << text.substr(0, 40);
  }
  EXPECT_TRUE(reports(error_of("{\n\n  \"asset\": x}"), "/none/a.gltf:3:12: ", {"invalid JSON", "expected a glTF file"}));
  EXPECT_EQ(error_of("{\n\"a\": -1e999}"), "/none/a.gltf:2:6: number overflow parsing '-1e999'; expected a finite number");
  // In a binary file, the text begins after 20 bytes, and this one has its error after 10 more.
  std::string glb = GltfBuilder().glb();
  glb[30] = 'x';
  EXPECT_TRUE(reports(error_of(glb), "/none/a.gltf: byte 30: ", {"invalid JSON"})) << glb.substr(20);
}

TEST(GltfHostile, RejectsTruncatedAndDamagedGlb) {
  const std::string whole = rich_file().glb();
  ASSERT_EQ(error_of(whole), "");
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_NE(error_of(whole.substr(0, size)), "") << size;
  std::string wrong = whole;
  wrong[4] = 1;
  EXPECT_NE(error_of(wrong).find("version 1"), std::string::npos);
}

TEST(GltfHostile, RejectsDamagedMeshoptData) {
  for (const char* mode : {"ATTRIBUTES", "TRIANGLES", "INDICES", "OTHER"}) {
    for (const uint8_t header : std::vector<uint8_t>{0x00, 0xa0, 0xe1, 0xd1}) {
      GltfBuilder file;
      const int view = file.view(std::vector<uint8_t>(40, header));
      file.json["bufferViews"][static_cast<std::size_t>(view)]["extensions"]["EXT_meshopt_compression"] = {
          {"buffer", 0}, {"byteLength", 40}, {"byteStride", 4}, {"count", 1'000'000}, {"mode", mode}};
      file.mesh_node(
          {{"attributes",
            {{"POSITION", file.add("accessors", {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}})}}}});
      // Neither the length of the view nor that of the data matches the count.
      EXPECT_NE(error_of(file.text()).find("EXT_meshopt_compression"), std::string::npos) << mode << int{header};
    }
  }
}

// 100 primitives without data (all zeros) need far more memory than the file has bytes.
TEST(GltfHostile, LimitsMemory) {
  GltfBuilder file;
  const int p = file.add("accessors", {{"componentType", 5126}, {"count", 1'000'000}, {"type", "VEC3"}});
  GltfJson primitives = GltfJson::array();
  for (int i = 0; i < 100; ++i) primitives.push_back({{"attributes", {{"POSITION", p}}}});
  file.add("meshes", {{"primitives", primitives}});
  const std::string error = error_of(file.text(), {.max_memory = 64u << 20, .memory_in_use = 16u << 20});
  EXPECT_NE(error.find(" MiB of memory in addition to "), std::string::npos) << error;
  EXPECT_NE(error.find(" in use; expected at most 64 MiB (--max-memory)"), std::string::npos) << error;
  file = {};
  file.json["extras"] = std::vector<int>(1'000'000, 1);
  EXPECT_NE(error_of(file.text(), {.max_memory = 64u << 20}).find("expected at most 64 MiB (--max-memory)"), std::string::npos);
}

// Returns the smallest limit with which a mesh of 100,000 vertices can be read.
std::size_t min_memory(bool with_normals, bool with_joints) {
  constexpr int kVertices = 99'999;
  GltfBuilder file;
  const auto zeros = [&](int component, const char* type) {
    return file.add("accessors", {{"componentType", component}, {"count", kVertices}, {"type", type}});
  };
  GltfJson attributes = {{"POSITION", zeros(5126, "VEC3")}};
  if (with_normals) attributes["NORMAL"] = zeros(5126, "VEC3");
  for (const char* set : {"0", "1"}) {
    if (!with_joints) continue;
    attributes[std::string("JOINTS_") + set] = zeros(5123, "VEC4");
    attributes[std::string("WEIGHTS_") + set] = zeros(5126, "VEC4");
  }
  file.mesh_node({{"attributes", attributes}});
  const std::string text = file.text();
  std::size_t low = 0, high = std::size_t{256} << 20;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (error_of(text, {.max_memory = middle}).empty() ? high : low) = middle;
  }
  return high;
}

// Flat normals duplicate the vertices. Two sets of joints and weights add 48 bytes to each new vertex; 16 of them are already included in
// the memory bound for meshes without joints.
TEST(GltfHostile, CountsTheJointsOfCopiedVertices) {
  const std::size_t joints = min_memory(true, true) - min_memory(true, false);
  const std::size_t copied_joints = min_memory(false, true) - min_memory(false, false);
  EXPECT_EQ(copied_joints - joints, 99'999u * 32);
}

TEST(GltfHostile, LimitsWarnings) {
  GltfBuilder file;
  for (int i = 0; i < 10'000; ++i) file.add("materials", {{"alphaCutoff", -1}});
  EXPECT_LE(file.read().warnings.size(), 100u);
  file = {};
  for (int i = 0; i < 1000; ++i) file.add("materials", {{"emissiveTexture", {{"index", i}}}});
  for (int i = 0; i < 1000; ++i) file.add("textures", {{"source", file.add("images", {{"uri", "missing " + std::to_string(i)}})}});
  const std::vector<std::string> warnings = file.read().warnings;
  ASSERT_EQ(warnings.size(), 501u);
  EXPECT_EQ(warnings.back(), "500 more warnings are not shown");
}

// Replaces bytes of text and binary files, and values of the JSON document.
TEST(GltfHostile, SurvivesRandomDamage) {
  std::mt19937 random(1);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  const GltfJson values[] = {-1, 0, 1, 2.5, 1e18, 1e300, 4294967295u, "x", nullptr, true, GltfJson::array(), GltfJson::object(), {1, 2, 3}};
  const std::string glb = rich_file().glb();
  const GltfJson flat = rich_file().finished().flatten();
  for (int i = 0; i < 3000; ++i) {
    GltfJson damaged = flat;
    for (std::size_t k = 0; k <= below(3); ++k) {
      auto item = damaged.begin();
      std::advance(item, below(damaged.size()));
      *item = values[below(std::size(values))];
    }
    std::string text;
    try {
      for (auto& item : damaged) {
        if (item.is_structured()) item = "structured";  // unflatten accepts only primitive values
      }
      text = damaged.unflatten().dump();
    } catch (const GltfJson::exception&) {
      continue;
    }
    (void)error_of(text, {.max_memory = 256u << 20});
    std::string bytes = glb;
    for (std::size_t k = 0; k <= below(3); ++k) bytes[below(bytes.size())] = static_cast<char>(below(256));
    (void)error_of(bytes, {.max_memory = 256u << 20});
  }
}

TEST(GltfHostile, ReadsAllSharedFiles) {
  const std::filesystem::path folder = shared_data("");
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << absent(folder);
  int good = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::filesystem::path& path = entry.path();
    if (!entry.is_regular_file() || (path.extension() != ".gltf" && path.extension() != ".glb")) continue;
    const std::vector<std::byte> bytes = file_bytes(path, std::size_t{1} << 30);
    const std::string error = error_of({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, {}, path);
    if (path.string().find("/broken/") != std::string::npos) continue;
    EXPECT_EQ(error, "");
    ++good;
  }
  EXPECT_GT(good, 0);
}

}  // namespace
}  // namespace halfspace
