// SPDX-License-Identifier: Apache-2.0
#include "halfspace/model/gltf/gltf_draco.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "halfspace/model/gltf/gltf_indices.h"

namespace halfspace::HS_LANES {

namespace {

constexpr const char* kExtension = "KHR_draco_mesh_compression";

struct Wanted {
  std::vector<std::string> names;
  std::vector<uint32_t> ids;
};

// Returns the attributes of the extension. They must also be attributes of the primitive.
Wanted wanted_attributes(const GltfDocument& document, const GltfValue& extension, const GltfValue& attributes) {
  const GltfValue& json = document.object(extension, "attributes");
  Wanted wanted;
  for (const auto& [name, id] : json.items()) {
    if (document.find(attributes, name.c_str()) == nullptr)
      document.fail(json, name, "is not an attribute of the primitive; expected only attributes that it has");
    wanted.names.push_back(name);
    wanted.ids.push_back(static_cast<uint32_t>(document.integer(json, name.c_str(), 0, 0xffffffffu)));
  }
  if (wanted.ids.size() > kMaxDracoAttributes)
    document.fail(json, fmt::format("has {} attributes; expected at most {}", wanted.ids.size(), kMaxDracoAttributes));
  return wanted;
}

}  // namespace

bool can_decode_draco() { return !find_draco_tool().empty(); }

// The primitive may also have uncompressed values, but this is optional.
void GltfDraco::check_fallback(const GltfValue& primitive) const {
  const GltfAccessor positions = accessors_.describe(document_.object(primitive, "attributes"), "POSITION");
  if (document_.find(*positions.json, "bufferView") != nullptr || document_.find(*positions.json, "sparse") != nullptr) return;
  document_.fail(primitive, std::string("is compressed with ") + kExtension + " and " + kDracoToolName +
                                " is not installed; expected uncompressed values, or that program");
}

GltfAccessor GltfDraco::checked_accessor(const GltfValue& object, const char* key, std::size_t count) const {
  const GltfAccessor accessor = accessors_.describe(object, key);
  if (accessor.count != count) {
    document_.fail(*accessor.json, "count",
                   fmt::format("{}, but the compressed mesh has {} values; expected the same number", accessor.count, count));
  }
  return accessor;
}

bool GltfDraco::decode(const GltfValue& primitive) {
  accessors_.clear_decoded();
  const GltfValue* extension = document_.extension(primitive, kExtension);
  if (extension == nullptr) return false;
  if (!can_decode_draco()) {
    check_fallback(primitive);
    return false;
  }
  const auto mode = static_cast<GltfMode>(document_.integer(primitive, "mode", 4, 6));
  if (mode != GltfMode::triangles && mode != GltfMode::triangle_strip)
    document_.fail(primitive, "mode", "is not a mode of compressed meshes; expected 4 or 5 (triangles or a triangle strip)");
  const GltfValue& attributes = document_.object(primitive, "attributes");
  const Wanted wanted = wanted_attributes(document_, *extension, attributes);
  const int view = document_.required_index(*extension, "bufferView", document_.list("bufferViews").size());
  DracoMesh mesh = process_.decode(accessors_.view_bytes(static_cast<std::size_t>(view)), wanted.ids, document_.memory_left());
  if (!mesh.problem.empty()) document_.fail(*extension, mesh.problem);
  document_.take_memory(*extension, mesh.indices.size(), 1);
  const std::size_t corners = mesh.indices.size() / sizeof(uint32_t);
  const GltfAccessor indices =
      mode == GltfMode::triangles ? checked_accessor(primitive, "indices", corners) : accessors_.describe(primitive, "indices");
  accessors_.check_width(indices, 1);
  accessors_.set_decoded(indices.index, {std::move(mesh.indices), corners, GltfComponent::uint32});
  for (std::size_t i = 0; i < wanted.names.size(); ++i) {
    const GltfAccessor accessor = checked_accessor(attributes, wanted.names[i].c_str(), mesh.points);
    const DracoAttributeHeader& type = mesh.attributes[i].type;
    if (static_cast<uint32_t>(accessor.component) != type.component || static_cast<uint32_t>(accessor.width) != type.width) {
      document_.fail(*accessor.json,
                     fmt::format("has {} components of type {}, but the compressed mesh has {} of type {}; expected the same",
                                 accessor.width, static_cast<int>(accessor.component), type.width, type.component));
    }
    document_.take_memory(*extension, mesh.attributes[i].values.size(), 1);
    accessors_.set_decoded(accessor.index, {std::move(mesh.attributes[i].values), mesh.points, accessor.component});
  }
  return true;
}

}  // namespace halfspace::HS_LANES
