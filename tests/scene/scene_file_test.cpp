// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/scene_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "halfspace/core/check.h"
#include "halfspace/scene/scene_paths.h"
#include "support/errors.h"
#include "support/files.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace halfspace {
namespace {

namespace fs = std::filesystem;

SceneFile scene_of(std::string_view text) { return SceneFile::parse(text, "test.json", "/somewhere"); }

// ---- every key of every scene ----------------------------------------------------------------------------------

class EveryScene : public testing::TestWithParam<std::string> {};

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const ShippedScene& scene : shipped_scenes()) names.emplace_back(scene.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryScene, testing::ValuesIn(scene_names()), [](const auto& p) {
  std::string name = p.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

TEST_P(EveryScene, PrintedSceneReadsBackUnchanged) {
  const std::string printed = SceneFile::open(GetParam()).print();
  EXPECT_EQ(scene_of(printed).print(), printed);
  EXPECT_NE(SceneFile::open(GetParam()).description().head.title, "");
}

// Returns a different value that is valid for the key.
std::string another_value(const Field& field) {
  const Key& key = *field.key;
  const Json now = value_of(field);
  const auto number = [&](double x) {
    const double low = key.limits.low, high = key.limits.high;
    if (key.name == std::string("samples")) return number_text(x == 8 ? 1 : 2 * x);  // powers of two
    const double up = key.type == KeyType::integer ? x + 1 : x + 0.125 * std::max(1.0, std::abs(x));
    const double step = key.name == std::string("width") ? 2 : 1;  // widths must be even
    return number_text(up + step - 1 <= high ? up + step - 1 : std::max(low, x - step));
  };
  const auto vector = [&](const Json& v) {
    return number(v[0].get<double>()) + "," + number(v[1].get<double>()) + "," + number(v[2].get<double>());
  };
  switch (key.type) {
    case KeyType::boolean: return now.get<bool>() ? "false" : "true";
    case KeyType::integer:
    case KeyType::number: return number(now.get<double>());
    case KeyType::vector:
    case KeyType::color: return vector(now);
    case KeyType::choice: return std::string(now == key.choices.back() ? key.choices.front() : key.choices.back());
    case KeyType::file: return "other.png";
    case KeyType::map: return "#804020";
    case KeyType::numbers: return now.is_array() ? vector(now) : number(now.get<double>());
    case KeyType::keyframes: return !now.empty() && now[0][1].is_array() ? "[[0, [0, 0, 1]], [1, [0, 2, 0]]]" : "[[0, 1], [1, 2]]";
    case KeyType::text: return "";
  }
  return "";
}

TEST_P(EveryScene, EveryKeyCanBeSetPrintedAndReadBack) {
  SceneDescription description = SceneFile::open(GetParam()).description();
  int keys = 0;
  for (const NamedSection& s : sections_of(description)) {
    for (const Field& field : fields_of(s.section)) {
      const std::string name = field.key->name;
      const std::string path = s.path.empty() ? name : s.path + "." + name;
      // Other tests cover animation targets (suite Animation) and keys that select a kind (KindsHaveTheirOwnKeys).
      if (name == "target" && s.path.starts_with("animations.")) continue;
      if (field.key == &s.section.front().keys.front() && field.key->type == KeyType::choice) continue;
      SceneFile scene = SceneFile::open(GetParam());
      const std::string value = name == "title" ? "Another" : another_value(field);
      ASSERT_EQ(input_error([&] { scene.set(path + "=" + value); }), "(no error)") << path << "=" << value;
      SceneDescription set = scene.description();
      const Json want = value_of(find_key(set, path, "").field);
      if (field.key->type != KeyType::text || name == "title") {
        EXPECT_NE(want, value_of(field)) << path << "=" << value;
      }
      const SceneFile again = scene_of(scene.print());
      SceneDescription read = again.description();
      EXPECT_EQ(value_of(find_key(read, path, "").field), want) << path;
      EXPECT_EQ(again.print(), scene.print()) << path;
      ++keys;
    }
  }
  EXPECT_GT(keys, 30);
}

// ---- reading ---------------------------------------------------------------------------------------------------

TEST(SceneFile, AcceptsCommentsAndAppliesDefaults) {
  const SceneFile scene = scene_of("// a comment\n{ \"version\": 1, /* another */ \"objects\": { \"ball\": { \"radius\": 2 } } }");
  const SceneDescription& d = scene.description();
  ASSERT_EQ(d.objects.size(), 1u);
  EXPECT_EQ(d.objects[0].second.radius, 2.0);
  EXPECT_EQ(d.objects[0].second.latitudes, ObjectDescription{}.latitudes);
  ASSERT_EQ(d.cameras.size(), 1u) << "a scene without cameras gets a default one";
}

TEST(SceneFile, AcceptsColorsInThreeForms) {
  const auto ambient = [](const char* value) {
    return scene_of(std::string("{\"version\": 1, \"ambient\": ") + value + "}").description().head.ambient.linear;
  };
  EXPECT_EQ(ambient("0.25"), glm::dvec3(0.25));
  EXPECT_EQ(ambient("[0.1, 0.2, 0.3]"), glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(ambient("\"#ffffff\""), glm::dvec3(1.0));
  // IEC 61966-2-1: ((128/255 + 0.055) / 1.055)^2.4, rounded to float.
  EXPECT_NEAR(ambient("\"#000080\"").z, 0.21586050, 1e-7);
}

TEST(SceneFile, ResolvesPathsRelativeToTheFileOrForSetToTheWorkingDirectory) {
  SceneFile scene = scene_of(R"({"version": 1, "objects": {"ball": {"color": "maps/a.png"}}})");
  EXPECT_EQ(std::get<FilePath>(scene.description().objects[0].second.surface.color).path, "/somewhere/maps/a.png");
  scene.set("ball.color=maps/b.png");
  EXPECT_EQ(std::get<FilePath>(scene.description().objects[0].second.surface.color).path, fs::current_path() / "maps/b.png");
}

TEST(SceneFile, MapsAreColorsTexturesOrFiles) {
  const SceneFile scene = scene_of(R"({"version": 1, "textures": {"stone": {"file": "s.png"}}, "objects": {
    "a": {"color": "#000000"}, "b": {"color": "stone"}, "c": {"color": "stone.png"}}})");
  const auto& o = scene.description().objects;
  EXPECT_TRUE(std::holds_alternative<Color>(o[0].second.surface.color));
  EXPECT_EQ(std::get<TextureName>(o[1].second.surface.color).name, "stone");
  EXPECT_EQ(std::get<FilePath>(o[2].second.surface.color).path, "/somewhere/stone.png");
}

TEST(SceneFile, ObjectsOverrideTheirMaterial) {
  const SceneFile scene = scene_of(R"({"version": 1, "materials": {"m": {"shininess": 7, "diffuse": 0.5}},
    "objects": {"a": {"material": "m", "shininess": 9}}})");
  EXPECT_EQ(scene.description().objects[0].second.surface.shininess, 9.0);
  EXPECT_EQ(scene.description().objects[0].second.surface.diffuse.linear, glm::dvec3(0.5));
}

