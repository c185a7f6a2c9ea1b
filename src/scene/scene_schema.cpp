// SPDX-License-Identifier: Apache-2.0
#include "halfspace/scene/scene_file.h"

#include <nlohmann/json.hpp>

#include "halfspace/scene/scene_paths.h"

namespace halfspace::HS_LANES {

namespace {

// The names that the reader accepts.
constexpr const char* kNamePattern = R"(^[^ #=,\x00-\x1f\x7f]([^=,\x00-\x1f\x7f]*[^ =,\x00-\x1f\x7f])?$)";

// Lists the keys of all kinds. The schema does not express which kind has which key; the program checks that.
Json schema_of(const Section& section) {
  Json properties = Json::object();
  for (const Fields& part : section) {
    for (const Key& key : part.keys) {
      properties[key.name] = schema_of(key);
      properties[key.name]["default"] = value_of({&key, key.member(part.data)});
    }
  }
  return {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
}

}  // namespace

std::string scene_schema() {
  SceneDescription scene;
  Json schema = schema_of(section_of(scene.head));
  Json& properties = schema["properties"];
  properties["version"] = {{"const", SceneFile::kVersion}};
  properties["$schema"] = {{"type", "string"}};
  for_each_single(scene, [&](const char* name, const char* help, auto& value) {
    properties[name] = schema_of(section_of(value));
    properties[name]["description"] = help;
  });
  for_each_collection(scene, [&](const char* name, const char* help, auto& list) {
    typename std::decay_t<decltype(list)>::value_type::second_type thing;
    Json item = schema_of(section_of(thing));
    item["description"] = help;
    if constexpr (std::is_same_v<decltype(thing), ObjectDescription>) {
      Placement p;
      item["properties"][kInstances] = {{"type", "array"}, {"items", schema_of(section_of(p))}};
    }
    properties[name] = {{"type", "object"}, {"propertyNames", {{"pattern", kNamePattern}}}, {"additionalProperties", item}};
  });
  Json out = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Halfspace scene"}};
  out.update(schema);
  out["required"] = {"version"};
  return out.dump(2) + "\n";
}

}  // namespace halfspace::HS_LANES
