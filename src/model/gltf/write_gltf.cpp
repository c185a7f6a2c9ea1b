// SPDX-License-Identifier: Apache-2.0
//
// glTF files: cameras, lights, skins, animations, and the assembly of the file.
#include "halfspace/model/gltf/write_gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "halfspace/core/check.h"
#include "halfspace/model/gltf/gltf_output.h"

namespace halfspace::HS_LANES {

namespace {

OutputJson camera_json(const ModelCamera& c) {
  OutputJson json;
  if (!c.name.empty()) json["name"] = c.name;
  json["type"] = c.perspective ? "perspective" : "orthographic";
  if (c.perspective) {
    json["perspective"] = {{"yfov", c.fovy}, {"znear", c.near}};
    if (std::isfinite(c.far)) json["perspective"]["zfar"] = c.far;
  } else {
    json["orthographic"] = {{"xmag", 0.5 * c.height}, {"ymag", 0.5 * c.height}, {"znear", c.near}, {"zfar", c.far}};
  }
  return json;
}

OutputJson light_json(const ModelLight& l) {
  OutputJson json;
  if (!l.name.empty()) json["name"] = l.name;
  json["type"] = l.type == ModelLightType::directional ? "directional" : l.type == ModelLightType::point ? "point" : "spot";
  if (l.color != glm::vec3(1.0f)) json["color"] = json_array(l.color);
  json["intensity"] = l.intensity;
  if (l.range > 0.0 && l.type != ModelLightType::directional) json["range"] = l.range;
  if (l.type == ModelLightType::spot) json["spot"] = {{"innerConeAngle", l.inner}, {"outerConeAngle", l.outer}};
  return json;
}

OutputJson skin_json(const ModelSkin& skin, GltfOutput& out) {
  std::vector<glm::mat4> matrices(skin.joint_from_mesh.begin(), skin.joint_from_mesh.end());
  return {{"joints", skin.joints}, {"inverseBindMatrices", out.accessor(matrices, GltfOutput::Use::other)}};
}

const char* path_of(AnimatedProperty property) {
  switch (property) {
    case AnimatedProperty::translation: return "translation";
    case AnimatedProperty::rotation: return "rotation";
    case AnimatedProperty::scale: return "scale";
    case AnimatedProperty::weights: return "weights";
    case AnimatedProperty::visibility: break;
  }
  return "pointer";
}

// Writes the channel's values as vectors with the width of its property.
int key_accessor(const AnimationChannel& channel, GltfOutput& out) {
  constexpr auto kOther = GltfOutput::Use::other;
  if (channel.property == AnimatedProperty::weights) return out.accessor(channel.values, kOther);
  if (channel.property == AnimatedProperty::visibility) return out.flag_accessor(channel.values);
  if (channel.property == AnimatedProperty::rotation) {
    std::vector<glm::vec4> values;
    for (std::size_t i = 0; i + 3 < channel.values.size(); i += 4)
      values.emplace_back(channel.values[i], channel.values[i + 1], channel.values[i + 2], channel.values[i + 3]);
    return out.accessor(values, kOther);
  }
  std::vector<glm::vec3> values;
  for (std::size_t i = 0; i + 2 < channel.values.size(); i += 3)
    values.emplace_back(channel.values[i], channel.values[i + 1], channel.values[i + 2]);
  return out.accessor(values, kOther);
}

OutputJson target_json(const AnimationChannel& channel, GltfOutput& out) {
  OutputJson target = {{"path", path_of(channel.property)}};
  if (channel.property == AnimatedProperty::visibility) {
    const std::string pointer = "/nodes/" + std::to_string(channel.node) + "/extensions/KHR_node_visibility/visible";
    out.extend(target, "KHR_animation_pointer", {{"pointer", pointer}});
  } else {
    target["node"] = channel.node;
  }
  return target;
}

OutputJson animation_json(const ModelAnimation& animation, GltfOutput& out) {
  OutputJson json;
  if (!animation.name.empty()) json["name"] = animation.name;
  for (const AnimationChannel& channel : animation.channels) {
    const int times = out.accessor(channel.times, GltfOutput::Use::other);
    out.set_bounds(times, channel.times, 1);
    const char* interpolation = channel.interpolation == KeyInterpolation::step     ? "STEP"
                                : channel.interpolation == KeyInterpolation::linear ? "LINEAR"
                                                                                    : "CUBICSPLINE";
    json["channels"].push_back({{"sampler", json["channels"].size()}, {"target", target_json(channel, out)}});
    json["samplers"].push_back({{"input", times}, {"interpolation", interpolation}, {"output", key_accessor(channel, out)}});
  }
  return json;
}

void append_chunk(std::vector<std::byte>& glb, const char* type, std::span<const std::byte> data, char padding) {
  const std::size_t padded = (data.size() + 3) / 4 * 4;
  append_value(glb, static_cast<uint32_t>(padded));
  append_text(glb, std::string_view(type, 4));
  glb.insert(glb.end(), data.begin(), data.end());
  glb.insert(glb.end(), padded - data.size(), static_cast<std::byte>(padding));
}

std::vector<std::byte> glb_of(const std::string& json, const std::vector<std::byte>& buffer) {
  std::vector<std::byte> chunks, glb;
  append_chunk(chunks, "JSON", std::as_bytes(std::span(json)), ' ');
  if (!buffer.empty()) append_chunk(chunks, "BIN\0", buffer, '\0');
  append_text(glb, "glTF");
  append_value(glb, uint32_t{2});
  append_value(glb, static_cast<uint32_t>(chunks.size() + 12));
  glb.insert(glb.end(), chunks.begin(), chunks.end());
  return glb;
}

// Returns the document as text. Invalid UTF-8 in names is replaced with replacement characters.
std::string dumped(const OutputJson& json, int indent) { return json.dump(indent, ' ', false, OutputJson::error_handler_t::replace); }

}  // namespace

void write_gltf_cameras_and_lights(const Model& model, GltfOutput& out) {
  for (const ModelCamera& camera : model.cameras) out.add("cameras", camera_json(camera));
  OutputJson lights = OutputJson::array();
  for (const ModelLight& light : model.lights) lights.push_back(light_json(light));
  if (!lights.empty()) out.extend(out.json, "KHR_lights_punctual", {{"lights", lights}});
  OutputJson variants = OutputJson::array();
  for (const std::string& name : model.variants) variants.push_back({{"name", name}});
  if (!variants.empty()) out.extend(out.json, "KHR_materials_variants", {{"variants", variants}});
}

void write_gltf_skins_and_animations(const Model& model, GltfOutput& out) {
  for (const ModelSkin& skin : model.skins) out.add("skins", skin_json(skin, out));
  for (const ModelAnimation& animation : model.animations) {
    if (!animation.channels.empty()) out.add("animations", animation_json(animation, out));
  }
}

WrittenModel write_gltf(const Model& model, const std::string& stem, bool binary) {
  constexpr std::size_t kMaxGlb = 0xffffffffu;
  GltfOutput out;
  write_gltf_cameras_and_lights(model, out);
  const GltfTextureOutput textures = write_gltf_textures(model, stem, binary, out);
  write_gltf_materials(model, textures.textures, out);
  write_gltf_meshes_and_nodes(model, out);
  write_gltf_skins_and_animations(model, out);
  WrittenModel written;
  const std::string buffer_name = stem + ".bin";
  if (!out.buffer.empty()) {
    OutputJson buffer = {{"byteLength", out.buffer.size()}};
    if (!binary) buffer["uri"] = percent_encoded(buffer_name);
    out.add("buffers", std::move(buffer));
  }
  const std::string json = dumped(out.json, binary ? -1 : 1);
  if (binary && json.size() + out.buffer.size() + 32 > kMaxGlb)
    throw OutputError(fmt::format("{}.glb: is larger than 4 GiB; expected a smaller model, or .gltf", stem));
  if (binary) {
    written.files.push_back({stem + ".glb", glb_of(json, out.buffer)});
  } else {
    written.files.push_back({stem + ".gltf", {}});
    append_text(written.files[0].bytes, json);
    if (!out.buffer.empty()) written.files.push_back({buffer_name, std::move(out.buffer)});
    for (const GltfImageFile& image : textures.files)
      written.files.push_back({image.name, *model.images[static_cast<std::size_t>(image.image)].bytes});
  }
  written.warnings = std::move(out.warnings);
  return written;
}

}  // namespace halfspace::HS_LANES