// A printed scene does not repeat values that come from a material, so that changes to the material still reach the object.
TEST(SceneFile, PrintedObjectsFollowTheirMaterial) {
  const SceneFile scene = scene_of(R"({"version": 1, "materials": {"m": {"shininess": 7, "diffuse": 0.5}},
    "objects": {"a": {"material": "m", "shininess": 9, "specular": 0.25}, "b": {}}})");
  SceneFile again = scene_of(scene.print());
  again.set(std::vector<std::string>{"m.diffuse=0.75", "m.shininess=3", "m.specular=1"});
  const SurfaceDescription& a = again.description().objects[0].second.surface;
  EXPECT_EQ(a.diffuse.linear, glm::dvec3(0.75)) << "from the material";
  EXPECT_EQ(a.shininess, 9.0) << "set on the object";
  EXPECT_EQ(a.specular.linear, glm::dvec3(0.25)) << "set on the object";
  EXPECT_NE(scene.print().find("\"b\": {\n      \"shape\": \"uv_sphere\""), std::string::npos);
  EXPECT_EQ(again.description().objects[1].second.surface.shininess, 32.0) << "an object without a material prints every key";
}

TEST(SceneFile, KindsHaveTheirOwnKeys) {
  SceneFile scene = scene_of(R"({"version": 1, "objects": {"floor": {"shape": "plane", "size": 4}}})");
  EXPECT_EQ(scene.print().find("latitudes"), std::string::npos);
  EXPECT_TRUE(reports(input_error([&] { scene.set("floor.latitudes=8"); }), "--set: floor.latitudes", {"unknown key 'latitudes'", "size"}));
}

TEST(SceneFile, ChangingTheKindDropsInapplicableKeys) {
  SceneFile scene = scene_of(R"({"version": 1, "objects": {"a": {"latitudes": 8, "specular": 0.5, "instances": [{}]}}})");
  scene.set("a.shape=cube");
  scene.set("a.size=3");
  EXPECT_EQ(scene.description().objects[0].second.size, 3.0);
  EXPECT_EQ(scene.description().objects[0].second.surface.specular.linear, glm::dvec3(0.5)) << "keys that both kinds have are kept";
  EXPECT_EQ(scene.description().objects[0].second.instances.size(), 1u);
  scene.set("a.shape=uv_sphere");
  EXPECT_EQ(scene.description().objects[0].second.latitudes, ObjectDescription{}.latitudes);
}

TEST(SceneFile, InstancesAreSetByIndex) {
  SceneFile scene = scene_of(R"({"version": 1, "objects": {"a": {"instances": [{"position": [1, 2, 3]}, {}]}}})");
  scene.set("a.instances.1.scale=2,2,2");
  EXPECT_EQ(scene.description().objects[0].second.instances[1].scale, glm::dvec3(2.0));
  EXPECT_EQ(scene.description().objects[0].second.instances[0].position, glm::dvec3(1, 2, 3));
}

// Each instance has its own transform, and each key of it can be animated separately.
TEST(SceneFile, InstancesAreAnimatedSeparately) {
  const SceneFile scene = scene_of(R"({"version": 1, "objects": {"a": {"instances": [{}, {"rotation": [0, 10, 0]}]}}, "animations": {
    "first": {"target": "objects.a.instances.0.position", "rate": [1, 0, 0]},
    "second": {"target": "a.instances.1.rotation", "rate": [0, 90, 0]},
    "both": {"target": "a.rotation", "rate": [0, 0, 5]}}})");
  const SceneDescription later = scene.at(2);
  const ObjectDescription& a = later.objects[0].second;
  EXPECT_EQ(a.instances[0].position, glm::dvec3(2, 0, 0));
  EXPECT_EQ(a.instances[0].rotation, glm::dvec3(0));
  EXPECT_EQ(a.instances[1].rotation, glm::dvec3(0, 190, 0));
  EXPECT_EQ(a.placement.rotation, glm::dvec3(0, 0, 10));
  EXPECT_EQ(scene.description().objects[0].second.instances[1].rotation, glm::dvec3(0, 10, 0)) << "the description at time 0 is unchanged";
}

// The total size over all instances is checked before any memory is allocated.
TEST(SceneFile, RejectsScenesThatAreTooLarge) {
  const auto scene_with = [](const std::string& object, int copies) {
    std::string text = R"({"version": 1, "objects": {"a": {)" + object + R"("instances": [{})";
    for (int i = 1; i < copies; ++i) text += ", {}";
    return text + "]}}}";
  };
  EXPECT_TRUE(reports(input_error([&] { scene_of(scene_with(R"("shape": "icosphere", "level": 8, )", 52)); }), "test.json: objects",
                      {"34078824 vertices", "33554432"}));
  EXPECT_EQ(input_error([&] { scene_of(scene_with(R"("shape": "icosphere", "level": 8, )", 51)); }), "(no error)");
  EXPECT_EQ(input_error([&] { scene_of(scene_with(R"("shape": "icosphere", "level": 8, "visible": false, )", 4096)); }), "(no error)");
  std::string text = R"({"version": 1, "objects": {)";
  for (int i = 0; i < 17; ++i) {
    const std::string list = scene_with(R"("shape": "plane", )", 4096);
    text += std::string(i == 0 ? "" : ", ") + "\"p" + std::to_string(i) +
            "\": " + list.substr(list.find("{\"shape"), list.find("]}") + 2 - list.find("{\"shape"));
  }
  EXPECT_TRUE(reports(input_error([&] { scene_of(text + "}}"); }), "test.json: objects", {"69632", "65536"}));
}

// ---- errors: file and key, the problem, the expected value --------------------------------------------------------

struct Wrong {
  const char* name;
  const char* text;
  const char* place;
  std::vector<std::string> keywords;
};
void PrintTo(const Wrong& w, std::ostream* os) { *os << w.name; }

const Wrong kWrong[] = {
    {"Empty", "", "test.json:1:1", {"JSON", "end of input"}},
    {"Comma", "{\n \"version\": 1,\n}", "test.json:3:1", {"JSON", "'}'"}},
    {"Array", "[1]", "test.json", {"object"}},
    {"NoVersion", "{}", "test.json: version", {"missing", "1"}},
    {"OtherVersion", "{\"version\": 2}", "test.json: version", {"expected 1, got 2"}},
    {"TwiceTheSame", R"({"version": 1, "version": 1})", "test.json:1:16", {"'version'", "once"}},
    {"TwiceInAnObject",
     "{\"version\": 1,\n  \"objects\": {\"a\": {\"radius\": 1, \"radius\" : 2}}}",
     "test.json:2:34",
     {"'radius'", "once"}},
    {"TwiceWithEscapes", R"({"version": 1, "a\"b\\": 1, "a\u0022b\\": 2})", "test.json:1:29", {"occurs twice"}},
    {"Section", R"({"version": 1, "lihgts": {}})", "test.json: lihgts", {"unknown key", "'lights'"}},
    {"Key", R"({"version": 1, "objects": {"a": {"raduis": 1}}})", "test.json: objects.a.raduis", {"unknown key", "'radius'"}},
    {"Type",
     R"({"version": 1, "objects": {"a": {"radius": "big"}}})",
     "test.json: objects.a.radius",
     {"number", "1e-06", "1e+06", "\"big\""}},
    {"Range", R"({"version": 1, "objects": {"a": {"latitudes": 1}}})", "test.json: objects.a.latitudes", {"2 to 8192", "got 1"}},
    {"Fraction", R"({"version": 1, "objects": {"a": {"latitudes": 8.5}}})", "test.json: objects.a.latitudes", {"2 to 8192", "8.5"}},
    {"Vector", R"({"version": 1, "objects": {"a": {"position": [1, 2]}}})", "test.json: objects.a.position", {"[x, y, z]", "[1,2]"}},
    {"Choice", R"({"version": 1, "objects": {"a": {"shape": "uv_spere"}}})", "test.json: objects.a.shape", {"\"uv_spere\"", "'uv_sphere'"}},
    {"Colour", R"({"version": 1, "ambient": "#12345"})", "test.json: ambient", {"#rrggbb", "\"#12345\""}},
    {"Boolean", R"({"version": 1, "objects": {"a": {"visible": 1}}})", "test.json: objects.a.visible", {"true or false", "got 1"}},
    {"Name", R"({"version": 1, "objects": {"a=b": {}}})", "test.json: objects.a=b", {"invalid name", "expected text without '='"}},
    {"NameEndsWithSpace", R"({"version": 1, "lights": {"a ": {}}})", "test.json: lights.a ", {"invalid name"}},
    {"NameLooksLikeColor", R"({"version": 1, "textures": {"#fff": {}}})", "test.json: textures.#fff", {"invalid name"}},
    {"NoObject", R"({"version": 1, "objects": {"a": 3}})", "test.json: objects.a", {"object", "got 3"}},
    {"NoCollection", R"({"version": 1, "objects": []})", "test.json: objects", {"object", "names"}},
    {"Material",
     R"({"version": 1, "materials": {"stone": {}}, "objects": {"a": {"material": "stoen"}}})",
     "test.json: objects.a.material",
     {"'stoen'", "'stone'"}},
    {"MaterialOfNone",
     R"({"version": 1, "objects": {"a": {"material": "red"}}})",
     "test.json: objects.a.material: no material 'red'",
     {"the scene has none", R"("materials": {"red": {"color": "#c02020"}})"}},
    {"OverrideOfNone",
     R"({"version": 1, "objects": {"a": {"shape": "file", "file": "a.obj", "model_materials": "Body=red"}}})",
     "test.json: objects.a.model_materials: no material 'red'",
     {"the scene has none", "\"materials\""}},
    {"Camera", R"({"version": 1, "camera": "frnot", "cameras": {"front": {}}})", "test.json: camera", {"'frnot'", "'front'"}},
    {"NearAndFar", R"({"version": 1, "cameras": {"c": {"near": 2, "far": 1}}})", "test.json: cameras.c.far", {"near"}},
    {"Up", R"({"version": 1, "cameras": {"c": {"up": [0, 0, 3]}}})", "test.json: cameras.c.up", {"position", "target", "line"}},
    {"Direction", R"({"version": 1, "lights": {"l": {"direction": [0, 0, 0]}}})", "test.json: lights.l.direction", {"zero"}},
    {"Attenuation",
     R"({"version": 1, "lights": {"l": {"type": "point", "attenuation": [0, 0, 0]}}})",
     "test.json: lights.l.attenuation",
     {"zero", "1e-06"}},
    {"Cone", R"({"version": 1, "lights": {"l": {"type": "spot", "inner": 40}}})", "test.json: lights.l.inner", {"40", "outer", "30"}},
    {"ShadingRate",
     R"({"version": 1, "objects": {"a": {"shading": "gourad"}}})",
     "test.json: objects.a.shading",
     {"\"gourad\"", "'gouraud'"}},
    {"Word", R"({"version": 1, "objects": {"camera": {}}})", "test.json: objects.camera", {"name"}},
    {"Texture",
     R"({"version": 1, "textures": {"ground": {}}, "objects": {"a": {"color": "gruond"}}})",
     "test.json: objects.a.color",
     {"'gruond'", "'ground'"}},
    {"OddWidth",
     R"({"version": 1, "textures": {"t": {"source": "moon_color", "width": 7}}})",
     "test.json: textures.t.width",
     {"even", "got 7"}},
    {"Vertices",
     R"({"version": 1, "objects": {"a": {"latitudes": 8192, "longitudes": 16384}}})",
     "test.json: objects.a.longitudes",
     {"2^23 vertices", "latitudes"}},
    {"PatternWidth",
     R"({"version": 1, "textures": {"t": {"source": "rock_color", "width": 4098}}})",
     "test.json: textures.t.width",
     {"4096", "got 4098"}},
    {"ShadowTooCoarse",
     R"({"version": 1, "objects": {"a": {}}, "shadow": {"resolution": 64}})",
     "test.json: shadow.resolution",
     {"256", "got 64"}},
    {"SunTooWide", R"({"version": 1, "objects": {"a": {}}, "lights": {"l": {"size": 46}}})", "test.json: lights.l.size", {"46", "45"}},
    {"TorusTube", R"({"version": 1, "objects": {"a": {"shape": "torus", "tube": 2}}})", "test.json: objects.a.tube", {"2", "radius", "1"}},
    {"TorusBands",
     R"({"version": 1, "objects": {"a": {"shape": "torus", "latitudes": 2}}})",
     "test.json: objects.a.latitudes",
     {"2", "at least 3"}},
    {"InsideOut",
     R"({"version": 1, "textures": {"h": {"source": "rock_height"}}, "objects": {"a": {"shape": "cube", "height": "h",
     "height_scale": 2}}})",
     "test.json: objects.a.height_scale",
     {"2", "inside out", "less than 1"}},
    {"Level", R"({"version": 1, "objects": {"a": {"shape": "icosphere", "level": 9}}})", "test.json: objects.a.level", {"0 to 8", "got 9"}},
    {"TargetThatStands",
     R"({"version": 1, "animations": {"t": {"target": "time.hours"}}})",
     "test.json: animations.t.target",
     {"time.hours", "object", "camera"}},
    {"UnknownParent",
     R"({"version": 1, "objects": {"wheel": {}, "a": {"parent": "weel"}}})",
     "test.json: objects.a.parent",
     {"'weel'", "'wheel'"}},
    {"ParentsInALoop",
     R"({"version": 1, "objects": {"a": {"parent": "b"}, "b": {"parent": "c"}, "c": {"parent": "b"}}})",
     "test.json: objects.a.parent",
     {"is a loop"}},
    {"StretchedParentOfSphere",
     R"({"version": 1, "objects": {"a": {"shape": "sphere", "parent": "b"}, "b": {"scale": [1, 2, 1]}}})",
     "test.json: objects.a.parent",
     {"'b'", "uniformly", "uv_sphere"}},
    {"OverrideWithoutMaterial",
     R"({"version": 1, "objects": {"a": {"shape": "file", "file": "a.obj", "model_materials": "Body"}}})",
     "test.json: objects.a.model_materials",
     {"'Body'", "NAME=MATERIAL"}},
    {"OverrideWithUnknownMaterial",
     R"({"version": 1, "materials": {"red": {}}, "objects": {"a": {"shape": "file", "file": "a.obj", "model_materials": "Body=rde"}}})",
     "test.json: objects.a.model_materials",
     {"'rde'", "'red'"}},
    {"OrbitOfANumber",
     R"({"version": 1, "objects": {"a": {}}, "animations": {"t": {"type": "orbit", "target": "a.radius"}}})",
     "test.json: animations.t.target",
     {"a.radius", "number", "vector"}},
    {"NoKeyframes",
     R"({"version": 1, "objects": {"a": {}}, "animations": {"t": {"type": "keyframes", "target": "a.radius"}}})",
     "test.json: animations.t.keys",
     {"empty", "[seconds, value]"}},
    {"Scale", R"({"version": 1, "objects": {"a": {"scale": [1, 0, 1]}}})", "test.json: objects.a.scale", {"zero", "1e-06"}},
    {"Target",
     R"({"version": 1, "objects": {"a": {}}, "animations": {"t": {"target": "a.radios"}}})",
     "test.json: animations.t.target",
     {"a.radios", "'radius'"}},
    {"TargetType",
     R"({"version": 1, "objects": {"a": {}}, "animations": {"t": {"target": "a.visible"}}})",
     "test.json: animations.t.target",
     {"a.visible", "number", "vector"}},
    {"RateSize",
     R"({"version": 1, "objects": {"a": {}}, "animations": {"t": {"target": "a.position", "rate": 1}}})",
     "test.json: animations.t.rate",
     {"[x, y, z]", "a.position"}},
    {"Keyframes",
     R"({"version": 1, "animations": {"t": {"type": "keyframes", "keys": [[1, 0], [0, 1]]}}})",
     "test.json: animations.t.keys",
     {"[seconds, value]", "[[1,0],[0,1]]"}},
};

class SceneFileError : public testing::TestWithParam<Wrong> {};

TEST_P(SceneFileError, IsOneLineWithPlaceAndKeywords) {
  EXPECT_TRUE(reports(input_error([&] { scene_of(GetParam().text); }), GetParam().place, GetParam().keywords));
}

// Checks the complete text of some messages.
TEST(SceneFile, ErrorMessagesAreExact) {
  const auto error = [](const char* text) { return input_error([&] { scene_of(text); }); };
  EXPECT_EQ(error("{\n \"version\": 1,\n}"),
            "test.json:3:1: invalid JSON: syntax error while parsing object key - unexpected '}'; expected string literal");
  EXPECT_EQ(error("{\n  \"version\": 1e999}"), "test.json:2:14: number overflow parsing '1e999'; expected a finite number");
  EXPECT_EQ(error(R"({"version": 1, "objects": {"a": {"raduis": 1}}})"),
            "test.json: objects.a.raduis: unknown key; did you mean 'radius'?");
  EXPECT_EQ(error(R"({"version": 1, "objects": {"a": {"radius": "big"}}})"),
            "test.json: objects.a.radius: expected a number from 1e-06 to 1e+06 (units), got \"big\"");
}

INSTANTIATE_TEST_SUITE_P(Table, SceneFileError, testing::ValuesIn(kWrong), [](const auto& p) { return p.param.name; });

TEST(SceneFile, SettingsAreValidatedTogether) {
  SceneFile scene = SceneFile::open("earth");
  EXPECT_TRUE(reports(input_error([&] { scene.set("equator.near=200"); }), "scene earth: cameras.equator.far", {"near"}));
  const std::vector<std::string> both{"equator.near=200", "equator.far=300"};
  scene.set(both);
  EXPECT_EQ(scene.description().cameras[0].second.far, 300.0);
  const std::vector<std::string> kind{"turn.type=keyframes", "turn.keys=[[0, [0, 0, 0]], [1, [0, 90, 0]]]"};
  scene.set(kind);
  EXPECT_EQ(scene.at(0.5).objects[0].second.placement.rotation.y, 45.0);
  const std::vector<std::string> target{"turn.type=rate", "turn.target=equator.fov", "turn.rate=5"};
  scene.set(target);
  EXPECT_EQ(scene.at(1).cameras[0].second.fov, 50.0);
  const std::string before = scene.print();
  EXPECT_NE(input_error([&] { scene.set(std::vector<std::string>{"earth.radius=2", "earth.radius=x"}); }), "(no error)");
  EXPECT_EQ(scene.print(), before) << "an error leaves the scene unchanged";
}

TEST(SceneFile, RejectsControlCharacters) {
  SceneFile scene = SceneFile::open("earth");
  for (const std::string& bad : {std::string("\xff"), std::string("a\nb"), std::string("a\0b", 3), std::string("\x1b[31m")}) {
    EXPECT_TRUE(reports(input_error([&] { scene.set("title=" + bad); }), "--set: title", {"control character"}));
  }
  EXPECT_TRUE(reports(input_error([&] { scene.set(std::string("earth.color=a\0b", 15)); }), "--set: earth.color", {"control character"}));
  EXPECT_NO_THROW(scene.set("title=Lüneburg – 月"));
  EXPECT_NE(scene.print().find("月"), std::string::npos);
}

// Paths can contain any bytes except zeros.
TEST(SceneFile, KeepsTheBytesOfPaths) {
  SceneFile scene = SceneFile::open("earth");
  const std::string path = "/a \xe9\n\x7f\\x41 月.png";
  scene.set("earth.height=" + path);
  const auto path_in = [](const SceneFile& s) { return std::get<FilePath>(s.description().objects.at(0).second.height).path.string(); };
  EXPECT_EQ(path_in(scene), path);
  EXPECT_EQ(path_in(SceneFile::parse(scene.print(), "copy", "/")), path);
  EXPECT_NE(scene.print().find(R"("/a \u0000e9\u00000a\u00007f\\x41 月.png")"), std::string::npos);
}

TEST(SceneFile, RejectsTooManyNames) {
  std::string text = "{\"version\": 1";
  for (int i = 0; i < 100000; ++i) text += ", \"a" + std::to_string(i) + "\": 0";
  EXPECT_TRUE(reports(input_error([&] { scene_of(text + "}"); }), "test.json", {"4096 names"}));
}

TEST(SceneFile, AcceptsTinyDirections) {
  SceneFile scene = SceneFile::open("moon");
  scene.set("whole.up=0,1e-300,0");
  scene.set("sun.direction=1e-300,0,1e-300");
  EXPECT_EQ(scene.description().cameras[0].second.up.y, 1e-300);
}

TEST(SceneFile, RejectsDeepNesting) {
  EXPECT_TRUE(reports(input_error([] { scene_of("{\"version\": " + std::string(100000, '[')); }), "test.json", {"nested", "32"}));
}

TEST(SceneFile, AmbiguousNamesNeedTheCollection) {
  SceneFile scene = scene_of(R"({"version": 1, "lights": {"sun": {}}, "objects": {"sun": {}}})");
  EXPECT_TRUE(reports(input_error([&] { scene.set("sun.intensity=2"); }), "--set: sun.intensity", {"'sun'", "lights", "objects"}));
  scene.set("lights.sun.intensity=2");
  EXPECT_EQ(scene.description().lights[0].second.intensity, 2.0);
}

TEST(SceneFile, RejectsPathsOfSections) {
  SceneFile scene = SceneFile::open("earth");
  EXPECT_TRUE(reports(input_error([&] { scene.set("earth=1"); }), "--set: earth", {"section", "objects.earth.KEY"}));
  EXPECT_TRUE(reports(input_error([&] { scene.set("background=1"); }), "--set: background", {"section", "background.KEY"}));
  EXPECT_TRUE(reports(input_error([&] { scene.set("earth.instances.0.position=1,1,1"); }), "--set: earth.instances.0.position",
                      {"no such key", "objects.earth.KEY"}));
  EXPECT_TRUE(reports(input_error([&] { scene.set("objects.erth.radius=1"); }), "--set: objects.erth.radius", {"'erth'", "'earth'"}));
}

TEST(SceneFile, UnknownScenesSuggestTheClosestName) {
  EXPECT_TRUE(reports(input_error([] { SceneFile::open("mooon"); }), "unknown scene", {"'mooon'", "'moon'"}));
  EXPECT_TRUE(reports(input_error([] { SceneFile::open("none.json"); }), "none.json", {"no such"}));
}

TEST(SceneFile, FilesInOtherFormatsGetAListOfFormats) {
  const TemporaryFolder folder;
  const auto error = [&](const char* name, std::string_view text) {
    write_bytes(folder.path() / name, text);
    return input_error([&] { SceneFile::open((folder.path() / name).string()); });
  };
  EXPECT_TRUE(reports(error("model", "v 0 0 0\n"), (folder.path() / "model").string(), {"not recognized", "scene file", ".glb"}));
  EXPECT_TRUE(reports(error("scene.json", "v 0 0 0\n"), (folder.path() / "scene.json").string(), {"invalid JSON"}));
  EXPECT_TRUE(reports(error("scene", "// a comment\n{,}"), (folder.path() / "scene").string(), {"invalid JSON"}));
  EXPECT_EQ(error("good", " \n{\"version\": 1}"), "(no error)");
}

// ---- time ------------------------------------------------------------------------------------------------------

TEST(Animation, RateOrbitAndKeyframesFollowTheirFormulas) {
  const SceneFile scene = scene_of(R"({"version": 1, "objects": {"a": {"rotation": [0, 10, 0]}, "b": {}, "c": {"radius": 1}},
    "animations": {
      "turn": {"type": "rate", "target": "a.rotation", "rate": [0, 5, 0]},
      "orbit": {"type": "orbit", "target": "b.position", "center": [1, 0, 0], "a": [2, 0, 0], "b": [0, 0, -3], "period": 8},
      "grow": {"type": "keyframes", "target": "c.radius", "keys": [[1, 1], [3, 2]], "easing": "smooth", "loop": false}}})");
  EXPECT_EQ(scene.at(0).objects[0].second.placement.rotation, glm::dvec3(0, 10, 0));
  EXPECT_EQ(scene.at(4).objects[0].second.placement.rotation, glm::dvec3(0, 30, 0));
  EXPECT_EQ(scene.at(0).objects[1].second.placement.position, glm::dvec3(3, 0, 0));
  EXPECT_EQ(scene.at(2).objects[1].second.placement.position, glm::dvec3(1, 0, -3)) << "quarter turns are exact";
  EXPECT_EQ(scene.at(0).objects[2].second.radius, 1.0);
  EXPECT_EQ(scene.at(1.5).objects[2].second.radius, 1.0 + 0.25 * 0.25 * 2.5) << "3x^2 - 2x^3 at x = 1/4";
  EXPECT_EQ(scene.at(2).objects[2].second.radius, 1.5);
  EXPECT_EQ(scene.at(9).objects[2].second.radius, 2.0);
}

TEST(Animation, MaterialsChangeTheObjectsThatDoNotOverrideTheKey) {
  const SceneFile scene = scene_of(R"({"version": 1, "materials": {"m": {"shininess": 10}},
    "objects": {"a": {"material": "m"}, "b": {"material": "m", "shininess": 7}, "c": {}},
    "animations": {"t": {"target": "m.shininess", "rate": 5}, "u": {"target": "a.radius", "rate": 1}}})");
  const SceneDescription then = scene.at(2);
  EXPECT_EQ(then.objects[0].second.surface.shininess, 20.0);
  EXPECT_EQ(then.objects[0].second.radius, 3.0) << "other animations still apply";
  EXPECT_EQ(then.objects[1].second.surface.shininess, 7.0);
  EXPECT_EQ(then.objects[2].second.surface.shininess, 32.0);
}

TEST(Animation, KeyframesLoopAndStep) {
  const SceneFile scene = scene_of(R"({"version": 1, "objects": {"a": {}, "b": {}}, "animations": {
      "l": {"type": "keyframes", "target": "a.radius", "keys": [[0, 1], [2, 3]], "easing": "linear"},
      "s": {"type": "keyframes", "target": "b.radius", "keys": [[0, 1], [1, 2], [2, 3]], "easing": "step"}}})");
  EXPECT_EQ(scene.at(5).objects[0].second.radius, 2.0) << "5 s into a loop of 2 s is the time 1 s";
  EXPECT_EQ(scene.at(0.99).objects[1].second.radius, 1.0);
  EXPECT_EQ(scene.at(1).objects[1].second.radius, 2.0);
}

TEST(Animation, SpeedScalesTime) {
  SceneFile scene = SceneFile::open("moon");
  const glm::dvec3 then = scene.at(3).objects[0].second.placement.rotation;
  scene.set("animation.speed=0.5");
  EXPECT_EQ(scene.at(6).objects[0].second.placement.rotation, then);
}

TEST(Animation, ReportsValuesThatLeaveTheirRange) {
  const SceneFile scene =
      scene_of(R"({"version": 1, "objects": {"a": {"radius": 1}}, "animations": {"t": {"target": "a.radius", "rate": -1}}})");
  EXPECT_TRUE(reports(input_error([&] { scene.at(2); }), "test.json: animations.t: a.radius", {"1e-06", "got -1"}));
}

// ---- schema ----------------------------------------------------------------------------------------------------

TEST(Merge, AddsChangesAndRemovesSections) {
  SceneFile scene = SceneFile::parse(R"({"version": 1, "objects": {"a": {"shape": "cube", "size": 2}}})", "test.json", ".");
  scene.set("a.size=3");
  scene.merge(R"({"samples": 4, "objects": {"a": {"segments": 2}, "b": {"shape": "plane"}}})", "patch");
  ASSERT_EQ(scene.description().objects.size(), 2u);
  EXPECT_EQ(scene.description().objects[0].second.size, 3.0) << "a setting is kept";
  EXPECT_EQ(scene.description().objects[0].second.segments, 2);
  EXPECT_EQ(scene.description().head.samples, 4);
  scene.merge(R"({"samples": null, "objects": {"a": null}})", "patch");
  ASSERT_EQ(scene.description().objects.size(), 1u);
  EXPECT_EQ(scene.description().objects[0].first, "b");
  EXPECT_EQ(scene.description().head.samples, 1);
}

TEST(Merge, LeavesTheSceneUnchangedOnErrors) {
  SceneFile scene = SceneFile::parse(R"({"version": 1, "samples": 2})", "test.json", ".");
  EXPECT_TRUE(reports(input_error([&] { scene.merge(R"({"samples": 3})", "patch"); }), "test.json: samples", {"8"}));
  EXPECT_TRUE(reports(input_error([&] { scene.merge("{", "patch"); }), "patch:1:2", {"JSON"}));
  EXPECT_EQ(scene.description().head.samples, 2);
}

// Names as other programs write them: with spaces, capitals, dots, signs and letters of all languages.
constexpr const char* kOddNames = R"json({"version": 1, "textures": {"1": {"source": "moon_color"}}, "materials": {"a.b": {}},
  "objects": {"My Obj": {}, "Cube": {}, "Cube.001": {"material": "a.b"}, "Größe (2)": {"parent": "Cube.001", "instances": [{}]}}})json";

TEST(SceneFile, NamesMayContainSpacesAndDots) {
  SceneFile file = SceneFile::parse(kOddNames, "test.json", {});
  file.set(std::vector<std::string>{"My Obj.radius=2", "Cube.001.radius=3", "objects.Cube.001.visible=false", "Cube.radius=4",
                                    "a.b.shininess=5", "Größe (2).instances.0.position=1,2,3", "My Obj.color=1"});
  const SceneDescription& scene = file.description();
  EXPECT_EQ(find_named(scene.objects, "My Obj")->radius, 2.0);
  EXPECT_EQ(find_named(scene.objects, "Cube.001")->radius, 3.0);
  EXPECT_FALSE(find_named(scene.objects, "Cube.001")->visible);
  EXPECT_EQ(find_named(scene.objects, "Cube")->radius, 4.0);
  EXPECT_EQ(find_named(scene.objects, "Cube.001")->surface.shininess, 5.0);
  EXPECT_EQ(find_named(scene.objects, "Größe (2)")->instances.at(0).position, glm::dvec3(1, 2, 3));
  EXPECT_TRUE(std::holds_alternative<TextureName>(find_named(scene.objects, "My Obj")->surface.color)) << "the texture is named 1";
  EXPECT_TRUE(reports(input_error([&] { file.set("Cube.001.radus=1"); }), "--set: Cube.001.radus", {"radius"}));
  EXPECT_TRUE(reports(input_error([&] { file.set("Cube.001=1"); }), "--set: Cube.001", {"section", "objects.Cube.001.KEY"}));
  EXPECT_EQ(SceneFile::parse(file.print(), "again.json", {}).print(), file.print());
}

TEST(Schema, FileInDocsIsUpToDate) {
  EXPECT_TRUE(read_bytes("docs/reference/scene.schema.json") == scene_schema())
      << "to update it, run: halfspace list --schema > docs/reference/scene.schema.json";
}

// Checks that an independent validator (Python's jsonschema) accepts and rejects the same scenes as the program.
TEST(Schema, AcceptsAndRejectsTheSameScenesAsTheProgram) {
  if (!command_works("python3 -c 'import jsonschema'")) GTEST_SKIP() << "python3-jsonschema is absent";
  const TemporaryFolder folder;
  const fs::path& directory = folder.path();
  std::ofstream(directory / "check.py") << R"(
import json, sys
from jsonschema import Draft202012Validator as V
d = sys.argv[1]
schema = json.load(open(d + '/schema.json'))
V.check_schema(schema)
ok = [json.load(open(d + '/' + n)) for n in sys.argv[2].split()]
bad = [json.load(open(d + '/' + n)) for n in sys.argv[3].split()]
sys.exit(0 if all(V(schema).is_valid(s) for s in ok) and not any(V(schema).is_valid(s) for s in bad) else 1)
)";
  std::ofstream(directory / "schema.json") << scene_schema();
  std::string right, wrong;
  for (const ShippedScene& scene : shipped_scenes()) {
    std::ofstream(directory / scene.name) << SceneFile::open(std::string(scene.name)).print();
    right += std::string(scene.name) + " ";
  }
  std::ofstream(directory / "names") << kOddNames;
  right += "names ";
  for (const Wrong& w : kWrong) {
    for (const char* kind : {"NoVersion", "OtherVersion", "Section", "Key", "Type", "Range", "Fraction", "Vector", "Choice", "Boolean",
                             "Name", "NameEndsWithSpace", "NameLooksLikeColor", "NoObject"}) {
      if (std::string(w.name) != kind) continue;
      std::ofstream(directory / w.name) << w.text;
      wrong += std::string(w.name) + " ";
    }
  }
  const std::string command =
      "python3 " + (directory / "check.py").string() + " " + directory.string() + " '" + right + "' '" + wrong + "'";
  EXPECT_EQ(run_command(command).exit_code, 0);
}

}  // namespace
}  // namespace halfspace
